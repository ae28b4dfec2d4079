//! Reasons why an index has no value at a design: a code in files, words for people.

use serde::{Deserialize, Serialize};

/// Reason why a design has no performance.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, thiserror::Error,
)]
#[serde(rename_all = "kebab-case")]
pub enum Failure {
    /// No stationary response exists.
    #[error("unstable at the operating speed")]
    Unstable,
    /// A motion without oscillation grows: the carbody overturns, or the trucks diverge.
    #[error("diverges: a static instability")]
    Diverges,
    /// The curving equations are singular.
    #[error("no steady-state solution in a curve")]
    NoCurve,
    /// The load transfer in a curve takes all of the load of the wheels on one side.
    #[error("wheel-lifted: no load on the wheels of one side")]
    WheelLifted,
    /// Beyond flange contact or slip, where the linear model has no verdict.
    #[error("outside-model: beyond flange contact or slip")]
    OutsideModel,
    /// The index belongs to a curve that the service does not give.
    #[error("no curve in [service]")]
    NoServiceCurve,
    /// No mode of the kind asked for exists.
    #[error("no mode of that kind")]
    NoMode,
    /// The eigenvalue iteration gave up.
    #[error("eigenvalues not converged")]
    Eigenvalues,
    /// The random response did not meet its tolerance.
    #[error("random response not converged")]
    #[serde(rename = "not-converged")]
    Integration,
    /// The end of the range searched bounds the index, and no more is known of it.
    #[error("only-bounded: beyond the range searched")]
    OnlyBounded,
    /// An index came out infinite or undefined.
    #[error("an index that is not a number")]
    NotFinite,
}

impl Failure {
    /// Whether the model does not cover what was asked, so that a demand on it is not assessed.
    pub fn is_not_covered(self) -> bool {
        matches!(self, Self::WheelLifted | Self::OutsideModel)
    }
}
