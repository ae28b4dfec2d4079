//! Designs of a front's points for one wheel profile.

use std::cell::RefCell;

use super::front::{FrontPoint, badness, of_badness};
use crate::{
    design::{
        explain::Explained,
        margin::worst_value,
        search::{Searched, search_feasible},
        study::Study,
    },
    index::Index,
    optimize::{
        archive::Archive,
        local::{Status, WIDE},
        problem::Failure,
        solve::{NoDesign, Start},
    },
    spec::Condition,
};

/// By how much a bound that is an end of the front is loosened to choose among the designs that
/// reach it, in badness.
pub(super) const END: f64 = 1e-3;

/// Bounds on indices, SI.
pub(super) type Bounds = Vec<(Index, f64)>;

/// A search for the best of one index within bounds on others.
#[derive(Debug, Clone)]
pub(super) struct Aim {
    /// Index optimised.
    pub objective: Index,
    /// Bounds on the others.
    pub bounds: Bounds,
}

/// The search for points of one profile.
pub(super) struct Tracer<'a> {
    /// Number of the wheel profile.
    pub profile: usize,
    /// Parameters, and demands on indices that are not traded off.
    pub study: Study,
    pub conditions: &'a [Condition],
    pub indices: &'a [Index],
    /// Start of a search everywhere.
    pub everywhere: Start,
    pub archive: &'a Archive<'a>,
    pub name: String,
    /// Designs of the basins seen so far.
    pub pool: Pool,
}

/// Designs in different basins, scaled.
pub(super) struct Pool(RefCell<Vec<Vec<f64>>>);

impl Pool {
    /// Designs kept at most; the latest are.
    const KEPT: usize = 5;
    /// Designs of different basins differ by this in some variable.
    const APART: f64 = 0.15;

    pub fn new(given: Vec<f64>) -> Self {
        Self(RefCell::new(vec![given]))
    }

    fn add(&self, x: &[f64]) {
        let mut designs = self.0.borrow_mut();
        designs.retain(|known| !is_near(known, x));
        designs.push(x.to_vec());
        if designs.len() > Self::KEPT {
            designs.remove(0);
        }
    }

    /// Designs followed by the designs of the pool that are not near any of them.
    fn with_others(&self, mut designs: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        let pool = self.0.borrow();
        let is_other = |x: &&Vec<f64>| !designs.iter().any(|known| is_near(known, x));
        let others: Vec<Vec<f64>> = pool.iter().filter(is_other).cloned().collect();
        designs.extend(others);
        designs
    }
}

fn is_near(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < Pool::APART)
}

impl Tracer<'_> {
    /// The best point of an aim, from designs `near` it and from the designs of all basins seen. `None` if
    /// no design found keeps the bounds, or the run ended before.
    pub fn follow(&self, aim: &Aim, near: Vec<Vec<f64>>) -> Option<FrontPoint> {
        self.beside(aim, self.pool.with_others(near))
    }

    /// The best point of an aim from designs near it alone.
    pub fn beside(&self, aim: &Aim, near: Vec<Vec<f64>>) -> Option<FrontPoint> {
        let start = Start {
            radius: WIDE / 2.0,
            ..Start::near(near)
        };
        self.solve(aim, &start).ok().flatten()
    }

    /// As [`Tracer::follow`], searched everywhere too.
    ///
    /// # Errors
    ///
    /// [`NoDesign`] if no design could be evaluated.
    pub fn everywhere(
        &self,
        aim: &Aim,
        near: Vec<Vec<f64>>,
    ) -> Result<Option<FrontPoint>, NoDesign> {
        let start = self.everywhere.clone();
        self.solve(aim, &start.with(self.pool.with_others(near)))
    }

    /// As [`Tracer::everywhere`], from uniform points and the basins seen, without far ends: the
    /// neighbours' basins take their place.
    ///
    /// # Errors
    ///
    /// [`NoDesign`] if no design could be evaluated.
    pub fn verify(&self, aim: &Aim, near: Vec<Vec<f64>>) -> Result<Option<FrontPoint>, NoDesign> {
        let start = self.everywhere.clone().plainly();
        self.solve(aim, &start.with(self.pool.with_others(near)))
    }

    /// Point of an aim; `None` if no design found keeps the bounds, or the run ended before it converged.
    pub fn solve(&self, aim: &Aim, start: &Start) -> Result<Option<FrontPoint>, NoDesign> {
        let mut study = self.study.clone();
        for condition in 0..study.conditions() {
            study = study.optimise(condition, aim.objective, 0, 1.0);
            for (index, bound) in &aim.bounds {
                study = study.demand(condition, *index, *bound);
            }
        }
        let Some(mut searched) = search_feasible(&study, start, self.archive)? else {
            return Ok(None);
        };
        if start.everywhere.is_some() {
            searched.add_curvature(self.archive);
        }
        let Searched { study, solved, .. } = &searched;
        if matches!(solved.status, Status::BudgetSpent | Status::Interrupted) {
            return Ok(None);
        }
        let n = study.parameters().len();
        for optimum in solved.optima.iter().rev() {
            let point = &optimum.found.point;
            if point.feasible() {
                self.pool.add(&point.x[..n]);
            }
        }
        let x = solved.point.x[..n].to_vec();
        let case = study.design(&x);
        let values = self
            .indices
            .iter()
            .map(|i| worst_value(&case, self.conditions, *i));
        // A design without one of the indices is no point.
        let Ok(values) = values.collect::<Result<Vec<f64>, Failure>>() else {
            return Ok(None);
        };
        Ok(Some(FrontPoint {
            profile: self.profile,
            values,
            is_verified: solved.coverage.is_some(),
            is_spared: false,
            explained: Explained::new(&searched, format!("best {}", aim.objective.words())),
            case,
            x,
            aim: aim.clone(),
        }))
    }

    /// Improves the other indices of a point at no more than a negligible loss: the search does not
    /// determine an index whose bound is not active.
    pub fn spare(&self, point: &mut FrontPoint) {
        let objective = point.aim.objective;
        for other in self.indices.iter().filter(|i| **i != objective) {
            if self.archive.stopped().is_some() {
                return;
            }
            self.announce(&format!("what {} can be for nothing", other.words()));
            let kept = self.indices.iter().filter(|i| *i != other);
            let aim = Aim {
                objective: *other,
                bounds: kept
                    .map(|i| (*i, of_badness(*i, self.badness_of(point, *i) + END)))
                    .collect(),
            };
            let near = Start {
                radius: WIDE,
                ..Start::near(vec![point.x.clone()])
            };
            if let Ok(Some(better)) = self.solve(&aim, &near)
                && better.explained.status == Status::Optimal
                && self.badness_of(&better, *other) < self.badness_of(point, *other) - END
            {
                *point = better;
            }
        }
    }

    pub fn badness_of(&self, point: &FrontPoint, index: Index) -> f64 {
        let at = self.indices.iter().position(|i| *i == index).unwrap_or(0);
        badness(index, point.values[at])
    }

    pub fn announce(&self, what: &str) {
        self.archive.stage(&format!("{}, {what}", self.name));
    }
}
