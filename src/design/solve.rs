//! Global search, then local searches from the best designs met.

use super::{
    evaluations::Evaluations,
    global, local,
    local::{Solution, Status},
    outcome::Stage,
    problem::{FEASIBLE, Failure, Point, Problem, Values, Variable},
};

/// What solving a problem gave.
#[derive(Debug, Clone)]
pub struct Solved {
    /// The best design with its certificate.
    pub solution: Solution,
    /// Full-model evaluations spent.
    pub evaluations: usize,
    /// How many of them had no result.
    pub failed: usize,
}

/// Is told how a long search gets on. Calls come from several threads.
pub trait Progress: Sync {
    /// A trade-off begins, in this round of the coupling loop.
    fn stage(&self, stage: Stage, round: usize);

    /// One more full-model evaluation is done.
    fn evaluated(&self);
}

/// Progress that nobody watches.
pub struct Silent;

impl Progress for Silent {
    fn stage(&self, _: Stage, _: usize) {}

    fn evaluated(&self) {}
}

/// Where a search begins.
#[derive(Debug, Clone, Copy)]
pub enum Start<'a> {
    /// Anywhere: the global phase with this seed, and designs worth a look.
    Everywhere {
        /// Of the global phase.
        seed: u64,
        /// Designs worth a look, in scaled coordinates.
        also: &'a [Vec<f64>],
        /// Objective that another problem has reached: one local search will do where this one
        /// has no hope to beat it.
        beat: f64,
    },
    /// Near a design that was optimal for a slightly different vehicle.
    Near(&'a [f64]),
}

/// What a local search may be hoped to gain; a start further behind the best is left out.
const PROMISE: f64 = 0.3;
/// Objectives closer than this are the same: the tolerance on constraints times their multipliers.
const SAME: f64 = 2e-5;
/// Seed of a global phase that takes the place of a search nearby.
const AGAIN: u64 = 1;

/// Solves a problem.
///
/// # Errors
///
/// Why the last design failed, if not one design could be evaluated.
pub fn solve(
    problem: &dyn Problem,
    start: Start,
    progress: &dyn Progress,
) -> Result<Solved, Failure> {
    let evaluations = Evaluations::new(problem, progress);
    if evaluations.dimension() == 0 {
        return alone(evaluations.at(&[]));
    }
    let (starts, radius, beat): (Vec<Point>, f64, f64) = match start {
        Start::Near(x) => {
            let point = evaluations.at(x);
            if point.values.is_ok() {
                (vec![point], local::NARROW, f64::INFINITY)
            } else {
                // What the other trade-off changed has left this design without a performance.
                (
                    global::search(&evaluations, AGAIN),
                    local::WIDE,
                    f64::INFINITY,
                )
            }
        }
        Start::Everywhere { seed, also, beat } => {
            evaluations.all(also);
            let starts = global::search(&evaluations, seed);
            (starts, local::WIDE, beat)
        }
    };
    let mut best: Option<Solution> = None;
    for start in starts {
        let Ok(values) = &start.values else { continue };
        let reach = values.objective() + global::START_PENALTY * values.violation() - PROMISE;
        let hopeless = |b: &Solution| {
            let reached = b
                .point
                .values
                .as_ref()
                .map_or(f64::INFINITY, Values::objective);
            beat < reach || (b.status != Status::Infeasible && reached < reach)
        };
        if best.as_ref().is_some_and(hopeless) {
            continue;
        }
        let solution = local::search(&evaluations, start, radius);
        if best
            .as_ref()
            .is_none_or(|b| solution.point.better_than(&b.point))
        {
            best = Some(solution);
        }
    }
    let Some(mut solution) = best else {
        return Err(evaluations.last_failure());
    };
    // Never merely the last: whatever evaluation was best.
    if let Some(point) = evaluations.best()
        && point.better_than(&solution.point)
    {
        let feasible = point
            .values
            .as_ref()
            .is_ok_and(|v| v.violation() <= FEASIBLE);
        let better = improvement(&solution.point, &point) > SAME;
        if feasible && (better || solution.status == Status::Infeasible) {
            solution.status = Status::Stalled;
        }
        solution.point = point;
    }
    if solution.status == Status::Infeasible {
        solution = least_violation(problem, &evaluations, solution, progress);
    }
    let (evaluations, failed) = evaluations.counts();
    Ok(Solved {
        solution,
        evaluations,
        failed,
    })
}

/// The only design there is, where no variable is open: one profile among several.
fn alone(point: Point) -> Result<Solved, Failure> {
    let feasible = point.values.as_ref().map_err(Clone::clone)?.violation() <= FEASIBLE;
    let status = if feasible {
        Status::Optimal
    } else {
        Status::Infeasible
    };
    Ok(Solved {
        solution: Solution {
            point,
            status,
            kkt_residual: 0.0,
            multipliers: Vec::new(),
        },
        evaluations: 1,
        failed: 0,
    })
}

/// The constraints of a problem as its objective: what comes closest to meeting them.
struct Violation<'a>(&'a dyn Problem);

impl Problem for Violation<'_> {
    fn variables(&self) -> &[Variable] {
        self.0.variables()
    }

    fn goal(&self) -> String {
        self.0.goal()
    }

    fn piece_name(&self, index: usize) -> String {
        self.0.piece_name(index)
    }

    fn evaluate(&self, x: &[f64]) -> Result<Values, Failure> {
        let values = self.0.evaluate(x)?;
        Ok(Values {
            objective: values.constraints,
            constraints: Vec::new(),
        })
    }
}

/// Reduces the largest violation as far as it goes.
fn least_violation(
    problem: &dyn Problem,
    evaluations: &Evaluations,
    from: Solution,
    progress: &dyn Progress,
) -> Solution {
    let violation = Violation(problem);
    let relaxed = Evaluations::new(&violation, progress);
    let start = relaxed.at(&from.point.x);
    let found = local::search(&relaxed, start, local::WIDE);
    let point = evaluations.at(&found.point.x);
    evaluations.add(relaxed.counts());
    Solution {
        status: Status::Infeasible,
        point: if point.better_than(&from.point) {
            point
        } else {
            from.point
        },
        ..found
    }
}

fn improvement(from: &Point, to: &Point) -> f64 {
    match (&from.values, &to.values) {
        (Ok(a), Ok(b)) => {
            (a.objective() - b.objective()).abs() + (a.violation() - b.violation()).abs()
        }
        _ => f64::INFINITY,
    }
}
