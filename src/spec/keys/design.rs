//! Keys of `[design]`, `[requirements]` and `[limits]`.

use super::Need::Optional;
use super::Range;
use super::Range::{Positive, PositiveUpTo};
use super::key::{Key, Slot, key};
use crate::spec::{DesignSpace, Interval, Limits, Requirements};
use crate::track::MAX_DEGREE;
use crate::units::Quantity;

const FIXED: super::Need = Optional("as it stands");
const FREE: super::Need = Optional("none");

/// Bounds of what may vary.
#[rustfmt::skip]
pub static BOUNDS: &[Key<DesignSpace, Interval>] = &[
    key!("design.primary_bending_stiffness", "K_b", RotationalStiffness, Positive, FIXED, "primary bending stiffness d_p² K_px; or primary_longitudinal_stiffness instead", primary_bending_stiffness),
    key!("design.primary_lateral_stiffness", "K_py", Stiffness, Positive, FIXED, "primary lateral stiffness, per corner", primary_lateral_stiffness),
    key!("design.secondary_lateral_frequency", "f_nL", Frequency, Positive, FIXED, "natural frequency of the carbody on its secondary lateral springs, √(4 K_sy / M_c) / 2π", secondary_lateral_frequency),
    key!("design.secondary_lateral_damping_ratio", "ξ_L", Dimensionless, PositiveUpTo(2.0), FIXED, "damping ratio C_sy / √(K_sy M_c)", secondary_lateral_damping_ratio),
    key!("design.secondary_vertical_frequency", "f_nV", Frequency, Positive, FIXED, "natural frequency of the carbody on its secondary vertical springs, √(4 K_sz / M_c) / 2π", secondary_vertical_frequency),
    key!("design.secondary_vertical_damping_ratio", "ξ_V", Dimensionless, PositiveUpTo(2.0), FIXED, "damping ratio C_sz / √(K_sz M_c)", secondary_vertical_damping_ratio),
];

/// Values that follow from a rule.
#[rustfmt::skip]
pub static RULES: &[Key<DesignSpace>] = &[
    key!("design.primary_vertical_frequency", "f_n", Frequency, Positive, FIXED, "vertical natural frequency of the truck frame, from which K_pz follows by (3.5-9)", primary_vertical_frequency),
];

/// What must be reached.
#[rustfmt::skip]
pub static REQUIREMENTS: &[Key<Requirements>] = &[
    key!("requirements.critical_speed", "V_cr", Speed, Positive, FREE, "critical speed, at least", critical_speed),
    Key {
        path: "requirements.degree_curve",
        symbol: "D",
        quantity: Quantity::DegreeOfCurve,
        meaning: "degree of the tightest curve without flanging or slip, at least",
        range: Range::PositiveUpTo(MAX_DEGREE * std::f64::consts::PI / 180.0),
        need: FREE,
        get: |requirements| requirements.degree_curve.map(f64::to_radians),
        set: |requirements, angle| requirements.degree_curve.write(angle.to_degrees()),
    },
    key!("requirements.lateral_acceleration", "", Acceleration, Positive, FREE, "average RMS lateral acceleration of the passenger points, at most", lateral_acceleration),
    key!("requirements.vertical_acceleration", "", Acceleration, Positive, FREE, "average RMS vertical acceleration of the passenger points, at most", vertical_acceleration),
];

/// What must not be exceeded, by three standard deviations.
#[rustfmt::skip]
pub static LIMITS: &[Key<Limits>] = &[
    key!("limits.secondary_lateral_stroke", "", Stroke, Positive, FREE, "secondary lateral stroke to the stops", secondary_lateral_stroke),
    key!("limits.secondary_vertical_stroke", "", Stroke, Positive, FREE, "secondary vertical stroke to the stops", secondary_vertical_stroke),
    key!("limits.primary_lateral_stroke", "", Stroke, Positive, FREE, "primary lateral stroke to the stops", primary_lateral_stroke),
    key!("limits.wheelset_excursion", "", Stroke, Positive, FREE, "excursion of a wheelset from the track centre line", wheelset_excursion),
];
