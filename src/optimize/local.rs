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
    problem::{EQUAL_OBJECTIVES, FEASIBLE, Failure, Point, Values, onto_bound},
    subproblem::{self, Step, Weights},
    surrogate::{Surrogate, along, displacement, pattern, unknown_directions},
};

/// Status of a finished search.
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
/// Thresholds below which the first-order conditions are verified: of the trust radius, and of the
/// predicted gain. The first is the noise of the evaluations. The second holds after a failed
/// verification: curvatures are then so great that noise is small beside them.
const VERIFY_AT: [VerifyAt; 2] = [
    VerifyAt {
        radius: 1e-6,
        gain: 1e-9,
    },
    VerifyAt {
        radius: 1e-9,
        gain: 1e-13,
    },
];

/// Thresholds of verification.
#[derive(Clone, Copy)]
struct VerifyAt {
    /// Trust radius, scaled.
    radius: f64,
    /// Gain in the merit function.
    gain: f64,
}

/// Distance of samples as a share of the trust radius.
const SAMPLE_SHARE: f64 = 0.5;
/// Least distance of samples: rounding of the evaluations (1e-10) does not disturb the gradients.
const LEAST_SAMPLE_DISTANCE: f64 = 2e-5;
/// Distance of the designs by which the first-order conditions are verified: gradients are good to 1e-6
/// for third derivatives of order one, and rounding does not matter.
const VERIFY_DISTANCE: f64 = 5e-4;
/// Further distances, for larger third derivatives.
const VERIFY_CLOSER_DISTANCES: [f64; 2] = [2e-5, 1e-6];
/// Limit on the verifications after which the search resumes.
const MAX_RESUMPTIONS: usize = 8;
/// Limit on the iterations; ten to thirty are usual.
const MAX_ITERATIONS: usize = 400;
/// Residual of the first-order conditions at which a point counts as optimal.
pub const KKT_TOLERANCE: f64 = 1e-4;
/// First penalty of a violation.
const FIRST_PENALTY: f64 = 10.0;
/// Highest penalty of a violation.
const HIGHEST_PENALTY: f64 = 1e6;
/// Distance from a bound within which a coordinate is put on it: interior-point solutions end short of
/// bounds.
const BOUND_SNAP: f64 = 1e-6;
/// Violation left by the subproblem, as a share of the radius, that counts as rounding.
const NEGLIGIBLE_VIOLATION: f64 = 1e-3;
/// Distance from a known optimum, in every variable, at which a search has arrived at it.
pub(super) const ARRIVED: f64 = 5e-3;
/// Distance, in every variable, of an optimum's neighbourhood.
pub(super) const NEIGHBOUR: f64 = 0.1;
/// Excess of the merit over that of a known optimum up to which a search in its neighbourhood has arrived.
const NEIGHBOUR_LEVEL: f64 = 1e-2;
/// Largest number of variables for which the first designs determine all curvatures.
const FEW_VARIABLES: usize = 3;

/// Result of a local search.
#[derive(Debug, Clone)]
pub struct Found {
    /// The design.
    pub point: Point,
    /// Status.
    pub status: Status,
    /// Its first-order conditions, where they could be verified.
    pub certificate: Option<Certificate>,
}

/// Local search from `start` with a first trust radius `radius`, until the first-order conditions hold
/// or the search arrives at one of the `known` optima.
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
        penalty: FIRST_PENALTY,
        verify_at: VERIFY_AT[0],
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

/// Certificate with the second-order condition, from fresh evaluations around its design.
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
        let around = evaluations.graded(&pattern(&centre.x, VERIFY_DISTANCE, false))?;
        let around: Vec<(f64, Point)> = around.into_iter().map(|p| (VERIFY_DISTANCE, p)).collect();
        Surrogate::from_gradients(&centre, &around)
    } else {
        evaluations.all(&pattern(&centre.x, VERIFY_DISTANCE, true))?;
        let around = evaluations.around(&centre.x);
        Surrogate::fit(&centre, &around, VERIFY_DISTANCE)
    };
    Ok(match surrogate {
        Some(surrogate) => certificate.with_curvature(&surrogate, &centre.x),
        None => certificate,
    })
}

/// State of a local search: centre, trust radius, penalty.
struct Region<'a> {
    evaluations: &'a Evaluations<'a>,
    centre: Point,
    radius: f64,
    penalty: f64,
    verify_at: VerifyAt,
    /// Optima found before.
    known: &'a [Found],
    /// The known optimum at which this search arrived.
    arrived: Option<&'a Found>,
    /// True if the violation cannot be reduced around the centre.
    infeasible: bool,
    /// The last step: a warm start for the multipliers of the next.
    step: Option<Step>,
    certificate: Option<Certificate>,
}

impl Region<'_> {
    fn search(&mut self) -> Result<(), Stop> {
        let n = self.centre.x.len();
        self.centre = self.evaluations.graded_at(&self.centre.x)?;
        if !has_gradients(&self.centre) {
            let first = pattern(&self.centre.x, self.step_length(), n <= FEW_VARIABLES);
            self.evaluations.all(&first)?;
        }
        let mut verified = 0;
        let mut last: Option<Vec<f64>> = None;
        for _ in 0..MAX_ITERATIONS {
            let Some((surrogate, step)) = self.model()? else {
                if self.radius < self.verify_at.radius {
                    return Ok(());
                }
                self.radius /= 4.0;
                continue;
            };
            let weights = self.weights();
            let none = DVector::zeros(n);
            let expected = weights.merit(&surrogate, &none) - weights.merit(&surrogate, &step.d);
            let verify_now = self.radius < self.verify_at.radius || expected < self.verify_at.gain;
            if self.infeasible || verify_now {
                if self.radius > VERIFY_DISTANCE {
                    self.radius = (self.radius / 4.0).max(VERIFY_DISTANCE);
                    continue;
                }
                let improvable = self.verify()?;
                verified += 1;
                if !improvable || verified > MAX_RESUMPTIONS {
                    return Ok(());
                }
                // From where it was verified before, the search looks closer.
                let stays = last.as_ref() == Some(&self.centre.x);
                self.radius = if stays {
                    VERIFY_DISTANCE / 20.0
                } else {
                    VERIFY_DISTANCE
                };
                last = Some(self.centre.x.clone());
                self.verify_at = VERIFY_AT[1];
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

    /// True if the search has arrived at a known optimum: at the design, or at its height in its
    /// neighbourhood. The height of a design of least violation is its violation.
    fn has_arrived(&self, known: &Found) -> bool {
        let height = |point: &Point| match (known.status, &point.values) {
            (Status::Optimal, _) => Some(point.merit(self.penalty)),
            (Status::Infeasible, Ok(values)) => Some(values.violation()),
            _ => None,
        };
        let (Some(here), Some(there)) = (height(&self.centre), height(&known.point)) else {
            return false;
        };
        let is_level = (-EQUAL_OBJECTIVES..NEIGHBOUR_LEVEL).contains(&(here - there));
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
        (SAMPLE_SHARE * self.radius).max(LEAST_SAMPLE_DISTANCE)
    }

    /// Surrogates with determined gradients, and the step that minimises them. `None` if the evaluations
    /// around the centre fail, or Clarabel does.
    fn model(&mut self) -> Result<Option<(Surrogate, Step)>, Stop> {
        let n = self.centre.x.len();
        let near = self.radius.max(LEAST_SAMPLE_DISTANCE);
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
            // A design that failed is replaced by its mirror image about the centre.
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

    /// Step of the subproblem, with the penalty raised as far as feasibility needs.
    fn steer(&mut self, surrogate: &Surrogate) -> Option<Step> {
        let x = &self.centre.x;
        let lower = DVector::from_fn(x.len(), |i, _| (-self.radius).max(-x[i]));
        let upper = DVector::from_fn(x.len(), |i, _| self.radius.min(1.0 - x[i]));
        let minimise = |weights, before: Option<&Step>| {
            subproblem::minimise(surrogate, &lower, &upper, self.radius, weights, before)
        };
        let mut step = minimise(self.weights(), self.step.as_ref())?;
        self.infeasible = false;
        // A violation at the accuracy of the program does not raise the penalty.
        let negligible = FEASIBLE.max(NEGLIGIBLE_VIOLATION * self.radius);
        if surrogate.violation(&step.d) > negligible {
            let feasibility = Weights {
                objective: 0.0,
                penalty: 1.0,
            };
            let here = surrogate.violation(&DVector::zeros(x.len()));
            let least = surrogate.violation(&minimise(feasibility, None)?.d);
            self.infeasible = here > FEASIBLE && here - least < self.verify_at.gain;
            // Nine tenths of the gain in feasibility that is possible.
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

    /// Evaluates the step, and updates centre and radius.
    fn advance(&mut self, d: &DVector<f64>, expected: f64) -> Result<(), Stop> {
        let x: Vec<f64> = self
            .centre
            .x
            .iter()
            .zip(d)
            .map(|(x, d)| onto_bound(x + d, BOUND_SNAP))
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
    /// the centre. Returns true if the search should go on from there.
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
        for distance in std::iter::once(VERIFY_DISTANCE).chain(VERIFY_CLOSER_DISTANCES) {
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
            // A better one of the fresh designs becomes the centre.
            let better = around.iter().map(|(_, p)| p).find(|p| {
                self.centre.merit(self.penalty) - p.merit(self.penalty) > 10.0 * self.verify_at.gain
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
