//! Coverage of a curve by the linear model.

use super::{Limit, first_exceedance};
use crate::{
    dynamics::curving::{CurvingError, CurvingModel, Side},
    evaluate::limits::MET,
};

/// Coverage of a curve by the linear steady-curving model. The model ends at flange contact and at slip,
/// and needs load on every wheel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CurveStatus {
    /// No flange touches, no wheel slips, every wheel carries load.
    WithinModel,
    /// A limit is exceeded: forces and strokes are an extrapolation.
    OutsideModel {
        /// Exceeded limit that is met first as the curve tightens at this cant deficiency.
        limit: Limit,
        /// Its ratio in this curve: |y_w| over the flange clearance, or the share of μN used.
        ratio: f64,
    },
    /// The load transfer takes all of the load of the wheels on one side: there are no forces.
    WheelLifted(Side),
}

/// Ratio up to which a curve at a limit counts as within the model: the tolerance within which any
/// bound counts as kept.
pub const AT_LIMIT: f64 = 1.0 + MET;

impl CurveStatus {
    /// Status of a curve with ratios to the limits in the order of [`Limit::ALL`].
    pub(super) fn of(model: &CurvingModel, flange_clearance: f64, ratios: &[f64; 12]) -> Self {
        let exceeded = Limit::ALL
            .into_iter()
            .zip(*ratios)
            .filter(|(_, ratio)| *ratio > AT_LIMIT);
        // Limits that are exceeded on straight track already: the largest ratio among them.
        let met = exceeded.map(|(limit, ratio)| {
            let curvature = first_exceedance(model, limit, flange_clearance);
            (curvature.unwrap_or(f64::INFINITY), limit, ratio)
        });
        let first = met.min_by(|a, b| a.0.total_cmp(&b.0).then(b.2.total_cmp(&a.2)));
        first.map_or(Self::WithinModel, |(_, limit, ratio)| Self::OutsideModel {
            limit,
            ratio,
        })
    }

    /// A result, or the status of a vehicle with a lifted wheel.
    ///
    /// # Errors
    ///
    /// [`CurvingError`] if there is no steady-state solution for another reason.
    pub fn or_lifted<T>(found: Result<T, CurvingError>) -> Result<Result<T, Self>, CurvingError> {
        match found {
            Ok(found) => Ok(Ok(found)),
            Err(CurvingError::WheelLifted(side)) => Ok(Err(Self::WheelLifted(side))),
            Err(error @ (CurvingError::Singular | CurvingError::NoConsistentState)) => Err(error),
        }
    }

    /// Name in files.
    pub fn code(self) -> &'static str {
        match self {
            Self::WithinModel => "within-model",
            Self::OutsideModel { .. } => "outside-model",
            Self::WheelLifted(_) => "wheel-lifted",
        }
    }

    /// The exceeded limit and its ratio.
    pub fn exceeded(self) -> Option<(Limit, f64)> {
        match self {
            Self::OutsideModel { limit, ratio } => Some((limit, ratio)),
            Self::WithinModel | Self::WheelLifted(_) => None,
        }
    }
}

impl std::fmt::Display for CurveStatus {
    /// The code and its reason.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.code())?;
        match self {
            Self::WithinModel => Ok(()),
            Self::OutsideModel { limit, ratio } => {
                write!(f, ": {limit}, {ratio:.3} times its limit")
            }
            Self::WheelLifted(side) => {
                write!(
                    f,
                    ": the load transfer exceeds the static load of the {side} wheels"
                )
            }
        }
    }
}
