//! The design procedure: three trade-offs in the order of Figure 4.2.1 with the coupling loop, and
//! all at once.
//!
//! The vertical trade-off depends on nothing that the others choose, so it comes first and once
//! (its K_sz is part of the lateral model's roll stiffness). Stability–curving and the lateral
//! trade-off then alternate until neither changes anything.

use std::time::Instant;

use super::{
    conflict::conflict,
    margin::{margins, worst_value},
    outcome::{Compared, DesignResult, Joint, StageResult, half_kalker, in_conditions},
    stage::{self, Brief, Candidate, Stage},
    study::Role,
    tasks::Tasks,
};
use crate::{
    case::Case,
    dynamics::EigenError,
    evaluate::Evaluation,
    index::Index,
    optimize::{
        archive::Archive,
        local::Status,
        problem::{Problem, Values},
        solve::{Effort, NoDesign},
    },
    parameter::TradeOff,
    spec::{Order, Spec},
};

/// Rounds of the coupling loop.
const ROUNDS: usize = 10;
/// Change of every scaled variable below which a round changed nothing.
const UNCHANGED: f64 = 1e-4;

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
    design_beside(spec, archive, |_| ()).map(|(result, ())| result)
}

/// As [`design`], with what `beside` makes of the chosen design: where all at once is searched only to
/// compare, meanwhile.
///
/// # Errors
///
/// As [`design`].
pub fn design_beside<T: Send>(
    spec: &Spec,
    archive: &Archive,
    beside: impl FnOnce(&Case) -> T + Send,
) -> Result<(DesignResult, T), DesignError> {
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
    let (mut result, made) = procedure.run(&open, beside)?;
    result.effort = Effort {
        evaluations: archive.count(),
        failures: archive.failures(),
        seconds: clock.elapsed().as_secs_f64(),
        ..Effort::default()
    };
    result.stopped = archive.stopped();
    Ok((result, made))
}

struct Procedure<'a> {
    spec: &'a Spec,
    tasks: Tasks<'a>,
    archive: &'a Archive<'a>,
}

impl Procedure<'_> {
    fn run<T: Send>(
        &self,
        open: &[TradeOff],
        beside: impl FnOnce(&Case) -> T + Send,
    ) -> Result<(DesignResult, T), DesignError> {
        let joint_only = self.spec.design.order == Order::Joint
            || !self.spec.objective.is_empty()
            || self.tasks.entangled();
        if joint_only {
            let stage = self.stage(&Brief {
                now: &self.spec.case,
                trade_off: None,
                known: None,
                also: &[],
                seed: self.spec.design.seed,
            })?;
            let made = beside(&stage.case);
            let result = self.finish(stage.case, vec![stage.result], 0, true, &stage.best, None)?;
            return Ok((result, made));
        }
        let (stages, rounds, settled) = self.sequential(open)?;
        let last = stages.last().expect("something is open");
        let case = last.case.clone();
        let compare = open.len() > 1 && self.archive.stopped().is_none();
        let all_at_once = || compare.then(|| self.joint(&case)).transpose();
        let (joint, made) = rayon::join(all_at_once, || beside(&case));
        let joint = match joint {
            Err(error) if error.is_stop() => None,
            other => other?,
        };
        // The conflict, if there is one, is that of the stage that fell short.
        let short = stages
            .iter()
            .find(|s| s.best.solved.status == Status::Infeasible)
            .unwrap_or(last);
        let best = short.best.clone();
        let results = stages.into_iter().map(|s| s.result).collect();
        let result = self.finish(case, results, rounds, settled, &best, joint)?;
        Ok((result, made))
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
        self.stage(&Brief {
            now,
            trade_off: Some(trade_off),
            known,
            also: &[],
            seed: self.spec.design.seed,
        })
    }

    /// All at once, from the sequential design and from everywhere.
    fn joint(&self, sequential: &Case) -> Result<Joint, DesignError> {
        self.archive.stage("all at once");
        let stage = self.stage(&Brief {
            now: sequential,
            trade_off: None,
            known: None,
            also: std::slice::from_ref(sequential),
            seed: self.spec.design.seed,
        })?;
        let study = &stage.best.study;
        // In the terms of the task, whether or not the solution is lifted.
        let plain = &self.tasks.joint(&stage.case).study;
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

    fn stage(&self, brief: &Brief) -> Result<Stage, DesignError> {
        stage::solve(brief, &self.tasks, self.archive)
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
