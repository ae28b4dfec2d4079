//! The report's closed forms beside the full models' values.

use serde_json::{Value, json};

use super::{
    number::{both, significant},
    sheet::Sheet,
};
use crate::{
    case::Case,
    closed_form::{
        corrections,
        curving::{SimpleTruck, pure_rolling_line, rigid_truck_excursion},
        kinematic,
        natural_frequencies::{self as natural, Oscillator},
    },
    dynamics::LateralModel,
    evaluate::{
        Evaluation, critical_speed::Stability, lateral_modes::LateralShape,
        vertical_modes::VerticalShape,
    },
    track::curvature_of_degree,
    units::{
        Quantity,
        us::{FOOT, LBF},
    },
    vehicle::Vehicle,
};

/// A closed form beside the full model.
struct CrossCheck {
    name: String,
    equation: &'static str,
    quantity: Quantity,
    closed_form: f64,
    /// `None`: the full model has no value of its own for it.
    full_model: Option<f64>,
}

/// Table of all that apply.
pub(super) fn table(sheet: &mut Sheet, case: &Case, evaluation: &Evaluation) {
    sheet.heading("Cross-checks: closed forms of the report beside the full models");
    let rows: Vec<Vec<String>> = cross_checks(case, evaluation)
        .iter()
        .map(|c| {
            let [si, us] = both(c.quantity, c.closed_form);
            let [full_si, full_us] = c
                .full_model
                .map_or([String::new(), String::new()], |v| both(c.quantity, v));
            let ratio = c
                .full_model
                .map_or(String::new(), |v| significant(c.closed_form / v, 3));
            vec![
                c.name.clone(),
                c.equation.into(),
                si,
                us,
                full_si,
                full_us,
                ratio,
            ]
        })
        .collect();
    sheet.table(
        &["", "equation", "closed form", "", "full model", "", "ratio"],
        &[1],
        &rows,
    );
}

/// The same as JSON.
pub(super) fn json(case: &Case, evaluation: &Evaluation) -> Value {
    let list: Vec<Value> = cross_checks(case, evaluation)
        .iter()
        .map(|c| {
            json!({
                "name": c.name,
                "equation": c.equation,
                "unit": c.quantity.dimension().to_string(),
                "closed_form_si": c.closed_form,
                "full_model_si": c.full_model,
            })
        })
        .collect();
    json!(list)
}

fn cross_checks(case: &Case, evaluation: &Evaluation) -> Vec<CrossCheck> {
    let mut list = Vec::new();
    hunting(&mut list, case, evaluation);
    corrected(&mut list, case, evaluation);
    frequencies(&mut list, case, evaluation);
    curves(&mut list, case, evaluation);
    list
}

fn hunting(list: &mut Vec<CrossCheck>, case: &Case, evaluation: &Evaluation) {
    let (vehicle, contact, speed) = (&case.vehicle, case.wheel_rail.contact(), case.service.speed);
    let conicity = contact.conicity;
    let mode = evaluation.modes.kinematic().map(|m| m.frequency);
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
fn corrected(list: &mut Vec<CrossCheck>, case: &Case, evaluation: &Evaluation) {
    let Some(critical) = evaluation.stability.critical_speed() else {
        return;
    };
    let prototype = Vehicle::prototype();
    let speed_of = |vehicle: Vehicle| {
        let case = Case {
            vehicle,
            ..case.clone()
        };
        Stability::search(&LateralModel::new(&case), case.model.speed_range)
            .ok()
            .and_then(|s| s.critical_speed())
    };
    let mut baseline = case.vehicle;
    baseline.wheelset = prototype.wheelset;
    baseline.truck.mass = prototype.truck.mass;
    baseline.truck.yaw_inertia = prototype.truck.yaw_inertia;
    if baseline != case.vehicle
        && corrections::mass_correction_applies(&case.vehicle)
        && let Some(speed) = speed_of(baseline)
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
        let mut prototype = prototype;
        prototype.suspension.primary = case.vehicle.suspension.primary;
        if let (Some(at_reference), Some(used), Some(own)) = (
            with_yaw(prototype, reference),
            with_yaw(prototype, yaw),
            with_yaw(case.vehicle, reference),
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

/// A motion with its equations, its closed form, and the full model's frequency and damping ratio.
type Motion = (
    &'static str,
    [&'static str; 2],
    Option<Oscillator>,
    Option<(f64, f64)>,
);

fn motions(v: &Vehicle, evaluation: &Evaluation) -> [Motion; 10] {
    let lateral = |shape: LateralShape| {
        let mode = evaluation
            .modes
            .oscillatory
            .iter()
            .find(|m| m.shape == shape);
        mode.map(|m| (m.frequency, m.damping_ratio))
    };
    let vertical = |shape: VerticalShape| {
        let mode = evaluation.vertical_modes.iter().find(|m| m.shape == shape);
        mode.map(|m| (m.frequency, m.damping_ratio))
    };
    let truck_lateral = lateral(LateralShape::TruckLateral);
    let truck_yaw = lateral(LateralShape::TruckYaw);
    let carbody_yaw = lateral(LateralShape::CarbodyYaw);
    [
        (
            "truck lateral",
            ["3.5-7", "3.5-8"],
            Some(natural::truck_lateral(v)),
            truck_lateral,
        ),
        (
            "truck bounce",
            ["3.5-9", "3.5-10"],
            Some(natural::truck_vertical(v)),
            vertical(VerticalShape::TruckHeave),
        ),
        (
            "truck roll",
            ["3.5-11", "3.5-12"],
            Some(natural::truck_roll(v)),
            vertical(VerticalShape::TruckRoll),
        ),
        (
            "truck yaw",
            ["3.5-13", "3.5-14"],
            Some(natural::truck_yaw(v)),
            truck_yaw,
        ),
        (
            "truck pitch",
            ["3.5-15", "3.5-16"],
            Some(natural::truck_pitch(v)),
            vertical(VerticalShape::TruckPitch),
        ),
        (
            "carbody lateral",
            ["3.5-17", "3.5-18"],
            Some(natural::carbody_lateral(v)),
            None,
        ),
        (
            "carbody heave",
            ["3.5-19", "3.5-20"],
            Some(natural::carbody_vertical(v)),
            vertical(VerticalShape::CarbodyHeave),
        ),
        (
            "carbody roll",
            ["3.5-21", "3.5-22"],
            natural::carbody_roll(v),
            None,
        ),
        (
            "carbody yaw",
            ["3.5-23", "3.5-24"],
            Some(natural::carbody_yaw(v)),
            carbody_yaw,
        ),
        (
            "carbody pitch",
            ["3.5-25", "3.5-26"],
            Some(natural::carbody_pitch(v)),
            vertical(VerticalShape::CarbodyPitch),
        ),
    ]
}

fn frequencies(list: &mut Vec<CrossCheck>, case: &Case, evaluation: &Evaluation) {
    for (motion, equations, closed, full) in motions(&case.vehicle, evaluation) {
        let Some(closed) = closed else { continue };
        let values = [
            (
                "frequency",
                Quantity::Frequency,
                closed.frequency,
                full.map(|f| f.0),
            ),
            (
                "damping ratio",
                Quantity::Dimensionless,
                closed.damping_ratio,
                full.map(|f| f.1),
            ),
        ];
        for ((what, quantity, closed_form, full_model), equation) in
            values.into_iter().zip(equations)
        {
            list.push(CrossCheck {
                name: format!("{motion} {what}"),
                equation,
                quantity,
                closed_form,
                full_model,
            });
        }
    }
}

fn curves(list: &mut Vec<CrossCheck>, case: &Case, evaluation: &Evaluation) {
    let (vehicle, contact) = (&case.vehicle, case.wheel_rail.contact());
    let truck = SimpleTruck::new(vehicle, &contact);
    let limits = evaluation.curving.as_ref().ok();
    let adhesion = case.wheel_rail.friction * vehicle.wheel_load();
    let clearance = case.wheel_rail.flange_clearance;
    for (name, equation, degree, full) in [
        (
            "flange-limited curve",
            "A-11, 4.5-5",
            truck.flange_limit(clearance, 0.0, 0.0),
            limits.and_then(|l| l.flange),
        ),
        (
            "slip-limited curve",
            "A-14, 4.5-6",
            truck.slip_limit(adhesion),
            limits.and_then(|l| l.slip),
        ),
    ] {
        list.push(CrossCheck {
            name: name.into(),
            equation,
            quantity: Quantity::DegreeOfCurve,
            closed_form: degree.to_radians(),
            full_model: full.map(|l| l.degree.to_radians()),
        });
    }
    if let Some(flange) = limits.and_then(|l| l.flange) {
        let curvature = curvature_of_degree(flange.degree);
        let excursion = |name: &str, equation, closed_form| CrossCheck {
            name: name.into(),
            equation,
            quantity: Quantity::Stroke,
            closed_form,
            full_model: Some(clearance),
        };
        let free = pure_rolling_line(vehicle, contact.conicity, curvature);
        let rigid = rigid_truck_excursion(vehicle, contact.conicity, curvature);
        let simple = truck.wheelsets(curvature, 0.0, 0.0);
        let force = truck.flanging_force(curvature, clearance, 0.0);
        list.extend([
            excursion(
                "pure rolling line in that flange-limited curve",
                "4.5-1",
                free,
            ),
            excursion("excursion of a rigid truck there", "4.5-4", rigid),
            excursion(
                "leading wheelset of the simple truck there",
                "A-6",
                simple.lateral[0] + free,
            ),
            CrossCheck {
                name: "flanging force of the simple truck there".into(),
                equation: "A-19, 4.5-9",
                quantity: Quantity::Force,
                closed_form: force,
                full_model: None,
            },
        ]);
    }
}
