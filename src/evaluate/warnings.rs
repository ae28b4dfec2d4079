//! Doubts about a result that a designer should see beside it.

use super::{Evaluation, curving::CurveStatus, limits, ride::NoRide};
use crate::{
    case::{Case, TruckRoll},
    closed_form::{natural_frequencies::truck_roll, unusual::secondary_oddities},
    units::us::MILE,
};

/// Advice on a case and its evaluation.
pub fn warnings(case: &Case, evaluation: &Evaluation) -> Vec<String> {
    let mut list = Vec::new();
    let speed = case.service.speed;
    let mph = |v: f64| v * 3600.0 / MILE;
    if let Some(critical) = evaluation.stability.critical_speed()
        && critical <= speed
    {
        list.push(format!(
            "the critical speed, {:.1} mph, is not above the operating speed, {:.1} mph",
            mph(critical),
            mph(speed)
        ));
    }
    if evaluation.stability.divergence.is_some() {
        list.push("a non-oscillatory motion grows: the vehicle is statically unstable".into());
    }
    if case.model.truck_roll == TruckRoll::Prescribed
        && let Some(onset) = evaluation.stability.onsets.first()
    {
        let roll = truck_roll(&case.vehicle).frequency;
        let ratio = roll / onset.frequency;
        if (1.0 / limits::SEPARATION..limits::SEPARATION).contains(&ratio) {
            list.push(format!(
                "truck roll ({roll:.1} Hz, 3.5-11) is within a factor of two of hunting \
                 ({:.1} Hz): check with truck_roll = \"dynamic\" in [model]",
                onset.frequency
            ));
        }
    }
    if let Ok(ride) = &evaluation.lateral {
        let clearance = case.wheel_rail.flange_clearance;
        let largest = ride.excursion.iter().copied().fold(0.0, f64::max);
        if 3.0 * largest > clearance {
            list.push(format!(
                "flange contact lies at {:.1} standard deviations of wheelset excursion: the \
                 linear wheel–rail model is exceeded at times",
                clearance / largest
            ));
        }
    }
    if let Ok(curve) = &evaluation.service_curve
        && curve.status != CurveStatus::WithinModel
    {
        list.push(format!(
            "in a curve of {:.2}° at {:.2}° cant deficiency the linear model does not hold ({}): it \
             gives no forces and strokes there",
            curve.degree,
            curve.cant_deficiency.to_degrees(),
            curve.status
        ));
    }
    let rides = [
        ("lateral", evaluation.lateral.as_ref().err()),
        ("vertical", evaluation.vertical.as_ref().err()),
    ];
    for (direction, reason) in rides {
        if let Some(NoRide::NotConverged) = reason {
            list.push(format!(
                "the {direction} random response did not reach its accuracy"
            ));
        }
    }
    if let Ok(ride) = &evaluation.vertical {
        let largest = ride.wheel_load.iter().copied().fold(0.0, f64::max);
        if 3.0 * largest > case.vehicle.wheel_load() {
            list.push(format!(
                "three standard deviations of wheel load variation are {:.0} % of the static wheel \
                 load: with massless wheels on rigid rails a stiff primary suspension overstates it",
                300.0 * largest / case.vehicle.wheel_load()
            ));
        }
    }
    let odd = secondary_oddities(&case.vehicle).into_iter();
    list.extend(odd.map(|oddity| format!("{}: {}", oddity.message, oddity.advice)));
    if case.wheel_rail.conicity < 0.02 {
        list.push("at so low a conicity the vehicle hardly centres itself".into());
    }
    list
}
