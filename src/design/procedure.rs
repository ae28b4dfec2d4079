//! The design procedure: three trade-offs in the order of Figure 4.2.1 with the coupling loop, and
//! all at once.
//!
//! The vertical trade-off depends on nothing that the others choose, so it comes first and once
//! (its K_sz is part of the lateral model's roll stiffness). Stability–curving and the lateral
//! trade-off then alternate until neither changes anything.

use std::time::Instant;

use super::{
    conflict::conflict,
    explain::Explained,
    margin::{margins, worst_value},
    outcome::{Compared, DesignResult, Joint, Profile, StageResult, half_kalker, in_conditions},
    search::{Searched, search},
    study::{Role, Study},
    tasks::{Task, Tasks},
};
use crate::{
    case::Case,
    dynamics::EigenError,
    evaluate::{Evaluation, critical_speed::Stability, curving::CurvingLimits},
    index::Index,
    optimize::{
        archive::Archive,
        local::Status,
        problem::{Problem, Values},
        solve::{Effort, NoDesign, Solved, Start},
    },
    parameter::TradeOff,
    spec::{Order, Spec},
};

/// Rounds of the coupling loop.
const ROUNDS: usize = 10;
/// Change of every scaled variable below which a round changed nothing.
const UNCHANGED: f64 = 1e-4;
/// Objective behind the best down to which a profile may still win in a later round: 5 %.
const RACE: f64 = 0.05;

/// Why there is no design.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DesignError {
    /// Nothing to choose.
    #[error("nothing is open to design: give bounds in [design]")]
    NothingOpen,
    /// Open stiffnesses without anything to judge them by.
    #[error(
        "the primary suspension, the yaw suspension or the conicity is open, but [requirements] \
         gives neither a critical_speed nor a degree_curve to choose them by, nor is there an \
         [objective]"
    )]
    NoRequirement,
    /// No design in the range could be evaluated.
    #[error("{}{reason}", .trade_off.map_or_else(String::new, |t| format!("{t}: ")))]
    NothingEvaluated {
        /// Where.
        trade_off: Option<TradeOff>,
        /// Why.
        reason: NoDesign,
    },
    /// The chosen design could not be evaluated.
    #[error(transparent)]
    Eigen(#[from] EigenError),
}

impl DesignError {
    /// Whether the run was ended rather than failed.
    fn is_stop(&self) -> bool {
        matches!(
            self,
            Self::NothingEvaluated {
                reason: NoDesign::Stopped(_),
                ..
            }
        )
    }
}

/// Designs the suspension of a spec.
///
/// # Errors
///
/// [`DesignError`] where there is nothing to choose or nothing to choose by. Requirements that
/// cannot be met are no error: the result holds the best compromise and says what is not met.
pub fn design(spec: &Spec, archive: &Archive) -> Result<DesignResult, DesignError> {
    let tasks = Tasks::new(spec);
    let all = [
        TradeOff::Vertical,
        TradeOff::StabilityCurving,
        TradeOff::Lateral,
    ];
    let open: Vec<TradeOff> = all.into_iter().filter(|t| tasks.open(*t)).collect();
    if open.is_empty() {
        return Err(DesignError::NothingOpen);
    }
    let judged = |index| spec.demands.get(index).is_some();
    if spec.objective.is_empty()
        && open.contains(&TradeOff::StabilityCurving)
        && !(judged(Index::CriticalSpeed) || judged(Index::DegreeCurve))
    {
        return Err(DesignError::NoRequirement);
    }
    let clock = Instant::now();
    let procedure = Procedure {
        spec,
        tasks,
        archive,
    };
    let mut result = procedure.run(&open)?;
    result.effort = Effort {
        evaluations: archive.count(),
        failures: archive.failures(),
        seconds: clock.elapsed().as_secs_f64(),
        ..Effort::default()
    };
    result.stopped = archive.stopped();
    Ok(result)
}

struct Procedure<'a> {
    spec: &'a Spec,
    tasks: Tasks<'a>,
    archive: &'a Archive<'a>,
}

/// A design found for one profile.
struct Candidate {
    study: Study,
    solved: Solved,
    conicity: f64,
}

/// A stage's result with its design, and how far it moved from where it began.
struct Stage {
    result: StageResult,
    case: Case,
    moved: f64,
    best: Candidate,
}

impl Procedure<'_> {
    fn run(&self, open: &[TradeOff]) -> Result<DesignResult, DesignError> {
        let joint_only = self.spec.design.order == Order::Joint
            || !self.spec.objective.is_empty()
            || self.tasks.entangled();
        if joint_only {
            let task = |case: &Case| self.tasks.joint(case);
            let stage = self.stage(&self.spec.case, None, &task, None, &[])?;
            return self.finish(stage.case, vec![stage.result], 0, true, &stage.best, None);
        }
        let (stages, rounds, settled) = self.sequential(open)?;
        let last = stages.last().expect("something is open");
        let case = last.case.clone();
        let joint = if open.len() > 1 && self.archive.stopped().is_none() {
            match self.joint(&case) {
                Ok(joint) => Some(joint),
                Err(error) if error.is_stop() => None,
                Err(error) => return Err(error),
            }
        } else {
            None
        };
        // The conflict, if there is one, is that of the stage that fell short.
        let short = stages
            .iter()
            .find(|s| s.best.solved.status == Status::Infeasible)
            .unwrap_or(last);
        let best = Candidate {
            study: short.best.study.clone(),
            solved: short.best.solved.clone(),
            conicity: short.best.conicity,
        };
        let results = stages.into_iter().map(|s| s.result).collect();
        self.finish(case, results, rounds, settled, &best, joint)
    }

    /// The report's order: the stages with their last results, and the rounds taken.
    fn sequential(&self, open: &[TradeOff]) -> Result<(Vec<Stage>, usize, bool), DesignError> {
        let mut now = self.spec.case.clone();
        let mut stages: Vec<Stage> = Vec::new();
        let coupled: Vec<TradeOff> = open
            .iter()
            .copied()
            .filter(|t| *t != TradeOff::Vertical)
            .collect();
        if open.contains(&TradeOff::Vertical) {
            let stage = self.trade_off(&now, TradeOff::Vertical, None, 0)?;
            now = stage.case.clone();
            stages.push(stage);
        }
        // What is finished stays if the run ends before the next trade-off has a design.
        let ended = |error: &DesignError, stages: &[Stage]| {
            let stopped = DesignError::is_stop(error);
            stopped && !stages.is_empty()
        };
        let mut rounds = 0;
        let mut settled = coupled.is_empty();
        while !settled && rounds < ROUNDS && self.archive.stopped().is_none() {
            let mut moved: f64 = 0.0;
            for trade_off in &coupled {
                let at = stages
                    .iter()
                    .position(|s| s.result.trade_off == Some(*trade_off));
                let known = at.map(|i| &stages[i].result);
                let mut stage = match self.trade_off(&now, *trade_off, known, rounds) {
                    Ok(stage) => stage,
                    Err(error) if ended(&error, &stages) => break,
                    Err(error) => return Err(error),
                };
                moved = moved.max(stage.moved);
                now = stage.case.clone();
                match at {
                    Some(i) => {
                        stage.result.absorb(&stages[i].result);
                        stages[i] = stage;
                    }
                    None => stages.push(stage),
                }
            }
            rounds += 1;
            settled = moved < UNCHANGED || coupled.len() < 2;
        }
        // The last stage knows the design as all have left it.
        if let Some(last) = stages.last_mut() {
            last.case = now;
        }
        Ok((stages, rounds, settled))
    }

    fn trade_off(
        &self,
        now: &Case,
        trade_off: TradeOff,
        known: Option<&StageResult>,
        round: usize,
    ) -> Result<Stage, DesignError> {
        self.archive
            .stage(&format!("{trade_off}, round {}", round + 1));
        let task = |case: &Case| self.tasks.trade_off(case, trade_off);
        self.stage(now, Some(trade_off), &task, known, &[])
    }

    /// All at once, from the sequential design and from everywhere.
    fn joint(&self, sequential: &Case) -> Result<Joint, DesignError> {
        self.archive.stage("all at once");
        let task = |case: &Case| self.tasks.joint(case);
        let stage = self.stage(
            sequential,
            None,
            &task,
            None,
            std::slice::from_ref(sequential),
        )?;
        let study = &stage.best.study;
        // In the terms of the task, whether or not the solution is lifted.
        let plain = &task(&stage.case).study;
        let merits = [sequential, &stage.case].map(|case| plain.evaluate(&plain.coordinates(case)));
        let mut indices: Vec<Index> = Vec::new();
        for term in study.terms() {
            if matches!(term.role, Role::Objective { .. }) && !indices.contains(&term.index) {
                indices.push(term.index);
            }
        }
        let merit = |values: &Result<Values, _>| match values {
            Ok(values) => values.objective(),
            Err(_) => f64::NAN,
        };
        Ok(Joint {
            gain: merit(&merits[0]) - merit(&merits[1]),
            indices: indices
                .into_iter()
                .map(|index| Compared {
                    index,
                    sequential: worst_value(sequential, &self.spec.conditions, index),
                    joint: worst_value(&stage.case, &self.spec.conditions, index),
                })
                .collect(),
            stage: stage.result,
            case: stage.case,
        })
    }

    /// Solves a task for every profile to choose from, or only those still in the race.
    fn stage(
        &self,
        now: &Case,
        trade_off: Option<TradeOff>,
        task: &dyn Fn(&Case) -> Task,
        known: Option<&StageResult>,
        also: &[Case],
    ) -> Result<Stage, DesignError> {
        let fail = |reason| DesignError::NothingEvaluated { trade_off, reason };
        let chooses = matches!(trade_off, None | Some(TradeOff::StabilityCurving));
        let choices = match (chooses, known) {
            (false, _) => vec![now.wheel_rail.conicity],
            (true, None) => self.tasks.profiles(now),
            (true, Some(known)) => in_the_race(known, self.tasks.profiles(now)),
        };
        let mut best: Option<Candidate> = None;
        let mut profiles = Vec::new();
        let mut effort = Effort::default();
        let mut given_up = Vec::new();
        let mut failure = None;
        for conicity in choices {
            let mut case = now.clone();
            case.wheel_rail.conicity = conicity;
            let Task { study, .. } = task(&case);
            let current = study.coordinates(now);
            // All at once only the profiles that may win matter; in turn the table shows each.
            let mut start = match known {
                None => Start::everywhere(self.spec.design.seed).with(vec![current.clone()]),
                Some(known) => {
                    let own = known.profiles.iter().find(|p| same(p.conicity, conicity));
                    Start::near(vec![own.map_or(current.clone(), |p| p.x.clone())])
                }
            };
            start = start.with(also.iter().map(|case| study.coordinates(case)).collect());
            start.gives_up = trade_off.is_none();
            if let Some(best) = &best
                && best.solved.point.feasible()
                && let Ok(values) = &best.solved.point.values
            {
                start.beat = values.objective();
            }
            match search(&study, &start, self.archive) {
                Ok(Searched { study, solved }) => {
                    // A profile that was given up has no optimum to show.
                    if trade_off.is_some() || solved.status != Status::Stalled {
                        profiles.push(profile(&study, &solved));
                    } else {
                        given_up.push(conicity);
                    }
                    effort.add(&solved.effort);
                    let better = best
                        .as_ref()
                        .is_none_or(|b| solved.point.better_than(&b.solved.point));
                    if better {
                        best = Some(Candidate {
                            study,
                            solved,
                            conicity,
                        });
                    }
                }
                Err(reason) => failure = Some(reason),
            }
            if self.archive.stopped().is_some() {
                break;
            }
        }
        let Some(best) = best else {
            return Err(fail(failure.unwrap_or(NoDesign::Failed(
                crate::optimize::problem::Failure::NotFinite,
            ))));
        };
        let case = best.study.design(&best.solved.point.x);
        let before: Vec<f64> = best.study.coordinates(now);
        let moved = best
            .solved
            .point
            .x
            .iter()
            .zip(&before)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        let moved = if same(best.conicity, now.wheel_rail.conicity) {
            moved
        } else {
            1.0
        };
        let goal = task(now).goal;
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
            case,
            moved,
            best,
        })
    }

    fn finish(
        &self,
        case: Case,
        mut stages: Vec<StageResult>,
        rounds: usize,
        settled: bool,
        best: &Candidate,
        joint: Option<Joint>,
    ) -> Result<DesignResult, DesignError> {
        for stage in &mut stages {
            if stage.profiles.len() < 2 {
                stage.profiles.clear();
            }
        }
        let spec = self.spec;
        let evaluation = Evaluation::new(&case)?;
        let margins = margins(&case, &spec.demands, &spec.conditions);
        let short = margins.iter().any(|m| !m.met());
        let conflict = if short && best.solved.status == Status::Infeasible {
            self.archive.stage("conflicting requirements");
            conflict(
                &best.study,
                &best.solved.point.x,
                spec.design.seed,
                self.archive,
            )
        } else if short && self.archive.stopped().is_none() {
            // The margins were made as large as can be and are too small: all demands together.
            let study = self.tasks.bare(&case, &[]);
            conflict(
                &study,
                &study.coordinates(&case),
                spec.design.seed,
                self.archive,
            )
        } else {
            None
        };
        Ok(DesignResult {
            half_kalker: half_kalker(&case)?,
            before: Evaluation::new(&spec.case)?,
            conditions: in_conditions(spec, &case)?,
            evaluation,
            case,
            stages,
            rounds,
            settled,
            joint,
            margins,
            conflict,
            effort: Effort::default(),
            stopped: None,
        })
    }
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
    fn absorb(&mut self, earlier: &Self) {
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
