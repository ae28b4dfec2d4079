//! The multipliers that come nearest to the first-order conditions of a design.
//!
//! ```math
//! minimise  ½ |G y|² + cᵀy   subject to   y ≥ 0,   Σ_i μ_ki = 1 for every objective k
//! ```
//!
//! Columns of G are the gradients of the pieces and the outward normals of the bounds; c is how far
//! each piece is from being active. G y is the residual of stationarity, cᵀy of complementarity.
//!
//! Few of many pieces are active. Beyond [`FEW`] the program is solved for the pieces nearest to
//! being active; a column left out belongs in it if its reduced cost is negative,
//!
//! ```math
//! g_jᵀ(G y) + c_j + z_k < 0,   z_k the multiplier of Σ_i μ_ki = 1 (0 for a constraint)
//! ```
//!
//! and joins until there is none (column generation, Dantzig and Wolfe 1960): the minimum is that of
//! all columns, and the time grows with their number, not with its cube.

use nalgebra::{DMatrix, DVector};

use super::{problem::Values, subproblem, surrogate::Surrogate};

/// Number of pieces in the first program, and of pieces that join it at a time.
const FEW: usize = 128;
/// Reduced cost that counts as zero: the accuracy of the program.
const ZERO_REDUCED_COST: f64 = 1e-9;
/// Weight of the squares of the multipliers: among equal sums of gradients the smallest multipliers win.
const RIDGE: f64 = 1e-12;

/// The columns of the first-order conditions: objective pieces, constraint pieces, lower bounds,
/// upper bounds.
pub(super) struct Conditions {
    n: usize,
    /// Gradients and outward normals.
    columns: Vec<DVector<f64>>,
    /// Distance of each from being active.
    pub gaps: Vec<f64>,
    /// Objective that each piece belongs to; `None` for a constraint.
    pub groups: Vec<Option<usize>>,
}

impl Conditions {
    /// Conditions of a design at scaled coordinates `x`.
    pub fn new(surrogate: &Surrogate, values: &Values, x: &[f64]) -> Self {
        let n = x.len();
        let objectives = surrogate.objectives.iter().enumerate();
        let groups = objectives.flat_map(|(k, pieces)| vec![Some(k); pieces.len()]);
        let groups = groups.chain(vec![None; surrogate.constraints.len()]);
        let pieces = surrogate.objectives.iter().flatten();
        let pieces = pieces.chain(&surrogate.constraints);
        let axis = |i: usize, sign: f64| {
            let mut normal = DVector::zeros(n);
            normal[i] = sign;
            normal
        };
        let columns = pieces.map(|piece| piece.gradient.clone());
        let columns = columns.chain((0..n).map(|i| axis(i, -1.0)));
        let columns = columns.chain((0..n).map(|i| axis(i, 1.0)));
        let gaps = values.objectives.iter().flat_map(|pieces| {
            let top = super::problem::largest(pieces);
            pieces.iter().map(move |p| top - p.value)
        });
        let slacks = values.constraints.iter().map(|p| (-p.value).max(0.0));
        let gaps = gaps.chain(slacks).chain(x.iter().copied());
        let gaps = gaps.chain(x.iter().map(|x| 1.0 - x));
        Self {
            n,
            columns: columns.collect(),
            gaps: gaps.collect(),
            groups: groups.collect(),
        }
    }

    /// G y.
    pub fn gradient_sum(&self, y: &[f64]) -> DVector<f64> {
        let mut sum = DVector::zeros(self.n);
        for (column, y) in self.columns.iter().zip(y).filter(|(_, y)| **y != 0.0) {
            sum.axpy(*y, column, 1.0);
        }
        sum
    }

    /// y, column by column. `None` if Clarabel fails.
    pub fn multipliers(&self) -> Option<Vec<f64>> {
        let pieces = self.groups.len();
        let mut weighed: Vec<bool> = vec![pieces <= FEW; pieces];
        if pieces > FEW {
            self.nearest(&mut weighed);
        }
        loop {
            let chosen: Vec<usize> = (0..self.columns.len())
                .filter(|j| weighed.get(*j).copied().unwrap_or(true))
                .collect();
            let (own, duals) = self.program(&chosen)?;
            let mut y = vec![0.0; self.columns.len()];
            for (j, own) in chosen.iter().zip(own) {
                y[*j] = own.max(0.0);
            }
            let sum = self.gradient_sum(&y);
            let cost = |j: usize| {
                let dual = self.groups[j].map_or(0.0, |k| duals[k]);
                self.columns[j].dot(&sum) + self.gaps[j] + dual
            };
            let left_out = (0..pieces).filter(|j| !weighed[*j]);
            let mut wanted: Vec<(f64, usize)> = left_out
                .map(|j| (cost(j), j))
                .filter(|(cost, _)| *cost < -ZERO_REDUCED_COST)
                .collect();
            if wanted.is_empty() {
                return Some(y);
            }
            wanted.sort_by(|(a, i), (b, j)| a.total_cmp(b).then(i.cmp(j)));
            for (_, j) in wanted.into_iter().take(FEW) {
                weighed[j] = true;
            }
        }
    }

    /// Marks the pieces nearest to holding, [`FEW`] and all that hold fully: every objective has one
    /// such.
    fn nearest(&self, weighed: &mut [bool]) {
        let mut order: Vec<usize> = (0..weighed.len()).collect();
        order.sort_by(|i, j| self.gaps[*i].total_cmp(&self.gaps[*j]).then(i.cmp(j)));
        for (rank, j) in order.into_iter().enumerate() {
            let is_largest = self.groups[j].is_some() && self.gaps[j] <= 0.0;
            weighed[j] = rank < FEW || is_largest;
        }
    }

    /// Solves the program for some of the columns: their multipliers, and those of the objectives'
    /// sums.
    fn program(&self, chosen: &[usize]) -> Option<(Vec<f64>, Vec<f64>)> {
        let count = chosen.len();
        let groups = self
            .groups
            .iter()
            .flatten()
            .max()
            .map_or(0, |last| last + 1);
        let mut g = DMatrix::zeros(self.n, count);
        let mut a = DMatrix::zeros(groups + count, count);
        let mut b = vec![0.0; groups + count];
        b[..groups].fill(1.0);
        for (i, &j) in chosen.iter().enumerate() {
            g.set_column(i, &self.columns[j]);
            if let Some(k) = self.groups.get(j).copied().flatten() {
                a[(k, i)] = 1.0;
            }
            a[(groups + i, i)] = -1.0;
        }
        let mut p = g.transpose() * &g;
        for i in 0..count {
            p[(i, i)] += RIDGE;
        }
        let gaps: Vec<f64> = chosen.iter().map(|j| self.gaps[*j]).collect();
        let (y, z) = subproblem::solve(&p, &gaps, &a, &b, groups)?;
        Some((y, z[..groups].to_vec()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optimize::{problem::Piece, surrogate::Quadratic};

    /// A number between −1 and 1 that looks random, from a number.
    fn scattered(k: usize) -> f64 {
        2.0 * (k as f64 * 0.754_877_666).fract() - 1.0
    }

    /// Many pieces in two objectives and constraints, some of them nearly holding.
    fn many(pieces: usize, n: usize) -> Conditions {
        let quadratic = |k: usize| Quadratic {
            value: -scattered(3 * k + 1).abs().powi(4),
            gradient: DVector::from_fn(n, |i, _| scattered(7 * k * (i + 2) + i)),
            hessian: DMatrix::zeros(n, n),
        };
        let part = |from: usize| (from..from + pieces).map(quadratic).collect::<Vec<_>>();
        let surrogate = Surrogate {
            objectives: vec![part(0), part(pieces)],
            constraints: part(2 * pieces),
        };
        let own = |pieces: &[Quadratic]| {
            let pieces = pieces.iter().enumerate();
            pieces.map(|(i, q)| Piece::single(i, q.value)).collect()
        };
        let values = Values {
            objectives: surrogate.objectives.iter().map(|p| own(p)).collect(),
            constraints: own(&surrogate.constraints),
        };
        Conditions::new(&surrogate, &values, &vec![0.4; n])
    }

    /// ½ |G y|² + cᵀy.
    fn cost(conditions: &Conditions, y: &[f64]) -> f64 {
        let gaps = y.iter().zip(&conditions.gaps).map(|(y, c)| y * c);
        conditions.gradient_sum(y).norm_squared() / 2.0 + gaps.sum::<f64>()
    }

    /// Column generation reaches the minimum over all columns.
    #[test]
    fn columns_left_out_change_no_minimum() {
        for n in [2, 5] {
            let conditions = many(150, n);
            assert!(conditions.groups.len() > 3 * FEW);
            let every: Vec<usize> = (0..conditions.columns.len()).collect();
            let (all, _) = conditions.program(&every).unwrap();
            let few = conditions.multipliers().unwrap();
            let (all, few) = (cost(&conditions, &all), cost(&conditions, &few));
            // Clarabel's own tolerance on the objective, 1e-8.
            assert!((all - few).abs() < 1e-7, "{n} variables: {all} {few}");
        }
    }

    /// Multipliers of an objective add up to one, and a piece far from holding has none.
    #[test]
    fn sums_and_gaps_hold() {
        let conditions = many(150, 3);
        let y = conditions.multipliers().unwrap();
        for k in 0..2 {
            let own = conditions
                .groups
                .iter()
                .zip(&y)
                .filter(|(g, _)| **g == Some(k));
            let sum: f64 = own.map(|(_, y)| y).sum();
            assert!((sum - 1.0).abs() < 1e-7);
        }
        let held = y.iter().zip(&conditions.gaps).filter(|(y, _)| **y > 1e-4);
        assert!(held.into_iter().all(|(_, gap)| *gap < 0.5));
    }
}
