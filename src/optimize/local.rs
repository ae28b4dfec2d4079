//! Local phase: a trust-region method on quadratic surrogates of the full models.
//!
//! Sequential quadratic programming: the surrogates come from gradients where the problem has them
//! (`secants`) and are fitted to evaluations around the best design where not
//! (`surrogate`); the subproblem minimises an exact penalty of them inside the trust
//! region, and the penalty rises where feasibility asks for it (Byrd, Nocedal, Waltz: *Steering
//! exact penalty methods for nonlinear programming*, 2008). Surrogates are right to first order at
//! the centre, by gradients or because before every fit the designs nearby are made to span the
//! space: a step that fails shrinks the region with good reason, the ground on which such methods
//! converge to first-order points from anywhere (Conn, Scheinberg, Vicente 2009, chapter 10).

use nalgebra::DVector;

use super::{
    archive::Stop,
    certificate::Certificate,
    evaluations::{Evaluations, near},
    problem::{FEASIBLE, Failure, Point, SAME, Values, onto_bound},
    subproblem::{self, Step, Weights},
    surrogate::{Surrogate, along, displacement, pattern, unknown_directions},
};

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// A point that satisfies the first-order conditions and every constraint; where it was searched
    /// everywhere, basins not yet seen are as unlikely as asked for.
    Optimal,
    /// As [`Status::Optimal`], but basins not yet seen are not unlikely enough.
    BestFound,
    /// The best point found is feasible, but the first-order conditions are not met to tolerance.
    Stalled,
    /// No feasible point was found; the point has the least violation found.
    Infeasible,
    /// The budget of evaluations was spent; the best point found so far.
    BudgetSpent,
    /// The run was interrupted; the best point found so far.
    Interrupted,
    /// No point looked at could be evaluated; the point is the one to begin from.
    Failed(Failure),
}

impl From<Stop> for Status {
    fn from(stop: Stop) -> Self {
        match stop {
            Stop::Budget => Self::BudgetSpent,
            Stop::Interrupted => Self::Interrupted,
        }
    }
}

/// First trust radius, in units of the variables' ranges: after a global search, and near a design
/// that was optimal for almost the same problem.
pub const WIDE: f64 = 0.08;
/// See [`WIDE`].
pub const NARROW: f64 = 0.01;
/// When to verify: the radius below a share of the ranges, or the predicted gain within the noise
/// of the evaluations. If the verification fails, the second holds: where curvatures are so great,
/// noise is small beside them.
const SETTLED: [Settled; 2] = [
    Settled {
        radius: 1e-6,
        gain: 1e-9,
    },
    Settled {
        radius: 1e-9,
        gain: 1e-13,
    },
];

#[derive(Clone, Copy)]
struct Settled {
    radius: f64,
    gain: f64,
}

/// Samples are taken at this share of the radius, but never so close that rounding of the
/// evaluations (1e-10) disturbs the gradients.
const SAMPLING: f64 = 0.5;
const CLOSEST: f64 = 2e-5;
/// Distances at which the first-order conditions are verified. At the first, gradients are good to
/// 1e-6 for third derivatives of order one, such as scaled indices have, and rounding does not
/// matter; the others are for sharper curves.
const VERIFY: f64 = 5e-4;
const VERIFY_CLOSELY: [f64; 2] = [2e-5, 1e-6];
/// Verifications that may send the search on.
const SENT_ON: usize = 8;
/// Iterations allowed; ten to thirty are normal.
const ITERATIONS: usize = 400;
/// Residual of the first-order conditions at which a point counts as optimal.
pub const KKT_TOLERANCE: f64 = 1e-4;
/// First price of a violation, and the highest.
const PENALTY: f64 = 10.0;
const HIGHEST_PENALTY: f64 = 1e6;
/// Interior-point solutions end this far short of a bound: it is put on it.
const SHORT: f64 = 1e-6;
/// A violation left by the subproblem below this share of the radius is rounding.
const NEGLIGIBLE: f64 = 1e-3;
/// A search this close to a known optimum, in every variable, has arrived at it; so has one that is
/// in its neighbourhood, behind it by no more than this, and no better.
pub(super) const ARRIVED: f64 = 5e-3;
pub(super) const NEIGHBOUR: f64 = 0.1;
const LEVEL: f64 = 1e-2;
/// Up to this many variables the first designs determine all curvatures.
const FEW: usize = 3;

/// What a local search found.
#[derive(Debug, Clone)]
pub struct Found {
    /// The design.
    pub point: Point,
    /// How the search ended.
    pub status: Status,
    /// Its first-order conditions, where they could be verified.
    pub certificate: Option<Certificate>,
}

/// Improves `start`, looking `radius` around it at first, until the first-order conditions hold.
///
/// `known` optima end the search where it comes close to one.
pub(super) fn search(
    evaluations: &Evaluations,
    start: Point,
    radius: f64,
    known: &[Found],
) -> Found {
    let mut region = Region {
        evaluations,
        centre: start,
        radius,
        penalty: PENALTY,
        settled: SETTLED[0],
        known,
        arrived: None,
        infeasible: false,
        step: None,
        certificate: None,
    };
    let outcome = region.search();
    if let Some(known) = region.arrived {
        return known.clone();
    }
    let point = region.centre;
    let status = match outcome {
        Err(stop) => stop.into(),
        Ok(()) if !point.feasible() => Status::Infeasible,
        Ok(()) => {
            let residual = region.certificate.as_ref().map(|c| c.kkt_residual);
            if residual.is_some_and(|r| r <= KKT_TOLERANCE) {
                Status::Optimal
            } else {
                Status::Stalled
            }
        }
    };
    Found {
        point,
        status,
        certificate: region.certificate,
    }
}

/// A certificate with the second-order condition, from fresh evaluations around its design.
pub(super) fn with_curvature(
    evaluations: &Evaluations,
    point: &Point,
    certificate: Certificate,
) -> Result<Certificate, Stop> {
    if certificate.curvature.is_some() {
        return Ok(certificate);
    }
    let centre = evaluations.graded_at(&point.x)?;
    let surrogate = if has_gradients(&centre) {
        let around = evaluations.graded(&pattern(&centre.x, VERIFY, false))?;
        let around: Vec<(f64, Point)> = around.into_iter().map(|p| (VERIFY, p)).collect();
        Surrogate::from_gradients(&centre, &around)
    } else {
        evaluations.all(&pattern(&centre.x, VERIFY, true))?;
        let around = evaluations.around(&centre.x);
        Surrogate::fit(&centre, &around, VERIFY)
    };
    Ok(match surrogate {
        Some(surrogate) => certificate.with_curvature(&surrogate, &centre.x),
        None => certificate,
    })
}

struct Region<'a> {
    evaluations: &'a Evaluations<'a>,
    centre: Point,
    radius: f64,
    penalty: f64,
    settled: Settled,
    /// Optima found before, and the one that this search came to.
    known: &'a [Found],
    arrived: Option<&'a Found>,
    /// The violation cannot be reduced around the centre.
    infeasible: bool,
    /// The last step, whose multipliers are nearly those of the next.
    step: Option<Step>,
    certificate: Option<Certificate>,
}

impl Region<'_> {
    fn search(&mut self) -> Result<(), Stop> {
        let n = self.centre.x.len();
        self.centre = self.evaluations.graded_at(&self.centre.x)?;
        if !has_gradients(&self.centre) {
            let first = pattern(&self.centre.x, self.step_length(), n <= FEW);
            self.evaluations.all(&first)?;
        }
        let mut verified = 0;
        let mut last: Option<Vec<f64>> = None;
        for _ in 0..ITERATIONS {
            let Some((surrogate, step)) = self.model()? else {
                if self.radius < self.settled.radius {
                    return Ok(());
                }
                self.radius /= 4.0;
                continue;
            };
            let weights = self.weights();
            let none = DVector::zeros(n);
            let expected = weights.merit(&surrogate, &none) - weights.merit(&surrogate, &step.d);
            let settled = self.radius < self.settled.radius || expected < self.settled.gain;
            if self.infeasible || settled {
                if self.radius > VERIFY {
                    self.radius = (self.radius / 4.0).max(VERIFY);
                    continue;
                }
                let improvable = self.verify()?;
                verified += 1;
                if !improvable || verified > SENT_ON {
                    return Ok(());
                }
                // From where it was verified before, the search looks closer.
                let stays = last.as_ref() == Some(&self.centre.x);
                self.radius = if stays { VERIFY / 20.0 } else { VERIFY };
                last = Some(self.centre.x.clone());
                self.settled = SETTLED[1];
                continue;
            }
            self.advance(&step.d, expected)?;
            self.arrived = self.known.iter().find(|known| self.has_arrived(known));
            if self.arrived.is_some() {
                return Ok(());
            }
        }
        self.verify()?;
        Ok(())
    }

    /// Whether the search has come to a known optimum, or so near and so far down its slope that it
    /// will; of designs of least violation the violation counts.
    fn has_arrived(&self, known: &Found) -> bool {
        let height = |point: &Point| match (known.status, &point.values) {
            (Status::Optimal, _) => Some(point.merit(self.penalty)),
            (Status::Infeasible, Ok(values)) => Some(values.violation()),
            _ => None,
        };
        let (Some(here), Some(there)) = (height(&self.centre), height(&known.point)) else {
            return false;
        };
        let is_level = (-SAME..LEVEL).contains(&(here - there));
        let is_near = |within: f64| near(&known.point.x, &self.centre.x, within);
        is_near(NEIGHBOUR) && is_level || known.status == Status::Optimal && is_near(ARRIVED)
    }

    fn weights(&self) -> Weights {
        Weights {
            objective: 1.0,
            penalty: self.penalty,
        }
    }

    fn step_length(&self) -> f64 {
        (SAMPLING * self.radius).max(CLOSEST)
    }

    /// Surrogates whose gradients are determined, and the step that they propose. `None` where
    /// evaluations fail all around or Clarabel does.
    fn model(&mut self) -> Result<Option<(Surrogate, Step)>, Stop> {
        let n = self.centre.x.len();
        let near = self.radius.max(CLOSEST);
        if has_gradients(&self.centre) {
            let around = self.evaluations.around(&self.centre.x);
            let Some(surrogate) = Surrogate::from_gradients(&self.centre, &around) else {
                return Ok(None);
            };
            return Ok(self.steer(&surrogate).map(|step| (surrogate, step)));
        }
        for _ in 0..2 {
            let missing = unknown_directions(&self.displacements(), n, near);
            if missing.is_empty() {
                break;
            }
            let designs = along(&self.centre.x, self.step_length(), &missing);
            let points = self.evaluations.all(&designs)?;
            // Where a design failed, the other way is tried.
            let back: Vec<Vec<f64>> = points
                .iter()
                .filter(|p| p.values.is_err())
                .map(|p| mirrored(&self.centre.x, &p.x))
                .collect();
            self.evaluations.all(&back)?;
        }
        let around = self.evaluations.around(&self.centre.x);
        let Some(surrogate) = Surrogate::fit(&self.centre, &around, near) else {
            return Ok(None);
        };
        Ok(self.steer(&surrogate).map(|step| (surrogate, step)))
    }

    fn displacements(&self) -> Vec<DVector<f64>> {
        self.evaluations
            .around(&self.centre.x)
            .iter()
            .filter(|(_, p)| p.values.is_ok())
            .map(|(_, p)| displacement(&self.centre, p))
            .collect()
    }

    /// The step, with the penalty raised as far as feasibility asks for it.
    fn steer(&mut self, surrogate: &Surrogate) -> Option<Step> {
        let x = &self.centre.x;
        let lower = DVector::from_fn(x.len(), |i, _| (-self.radius).max(-x[i]));
        let upper = DVector::from_fn(x.len(), |i, _| self.radius.min(1.0 - x[i]));
        let minimise = |weights, before: Option<&Step>| {
            subproblem::minimise(surrogate, &lower, &upper, self.radius, weights, before)
        };
        let mut step = minimise(self.weights(), self.step.as_ref())?;
        self.infeasible = false;
        // The program's own accuracy is no reason to raise the penalty.
        let negligible = FEASIBLE.max(NEGLIGIBLE * self.radius);
        if surrogate.violation(&step.d) > negligible {
            let feasibility = Weights {
                objective: 0.0,
                penalty: 1.0,
            };
            let here = surrogate.violation(&DVector::zeros(x.len()));
            let least = surrogate.violation(&minimise(feasibility, None)?.d);
            self.infeasible = here > FEASIBLE && here - least < self.settled.gain;
            // Nine tenths of what feasibility alone would gain.
            let enough = (least + 0.1 * (here - least)).max(negligible);
            let mut penalty = self.penalty;
            while surrogate.violation(&step.d) > enough && penalty < HIGHEST_PENALTY {
                penalty *= 10.0;
                let dearer = Weights {
                    objective: 1.0,
                    penalty,
                };
                step = minimise(dearer, Some(&step))?;
            }
            if surrogate.violation(&step.d) <= enough {
                self.penalty = penalty;
            }
        }
        self.step = Some(step.clone());
        Some(step)
    }

    /// Tries the step and settles the radius.
    fn advance(&mut self, d: &DVector<f64>, expected: f64) -> Result<(), Stop> {
        let x: Vec<f64> = self
            .centre
            .x
            .iter()
            .zip(d)
            .map(|(x, d)| onto_bound(x + d, SHORT))
            .collect();
        let trial = self.evaluations.graded_at(&x)?;
        let gain = self.centre.merit(self.penalty) - trial.merit(self.penalty);
        let ratio = gain / expected;
        let length = d.amax();
        if gain > 0.0 {
            self.centre = trial;
        }
        self.radius = if ratio > 0.75 && length > 0.9 * self.radius {
            2.0 * self.radius
        } else if ratio > 0.25 {
            // The surrogate is good but its minimum is near: look closer.
            self.radius.min((4.0 * length).max(self.radius / 8.0))
        } else {
            (self.radius / 4.0).min(length.max(self.radius / 16.0))
        };
        Ok(())
    }

    /// Verifies the first-order conditions, by exact gradients or by fresh evaluations on both sides of
    /// the centre. Whether the search should go on from there.
    fn verify(&mut self) -> Result<bool, Stop> {
        self.certificate = None;
        if has_gradients(&self.centre) {
            if let Some(surrogate) = Surrogate::from_gradients(&self.centre, &[])
                && let Ok(values) = &self.centre.values
            {
                self.certificate = Certificate::new(&surrogate, values, &self.centre.x);
            }
            let residual = self.certificate.as_ref().map(|c| c.kkt_residual);
            let holds = residual.is_some_and(|r| r <= KKT_TOLERANCE / 10.0);
            return Ok(!holds && !self.infeasible);
        }
        for distance in std::iter::once(VERIFY).chain(VERIFY_CLOSELY) {
            let designs = pattern(&self.centre.x, distance, false);
            let fresh = self.evaluations.all(&designs)?;
            let around: Vec<(f64, Point)> = fresh.into_iter().map(|p| (distance, p)).collect();
            let (Some(surrogate), Ok(values)) = (
                Surrogate::fit(&self.centre, &around, distance),
                &self.centre.values,
            ) else {
                continue;
            };
            let certificate = Certificate::new(&surrogate, values, &self.centre.x);
            let residual =
                |c: &Option<Certificate>| c.as_ref().map_or(f64::INFINITY, |c| c.kkt_residual);
            if residual(&certificate) < residual(&self.certificate) {
                self.certificate = certificate;
            }
            if residual(&self.certificate) <= KKT_TOLERANCE / 10.0 || self.infeasible {
                return Ok(false);
            }
            // What the fresh designs themselves show is taken at once.
            let better = around.iter().map(|(_, p)| p).find(|p| {
                self.centre.merit(self.penalty) - p.merit(self.penalty) > 10.0 * self.settled.gain
            });
            if let Some(better) = better {
                self.centre = better.clone();
                return Ok(true);
            }
        }
        Ok(true)
    }
}

fn has_gradients(point: &Point) -> bool {
    point.values.as_ref().is_ok_and(Values::has_gradients)
}

/// The design on the other side of `centre`, kept inside the unit box.
fn mirrored(centre: &[f64], x: &[f64]) -> Vec<f64> {
    let pairs = centre.iter().zip(x);
    pairs.map(|(c, x)| (2.0 * c - x).clamp(0.0, 1.0)).collect()
}
