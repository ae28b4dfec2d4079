//! Performance indices of a case.

pub mod checks;
pub mod critical_speed;
pub mod cross_checks;
pub mod curving;
pub mod damping_range;
pub mod equalization;
mod followed_modes;
mod hopf;
pub mod integration;
pub mod lateral_modes;
pub mod limits;
pub mod mode;
pub mod response;
pub mod ride;
pub mod vertical_modes;
pub mod warnings;

use critical_speed::Stability;
use curving::CurvingLimits;
use lateral_modes::{KinematicBand, LateralModes};
use ride::{LateralRide, VerticalRide};
use vertical_modes::VerticalMode;

use crate::{
    case::Case,
    dynamics::{EigenError, LateralModel, VerticalModel, curving::CurvingError},
};

/// All performance indices of a case.
#[derive(Debug, Clone)]
pub struct Evaluation {
    /// Critical speed and what hunts.
    pub stability: Stability,
    /// Modes of the lateral model at the operating speed.
    pub modes: LateralModes,
    /// Modes of the vertical model.
    pub vertical_modes: Vec<VerticalMode>,
    /// Flange- and slip-limited curves at zero cant deficiency.
    pub curving: Result<CurvingLimits, CurvingError>,
    /// Lateral ride; `None`: unstable at the operating speed, no stationary response.
    pub lateral: Option<LateralRide>,
    /// Vertical ride; `None`: the carbody overturns.
    pub vertical: Option<VerticalRide>,
}

impl Evaluation {
    /// Evaluates a case.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if the eigenvalues of a model cannot be had.
    pub fn new(case: &Case) -> Result<Self, EigenError> {
        let lateral = LateralModel::new(case);
        let vertical = VerticalModel::new(case);
        let speed = case.service.speed;
        let band = KinematicBand::new(&case.vehicle, &case.wheel_rail.contact(), speed);
        let modes = LateralModes::new(&lateral, speed, band)?;
        let vertical_modes = vertical_modes::vertical_modes(&vertical)?;
        let settles = vertical_modes.iter().all(|m| m.damping_ratio > 0.0);
        Ok(Self {
            stability: Stability::search(&lateral, case.model.speed_range)?,
            curving: CurvingLimits::new(case, 0.0),
            lateral: modes.stable().then(|| LateralRide::new(&lateral, case)),
            vertical: settles.then(|| VerticalRide::new(&vertical, case)),
            modes,
            vertical_modes,
        })
    }
}
