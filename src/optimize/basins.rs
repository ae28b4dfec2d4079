//! Local optima found by the searches, and the estimated share of the space in basins not yet seen.
//!
//! ```math
//! u = w (w + 1) / (N (N − 1))
//! ```
//!
//! is the expected share of the space in basins of attraction not yet seen, after local searches
//! from N uniform points came to w different optima (Boender and Rinnooy Kan: *Bayesian stopping
//! rules for multistart global optimization methods*, Mathematical Programming 37, 1987; the
//! numbers and sizes of the basins are a priori equally likely). Optima that other searches found
//! count in w, which makes u the larger; their starts never count in N.

use super::{
    evaluations::near,
    local::{ARRIVED, Found, NEIGHBOUR, Status},
    problem::{EQUAL_OBJECTIVES, Point},
};

/// Difference of objectives up to which a stalled search counts as arrived at an optimum in its
/// neighbourhood.
const STALLED_DIFFERENCE: f64 = 1e-3;

/// A local optimum.
#[derive(Debug, Clone)]
pub struct Optimum {
    /// The best design that a search came to in its basin.
    pub found: Found,
    /// Searches that came to it.
    pub searches: usize,
}

/// All local optima of a problem seen so far. Searches that end without a feasible design count as
/// one outcome: the design of least violation.
#[derive(Debug, Default)]
pub(super) struct Basins {
    optima: Vec<Optimum>,
    uniform: usize,
}

impl Basins {
    /// Adds the result of a search, from a uniform point or not.
    pub fn add(&mut self, found: Found, is_uniform: bool) {
        self.uniform += usize::from(is_uniform);
        let known = self.optima.iter_mut().find(|o| same(&o.found, &found));
        let Some(known) = known else {
            self.optima.push(Optimum { found, searches: 1 });
            return;
        };
        known.searches += 1;
        let rank = |found: &Found| u8::from(found.status != Status::Optimal);
        let order = rank(&found).cmp(&rank(&known.found));
        let order = order.then_with(|| found.point.order(&known.found.point));
        if order.is_lt() {
            known.found = found;
        }
    }

    /// Number of local searches from uniform points.
    pub fn uniform(&self) -> usize {
        self.uniform
    }

    /// Number of local searches.
    pub fn searches(&self) -> usize {
        self.optima.iter().map(|o| o.searches).sum()
    }

    /// Expected share of the space in basins not yet seen, u; 1 before two searches from uniform points.
    pub fn unseen(&self) -> f64 {
        unseen(self.optima.len(), self.uniform)
    }

    /// Number of different optima.
    pub fn optima(&self) -> usize {
        self.optima.len()
    }

    /// Best design of each.
    pub fn found(&self) -> impl Iterator<Item = &Found> {
        self.optima.iter().map(|o| &o.found)
    }

    /// The best of all.
    pub fn best(&self) -> Option<&Found> {
        self.found().min_by(|a, b| a.point.order(&b.point))
    }

    /// The optima, the best first.
    pub fn into_optima(self) -> Vec<Optimum> {
        let mut optima = self.optima;
        optima.sort_by(|a, b| a.found.point.order(&b.found.point));
        optima
    }
}

/// Expected share of the space in basins not yet seen, after searches from `uniform` points came to
/// `optima` different ones.
pub fn unseen(optima: usize, uniform: usize) -> f64 {
    if uniform < 2 {
        return 1.0;
    }
    let (w, n) = (optima as f64, uniform as f64);
    (w * (w + 1.0) / (n * (n - 1.0))).min(1.0)
}

/// True if a design is better than an optimum by more than tolerances explain: by more than the violation
/// that the constraint tolerance allows is worth at the optimum's multipliers.
pub(super) fn is_overtaken(optimum: &Found, by: &Point) -> bool {
    if !by.better_than(&optimum.point) {
        return false;
    }
    if !by.feasible() || !optimum.point.feasible() {
        return true;
    }
    let (Some(certificate), Ok(own), Ok(others)) =
        (&optimum.certificate, &optimum.point.values, &by.values)
    else {
        return true;
    };
    let price: f64 = certificate.constraint_multipliers.iter().sum();
    let owed = price * (others.violation() - own.violation()).max(0.0);
    own.objective() - others.objective() > EQUAL_OBJECTIVES + owed
}

/// True if two searches came to the same optimum.
pub(super) fn same(a: &Found, b: &Found) -> bool {
    let (p, q) = (&a.point, &b.point);
    if p.feasible() != q.feasible() {
        return false;
    }
    if !p.feasible() || near(&p.x, &q.x, ARRIVED) {
        return true;
    }
    let apart = (p.objective() - q.objective()).abs();
    let stalled = a.status != Status::Optimal || b.status != Status::Optimal;
    apart < EQUAL_OBJECTIVES || stalled && apart < STALLED_DIFFERENCE && near(&p.x, &q.x, NEIGHBOUR)
}

#[cfg(test)]
mod tests {
    use super::unseen;

    /// Boender and Rinnooy Kan's estimate and the least N that brings it to 5 %.
    #[test]
    fn unseen_share_by_the_number_of_optima() {
        for (optima, least) in [(1, 7), (2, 12), (3, 16), (5, 25), (10, 48)] {
            assert!(unseen(optima, least) <= 0.05, "{optima}");
            assert!(unseen(optima, least - 1) > 0.05, "{optima}");
        }
        assert!((unseen(2, 12) - 6.0 / 132.0).abs() < 1e-15);
        assert!((unseen(1, 1) - 1.0).abs() < 1e-15);
    }
}
