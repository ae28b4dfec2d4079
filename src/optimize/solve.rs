//! Search for the best design of a problem, with its status and certificate.

use std::time::Instant;

pub use super::{
    basins::Optimum,
    effort::Effort,
    global::halton,
    start::{Everywhere, Start, UNSEEN, UNSEEN_THOROUGH},
};

use super::{
    archive::{Archive, Stop},
    basins::{Basins, is_overtaken, same},
    certificate::Certificate,
    evaluations::Evaluations,
    global::{self, Explored},
    local::{self, Found, Status},
    problem::{Failure, Point, Problem},
    violation::least_violation,
};

/// Solution of a problem.
#[derive(Debug, Clone)]
pub struct Solved {
    /// The best design found.
    pub point: Point,
    /// Status of the search.
    pub status: Status,
    /// Its first- and second-order conditions, where they could be verified.
    pub certificate: Option<Certificate>,
    /// Effort spent.
    pub effort: Effort,
    /// The local optima found, the best first.
    pub optima: Vec<Optimum>,
    /// Coverage of the space; `None` if the search stayed near given designs.
    pub coverage: Option<Coverage>,
}

impl Solved {
    /// The solution with its second-order condition, from evaluations around it. As it is where the run
    /// has ended.
    #[must_use]
    pub fn with_curvature(mut self, problem: &dyn Problem, archive: &Archive) -> Self {
        let is_optimum = matches!(self.status, Status::Optimal | Status::BestFound);
        if let Some(certificate) = self.certificate.clone().filter(|_| is_optimum) {
            let evaluations = Evaluations::new(problem, archive);
            let curved = local::with_curvature(&evaluations, &self.point, certificate);
            self.certificate = curved.ok().or(self.certificate);
        }
        self
    }

    /// The solution with the evidence of a wider search, from whose result it was followed.
    pub fn followed_from(&mut self, wider: &Self) {
        self.effort.starts = wider.effort.starts;
        self.effort.agreed = wider.effort.agreed;
        self.coverage = wider.coverage;
        if self.status == Status::Optimal && self.coverage.is_some_and(|c| !c.is_enough()) {
            self.status = Status::BestFound;
        }
    }
}

/// Coverage of the space by searches for other optima.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coverage {
    /// Local searches from uniform points.
    pub uniform: usize,
    /// Expected share of the space in basins not yet seen.
    pub unseen: f64,
    /// The bound asked for.
    pub bound: f64,
}

impl Coverage {
    /// True if the expected share of basins not yet seen is within the bound.
    pub fn is_enough(&self) -> bool {
        self.unseen <= self.bound
    }
}

/// Reason why no design has values.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NoDesign {
    /// All evaluations failed.
    #[error("no design within the bounds could be evaluated: {0}")]
    Failed(Failure),
    /// The search ended before any evaluation.
    #[error("{0} before any design was evaluated")]
    Stopped(#[from] Stop),
}

/// Seed of a global search that replaces a local one.
const AGAIN: u64 = 1;

/// Solves a problem.
///
/// # Errors
///
/// [`NoDesign`] if no design could be evaluated.
pub fn solve(problem: &dyn Problem, start: &Start, archive: &Archive) -> Result<Solved, NoDesign> {
    let clock = Instant::now();
    let before = archive.spent();
    let is_free = !problem.variables().is_empty();
    let explored = if is_free {
        let announced = global::forecast(problem.variables().len(), start);
        archive.announce(announced);
        let explored = explore(problem, start, archive);
        let taken = archive.spent().since(&before).evaluations;
        archive.settle(announced, taken);
        explored
    } else {
        alone(problem, archive)?
    };
    let coverage = start.everywhere.map(|everywhere| Coverage {
        uniform: explored.basins.uniform(),
        unseen: if is_free {
            explored.basins.unseen()
        } else {
            0.0
        },
        bound: everywhere.unseen,
    });
    let mut found = finish(&explored)?;
    let optima = explored.basins.into_optima();
    if found.status == Status::Infeasible && is_free {
        found = least_violation(problem, archive, found);
    }
    if found.status == Status::Optimal && coverage.is_some_and(|coverage| !coverage.is_enough()) {
        found.status = Status::BestFound;
    }
    let own = optima.iter().find(|optimum| same(&optimum.found, &found));
    let spent = archive.spent().since(&before);
    Ok(Solved {
        effort: Effort {
            evaluations: spent.evaluations,
            failures: spent.failures,
            starts: optima.iter().map(|optimum| optimum.searches).sum(),
            agreed: own.map_or(0, |optimum| optimum.searches),
            seconds: clock.elapsed().as_secs_f64(),
        },
        point: found.point,
        status: found.status,
        certificate: found.certificate,
        optima,
        coverage,
    })
}

/// Search from `start`; a global one if no design of a local start has values any more.
fn explore(problem: &dyn Problem, start: &Start, archive: &Archive) -> Explored {
    let explored = global::explore(problem, archive, start);
    let is_empty = explored.basins.searches() == 0 && explored.stop.is_none();
    if start.everywhere.is_none() && is_empty {
        return global::explore(problem, archive, &Start::everywhere(AGAIN));
    }
    explored
}

/// The only design of a problem without variables.
fn alone(problem: &dyn Problem, archive: &Archive) -> Result<Explored, NoDesign> {
    let point = Evaluations::new(problem, archive).at(&[])?;
    let mut basins = Basins::default();
    if let Ok(values) = &point.values {
        let status = if point.feasible() {
            Status::Optimal
        } else {
            Status::Infeasible
        };
        let certificate = Some(Certificate::alone(values));
        basins.add(
            Found {
                point: point.clone(),
                status,
                certificate,
            },
            false,
        );
    }
    Ok(Explored {
        basins,
        met: Some(point),
        stop: None,
    })
}

/// The best local result, or a better evaluated design.
fn finish(explored: &Explored) -> Result<Found, NoDesign> {
    let Some(met) = explored.met.as_ref().filter(|p| p.values.is_ok()) else {
        return Err(match (explored.stop, &explored.met) {
            (Some(stop), _) => stop.into(),
            (
                None,
                Some(Point {
                    values: Err(failure),
                    ..
                }),
            ) => NoDesign::Failed(*failure),
            (None, _) => NoDesign::Failed(Failure::NotFinite),
        });
    };
    let mut found = match explored.basins.best() {
        Some(best) if !is_overtaken(best, met) => best.clone(),
        best => Found {
            status: if met.feasible() {
                Status::Stalled
            } else {
                Status::Infeasible
            },
            certificate: best
                .and_then(|best| best.certificate.clone())
                .filter(|c| !met.feasible() && c.is_of(met)),
            point: met.clone(),
        },
    };
    if let Some(stop) = explored.stop {
        found.status = stop.into();
    }
    Ok(found)
}
