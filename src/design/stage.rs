//! One stage of the procedure: a task solved for every profile to choose from.

use super::{
    explain::Explained,
    outcome::{Profile, StageResult},
    search::{Searched, search},
    study::Study,
    tasks::{Task, Tasks},
    unused::unused,
};
use crate::{
    case::Case,
    evaluate::{critical_speed::Stability, curving::CurvingLimits},
    index::MET,
    optimize::{
        archive::{Archive, Stop},
        local::Status,
        problem::{Failure, Point, Values},
        solve::{Effort, NoDesign, Solved, Start},
    },
    parameter::{Parameter, TradeOff},
};

/// Objective behind the best down to which a profile may still win in a later round: 5 %.
const RACE: f64 = 0.05;

/// A design found for one profile.
pub struct Candidate {
    /// The study and its solution.
    pub searched: Searched,
    /// Parameters without influence, which keep the value as given.
    unused: Vec<Parameter>,
    conicity: f64,
}

/// A stage's result with its design, and how far it moved from where it began.
pub struct Stage {
    /// For the tables.
    pub result: StageResult,
    /// The best design.
    pub case: Case,
    /// Largest change of a scaled variable.
    pub moved: f64,
    /// The best of the profiles.
    pub best: Candidate,
}

/// A task to be solved, and the designs to begin from.
pub struct StageInput<'a> {
    /// The design at hand.
    pub now: &'a Case,
    /// `None` for all at once.
    pub trade_off: Option<TradeOff>,
    /// The result of an earlier round: only profiles still in the race are followed.
    pub known: Option<&'a StageResult>,
    /// Other designs to begin from.
    pub also: &'a [Case],
    /// Seed of the global search.
    pub seed: u64,
}

impl StageInput<'_> {
    fn choices(&self, tasks: &Tasks) -> Vec<f64> {
        let chooses = matches!(self.trade_off, None | Some(TradeOff::StabilityCurving));
        match (chooses, self.known) {
            (false, _) => vec![self.now.wheel_rail.conicity],
            (true, None) => tasks.profiles(self.now),
            (true, Some(known)) => in_the_race(known, tasks.profiles(self.now)),
        }
    }

    fn task(&self, tasks: &Tasks, case: &Case) -> Task {
        match self.trade_off {
            Some(trade_off) => tasks.trade_off(case, trade_off),
            None => tasks.joint(case),
        }
    }

    /// The study of a profile, where its search begins when another has reached `beat`, and the
    /// parameters without influence, which it leaves out.
    fn begin(
        &self,
        tasks: &Tasks,
        conicity: f64,
        beat: f64,
        archive: &Archive,
    ) -> (Study, Start, Vec<Parameter>) {
        let mut case = self.now.clone();
        case.wheel_rail.conicity = conicity;
        let Task { study, .. } = self.task(tasks, &case);
        let without = unused(&study, &study.coordinates(self.now), archive);
        let parameters = without.iter().map(|i| study.parameters()[*i]).collect();
        let study = study.without(&without);
        let current = study.coordinates(self.now);
        let start = match self.known {
            None => Start::everywhere(self.seed).with(vec![current]),
            Some(known) => {
                let own = known.profiles.iter().find(|p| same(p.conicity, conicity));
                Start::near(vec![own.map_or(current, |p| study.coordinates(&p.case))])
            }
        };
        let also = self.also.iter().map(|case| study.coordinates(case));
        let start = Start {
            // All at once only the profiles that may win matter; in turn the table shows each.
            gives_up: self.trade_off.is_none(),
            beat,
            ..start.with(also.collect())
        };
        (study, start, parameters)
    }
}

/// Solves a task for every profile to choose from, or only those still in the race. Where no design
/// of any profile can be evaluated, the design at hand stays.
///
/// # Errors
///
/// [`Stop`] if the run ended before a design was evaluated.
pub fn solve(input: &StageInput, tasks: &Tasks, archive: &Archive) -> Result<Stage, Stop> {
    let mut best: Option<Candidate> = None;
    let mut profiles = Vec::new();
    let mut effort = Effort::default();
    let mut given_up = Vec::new();
    let mut beat = f64::INFINITY;
    for conicity in input.choices(tasks) {
        let (study, start, unused) = input.begin(tasks, conicity, beat, archive);
        let searched = match search(&study, &start, archive) {
            Ok(searched) => searched,
            Err(NoDesign::Failed(reason)) => at_hand(study, input.now, reason),
            Err(NoDesign::Stopped(stop)) if best.is_none() => return Err(stop),
            Err(NoDesign::Stopped(_)) => break,
        };
        let candidate = Candidate {
            searched,
            unused,
            conicity,
        };
        let solved = &candidate.searched.solved;
        // A profile that was given up has no optimum to show.
        if input.trade_off.is_some() || solved.status != Status::Stalled {
            profiles.push(profile(&candidate));
        } else {
            given_up.push(conicity);
        }
        effort.add(&solved.effort);
        if best.as_ref().is_none_or(|best| candidate.is_better(best)) {
            if let (0, objective) = candidate.rank() {
                beat = objective;
            }
            best = Some(candidate);
        }
        if archive.stopped().is_some() {
            break;
        }
    }
    let best = best.ok_or(archive.stopped().unwrap_or(Stop::Interrupted))?;
    let Searched { study, solved, .. } = &best.searched;
    let before = study.coordinates(input.now);
    let changes = solved.point.x.iter().zip(&before);
    let moved = if same(best.conicity, input.now.wheel_rail.conicity) {
        changes.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    } else {
        1.0
    };
    let goal = input.task(tasks, input.now).goal;
    let mut explained = Explained::new(&best.searched, goal);
    explained.effort.evaluations = effort.evaluations;
    explained.effort.failures = effort.failures;
    profiles.sort_by(|a, b| a.conicity.total_cmp(&b.conicity));
    Ok(Stage {
        result: StageResult {
            trade_off: input.trade_off,
            explained,
            unused: best.unused.clone(),
            profiles,
            given_up,
        },
        case: study.design(&solved.point.x),
        moved,
        best,
    })
}

/// The design at hand as the answer to a study that no design has a performance in.
fn at_hand(study: Study, now: &Case, reason: Failure) -> Searched {
    Searched {
        solved: Solved {
            point: Point {
                x: study.coordinates(now),
                values: Err(reason),
            },
            status: Status::Failed(reason),
            certificate: None,
            effort: Effort::default(),
            ends: Vec::new(),
        },
        asked: study.clone(),
        study,
        missed: Vec::new(),
    }
}

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 0.0
}

impl Candidate {
    /// Class (all met, demands missed, no performance) and, within it, the objective or the largest
    /// violation.
    fn rank(&self) -> (u8, f64) {
        let violation = self.searched.violation();
        match &self.searched.solved.point.values {
            Err(_) => (2, 0.0),
            Ok(values) if !values.feasible() => (1, values.violation().max(violation)),
            Ok(values) if !self.searched.misses() => (0, values.objective()),
            Ok(_) => (1, violation),
        }
    }

    /// Whether it is better than another: violations that differ by less than is seen are decided
    /// by the objective, equals by the order in which they come.
    fn is_better(&self, other: &Self) -> bool {
        let ((class, value), (others_class, others)) = (self.rank(), other.rank());
        if class != others_class {
            return class < others_class;
        }
        if class == 1 && (value - others).abs() <= MET {
            let objective = |candidate: &Self| {
                let values = candidate.searched.solved.point.values.as_ref();
                values.map_or(f64::INFINITY, Values::objective)
            };
            return objective(self) < objective(other);
        }
        value < others
    }
}

/// What the profile of a solved study allows.
fn profile(candidate: &Candidate) -> Profile {
    let Searched { study, solved, .. } = &candidate.searched;
    let case = study.design(&solved.point.x);
    let stability = Stability::of(&case);
    Profile {
        conicity: case.wheel_rail.conicity,
        status: solved.status,
        critical_speed: stability.ok().and_then(|s| s.critical_speed()),
        degree: CurvingLimits::new(&case, 0.0).map_or(0.0, |limits| limits.degree()),
        bending_stiffness: case.vehicle.bending_stiffness(),
        lateral_stiffness: case.vehicle.suspension.primary.lateral_stiffness,
        rank: candidate.rank(),
        case,
    }
}

/// Profiles nearly as good as the best: later rounds change little.
fn in_the_race(known: &StageResult, all: Vec<f64>) -> Vec<f64> {
    let best = known
        .profiles
        .iter()
        .map(|p| p.rank)
        .min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let near =
        |p: &Profile| best.is_some_and(|(class, rank)| p.rank.0 == class && p.rank.1 < rank + RACE);
    all.into_iter()
        .filter(|c| {
            known
                .profiles
                .iter()
                .any(|p| same(p.conicity, *c) && near(p))
        })
        .collect()
}

impl StageResult {
    /// Adds what an earlier round spent, and its profiles that left the race.
    pub(super) fn absorb(&mut self, earlier: &Self) {
        let first = &earlier.explained.effort;
        self.explained.effort.add(first);
        // The first round looked everywhere; later ones follow.
        self.explained.effort.starts = first.starts;
        self.explained.effort.agreed = first.agreed;
        for profile in &earlier.profiles {
            if !self
                .profiles
                .iter()
                .any(|p| same(p.conicity, profile.conicity))
            {
                self.profiles.push(profile.clone());
            }
        }
        self.profiles
            .sort_by(|a, b| a.conicity.total_cmp(&b.conicity));
    }
}
