//! One stage of the procedure: a task solved for every profile to choose from.

use super::{
    explain::Explained,
    outcome::{Profile, StageResult},
    procedure::DesignError,
    search::{Searched, search},
    study::Study,
    tasks::{Task, Tasks},
};
use crate::{
    case::Case,
    evaluate::{critical_speed::Stability, curving::CurvingLimits},
    optimize::{
        archive::Archive,
        local::Status,
        problem::Failure,
        solve::{Effort, NoDesign, Solved, Start},
    },
    parameter::TradeOff,
};

/// Objective behind the best down to which a profile may still win in a later round: 5 %.
const RACE: f64 = 0.05;

/// A design found for one profile.
#[derive(Clone)]
pub struct Candidate {
    /// The study in whose terms it was found.
    pub study: Study,
    /// Its solution.
    pub solved: Solved,
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

/// What a stage is to solve, and from where.
pub struct Brief<'a> {
    /// The design at hand.
    pub now: &'a Case,
    /// `None` for all at once.
    pub trade_off: Option<TradeOff>,
    /// What an earlier round came to: only profiles still in the race are followed.
    pub known: Option<&'a StageResult>,
    /// Other designs to begin from.
    pub also: &'a [Case],
    /// Seed of searches everywhere.
    pub seed: u64,
}

impl Brief<'_> {
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

    /// The study of a profile and where its search begins, when another has reached `beat`.
    fn begin(&self, tasks: &Tasks, conicity: f64, beat: f64) -> (Study, Start) {
        let mut case = self.now.clone();
        case.wheel_rail.conicity = conicity;
        let Task { study, .. } = self.task(tasks, &case);
        let current = study.coordinates(self.now);
        let start = match self.known {
            None => Start::everywhere(self.seed).with(vec![current]),
            Some(known) => {
                let own = known.profiles.iter().find(|p| same(p.conicity, conicity));
                Start::near(vec![own.map_or(current, |p| p.x.clone())])
            }
        };
        let also = self.also.iter().map(|case| study.coordinates(case));
        let start = Start {
            // All at once only the profiles that may win matter; in turn the table shows each.
            gives_up: self.trade_off.is_none(),
            beat,
            ..start.with(also.collect())
        };
        (study, start)
    }
}

/// Solves a task for every profile to choose from, or only those still in the race.
///
/// # Errors
///
/// [`DesignError::NothingEvaluated`] if no design of any profile could be evaluated.
pub fn solve(brief: &Brief, tasks: &Tasks, archive: &Archive) -> Result<Stage, DesignError> {
    let mut best: Option<Candidate> = None;
    let mut profiles = Vec::new();
    let mut effort = Effort::default();
    let mut given_up = Vec::new();
    let mut failure = NoDesign::Failed(Failure::NotFinite);
    let mut beat = f64::INFINITY;
    for conicity in brief.choices(tasks) {
        let (study, start) = brief.begin(tasks, conicity, beat);
        match search(&study, &start, archive) {
            Ok(Searched { study, solved }) => {
                // A profile that was given up has no optimum to show.
                if brief.trade_off.is_some() || solved.status != Status::Stalled {
                    profiles.push(profile(&study, &solved));
                } else {
                    given_up.push(conicity);
                }
                effort.add(&solved.effort);
                let is_better = |b: &Candidate| solved.point.better_than(&b.solved.point);
                if best.as_ref().is_none_or(is_better) {
                    if solved.point.feasible()
                        && let Ok(values) = &solved.point.values
                    {
                        beat = values.objective();
                    }
                    best = Some(Candidate {
                        study,
                        solved,
                        conicity,
                    });
                }
            }
            Err(reason) => failure = reason,
        }
        if archive.stopped().is_some() {
            break;
        }
    }
    let trade_off = brief.trade_off;
    let best = best.ok_or(DesignError::NothingEvaluated {
        trade_off,
        reason: failure,
    })?;
    let before = best.study.coordinates(brief.now);
    let changes = best.solved.point.x.iter().zip(&before);
    let moved = if same(best.conicity, brief.now.wheel_rail.conicity) {
        changes.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    } else {
        1.0
    };
    let goal = brief.task(tasks, brief.now).goal;
    let mut explained = Explained::new(&best.study, &best.solved, goal);
    explained.effort.evaluations = effort.evaluations;
    explained.effort.failures = effort.failures;
    profiles.sort_by(|a, b| a.conicity.total_cmp(&b.conicity));
    Ok(Stage {
        result: StageResult {
            trade_off,
            explained,
            profiles,
            given_up,
        },
        case: best.study.design(&best.solved.point.x),
        moved,
        best,
    })
}

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 0.0
}

/// What the profile of a solved study allows.
fn profile(study: &Study, solved: &Solved) -> Profile {
    let case = study.design(&solved.point.x);
    let stability = Stability::of(&case);
    Profile {
        conicity: case.wheel_rail.conicity,
        status: solved.status,
        critical_speed: stability.ok().and_then(|s| s.critical_speed()),
        degree: CurvingLimits::new(&case, 0.0).map_or(0.0, |limits| limits.degree()),
        bending_stiffness: case.vehicle.bending_stiffness(),
        lateral_stiffness: case.vehicle.suspension.primary.lateral_stiffness,
        x: solved.point.x.clone(),
        rank: match &solved.point.values {
            Ok(values) if values.feasible() => (0, values.objective()),
            Ok(values) => (1, values.violation()),
            Err(_) => (2, 0.0),
        },
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
