//! Performance indices of a case, from the solutions of its equations.
//!
//! Every fast method answers or steps aside for its plain twin in the next folder: modes followed over
//! the speed for full spectra ([`stability`]), elimination without pivoting for a pivoted factorisation
//! ([`ride::response`]).

pub mod checks;
pub mod cross_checks;
pub mod curving;
pub mod equalization;
pub mod gradients;
pub mod limits;
pub mod modes;
pub mod ride;
pub mod stability;
pub mod stroke_in_curve;
pub mod warnings;

use curving::{CurvingLimits, ServiceCurve, level_curves};
use modes::{LateralModes, VerticalMode, vertical_modes};
use ride::{LateralRide, NoRide, PassengerRide, VerticalRide};
use stability::Stability;

use crate::{
    case::Case,
    dynamics::{LateralModel, VerticalModel, curving::CurvingError},
    numerics::{EigenError, Poles},
};

/// All performance indices of a case.
#[derive(Debug, Clone)]
pub struct Evaluation {
    /// Critical speed and hunting modes.
    pub stability: Stability,
    /// Modes of the lateral model at the operating speed.
    pub modes: LateralModes,
    /// Modes of the vertical model.
    pub vertical_modes: Vec<VerticalMode>,
    /// Flange- and slip-limited curves at zero cant deficiency.
    pub curving: Result<CurvingLimits, CurvingError>,
    /// The vehicle in the curve of its service.
    pub service_curve: Result<ServiceCurve, CurvingError>,
    /// Lateral ride.
    pub lateral: Result<LateralRide, NoRide>,
    /// Lateral comfort measures at c.g., front, rear; `None` without a stationary response.
    pub lateral_passengers: Option<[PassengerRide; 3]>,
    /// Vertical ride.
    pub vertical: Result<VerticalRide, NoRide>,
    /// Vertical comfort measures at c.g., front, rear; `None` without a stationary response.
    pub vertical_passengers: Option<[PassengerRide; 3]>,
}

impl Evaluation {
    /// Evaluates a case.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if the eigenvalues of a model do not converge.
    pub fn new(case: &Case) -> Result<Self, EigenError> {
        let lateral = LateralModel::new(case);
        let vertical = VerticalModel::new(case);
        let speed = case.service.speed;
        let lateral_poles = Poles::at(&lateral.forced, speed)?;
        let vertical_poles = Poles::at(&vertical.forced, speed)?;
        let modes = LateralModes::new(&lateral, case, &lateral_poles)?;
        let vertical_modes = vertical_modes(&vertical, &vertical_poles)?;
        let level = level_curves(case);
        let service_curve = match &level {
            Ok(level) => ServiceCurve::beside(case, level),
            Err(_) => ServiceCurve::of(case),
        };
        Ok(Self {
            stability: Stability::new(&lateral, &lateral_poles, case.model.speed_range, 1.0)?,
            curving: level.map(|(_, limits)| limits),
            service_curve,
            lateral: LateralRide::from_poles(&lateral, case, &lateral_poles),
            lateral_passengers: PassengerRide::lateral(&lateral, case, &lateral_poles).ok(),
            vertical: VerticalRide::from_poles(&vertical, case, &vertical_poles),
            vertical_passengers: PassengerRide::vertical(&vertical, case, &vertical_poles).ok(),
            modes,
            vertical_modes,
        })
    }
}
