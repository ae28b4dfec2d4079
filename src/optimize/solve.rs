//! Global search, then local searches from the best designs met.

use std::{collections::VecDeque, time::Instant};

pub use super::{effort::Effort, global::halton, start::Start};

use super::{
    archive::{Archive, Stop},
    certificate::Certificate,
    evaluations::{Evaluations, near},
    global,
    local::{self, Found, Status},
    problem::{Failure, Point, Problem, Values},
    violation::least_violation,
};

/// What solving a problem gave.
#[derive(Debug, Clone)]
pub struct Solved {
    /// The best design found.
    pub point: Point,
    /// How the search for it ended.
    pub status: Status,
    /// Its first- and second-order conditions, where they could be verified.
    pub certificate: Option<Certificate>,
    /// What was spent.
    pub effort: Effort,
    /// Designs to which the local searches came, in scaled coordinates.
    pub ends: Vec<Vec<f64>>,
}

/// Not one design could be evaluated.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NoDesign {
    /// All evaluations failed.
    #[error("no design within the bounds could be evaluated: {0}")]
    Failed(Failure),
    /// The search ended before one could.
    #[error("{0} before any design was evaluated")]
    Stopped(#[from] Stop),
}

/// What a local search may be hoped to gain per variable; a start further behind the best is left
/// out.
const PROMISE: f64 = 0.2;
/// Objectives closer than this are the same: what the tolerance on first-order conditions leaves.
const SAME: f64 = 2e-5;
/// Starts agree within this in every variable, or in objective within [`SAME`].
const AGREE: f64 = 1e-3;
/// Local searches added from such designs.
const AGAIN_FROM_BEST: usize = 3;
/// Seed of a global phase that takes the place of a search nearby.
const AGAIN: u64 = 1;

/// Solves a problem.
///
/// # Errors
///
/// [`NoDesign`] if not one design could be evaluated.
pub fn solve(problem: &dyn Problem, start: &Start, archive: &Archive) -> Result<Solved, NoDesign> {
    let clock = Instant::now();
    let (count, failures) = (archive.count(), archive.failures());
    let announced = forecast(problem.variables().len(), start);
    archive.announce(announced);
    let evaluations = Evaluations::new(problem, archive);
    let mut search = Search {
        evaluations: &evaluations,
        best: None,
        ends: Vec::new(),
        gives_up: start.gives_up,
    };
    let outcome = search.run(start);
    archive.settle(announced, archive.count() - count);
    let ends = std::mem::take(&mut search.ends);
    let best = search.best.take();
    let mut found = finish(&evaluations, best, outcome.err())?;
    let is_free = !problem.variables().is_empty();
    if found.status == Status::Infeasible && is_free {
        found = least_violation(problem, archive, found);
    } else if found.status == Status::Optimal
        && let Ok(curved) = local::with_curvature(&evaluations, found.clone())
    {
        found = curved;
    }
    let agreed = ends
        .iter()
        .filter(|end| agrees(&end.point, &found.point))
        .count();
    Ok(Solved {
        effort: Effort {
            evaluations: archive.count() - count,
            failures: archive.failures_since(&failures),
            starts: ends.len(),
            agreed,
            seconds: clock.elapsed().as_secs_f64(),
        },
        point: found.point,
        status: found.status,
        certificate: found.certificate,
        ends: ends.into_iter().map(|end| end.point.x).collect(),
    })
}

/// Evaluations that a search may take, for whoever waits.
fn forecast(n: usize, start: &Start) -> usize {
    let local = 10 + 12 * n;
    match start.everywhere {
        Some(_) => global::EVALUATIONS_PER_VARIABLE * n + (start.starts + n) * local,
        None => start.designs.len() * local,
    }
}

struct Search<'a> {
    evaluations: &'a Evaluations<'a>,
    best: Option<Found>,
    ends: Vec<Found>,
    gives_up: bool,
}

impl Search<'_> {
    fn run(&mut self, start: &Start) -> Result<(), Stop> {
        let evaluations = self.evaluations;
        if evaluations.problem.variables().is_empty() {
            let point = evaluations.at(&[])?;
            let certificate = point.values.as_ref().ok().map(Certificate::alone);
            let status = if point.feasible() {
                Status::Optimal
            } else {
                Status::Infeasible
            };
            if point.values.is_ok() {
                self.best = Some(Found {
                    point,
                    status,
                    certificate,
                });
            }
            return Ok(());
        }
        let given = evaluations.all(&start.designs)?;
        let usable: Vec<Point> = given.into_iter().filter(|p| p.values.is_ok()).collect();
        let (mut starts, radius) = match start.everywhere {
            Some(seed) => (
                global::search(evaluations, seed, start.starts)?,
                local::WIDE,
            ),
            // What changed since has left these designs without a performance.
            None if usable.is_empty() => (
                global::search(evaluations, AGAIN, start.starts)?,
                local::WIDE,
            ),
            None => (usable, start.radius),
        };
        // The best that holds all constraints is a start too, whatever its merit.
        if start.everywhere.is_some()
            && let Some(best) = evaluations.best().filter(Point::feasible)
            && !starts.iter().any(|p| near(&p.x, &best.x, global::APART))
        {
            starts.push(best);
        }
        let mut starts: VecDeque<Point> = starts.into();
        let mut again = 0;
        while let Some(from) = starts.pop_front() {
            if self.hopeless(&from, start.beat) {
                continue;
            }
            let found = local::search(evaluations, from, radius, &self.ends);
            let stopped = match found.status {
                Status::BudgetSpent => Some(Stop::Budget),
                Status::Interrupted => Some(Stop::Interrupted),
                _ => None,
            };
            self.ends.push(found.clone());
            if self
                .best
                .as_ref()
                .is_none_or(|b| found.point.better_than(&b.point))
            {
                self.best = Some(found);
            }
            if let Some(stop) = stopped {
                return Err(stop);
            }
            // A local search that met something better on its way than what it came to.
            if starts.is_empty()
                && again < AGAIN_FROM_BEST
                && let Some(best) = self.overtaken()
            {
                again += 1;
                starts.push_back(best);
            }
        }
        Ok(())
    }

    /// The best evaluated design, if it is truly better than what the local searches came to.
    fn overtaken(&self) -> Option<Point> {
        let best = self.evaluations.best()?;
        let known = self.best.as_ref()?;
        let better = best.better_than(&known.point) && best.feasible() && !stands(known, &best);
        (better && (!known.point.feasible() || improvement(&known.point, &best) > SAME))
            .then_some(best)
    }

    fn hopeless(&self, from: &Point, beat: f64) -> bool {
        let Ok(values) = &from.values else {
            return false;
        };
        let promise = PROMISE * from.x.len() as f64;
        let reach = values.objective() + global::START_PENALTY * values.violation() - promise;
        let reached = match &self.best {
            Some(best) if best.status != Status::Infeasible => best
                .point
                .values
                .as_ref()
                .map_or(f64::INFINITY, Values::objective),
            _ => f64::INFINITY,
        };
        let one_will_do = self.best.is_some() || self.gives_up;
        one_will_do && beat < reach || reached < reach
    }
}

/// The best local result, unless some other evaluation was better: never merely the last.
fn finish(
    evaluations: &Evaluations,
    best: Option<Found>,
    stop: Option<Stop>,
) -> Result<Found, NoDesign> {
    let any = evaluations.best().filter(|p| p.values.is_ok());
    let Some(any) = any else {
        return Err(match stop {
            Some(stop) => stop.into(),
            None => NoDesign::Failed(evaluations.last_failure().unwrap_or(Failure::NotFinite)),
        });
    };
    let mut found = match best {
        Some(found) if !any.better_than(&found.point) || stands(&found, &any) => found,
        Some(found) => {
            let feasible = any.feasible();
            let better = improvement(&found.point, &any) > SAME;
            let keeps = !better && found.point.feasible() == feasible;
            Found {
                status: if feasible && !keeps {
                    Status::Stalled
                } else {
                    found.status
                },
                certificate: found.certificate.filter(|c| keeps && c.is_of(&any)),
                point: any,
            }
        }
        None => Found {
            status: if any.feasible() {
                Status::Stalled
            } else {
                Status::Infeasible
            },
            point: any,
            certificate: None,
        },
    };
    if let Some(stop) = stop {
        found.status = stop.into();
    }
    Ok(found)
}

/// Whether an optimum is as good as another design, but for what that one owes to the tolerance on
/// the constraints: where these are nearly flat they are dear.
fn stands(optimum: &Found, other: &Point) -> bool {
    let (Some(certificate), Ok(own), Ok(others)) =
        (&optimum.certificate, &optimum.point.values, &other.values)
    else {
        return false;
    };
    let price: f64 = certificate.constraint_multipliers.iter().sum();
    let owed = price * (others.violation() - own.violation()).max(0.0);
    optimum.status == Status::Optimal && own.objective() - others.objective() <= SAME + owed
}

fn agrees(a: &Point, b: &Point) -> bool {
    let objective = |p: &Point| p.values.as_ref().map_or(f64::INFINITY, Values::objective);
    a.feasible() == b.feasible()
        && (near(&a.x, &b.x, AGREE) || (objective(a) - objective(b)).abs() < SAME)
}

fn improvement(from: &Point, to: &Point) -> f64 {
    match (&from.values, &to.values) {
        (Ok(a), Ok(b)) => {
            (a.objective() - b.objective()).abs() + (a.violation() - b.violation()).abs()
        }
        _ => f64::INFINITY,
    }
}
