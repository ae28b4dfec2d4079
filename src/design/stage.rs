//! One stage of the procedure: a task solved for every profile to choose from.

use rayon::prelude::*;

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
    evaluate::{curving::CurvingLimits, stability::Stability},
    index::MET,
    optimize::{
        archive::{Archive, Stop},
        local::Status,
        problem::{Failure, Point},
        solve::{Effort, NoDesign, Solved, Start},
    },
    parameter::{Parameter, TradeOff},
};

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
    /// The result of an earlier round, whose designs are looked at too.
    pub known: Option<&'a StageResult>,
    /// Other designs to begin from.
    pub also: &'a [Case],
    /// Start of the search, without designs.
    pub start: Start,
}

impl StageInput<'_> {
    fn choices(&self, tasks: &Tasks) -> Vec<f64> {
        let chooses = matches!(self.trade_off, None | Some(TradeOff::StabilityCurving));
        let is_followed = self.known.is_some() && self.start.everywhere.is_none();
        if chooses && !is_followed {
            tasks.profiles(self.now)
        } else {
            vec![self.now.wheel_rail.conicity]
        }
    }

    fn task(&self, tasks: &Tasks, case: &Case) -> Task {
        match self.trade_off {
            Some(trade_off) => tasks.trade_off(case, trade_off),
            None => tasks.joint(case),
        }
    }

    /// The study of a profile, where its search begins, and the parameters without influence, which
    /// it leaves out.
    fn begin(
        &self,
        tasks: &Tasks,
        conicity: f64,
        archive: &Archive,
    ) -> (Study, Start, Vec<Parameter>) {
        let mut case = self.now.clone();
        case.wheel_rail.conicity = conicity;
        let Task { study, .. } = self.task(tasks, &case);
        let without = unused(&study, &study.coordinates(self.now), archive);
        let parameters = without.iter().map(|i| study.parameters()[*i]).collect();
        let study = study.without(&without);
        let known = self.known.iter().flat_map(|known| &known.profiles);
        let own = known.into_iter().find(|p| same(p.conicity, conicity));
        let first = own.map_or(self.now, |own| &own.case);
        let designs = std::iter::once(first).chain(self.also);
        let designs = designs.map(|case| study.coordinates(case)).collect();
        let start = match own {
            // A global search for the least violation was made before.
            Some(own) if own.status == Status::Infeasible && own.coverage.is_some() => {
                Start::near(designs)
            }
            _ => self.start.clone().with(designs),
        };
        (study, start, parameters)
    }
}

/// Solves a task for every profile to choose from, with equal effort for each. Where no design
/// of any profile can be evaluated, the design at hand stays.
///
/// # Errors
///
/// [`Stop`] if the run ended before a design was evaluated.
pub fn solve(input: &StageInput, tasks: &Tasks, archive: &Archive) -> Result<Stage, Stop> {
    let mut best: Option<Candidate> = None;
    let mut profiles = Vec::new();
    let mut effort = Effort::default();
    for candidate in candidates(input, tasks, archive) {
        let candidate = match candidate {
            Ok(candidate) => candidate,
            Err(stop) if best.is_none() => return Err(stop),
            Err(_) => break,
        };
        profiles.push(profile(&candidate));
        effort.add(&candidate.searched.solved.effort);
        if best.as_ref().is_none_or(|best| candidate.is_better(best)) {
            best = Some(candidate);
        }
    }
    let mut best = best.ok_or(archive.stopped().unwrap_or(Stop::Interrupted))?;
    best.searched.add_curvature(archive);
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
    let is_best_found = |p: &Profile| p.status == Status::BestFound;
    if explained.status == Status::Optimal && profiles.iter().any(is_best_found) {
        // The other profile may have a better optimum.
        explained.status = Status::BestFound;
    }
    profiles.sort_by(|a, b| a.conicity.total_cmp(&b.conicity));
    Ok(Stage {
        result: StageResult {
            trade_off: input.trade_off,
            explained,
            unused: best.unused.clone(),
            profiles,
        },
        case: study.design(&solved.point.x),
        moved,
        best,
    })
}

/// Results for every profile; after the end of a run no further profile is begun.
fn candidates(
    input: &StageInput,
    tasks: &Tasks,
    archive: &Archive,
) -> Vec<Result<Candidate, Stop>> {
    let find = |conicity: f64, archive: &Archive| {
        let (study, start, unused) = input.begin(tasks, conicity, archive);
        let searched = match search(&study, &start, archive) {
            Ok(searched) => searched,
            Err(NoDesign::Failed(reason)) => at_hand(study, input.now, reason),
            Err(NoDesign::Stopped(stop)) => return Err(stop),
        };
        Ok(Candidate {
            searched,
            unused,
            conicity,
        })
    };
    let choices = input.choices(tasks);
    if !archive.has_budget() {
        let choices = choices.into_par_iter();
        return choices
            .map(|conicity| find(conicity, &archive.branch()))
            .collect();
    }
    // The order of evaluation decides which designs the budget still allows.
    let mut found = Vec::new();
    for conicity in choices {
        found.push(find(conicity, archive));
        if archive.stopped().is_some() {
            break;
        }
    }
    found
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
            optima: Vec::new(),
            coverage: None,
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

    /// True if it is better than another: violations that differ by less than is seen are decided
    /// by the objective, equals by the order in which they come.
    fn is_better(&self, other: &Self) -> bool {
        let ((class, value), (others_class, others)) = (self.rank(), other.rank());
        if class != others_class {
            return class < others_class;
        }
        if class == 1 && (value - others).abs() <= MET {
            let objective = |candidate: &Self| candidate.searched.solved.point.objective();
            return objective(self) < objective(other);
        }
        value < others
    }
}

/// Best design with the profile of a solved study.
fn profile(candidate: &Candidate) -> Profile {
    let Searched { study, solved, .. } = &candidate.searched;
    let case = study.design(&solved.point.x);
    let stability = Stability::of(&case);
    Profile {
        conicity: case.wheel_rail.conicity,
        status: solved.status,
        coverage: solved.coverage,
        critical_speed: stability.ok().and_then(|s| s.critical_speed()),
        degree: CurvingLimits::new(&case, 0.0).map_or(0.0, |limits| limits.degree()),
        bending_stiffness: case.vehicle.bending_stiffness(),
        lateral_stiffness: case.vehicle.suspension.primary.lateral_stiffness,
        case,
    }
}

impl StageResult {
    /// Adds the effort of an earlier round, and the profiles that only it searched.
    pub(super) fn absorb(&mut self, earlier: &Self) {
        self.explained.effort.add(&earlier.explained.effort);
        for profile in &earlier.profiles {
            let mut own = self.profiles.iter();
            if !own.any(|p| same(p.conicity, profile.conicity)) {
                self.profiles.push(profile.clone());
            }
        }
        self.profiles
            .sort_by(|a, b| a.conicity.total_cmp(&b.conicity));
    }
}
