//! The curve of the service, in which forces on the rails are judged.

use super::{CurveStatus, CurvingLimits, CurvingState};
use crate::{
    case::Case,
    dynamics::curving::{CurvingError, CurvingModel},
};

/// The vehicle in the curve and at the cant deficiency of its service. Without a curve given, the
/// tightest that it runs without flange contact or slip at zero cant deficiency; without a cant
/// deficiency, zero.
#[derive(Debug, Clone)]
pub struct ServiceCurve {
    /// D, degrees.
    pub degree: f64,
    /// φ_d, rad.
    pub cant_deficiency: f64,
    /// True if the service gives the curve.
    pub is_given: bool,
    /// True if the model covers it.
    pub status: CurveStatus,
    /// The vehicle there; `None` where a wheel is lifted.
    pub state: Option<CurvingState>,
}

impl ServiceCurve {
    /// Service curve of a case.
    ///
    /// # Errors
    ///
    /// [`CurvingError`] if there is no steady-state solution; a lifted wheel is a status.
    pub fn of(case: &Case) -> Result<Self, CurvingError> {
        match case.service.curve {
            Some(angle) => Self::at(case, angle.to_degrees(), None),
            None => Self::beside(case, &level_curves(case)?),
        }
    }

    /// As [`ServiceCurve::of`], with the model at zero cant deficiency and its limits known.
    ///
    /// # Errors
    ///
    /// As [`ServiceCurve::of`].
    pub fn beside(
        case: &Case,
        (level, limits): &(CurvingModel, CurvingLimits),
    ) -> Result<Self, CurvingError> {
        let degree = case.service.curve.map(f64::to_degrees);
        Self::at(case, degree.unwrap_or_else(|| limits.degree()), Some(level))
    }

    /// In a curve of `degree` degrees; `level` is the model at zero cant deficiency where known.
    fn at(case: &Case, degree: f64, level: Option<&CurvingModel>) -> Result<Self, CurvingError> {
        let cant_deficiency = case.service.cant_deficiency();
        let clearance = case.wheel_rail.flange_clearance;
        let state = match level.filter(|_| cant_deficiency == 0.0) {
            Some(level) => Ok(CurvingState::of(level, clearance, degree, cant_deficiency)),
            None => CurvingState::new(case, degree, cant_deficiency),
        };
        let (status, state) = match CurveStatus::or_lifted(state)? {
            Ok(state) => (state.status, Some(state)),
            Err(lifted) => (lifted, None),
        };
        Ok(Self {
            degree,
            cant_deficiency,
            is_given: case.service.curve.is_some(),
            status,
            state,
        })
    }

    /// The vehicle there, for a verdict.
    ///
    /// # Errors
    ///
    /// The status, where the model does not cover the curve.
    pub fn covered(&self) -> Result<&CurvingState, CurveStatus> {
        let state = self.state.as_ref();
        state
            .filter(|_| self.status == CurveStatus::WithinModel)
            .ok_or(self.status)
    }
}

/// Model and limits of a case at zero cant deficiency.
///
/// # Errors
///
/// [`CurvingError`] if there is no steady-state solution.
pub fn level_curves(case: &Case) -> Result<(CurvingModel, CurvingLimits), CurvingError> {
    let model = CurvingModel::new(case, 0.0)?;
    let limits = CurvingLimits::of(&model, case.wheel_rail.flange_clearance, 0.0);
    Ok((model, limits))
}
