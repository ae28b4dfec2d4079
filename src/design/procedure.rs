//! The design procedure: three trade-offs in the order of Figure 4.2.1 with the coupling loop, and
//! all at once.
//!
//! The vertical trade-off depends on nothing that the others choose, so it comes first and once
//! (its K_sz is part of the lateral model's roll stiffness). Stability–curving and the lateral
//! trade-off then alternate until neither changes anything.

use std::time::Instant;

use super::{
    conflict::conflict,
    margin::{Margin, margins, worst_value},
    outcome::{Compared, Delivered, DesignResult, Joint, StageResult, half_kalker, in_conditions},
    search::Searched,
    stage::{self, Stage, StageInput},
    standing::Standing,
    study::Role,
    tasks::Tasks,
};
use crate::{
    case::Case,
    dynamics::EigenError,
    evaluate::Evaluation,
    index::Index,
    optimize::{
        archive::{Archive, Stop},
        problem::Problem,
        solve::{Effort, Start},
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
    /// The chosen design could not be evaluated.
    #[error(transparent)]
    Eigen(#[from] EigenError),
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

/// As [`design`], with the result of `beside` for the delivered design; where all at once is searched
/// only to compare, both run side by side.
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
    let given = procedure.tasks.admissible(&spec.case);
    let (chosen, made) = procedure.run(&open, &given, beside);
    let mut result = procedure.finish(chosen)?;
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

/// The design to be delivered and how it was come to.
struct Chosen {
    case: Case,
    delivered: Delivered,
    stages: Vec<Stage>,
    rounds: usize,
    settled: bool,
    joint: Option<(Joint, Searched)>,
}

impl Procedure<'_> {
    fn run<T: Send>(
        &self,
        open: &[TradeOff],
        given: &Case,
        beside: impl FnOnce(&Case) -> T + Send,
    ) -> (Chosen, T) {
        let joint_only = self.spec.design.order == Order::Joint
            || !self.spec.objective.is_empty()
            || self.tasks.entangled();
        let mut chosen = if joint_only {
            self.joint_only(given)
        } else {
            self.sequential(open, given)
        };
        let stages = chosen.stages.iter().map(|stage| &stage.result);
        let mut standing = self.standing(&chosen.case, stages);
        let short = standing != Standing::default();
        let compare = !joint_only && (open.len() > 1 || short) && self.archive.stopped().is_none();
        if compare && !short {
            let case = chosen.case.clone();
            let (joint, made) = rayon::join(|| self.joint(&case, given), || beside(&case));
            chosen.joint = joint;
            return (chosen, made);
        }
        if compare {
            // In turn something is missed: all at once may meet it.
            chosen.joint = self.joint(&chosen.case, given);
            if let Some((joint, _)) = &chosen.joint {
                let all_at_once = self.standing(&joint.case, [&joint.stage]);
                if all_at_once.is_better_than(&standing) {
                    standing = all_at_once;
                    chosen.case = joint.case.clone();
                    chosen.delivered = Delivered::AllAtOnce;
                }
            }
        }
        let stages = chosen.stages.iter().map(|stage| &stage.result);
        if short && self.standing(given, stages).is_better_than(&standing) {
            chosen.case = given.clone();
            chosen.delivered = Delivered::AsGiven;
        }
        let made = beside(&chosen.case);
        (chosen, made)
    }

    /// Everywhere, as thoroughly as the spec asks.
    fn start(&self) -> Start {
        Start::everywhere(self.spec.design.seed).until(self.spec.design.unseen)
    }

    fn margins(&self, case: &Case) -> Vec<Margin> {
        margins(case, &self.spec.demands, &self.spec.conditions)
    }

    /// How a design that some stages led to stands to the demands.
    fn standing<'r>(
        &self,
        case: &Case,
        stages: impl IntoIterator<Item = &'r StageResult>,
    ) -> Standing {
        let failed = stages.into_iter().any(|stage| stage.failure().is_some());
        Standing::new(&self.margins(case), failed)
    }

    fn joint_only(&self, given: &Case) -> Chosen {
        let stage = self.stage(&StageInput {
            now: given,
            trade_off: None,
            known: None,
            also: &[],
            start: self.start(),
        });
        let stages: Vec<Stage> = stage.into_iter().collect();
        Chosen {
            case: stages
                .last()
                .map_or_else(|| given.clone(), |stage| stage.case.clone()),
            delivered: Delivered::AllAtOnce,
            stages,
            rounds: 0,
            settled: true,
            joint: None,
        }
    }

    /// The report's order: the stages with their last results, and the rounds taken. A run that ends
    /// early keeps what is finished.
    fn sequential(&self, open: &[TradeOff], given: &Case) -> Chosen {
        let mut now = given.clone();
        let mut stages: Vec<Stage> = Vec::new();
        let coupled: Vec<TradeOff> = open
            .iter()
            .copied()
            .filter(|t| *t != TradeOff::Vertical)
            .collect();
        if open.contains(&TradeOff::Vertical)
            && let Ok(stage) = self.trade_off(&now, TradeOff::Vertical, None, self.start(), 0)
        {
            now = stage.case.clone();
            stages.push(stage);
        }
        let mut rounds = 0;
        let mut settled = coupled.is_empty();
        // The first round looks everywhere and the next follow the designs found; the last looks
        // everywhere again, as what holds then is not what held at first.
        let mut everywhere = true;
        while !settled && rounds < ROUNDS && self.archive.stopped().is_none() {
            let mut moved: f64 = 0.0;
            for trade_off in &coupled {
                let at = stages
                    .iter()
                    .position(|s| s.result.trade_off == Some(*trade_off));
                let known = at.map(|i| &stages[i].result).filter(|_| rounds > 0);
                let start = if everywhere {
                    self.start()
                } else {
                    Start::near(Vec::new())
                };
                let Ok(mut stage) = self.trade_off(&now, *trade_off, known, start, rounds) else {
                    break;
                };
                moved = moved.max(stage.moved);
                now = stage.case.clone();
                match at {
                    Some(i) => {
                        stage
                            .result
                            .explained
                            .effort
                            .add(&stages[i].result.explained.effort);
                        stages[i] = stage;
                    }
                    None => stages.push(stage),
                }
            }
            rounds += 1;
            let unchanged = moved < UNCHANGED || coupled.len() < 2;
            settled = unchanged && everywhere;
            everywhere = unchanged;
        }
        Chosen {
            case: now,
            delivered: Delivered::InTurn,
            stages,
            rounds,
            settled,
            joint: None,
        }
    }

    fn trade_off(
        &self,
        now: &Case,
        trade_off: TradeOff,
        known: Option<&StageResult>,
        start: Start,
        round: usize,
    ) -> Result<Stage, Stop> {
        self.archive
            .stage(&format!("{trade_off}, round {}", round + 1));
        self.stage(&StageInput {
            now,
            trade_off: Some(trade_off),
            known,
            also: &[],
            start,
        })
    }

    /// All at once, from the sequential design, the one as given, and from everywhere. `None` if the
    /// run ended before.
    fn joint(&self, sequential: &Case, given: &Case) -> Option<(Joint, Searched)> {
        self.archive.stage("all at once");
        let stage = self
            .stage(&StageInput {
                now: sequential,
                trade_off: None,
                known: None,
                also: &[sequential.clone(), given.clone()],
                start: self.start(),
            })
            .ok()?;
        // In the terms of the task, whether or not the solution is lifted.
        let plain = &self.tasks.joint(&stage.case).study;
        let merits = [sequential, &stage.case].map(|case| plain.evaluate(&plain.coordinates(case)));
        let mut indices: Vec<Index> = Vec::new();
        for term in plain.terms() {
            if matches!(term.role, Role::Objective { .. }) && !indices.contains(&term.index) {
                indices.push(term.index);
            }
        }
        let [before, after] = merits.map(|values| values.map(|values| values.objective()));
        let joint = Joint {
            gain: before.and_then(|before| Ok(before - after?)).ok(),
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
        };
        Some((joint, stage.best.searched))
    }

    fn stage(&self, input: &StageInput) -> Result<Stage, Stop> {
        stage::solve(input, &self.tasks, self.archive)
    }

    fn finish(&self, chosen: Chosen) -> Result<DesignResult, EigenError> {
        let Chosen {
            case,
            delivered,
            stages,
            rounds,
            settled,
            joint,
        } = chosen;
        let spec = self.spec;
        let evaluation = Evaluation::new(&case)?;
        let margins = self.margins(&case);
        // The search with all demands knows which of them conflict.
        let searched = match (&joint, &stages[..]) {
            (Some((_, searched)), _) => Some(searched),
            (None, [only]) => Some(&only.best.searched),
            _ => None,
        };
        let short = margins.iter().any(|margin| !margin.met());
        let searched = searched.filter(|_| short && self.archive.stopped().is_none());
        let conflict = searched.and_then(|searched| {
            self.archive.stage("conflicting requirements");
            conflict(searched, spec.design.seed, self.archive)
        });
        let mut stages: Vec<StageResult> = stages.into_iter().map(|s| s.result).collect();
        let mut joint = joint.map(|(joint, _)| joint);
        // One profile is no choice.
        for stage in stages
            .iter_mut()
            .chain(joint.as_mut().map(|joint| &mut joint.stage))
        {
            if stage.profiles.len() < 2 {
                stage.profiles.clear();
            }
        }
        Ok(DesignResult {
            half_kalker: half_kalker(&case)?,
            before: Evaluation::new(&spec.case)?,
            conditions: in_conditions(spec, &case)?,
            evaluation,
            case,
            delivered,
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
