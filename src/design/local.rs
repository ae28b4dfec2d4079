//! Local phase: a trust-region method on quadratic surrogates of the full models.

use nalgebra::DVector;

use super::{
    evaluations::Evaluations,
    problem::{FEASIBLE, Point},
    subproblem::{self, Step},
    surrogate::{Surrogate, pattern},
};

/// How a local search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// A point that satisfies the first-order conditions and every constraint.
    Optimal,
    /// The best point found is feasible, but the first-order conditions are not met to tolerance.
    Stalled,
    /// No feasible point was found; the point has the least violation found.
    Infeasible,
}

/// Result of a local search.
#[derive(Debug, Clone)]
pub struct Solution {
    /// The design.
    pub point: Point,
    /// How it ended.
    pub status: Status,
    /// Residual of the first-order conditions in scaled variables.
    pub kkt_residual: f64,
    /// Multipliers of the constraints' pieces.
    pub multipliers: Vec<f64>,
}

/// First trust radius, in units of the variables' ranges: after a global search, and near a design
/// that was optimal for almost the same vehicle.
pub(super) const WIDE: f64 = 0.08;
pub(super) const NARROW: f64 = 0.01;
/// The search has converged when the radius is below this, 1e-6 of the ranges.
const SMALLEST: f64 = 1e-6;
/// Residual below which a step shorter than ten times that ends the search.
const SETTLED: f64 = 1e-5;
/// Samples are taken at this share of the radius, but never so close that rounding of the
/// evaluations (1e-10) disturbs curvatures.
const SAMPLING: f64 = 0.5;
const CLOSEST: f64 = 2e-4;
/// Iterations allowed; ten to twenty are normal.
const ITERATIONS: usize = 40;
/// Residual of the first-order conditions at which a point counts as optimal.
pub const KKT_TOLERANCE: f64 = 1e-4;

/// Improves `start`, looking `radius` around it at first, until the first-order conditions hold.
pub(super) fn search(evaluations: &Evaluations, start: Point, mut radius: f64) -> Solution {
    let n = start.x.len();
    let penalty = super::global::PENALTY;
    let mut centre = start;
    let mut kkt_residual = f64::INFINITY;
    let mut multipliers = Vec::new();
    for _ in 0..ITERATIONS {
        if radius < SMALLEST {
            break;
        }
        let samples = evaluations.all(&pattern(&centre.x, (SAMPLING * radius).max(CLOSEST)));
        let Some(surrogate) = Surrogate::fit(&centre, &samples) else {
            radius /= 4.0;
            continue;
        };
        let lower = DVector::from_fn(n, |i, _| (-radius).max(-centre.x[i]));
        let upper = DVector::from_fn(n, |i, _| radius.min(1.0 - centre.x[i]));
        let Some(step) = subproblem::minimise(&surrogate, &lower, &upper) else {
            radius /= 4.0;
            continue;
        };
        kkt_residual = residual(&surrogate, &step, &centre.x);
        multipliers.clone_from(&step.constraint_multipliers);
        let x: Vec<f64> = (0..n).map(|i| snap(centre.x[i] + step.d[i])).collect();
        let predicted = {
            let worst = |q: &[super::surrogate::Quadratic]| {
                q.iter()
                    .map(|q| q.at(&step.d))
                    .fold(f64::NEG_INFINITY, f64::max)
            };
            worst(&surrogate.objective) + penalty * worst(&surrogate.constraints).max(0.0)
        };
        let trial = evaluations.at(&x);
        let gain = centre.merit(penalty) - trial.merit(penalty);
        let expected = centre.merit(penalty) - predicted;
        let length = step.d.amax();
        let ratio = if expected > 0.0 { gain / expected } else { 0.0 };
        if gain > 0.0 {
            centre = trial;
        }
        if kkt_residual < SETTLED && length < 10.0 * SMALLEST {
            break;
        }
        radius = if ratio > 0.75 && length > 0.9 * radius {
            2.0 * radius
        } else if ratio > 0.25 {
            // The surrogate is good but its minimum is near: look closer.
            radius.min((4.0 * length).max(radius / 8.0))
        } else {
            (radius / 4.0).min(length.max(radius / 16.0))
        };
    }
    let violation = centre
        .values
        .as_ref()
        .map_or(f64::INFINITY, super::problem::Values::violation);
    let status = if violation > FEASIBLE {
        Status::Infeasible
    } else if kkt_residual <= KKT_TOLERANCE {
        Status::Optimal
    } else {
        Status::Stalled
    };
    Solution {
        point: centre,
        status,
        kkt_residual,
        multipliers,
    }
}

/// Interior-point solutions end just short of a bound: puts them on it.
fn snap(x: f64) -> f64 {
    const NEAR: f64 = 1e-6;
    if x < NEAR {
        0.0
    } else if x > 1.0 - NEAR {
        1.0
    } else {
        x
    }
}

/// Largest component of the Lagrangian's gradient at the centre that no bound accounts for, with
/// the multipliers of the last program.
fn residual(surrogate: &Surrogate, step: &Step, x: &[f64]) -> f64 {
    let mut gradient = DVector::zeros(x.len());
    let objective = surrogate.objective.iter().zip(&step.objective_multipliers);
    let constraints = surrogate
        .constraints
        .iter()
        .zip(&step.constraint_multipliers);
    for (piece, &multiplier) in objective.chain(constraints) {
        gradient += &piece.gradient * multiplier;
    }
    (0..x.len())
        .map(|i| {
            let pushes_out =
                (x[i] <= 0.0 && gradient[i] > 0.0) || (x[i] >= 1.0 && gradient[i] < 0.0);
            if pushes_out { 0.0 } else { gradient[i].abs() }
        })
        .fold(0.0, f64::max)
}
