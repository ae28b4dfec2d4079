//! The design procedure: three trade-offs in the order of Figure 4.2.1 with the coupling loop, and
//! all at once.
//!
//! The vertical trade-off does not depend on the others' variables, so it comes first and once (its
//! K_sz is part of the lateral model's roll stiffness). Stability–curving and the lateral trade-off
//! then alternate until neither changes a variable.

use std::time::Instant;

use super::{
    conflict::conflict,
    delivered::{Nearby, preferred},
    freedom::{Free, Neighbourhood},
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
    evaluate::Evaluation,
    index::Index,
    numerics::EigenError,
    optimize::{
        archive::{Archive, Stop},
        problem::Problem,
        solve::{Effort, Start},
    },
    parameter::{Parameter, TradeOff},
    spec::{Order, Spec},
};

/// Rounds of the coupling loop.
const MAX_ROUNDS: usize = 10;
/// Change of a scaled variable that counts as none.
const UNCHANGED: f64 = 1e-4;

/// Reason why there is no design.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DesignError {
    /// No open parameter.
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
/// [`DesignError`] without an open parameter, or without an objective. Requirements that
/// cannot be met are no error: the result holds the best compromise and says what is not met.
pub fn design(spec: &Spec, archive: &Archive) -> Result<DesignResult, DesignError> {
    design_beside(spec, archive, |_| ()).map(|(result, ())| result)
}

/// As [`design`], with the result of `beside` for the delivered design. It runs side by side with the
/// parts that do not decide the design: the joint optimisation for comparison, and the ranges of the
/// variables.
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
    /// The optimum.
    case: Case,
    /// The design within a small loss of it; `None`: the optimum itself.
    nearby: Option<Nearby>,
    free: Vec<Free>,
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
        if compare && short {
            // In turn something is missed: all at once may meet it.
            chosen.joint = self.joint(&chosen.case, given, self.start());
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
        let around = (standing == Standing::default())
            .then(|| self.around(&chosen))
            .flatten();
        chosen.nearby = around
            .as_ref()
            .and_then(|around| self.nearby(around, given));
        let nearby = chosen.nearby.as_ref();
        let (optimum, delivered) = (
            &chosen.case,
            nearby.map_or(&chosen.case, |nearby| &nearby.case),
        );
        let ((joint, free), made) = rayon::join(
            || {
                let joint =
                    (compare && !short).then(|| self.joint(optimum, given, self.start().plainly()));
                let free = self.ranges(around.as_ref(), nearby);
                (joint.flatten(), free)
            },
            || beside(delivered),
        );
        chosen.joint = chosen.joint.or(joint);
        chosen.free = free;
        (chosen, made)
    }

    /// Everywhere, as thoroughly as the spec asks.
    fn start(&self) -> Start {
        Start::everywhere(self.spec.design.seed).until(self.spec.design.unseen)
    }

    /// Designs around the optimum. `None` if demands are missed, or no parameter varies.
    fn around(&self, chosen: &Chosen) -> Option<Neighbourhood> {
        if self.archive.stopped().is_some() {
            return None;
        }
        let searched = match (chosen.delivered, &chosen.joint, &chosen.stages[..]) {
            (Delivered::InTurn, _, stages) => {
                // Every trade-off keeps its own objective, and all keep all demands.
                let study = self.tasks.joint(&chosen.case).study;
                let is_unused = |parameter: &Parameter| {
                    let mut stages = stages.iter();
                    stages.any(|stage| stage.result.unused.contains(parameter))
                };
                let numbered = study.parameters().iter().enumerate();
                let unused = numbered.filter(|(_, parameter)| is_unused(parameter));
                let unused: Vec<usize> = unused.map(|(i, _)| i).collect();
                return Neighbourhood::new(&study.without(&unused), &chosen.case, false);
            }
            (Delivered::AllAtOnce, Some((_, searched)), _) => searched,
            (Delivered::AllAtOnce, None, [only]) => &only.best.searched,
            // The design as given is delivered where demands are missed.
            _ => return None,
        };
        let meets_all = searched.missed.is_empty() && searched.solved.point.feasible();
        meets_all
            .then(|| Neighbourhood::new(&searched.study, &chosen.case, true))
            .flatten()
    }

    /// The preferred design within a small loss of the optimum, if it keeps every demand too.
    fn nearby(&self, around: &Neighbourhood, given: &Case) -> Option<Nearby> {
        self.archive.stage("the design to deliver");
        let nearby = preferred(around, &self.spec.design, given, self.archive);
        let nearby = nearby.ok().flatten()?;
        let keeps_all = self.margins(&nearby.case).iter().all(Margin::met);
        keeps_all.then_some(nearby)
    }

    /// The ranges of the variables, in which the design delivered lies if it loses no more.
    fn ranges(&self, around: Option<&Neighbourhood>, nearby: Option<&Nearby>) -> Vec<Free> {
        let Some(around) = around.filter(|_| self.archive.stopped().is_none()) else {
            return Vec::new();
        };
        self.archive.stage("how free the variables are");
        let share = self.spec.design.free_within;
        let known = nearby.filter(|nearby| nearby.losses.iter().all(|loss| loss.share <= share));
        let known: Vec<Case> = known.iter().map(|nearby| nearby.case.clone()).collect();
        around.ranges(share, &known, self.archive)
    }

    fn margins(&self, case: &Case) -> Vec<Margin> {
        margins(case, &self.spec.demands, &self.spec.conditions)
    }

    /// Rank of a design that some stages led to.
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
            nearby: None,
            free: Vec::new(),
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
        // Rounds follow the designs found until no variable changes; then one searches globally, with what
        // holds then.
        let mut everywhere = coupled.len() < 2;
        while !settled && rounds < MAX_ROUNDS && self.archive.stopped().is_none() {
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
                        stage.result.absorb(&stages[i].result);
                        stages[i] = stage;
                    }
                    None => stages.push(stage),
                }
            }
            rounds += 1;
            let unchanged = moved < UNCHANGED || coupled.len() < 2;
            settled = unchanged && everywhere;
            // Not followed for ever: the last round looks everywhere.
            everywhere = unchanged || rounds + 1 == MAX_ROUNDS;
        }
        Chosen {
            case: now,
            nearby: None,
            free: Vec::new(),
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
    fn joint(&self, sequential: &Case, given: &Case, start: Start) -> Option<(Joint, Searched)> {
        self.archive.stage("all at once");
        let stage = self
            .stage(&StageInput {
                now: sequential,
                trade_off: None,
                known: None,
                also: &[sequential.clone(), given.clone()],
                start,
            })
            .ok()?;
        // In the terms of the task, with or without an epigraph variable.
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
            case: optimum,
            nearby,
            free,
            delivered,
            stages,
            rounds,
            settled,
            joint,
        } = chosen;
        let spec = self.spec;
        let (case, losses) = nearby.map_or_else(
            || (optimum.clone(), Vec::new()),
            |nearby| (nearby.case, nearby.losses),
        );
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
            optimum,
            losses,
            free,
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
