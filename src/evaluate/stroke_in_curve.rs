//! Secondary lateral stroke in the curve of the service: quasi-static and random together.

use super::{Evaluation, curving::CurveStatus, limits::PEAK, ride::NoRide};
use crate::dynamics::curving::CurvingError;

/// Reason why there is no such stroke.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum NoStroke {
    /// The service gives no curve.
    #[error("no-curve")]
    NotAsked,
    /// The model does not cover the curve.
    #[error("{}", .0.code())]
    NotCovered(CurveStatus),
    /// There is no steady-state solution.
    #[error(transparent)]
    NoCurve(#[from] CurvingError),
    /// There is no random stroke.
    #[error(transparent)]
    NoRide(#[from] NoRide),
}

impl NoStroke {
    /// Code in files.
    pub fn code(self) -> &'static str {
        match self {
            Self::NotAsked => "no-curve",
            Self::NotCovered(status) => status.code(),
            Self::NoCurve(_) => "no-steady-state",
            Self::NoRide(reason) => reason.code(),
        }
    }
}

/// Stroke taken in the curve, m: the quasi-static stroke s of a truck, m, and three standard deviations
/// σ of its random stroke, m. Both are taken to add up, which is our convention: the curve is run
/// while its track is as rough as the tangent track.
///
/// ```math
/// |s| + 3 σ
/// ```
pub fn taken(quasi_static: f64, random: f64) -> f64 {
    quasi_static.abs() + PEAK * random
}

impl Evaluation {
    /// Secondary lateral strokes of trucks 1 and 2 in the curve of the service, m.
    ///
    /// # Errors
    ///
    /// [`NoStroke`]: no curve is given, the model does not cover it, or the vehicle has no ride.
    pub fn secondary_lateral_stroke_in_curve(&self) -> Result<[f64; 2], NoStroke> {
        let curve = self.service_curve.as_ref().map_err(|error| *error)?;
        if !curve.is_given {
            return Err(NoStroke::NotAsked);
        }
        let state = curve.covered().map_err(NoStroke::NotCovered)?;
        let ride = self.lateral.as_ref().map_err(|reason| *reason)?;
        let strokes = |j: usize| {
            let quasi_static = state.secondary_lateral_stroke[j];
            taken(quasi_static, ride.secondary_stroke[j])
        };
        Ok([strokes(0), strokes(1)])
    }
}
