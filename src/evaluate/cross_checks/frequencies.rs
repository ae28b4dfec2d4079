//! Natural frequencies and damping ratios (3.5.3).

use super::CrossCheck;
use crate::{
    case::Case,
    closed_form::natural_frequencies::{self as natural, Oscillator},
    evaluate::{
        Evaluation,
        modes::{LateralShape, VerticalShape},
    },
    units::Quantity,
    vehicle::Vehicle,
};

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

pub(super) fn frequencies(list: &mut Vec<CrossCheck>, case: &Case, evaluation: &Evaluation) {
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
