//! Result of the design procedure.

use rayon::prelude::*;

use super::{
    conflict::Conflict,
    explain::Explained,
    freedom::{Free, Loss},
    margin::{Margin, margins},
};
use crate::{
    case::Case,
    evaluate::Evaluation,
    index::Index,
    numerics::EigenError,
    optimize::{
        archive::Stop,
        local::Status,
        problem::Failure,
        solve::{Coverage, Effort},
    },
    parameter::{Parameter, TradeOff},
    spec::{Condition, Spec},
};

/// Result of one trade-off, or of all at once.
#[derive(Debug, Clone, PartialEq)]
pub struct StageResult {
    /// Trade-off; `None` for all at once.
    pub trade_off: Option<TradeOff>,
    /// The solution explained.
    pub explained: Explained,
    /// Open parameters that no index of the trade-off depends on: they keep the value as given.
    pub unused: Vec<Parameter>,
    /// Profiles tried.
    pub profiles: Vec<Profile>,
}

impl StageResult {
    /// Reason why no design could be evaluated.
    pub fn failure(&self) -> Option<Failure> {
        match self.explained.status {
            Status::Failed(failure) => Some(failure),
            _ => None,
        }
    }
}

/// Best design with one of several wheel profiles.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// λ.
    pub conicity: f64,
    /// Status of its search.
    pub status: Status,
    /// Coverage of the space; `None` if the search stayed near known designs.
    pub coverage: Option<Coverage>,
    /// Critical speed, m/s; `None`: stable over the range searched.
    pub critical_speed: Option<f64>,
    /// Degree curve, degrees.
    pub degree: f64,
    /// K_b, N m/rad.
    pub bending_stiffness: f64,
    /// K_py, N/m.
    pub lateral_stiffness: f64,
    /// Its design, from which a later round goes on.
    pub(super) case: Case,
}

/// Gain of the joint optimisation over the sequential one.
#[derive(Debug, Clone)]
pub struct Joint {
    /// Its solution.
    pub stage: StageResult,
    /// Its design.
    pub case: Case,
    /// Indices of the objectives.
    pub indices: Vec<Compared>,
    /// Gain of the sum of the objectives' relative changes; `None` if one of the designs has none.
    pub gain: Option<f64>,
}

/// An index in the sequential and the joint design, SI.
#[derive(Debug, Clone, PartialEq)]
pub struct Compared {
    /// Which.
    pub index: Index,
    /// In the sequential design.
    pub sequential: Result<f64, Failure>,
    /// In the joint design.
    pub joint: Result<f64, Failure>,
}

/// A design evaluated in one of the further conditions.
#[derive(Debug, Clone)]
pub struct InCondition {
    /// Name of the condition.
    pub name: String,
    /// The case in it.
    pub case: Case,
    /// Its performance.
    pub evaluation: Evaluation,
}

/// Performance of a case in the further conditions of a spec.
pub(super) fn in_conditions(spec: &Spec, case: &Case) -> Result<Vec<InCondition>, EigenError> {
    let evaluated = |condition: &Condition| {
        let case = condition.apply(case);
        Ok(InCondition {
            name: condition.name.clone(),
            evaluation: Evaluation::new(&case)?,
            case,
        })
    };
    let conditions: Vec<Result<InCondition, EigenError>> =
        spec.conditions.par_iter().map(evaluated).collect();
    // The first error in the spec's order, whatever the threads do.
    conditions.into_iter().collect()
}

/// Performance of a case at half the creep coefficients (4.5.4).
pub(super) fn half_kalker(case: &Case) -> Result<Evaluation, EigenError> {
    let mut half = case.clone();
    half.wheel_rail.creep_factor *= 0.5;
    Evaluation::new(&half)
}

/// Origin of the design delivered.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Delivered {
    /// The trade-offs in turn.
    InTurn,
    /// That of all parameters at once: asked for, or because in turn demands are missed that it
    /// meets or comes closer to.
    AllAtOnce,
    /// The design as given, or the one nearest to it within the bounds: it stands better to the
    /// demands than any found.
    AsGiven,
}

/// A finished design.
#[derive(Debug, Clone)]
pub struct DesignResult {
    /// The case with the suspension and profile delivered: within a small loss of the optimum, or the
    /// optimum itself.
    pub case: Case,
    /// The case of the optimum, to which certificates and prices belong.
    pub optimum: Case,
    /// Loss of each goal of the design delivered against the optimum; empty if it is the optimum.
    pub losses: Vec<Loss>,
    /// The ranges over which the variables are free; empty where demands are missed.
    pub free: Vec<Free>,
    /// Its performance.
    pub evaluation: Evaluation,
    /// Performance of the case as the spec gave it.
    pub before: Evaluation,
    /// Performance of the design at half the creep coefficients (4.5.4).
    pub half_kalker: Evaluation,
    /// Its performance in the further conditions.
    pub conditions: Vec<InCondition>,
    /// Origin of the design.
    pub delivered: Delivered,
    /// The trade-offs in the order of the procedure, or all at once.
    pub stages: Vec<StageResult>,
    /// Rounds of the coupling loop; 0 for all at once.
    pub rounds: usize,
    /// True if the last round changed no variable.
    pub settled: bool,
    /// The joint optimisation beside the sequential one.
    pub joint: Option<Joint>,
    /// Every demand and the value reached.
    pub margins: Vec<Margin>,
    /// Demands in conflict, if some are not met.
    pub conflict: Option<Conflict>,
    /// Effort of all stages.
    pub effort: Effort,
    /// Reason for an early end of the run.
    pub stopped: Option<Stop>,
}

impl DesignResult {
    /// Result for a spec's design as given, without a search.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if the eigenvalues of a model do not converge.
    pub fn as_given(spec: &Spec) -> Result<Self, EigenError> {
        let evaluation = Evaluation::new(&spec.case)?;
        Ok(Self {
            before: evaluation.clone(),
            half_kalker: half_kalker(&spec.case)?,
            conditions: in_conditions(spec, &spec.case)?,
            margins: margins(&spec.case, &spec.demands, &spec.conditions),
            case: spec.case.clone(),
            optimum: spec.case.clone(),
            losses: Vec::new(),
            free: Vec::new(),
            evaluation,
            delivered: Delivered::InTurn,
            stages: Vec::new(),
            rounds: 0,
            settled: true,
            joint: None,
            conflict: None,
            effort: Effort::default(),
            stopped: None,
        })
    }

    /// The largest relative loss of a goal against the optimum: of an index, or of a sum of relative
    /// changes; 0 if the design delivered is the optimum or has no loss.
    pub fn loss(&self) -> f64 {
        let losses = self.losses.iter().map(|loss| loss.share);
        losses.fold(0.0, f64::max)
    }

    /// True if the design delivered is the optimum itself.
    pub fn is_optimum(&self) -> bool {
        self.losses.is_empty()
    }

    /// The range over which a variable is free, where it is known.
    pub fn free(&self, parameter: Parameter) -> Option<&Free> {
        self.free.iter().find(|free| free.parameter == parameter)
    }

    /// True if the trade-offs in turn miss a demand that the delivered design, all at once, meets or
    /// comes closer to.
    pub fn joint_in_place_of_sequence(&self) -> bool {
        self.delivered == Delivered::AllAtOnce && self.joint.is_some()
    }

    /// The stages that led to the design delivered; for the given design, the stages that found no better
    /// one.
    pub fn delivered_stages(&self) -> impl Iterator<Item = &StageResult> {
        let is = |delivered| self.delivered == delivered;
        let joint = self.joint.as_ref().filter(|_| is(Delivered::AllAtOnce));
        let in_turn = self.stages.iter().filter(move |_| joint.is_none());
        in_turn.chain(joint.map(|joint| &joint.stage))
    }

    /// Why a search that led to the design found none with a performance, if one did not.
    pub fn failure(&self) -> Option<Failure> {
        self.delivered_stages().find_map(StageResult::failure)
    }

    /// Demands that are not met.
    pub fn unmet(&self) -> impl Iterator<Item = &Margin> {
        self.margins.iter().filter(|m| !m.met())
    }

    /// True if all demands are met, by a design that every search could evaluate.
    pub fn met(&self) -> bool {
        self.unmet().next().is_none() && self.failure().is_none()
    }
}
