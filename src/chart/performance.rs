//! Performance of a case, as charts plot it: what cannot be had is a gap.

use crate::{
    case::Case,
    dynamics::{LateralModel, VerticalModel},
    evaluate::{
        curving::CurvingLimits,
        modes::{LateralMode, LateralModes},
        ride::{LateralRide, PassengerRide, VerticalRide},
        stability::{Outcome, Stability},
    },
    numerics::Poles,
    optimize::problem::Failure,
};

/// Critical speed, m/s. `None`: stable over the whole range searched.
///
/// # Errors
///
/// [`Failure`] if there are no eigenvalues, or the vehicle diverges.
pub fn critical_speed(case: &Case) -> Result<Option<f64>, Failure> {
    let found = Stability::of(case).map_err(|_| Failure::Eigenvalues)?;
    match found.outcome() {
        Outcome::Diverges => Err(Failure::Diverges),
        _ => Ok(found.critical_speed()),
    }
}

/// Degree curve, degrees. `None`: there is no steady state.
pub fn degree_curve(case: &Case) -> Option<f64> {
    Some(CurvingLimits::new(case, 0.0).ok()?.degree())
}

/// Lateral ride; `None`: unstable at the operating speed.
pub fn lateral_ride(case: &Case) -> Option<LateralRide> {
    LateralRide::new(&LateralModel::new(case), case).ok()
}

/// Vertical ride; `None`: the carbody overturns.
pub fn vertical_ride(case: &Case) -> Option<VerticalRide> {
    VerticalRide::new(&VerticalModel::new(case), case).ok()
}

/// Lateral ride of passengers, at c.g., front and rear; `None`: unstable at the operating speed.
pub fn lateral_passengers(case: &Case, model: &LateralModel) -> Option<[PassengerRide; 3]> {
    let poles = Poles::at(&model.forced, case.service.speed).ok()?;
    PassengerRide::lateral(model, case, &poles).ok()
}

/// Vertical ride of passengers; `None`: the carbody overturns.
pub fn vertical_passengers(case: &Case) -> Option<[PassengerRide; 3]> {
    let model = VerticalModel::new(case);
    let poles = Poles::at(&model.forced, case.service.speed).ok()?;
    PassengerRide::vertical(&model, case, &poles).ok()
}

/// Modes of the lateral model at a speed, m/s; none where there are no eigenvalues.
pub fn lateral_modes(case: &Case, model: &LateralModel, speed: f64) -> Vec<LateralMode> {
    let modes = Poles::at(&model.forced, speed)
        .and_then(|poles| LateralModes::of_vehicle(model, case, &poles));
    modes.map_or_else(|_| Vec::new(), |modes| modes.oscillatory)
}
