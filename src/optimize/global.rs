//! Global phase: local searches from uniform points, and from the far ends of the best design's
//! variables, until basins not yet seen are unlikely. A solver of argmin, one round of searches an
//! iteration.
//!
//! Multistart with the stopping rule of [`super::basins`]. Points without values are drawn again:
//! shares are of the space that can be evaluated. Two optima often differ in one variable, which is at
//! opposite ends of its range: from the best design found, each variable is moved to the far end of its
//! range and a local search follows; so again from a better design.

use std::collections::VecDeque;

use argmin::core::{
    CostFunction, Error, Executor, IterState, KV, Problem as Counted, Solver, TerminationReason,
    TerminationStatus,
};
use rand_chacha::{
    ChaCha8Rng,
    rand_core::{RngCore, SeedableRng},
};
use rayon::prelude::*;

use super::{
    archive::{Archive, Stop},
    basins::{Basins, is_overtaken, unseen},
    evaluations::Evaluations,
    local::{self, Found, Status},
    problem::{Point, Problem},
    start::{Everywhere, Start},
};

/// Number of local searches in a round, side by side on any number of threads.
const ROUND: usize = 4;
/// Number of uniform points evaluated at a time.
const BATCH: usize = 2 * ROUND;
/// Largest number of local optima for which the stopping rule is followed; problems with more end with the
/// best design found.
const MOST_OPTIMA: f64 = 14.0;
/// Limit on the uniform points drawn, per variable, for one that has values.
const DRAWS: usize = 40;
/// Least violation above which the box is covered evenly: a demand is missed by more than the factor e.
const FAR_FROM_FEASIBLE: f64 = 1.0;
/// Number of designs per variable of the even covering.
const COVERING: usize = 16;
/// Penalty by which its designs are ranked.
const START_PENALTY: f64 = 4.0;
/// Least distance of the chosen designs in at least one variable.
const START_DISTANCE: f64 = 0.12;
/// Scaled distance from which an end of a variable's range counts as far.
const FAR_END: f64 = 0.3;
/// Limit on the searches from the best design met, if the search that met it ended at a worse one.
const AGAIN_FROM_BEST: usize = 3;
/// Penalty of a violation in the merit for argmin.
const PENALTY: f64 = 20.0;

/// The merit of a design, as argmin sees it.
impl CostFunction for Evaluations<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
        Ok(self.graded_at(x)?.merit(PENALTY))
    }
}

/// Result of the global phase.
pub(super) struct Explored {
    /// The local optima.
    pub basins: Basins,
    /// The best design that a search met on its way.
    pub met: Option<Point>,
    /// Reason for an early end.
    pub stop: Option<Stop>,
}

/// Searches the unit box; the same seed gives the same designs on any number of threads.
pub(super) fn explore(problem: &dyn Problem, archive: &Archive, start: &Start) -> Explored {
    let mut multistart = Multistart::new(archive, start, problem.variables().len());
    let run = Executor::new(Evaluations::new(problem, archive), &mut multistart).run();
    // Evaluations that fail have a merit all the same: only the archive ends a run.
    let stop = run.err().and_then(|error| error.downcast_ref().copied());
    Explored {
        basins: multistart.basins,
        met: multistart.met,
        stop,
    }
}

/// Expected number of evaluations of a search, for progress reports.
pub(super) fn forecast(n: usize, start: &Start) -> usize {
    /// Local searches from uniform points where there are two optima.
    const SEARCHES: usize = 12;
    let local = 10 + 2 * n;
    let searches = match start.everywhere {
        Some(_) => SEARCHES + n,
        None => 0,
    };
    (searches + start.designs.len()) * local
}

/// Local searches from designs given, uniform points, and far ends.
struct Multistart<'a> {
    archive: &'a Archive<'a>,
    /// Trust radius of the searches.
    radius: f64,
    everywhere: Option<Everywhere>,
    random: ChaCha8Rng,
    /// Uniform points that can be evaluated, to search from.
    sample: VecDeque<Point>,
    /// Points drawn since the last that can be evaluated.
    failed: usize,
    /// Other designs to search from.
    others: VecDeque<Vec<f64>>,
    /// Optima from whose far ends was searched.
    turned: Vec<Vec<f64>>,
    is_covered: bool,
    again: usize,
    basins: Basins,
    met: Option<Point>,
    is_done: bool,
    n: usize,
}

/// Designs to search from.
enum Round {
    Uniform(Vec<Point>),
    Others(Vec<Point>),
}

impl<'a> Multistart<'a> {
    fn new(archive: &'a Archive<'a>, start: &Start, n: usize) -> Self {
        let mut others: VecDeque<Vec<f64>> = VecDeque::new();
        for design in &start.designs {
            if !others.contains(design) {
                others.push_back(design.clone());
            }
        }
        Self {
            archive,
            radius: start.radius,
            everywhere: start.everywhere,
            random: ChaCha8Rng::seed_from_u64(start.everywhere.map_or(0, |e| e.seed)),
            sample: VecDeque::new(),
            failed: 0,
            others,
            turned: Vec::new(),
            is_covered: false,
            again: 0,
            basins: Basins::default(),
            met: None,
            is_done: false,
            n,
        }
    }

    /// Keeps the best design met.
    fn meet(&mut self, point: &Point) {
        if self.met.as_ref().is_none_or(|best| point.better_than(best)) {
            self.met = Some(point.clone());
        }
    }

    /// The next designs to search from; none when the search is done.
    fn round(&mut self, evaluations: &Evaluations) -> Result<Option<Round>, Stop> {
        loop {
            if !self.others.is_empty() {
                let count = self.others.len().min(ROUND);
                let designs: Vec<Vec<f64>> = self.others.drain(..count).collect();
                let points = evaluations.graded(&designs)?;
                for point in &points {
                    self.meet(point);
                }
                let usable: Vec<Point> = points.into_iter().filter(|p| p.values.is_ok()).collect();
                if usable.is_empty() {
                    continue;
                }
                return Ok(Some(Round::Others(usable)));
            }
            if self.needs_sample() {
                self.draw(evaluations)?;
                let count = self.sample.len().min(ROUND).min(self.wanting());
                if count > 0 {
                    return Ok(Some(Round::Uniform(self.sample.drain(..count).collect())));
                }
            }
            if !self.cover(evaluations)? && !self.turn() && !self.go_on() {
                return Ok(None);
            }
        }
    }

    /// True if the stopping rule asks for more uniform points, and they can be had.
    fn needs_sample(&self) -> bool {
        self.everywhere.is_some_and(|everywhere| {
            let most = MOST_OPTIMA / everywhere.unseen.sqrt();
            self.basins.unseen() > everywhere.unseen
                && (self.basins.uniform() as f64) < most
                && self.failed < DRAWS * self.n
        })
    }

    /// Uniform points that the stopping rule asks for if no other optimum is found.
    fn wanting(&self) -> usize {
        let bound = self.everywhere.map_or(1.0, |everywhere| everywhere.unseen);
        let optima = self.basins.optima().max(1);
        (1..=ROUND)
            .find(|more| unseen(optima, self.basins.uniform() + more) <= bound)
            .unwrap_or(ROUND)
    }

    /// Draws uniform points until a round of them can be evaluated.
    fn draw(&mut self, evaluations: &Evaluations) -> Result<(), Stop> {
        while self.sample.len() < ROUND && self.failed < DRAWS * self.n {
            let coordinate =
                |random: &mut ChaCha8Rng| f64::from(random.next_u32()) / f64::from(u32::MAX);
            let designs: Vec<Vec<f64>> = (0..BATCH)
                .map(|_| (0..self.n).map(|_| coordinate(&mut self.random)).collect())
                .collect();
            for point in evaluations.graded(&designs)? {
                self.meet(&point);
                if point.values.is_ok() {
                    self.failed = 0;
                    self.sample.push_back(point);
                } else {
                    self.failed += 1;
                }
            }
        }
        Ok(())
    }

    /// Even covering of the box, once, if no known design is near feasibility: the best designs become
    /// starts, because local searches from elsewhere may not reach feasible ones. Returns true if there
    /// are new starts.
    fn cover(&mut self, evaluations: &Evaluations) -> Result<bool, Stop> {
        let least = self.met.as_ref().and_then(|met| met.values.as_ref().ok());
        let is_near = least.is_some_and(|values| values.violation() < FAR_FROM_FEASIBLE);
        if is_near || self.is_covered || self.everywhere.is_none() {
            return Ok(false);
        }
        self.is_covered = true;
        let covering: Vec<Vec<f64>> = (1..=COVERING * self.n).map(|i| halton(i, self.n)).collect();
        for point in evaluations.all(&covering)? {
            self.meet(&point);
        }
        let starts = evaluations.best_apart(START_PENALTY, START_DISTANCE, 2 + self.n);
        self.others.extend(starts.into_iter().map(|point| point.x));
        Ok(!self.others.is_empty())
    }

    /// Starts with each variable of the best design at the far ends of its range. Returns true if there
    /// are new ones.
    fn turn(&mut self) -> bool {
        let turns = self.everywhere.is_some_and(|everywhere| everywhere.turns);
        let Some(best) = self.basins.best().filter(|_| turns) else {
            return false;
        };
        let x = best.point.x.clone();
        if self.turned.contains(&x) {
            return false;
        }
        for (i, at) in x.iter().enumerate() {
            for end in [0.0, 1.0] {
                if (at - end).abs() > FAR_END {
                    let mut design = x.clone();
                    design[i] = end;
                    self.others.push_back(design);
                }
            }
        }
        self.turned.push(x);
        true
    }

    /// Start at the best design met, if the search that met it ended at a worse one.
    fn go_on(&mut self) -> bool {
        let (Some(met), Some(known)) = (&self.met, self.basins.best()) else {
            return false;
        };
        if self.again == AGAIN_FROM_BEST || !met.feasible() || !is_overtaken(known, met) {
            return false;
        }
        self.again += 1;
        self.others.push_back(met.x.clone());
        true
    }

    /// Searches from all designs of a round, independent of each other.
    fn follow(&mut self, round: Round, evaluations: &Evaluations) -> Result<(), Stop> {
        let (is_uniform, starts) = match round {
            Round::Uniform(starts) => (true, starts),
            Round::Others(starts) => (false, starts),
        };
        let known: Vec<Found> = self.basins.found().cloned().collect();
        let radius = if is_uniform { local::WIDE } else { self.radius };
        let search = |from: Point| {
            let own = Evaluations::new(evaluations.problem, self.archive);
            let found = local::search(&own, from, radius, &known);
            (found, own.best())
        };
        let ends: Vec<(Found, Option<Point>)> = if self.archive.has_budget() {
            // The order of evaluation decides which designs the budget still allows.
            starts.into_iter().map(search).collect()
        } else {
            starts.into_par_iter().map(search).collect()
        };
        let mut stop = None;
        for (found, met) in ends {
            stop = stop.or(match found.status {
                Status::BudgetSpent => Some(Stop::Budget),
                Status::Interrupted => Some(Stop::Interrupted),
                _ => None,
            });
            self.basins.add(found, is_uniform);
            if let Some(point) = met {
                self.meet(&point);
            }
        }
        stop.map_or(Ok(()), Err)
    }
}

type Progress = IterState<Vec<f64>, (), (), (), (), f64>;

impl<'p> Solver<Evaluations<'p>, Progress> for &mut Multistart<'_> {
    fn name(&self) -> &'static str {
        "multistart"
    }

    fn next_iter(
        &mut self,
        counted: &mut Counted<Evaluations<'p>>,
        state: Progress,
    ) -> Result<(Progress, Option<KV>), Error> {
        let evaluations = counted.problem.as_ref();
        let evaluations = evaluations.ok_or_else(|| Error::msg("no problem"))?;
        match self.round(evaluations)? {
            Some(round) => self.follow(round, evaluations)?,
            None => self.is_done = true,
        }
        let Some(best) = self.basins.best() else {
            return Ok((state, None));
        };
        let (x, merit) = (best.point.x.clone(), best.point.merit(PENALTY));
        Ok((state.param(x).cost(merit), None))
    }

    fn terminate(&mut self, _: &Progress) -> TerminationStatus {
        if self.is_done {
            TerminationStatus::Terminated(TerminationReason::SolverConverged)
        } else {
            TerminationStatus::NotTerminated
        }
    }
}

/// Point `i` of Halton's low-discrepancy sequence in `n` dimensions (Halton 1960).
pub fn halton(i: usize, n: usize) -> Vec<f64> {
    const PRIMES: [usize; 16] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53];
    PRIMES
        .iter()
        .take(n)
        .map(|&base| {
            let (mut rest, mut digit, mut x) = (i, 1.0, 0.0);
            while rest > 0 {
                digit /= base as f64;
                x += digit * (rest % base) as f64;
                rest /= base;
            }
            x
        })
        .collect()
}
