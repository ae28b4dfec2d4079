//! Kinematic frequencies and approximate critical speeds (3.5.2, 4.5.3, 4.6).

use super::CrossCheck;
use crate::{
    case::Case,
    closed_form::{corrections, kinematic},
    evaluate::{Evaluation, stability::Stability},
    units::{
        Quantity,
        us::{FOOT, LBF},
    },
    vehicle::Vehicle,
};

pub(super) fn hunting(list: &mut Vec<CrossCheck>, case: &Case, evaluation: &Evaluation) {
    let (vehicle, contact, speed) = (&case.vehicle, case.wheel_rail.contact(), case.service.speed);
    let conicity = contact.conicity;
    let mode = evaluation.modes.kinematic.as_ref().map(|m| m.frequency);
    let critical = evaluation.stability.critical_speed();
    let entry = |name: &str, equation, quantity, closed_form, full_model| CrossCheck {
        name: name.into(),
        equation,
        quantity,
        closed_form,
        full_model,
    };
    list.extend([
        entry(
            "wavelength of the free wheelset",
            "3.5-1",
            Quantity::Length,
            kinematic::wheelset_wavelength(vehicle, conicity),
            None,
        ),
        entry(
            "wavelength of the rigid truck",
            "3.5-4",
            Quantity::Length,
            kinematic::truck_wavelength(vehicle, conicity),
            None,
        ),
        entry(
            "kinematic frequency, free wheelset",
            "3.5-2, 4.5-10",
            Quantity::Frequency,
            kinematic::wheelset_frequency(vehicle, conicity, speed),
            mode,
        ),
        entry(
            "kinematic frequency, rigid truck",
            "3.5-5, 4.5-11",
            Quantity::Frequency,
            kinematic::truck_frequency(vehicle, conicity, speed),
            mode,
        ),
        entry(
            "kinematic frequency, carbody",
            "4.5-12",
            Quantity::Frequency,
            kinematic::carbody_frequency(vehicle, conicity, speed),
            None,
        ),
        entry(
            "critical speed, wheelset on soft springs",
            "3.5-3",
            Quantity::Speed,
            kinematic::wheelset_critical_speed(vehicle, &contact),
            critical,
        ),
        entry(
            "critical speed, rigid truck",
            "3.5-6",
            Quantity::Speed,
            kinematic::truck_critical_speed(vehicle, &contact),
            critical,
        ),
    ]);
}

/// Critical speed from that with the prototype's running gear, or with its yaw stiffness, by the
/// corrections of 4.6.
pub(super) fn corrected(list: &mut Vec<CrossCheck>, case: &Case, evaluation: &Evaluation) {
    let Some(critical) = evaluation.stability.critical_speed() else {
        return;
    };
    let prototype = Vehicle::prototype();
    let speed_of = |vehicle: Vehicle| {
        let case = Case {
            vehicle,
            ..case.clone()
        };
        Stability::of(&case).ok().and_then(|s| s.critical_speed())
    };
    let mut baseline = case.vehicle.clone();
    baseline.wheelset = prototype.wheelset;
    baseline.truck.mass = prototype.truck.mass;
    baseline.truck.yaw_inertia = prototype.truck.yaw_inertia;
    if baseline != case.vehicle
        && corrections::mass_correction_applies(&case.vehicle)
        && let Some(speed) = speed_of(baseline.clone())
    {
        list.push(CrossCheck {
            name: "critical speed, prototype's running gear corrected for mass".into(),
            equation: "4.6-2",
            quantity: Quantity::Speed,
            closed_form: corrections::for_mass(speed, &baseline, &case.vehicle),
            full_model: Some(critical),
        });
    }
    let reference = 1e6 * LBF * FOOT;
    let yaw = case.vehicle.suspension.secondary.yaw_stiffness;
    if (yaw / reference - 1.0).abs() > 0.01 {
        let with_yaw = |mut vehicle: Vehicle, k: f64| {
            vehicle.suspension.secondary.yaw_stiffness = k;
            vehicle.suspension.secondary.yaw_damping = None;
            speed_of(vehicle)
        };
        // The baseline is the prototype with this case's primary stiffnesses and conicity.
        let mut prototype = prototype.clone();
        prototype.suspension.primary = case.vehicle.suspension.primary;
        if let (Some(at_reference), Some(used), Some(own)) = (
            with_yaw(prototype.clone(), reference),
            with_yaw(prototype, yaw),
            with_yaw(case.vehicle.clone(), reference),
        ) {
            list.push(CrossCheck {
                name: "critical speed, corrected for yaw stiffness".into(),
                equation: "4.6-3",
                quantity: Quantity::Speed,
                closed_form: corrections::for_yaw_stiffness(own, used, at_reference),
                full_model: Some(critical),
            });
        }
    }
}
