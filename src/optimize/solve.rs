//! Global search, then local searches from the best designs met.

use std::{
    collections::{BTreeMap, VecDeque},
    time::Instant,
};

use super::{
    archive::{Archive, Measured, Stop},
    certificate::Certificate,
    evaluations::{Evaluations, near},
    global,
    local::{self, Found, Status},
    problem::{Detail, Failure, Key, Piece, Point, Problem, Values, Variable},
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

/// What a search has spent.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Effort {
    /// Full-model evaluations; what the archive knew is not counted.
    pub evaluations: usize,
    /// Of which without a result, by reason.
    pub failures: BTreeMap<Failure, usize>,
    /// Local searches.
    pub starts: usize,
    /// How many of them came to the design that was returned.
    pub agreed: usize,
    /// Seconds.
    pub seconds: f64,
}

impl Effort {
    /// Adds another search's.
    pub fn add(&mut self, other: &Self) {
        self.evaluations += other.evaluations;
        for (failure, count) in &other.failures {
            *self.failures.entry(*failure).or_default() += count;
        }
        self.starts += other.starts;
        self.agreed += other.agreed;
        self.seconds += other.seconds;
    }

    /// Evaluations without a result.
    pub fn failed(&self) -> usize {
        self.failures.values().sum()
    }
}

/// Where a search begins.
#[derive(Debug, Clone)]
pub struct Start {
    /// Search everywhere with this seed; otherwise only from `designs`.
    pub everywhere: Option<u64>,
    /// Local searches that follow a global phase, beside one per variable.
    pub starts: usize,
    /// Designs worth a look, in scaled coordinates.
    pub designs: Vec<Vec<f64>>,
    /// Trust radius around these; a global phase sets its own.
    pub radius: f64,
    /// Objective that another problem has reached: one local search will do where this one has no
    /// hope to beat it.
    pub beat: f64,
    /// Then not even one.
    pub gives_up: bool,
}

impl Start {
    /// Anywhere, with a seed.
    pub fn everywhere(seed: u64) -> Self {
        Self {
            everywhere: Some(seed),
            starts: STARTS,
            designs: Vec::new(),
            radius: local::WIDE,
            beat: f64::INFINITY,
            gives_up: false,
        }
    }

    /// Near designs that were optimal for a slightly different problem.
    pub fn near(designs: Vec<Vec<f64>>) -> Self {
        Self {
            everywhere: None,
            starts: STARTS,
            designs,
            radius: local::NARROW,
            beat: f64::INFINITY,
            gives_up: false,
        }
    }

    /// Searches locally from many of the designs that the global phase met.
    #[must_use]
    pub fn thoroughly(self) -> Self {
        Self {
            starts: MANY_STARTS,
            ..self
        }
    }

    /// Looks at these designs too.
    #[must_use]
    pub fn with(mut self, designs: Vec<Vec<f64>>) -> Self {
        self.designs.extend(designs);
        self
    }
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

/// Local searches that follow a global phase, unless told otherwise, and where an index has many
/// local optima.
const STARTS: usize = 2;
const MANY_STARTS: usize = 8;
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
    if found.status == Status::Infeasible {
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
    let mut spent = archive.failures();
    for (failure, before) in failures {
        if let Some(count) = spent.get_mut(&failure) {
            *count -= before;
        }
    }
    spent.retain(|_, count| *count > 0);
    Ok(Solved {
        effort: Effort {
            evaluations: archive.count() - count,
            failures: spent,
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
                certificate: found.certificate.filter(|_| keeps),
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

/// The constraints of a problem as its objective: what comes closest to meeting them.
struct Violation<'a>(&'a dyn Problem);

impl Problem for Violation<'_> {
    fn variables(&self) -> &[Variable] {
        self.0.variables()
    }

    fn piece_name(&self, index: usize) -> String {
        self.0.piece_name(index)
    }

    fn key(&self, x: &[f64]) -> Key {
        self.0.key(x)
    }

    fn measure(&self, x: &[f64], detail: Detail) -> Measured {
        self.0.measure(x, detail)
    }

    fn has_gradients(&self) -> bool {
        self.0.has_gradients()
    }

    fn judge(&self, measured: &[Piece]) -> Values {
        Values {
            objectives: vec![self.0.judge(measured).constraints],
            constraints: Vec::new(),
        }
    }
}

/// Reduces the largest violation as far as it goes. The certificate is that of the reduction: its
/// objective multipliers tell which constraints conflict.
fn least_violation(problem: &dyn Problem, archive: &Archive, from: Found) -> Found {
    let relaxed = Violation(problem);
    let evaluations = Evaluations::new(&relaxed, archive);
    let Ok(start) = evaluations.at(&from.point.x) else {
        return from;
    };
    let found = local::search(&evaluations, start, local::WIDE, &[]);
    let status = match found.status {
        status @ (Status::BudgetSpent | Status::Interrupted) => status,
        _ => Status::Infeasible,
    };
    let values = archive
        .known(&problem.key(&found.point.x))
        .map(|measured| measured.map(|pieces| problem.judge(&pieces)));
    let point = Point {
        x: found.point.x,
        values: values.unwrap_or(Err(Failure::NotFinite)),
    };
    if point.feasible() {
        // The reduction found what the search had missed: it goes on from there.
        let evaluations = Evaluations::new(problem, archive);
        return local::search(&evaluations, point, local::NARROW, &[]);
    }
    if from.point.better_than(&point) {
        return from;
    }
    Found {
        point,
        status,
        certificate: found.certificate,
    }
}
