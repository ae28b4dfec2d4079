//! Other ways to state a spring or damper: as a natural frequency, a damping ratio, or a bending stiffness.

use crate::{
    case::Case,
    closed_form::natural_frequencies as closed,
    units::{Quantity, Range},
};

use super::Parameter;

/// A quantity that stands for a constant of the vehicle.
pub(super) struct Natural {
    /// Name in `[design]`.
    pub name: &'static str,
    /// Name in tables.
    pub words: &'static str,
    pub symbol: &'static str,
    pub quantity: Quantity,
    pub range: Range,
    /// The constant that it sets.
    pub constant: Parameter,
    /// Its relation to that constant.
    pub relation: &'static str,
    /// Value in a case, SI.
    pub get: fn(&Case) -> f64,
    /// The constant for a value in a case, SI.
    pub constant_for: fn(&Case, f64) -> f64,
    /// Moving the quantity keeps the value of this one.
    pub keeps: Option<Parameter>,
}

const RATIO: Range = Range::PositiveUpTo(2.0);

/// All of them, in the order of [`Parameter`]'s numbers.
pub(super) static NATURAL: [Natural; 6] = [
    // K_b = d_p² K_px (4.5-7).
    Natural {
        name: "primary_bending_stiffness",
        words: "primary bending stiffness",
        symbol: "K_b",
        quantity: Quantity::RotationalStiffness,
        range: Range::Positive,
        constant: Parameter::PRIMARY_LONGITUDINAL_STIFFNESS,
        relation: "K_b = d_p² K_px",
        get: |case| case.vehicle.bending_stiffness(),
        constant_for: |case, k_b| k_b / case.vehicle.truck.half_primary_spacing.powi(2),
        keeps: None,
    },
    // (4.6-8); moving it keeps the damping ratio.
    Natural {
        name: "secondary_lateral_frequency",
        words: "lateral natural frequency",
        symbol: "f_nL",
        quantity: Quantity::Frequency,
        range: Range::Positive,
        constant: Parameter::SECONDARY_LATERAL_STIFFNESS,
        relation: "f_n = √(4 K_sy / M_c) / 2π",
        get: |case| {
            let k = case.vehicle.suspension.secondary.lateral_stiffness;
            closed::secondary_frequency(case.vehicle.carbody.mass, k)
        },
        constant_for: |case, f| closed::secondary_stiffness(case.vehicle.carbody.mass, f),
        keeps: Some(Parameter::SECONDARY_LATERAL_DAMPING_RATIO),
    },
    // (4.6-9).
    Natural {
        name: "secondary_lateral_damping_ratio",
        words: "lateral damping ratio",
        symbol: "ξ_L",
        quantity: Quantity::Dimensionless,
        range: RATIO,
        constant: Parameter::SECONDARY_LATERAL_DAMPING,
        relation: "ξ = C_sy / √(K_sy M_c)",
        get: |case| {
            let secondary = &case.vehicle.suspension.secondary;
            let (k, c) = (secondary.lateral_stiffness, secondary.lateral_damping);
            closed::secondary_damping_ratio(case.vehicle.carbody.mass, k, c)
        },
        constant_for: |case, ratio| {
            let k = case.vehicle.suspension.secondary.lateral_stiffness;
            closed::secondary_damping(case.vehicle.carbody.mass, k, ratio)
        },
        keeps: None,
    },
    // (4.6-14); moving it keeps the damping ratio.
    Natural {
        name: "secondary_vertical_frequency",
        words: "vertical natural frequency",
        symbol: "f_nV",
        quantity: Quantity::Frequency,
        range: Range::Positive,
        constant: Parameter::SECONDARY_VERTICAL_STIFFNESS,
        relation: "f_n = √(4 K_sz / M_c) / 2π",
        get: |case| {
            let k = case.vehicle.suspension.secondary.vertical_stiffness;
            closed::secondary_frequency(case.vehicle.carbody.mass, k)
        },
        constant_for: |case, f| closed::secondary_stiffness(case.vehicle.carbody.mass, f),
        keeps: Some(Parameter::SECONDARY_VERTICAL_DAMPING_RATIO),
    },
    // (4.6-15).
    Natural {
        name: "secondary_vertical_damping_ratio",
        words: "vertical damping ratio",
        symbol: "ξ_V",
        quantity: Quantity::Dimensionless,
        range: RATIO,
        constant: Parameter::SECONDARY_VERTICAL_DAMPING,
        relation: "ξ = C_sz / √(K_sz M_c)",
        get: |case| {
            let secondary = &case.vehicle.suspension.secondary;
            let (k, c) = (secondary.vertical_stiffness, secondary.vertical_damping);
            closed::secondary_damping_ratio(case.vehicle.carbody.mass, k, c)
        },
        constant_for: |case, ratio| {
            let k = case.vehicle.suspension.secondary.vertical_stiffness;
            closed::secondary_damping(case.vehicle.carbody.mass, k, ratio)
        },
        keeps: None,
    },
    // (3.5-9), with the static stiffness of air springs where there are any.
    Natural {
        name: "primary_vertical_frequency",
        words: "truck bounce frequency",
        symbol: "f_nP",
        quantity: Quantity::Frequency,
        range: Range::Positive,
        constant: Parameter::PRIMARY_VERTICAL_STIFFNESS,
        relation: "K_pz follows from it by (3.5-9)",
        get: |case| closed::truck_vertical(&case.vehicle).frequency,
        constant_for: |case, f| {
            let k_sz = case
                .vehicle
                .suspension
                .secondary
                .static_vertical_stiffness();
            closed::primary_vertical_stiffness(case.vehicle.truck.mass, k_sz, f)
        },
        keeps: None,
    },
];
