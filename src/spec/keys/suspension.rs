//! Keys of `[suspension.*]`, constants per element.

use super::Need::{Optional, Required};
use super::Range::{NonNegative, Positive};
use super::key::{Key, key};
use crate::case::Case;
use crate::units::Quantity;
use crate::vehicle::AirSpring;

#[rustfmt::skip]
pub(super) static PRIMARY: &[Key<Case>] = &[
    key!("suspension.primary.longitudinal_stiffness", "K_px", Stiffness, Positive, Required, "primary longitudinal stiffness, per corner (4 per truck)", vehicle.suspension.primary.longitudinal_stiffness),
    key!("suspension.primary.lateral_stiffness", "K_py", Stiffness, Positive, Required, "primary lateral stiffness, per corner", vehicle.suspension.primary.lateral_stiffness),
    key!("suspension.primary.vertical_stiffness", "K_pz", Stiffness, Positive, Required, "primary vertical stiffness, per corner", vehicle.suspension.primary.vertical_stiffness),
    key!("suspension.primary.longitudinal_damping", "C_px", Damping, NonNegative, Optional("longitudinal_stiffness / 250 s⁻¹"), "primary longitudinal damping, per corner", vehicle.suspension.primary.longitudinal_damping),
    key!("suspension.primary.lateral_damping", "C_py", Damping, NonNegative, Optional("lateral_stiffness / 250 s⁻¹"), "primary lateral damping, per corner", vehicle.suspension.primary.lateral_damping),
    key!("suspension.primary.vertical_damping", "C_pz", Damping, NonNegative, Optional("vertical_stiffness / 250 s⁻¹"), "primary vertical damping, per corner", vehicle.suspension.primary.vertical_damping),
];

#[rustfmt::skip]
pub(super) static SECONDARY: &[Key<Case>] = &[
    key!("suspension.secondary.lateral_stiffness", "K_sy", Stiffness, Positive, Required, "secondary lateral stiffness, per side (2 per truck)", vehicle.suspension.secondary.lateral_stiffness),
    key!("suspension.secondary.lateral_damping", "C_sy", Damping, NonNegative, Required, "secondary lateral damping, per side", vehicle.suspension.secondary.lateral_damping),
    key!("suspension.secondary.vertical_stiffness", "K_sz", Stiffness, Positive, Required, "secondary vertical stiffness, per side", vehicle.suspension.secondary.vertical_stiffness),
    key!("suspension.secondary.vertical_damping", "C_sz", Damping, NonNegative, Required, "secondary vertical damping, per side", vehicle.suspension.secondary.vertical_damping),
    key!("suspension.secondary.yaw_stiffness", "K_sψ", RotationalStiffness, NonNegative, Required, "secondary yaw stiffness, per truck", vehicle.suspension.secondary.yaw_stiffness),
    key!("suspension.secondary.yaw_damping", "C_sψ", RotationalDamping, NonNegative, Optional("yaw_stiffness / 250 s⁻¹"), "secondary yaw damping, per truck", vehicle.suspension.secondary.yaw_damping),
    key!("suspension.secondary.yaw_breakaway_torque", "T_sψ", Torque, NonNegative, Required, "torque at which the truck begins to slip under the carbody", vehicle.suspension.secondary.yaw_breakaway_torque),
];

/// A key of the air spring, which comes into being with the first of them.
macro_rules! air {
    ($path:literal, $quantity:ident, $range:expr, $need:expr, $meaning:literal, $field:ident) => {
        Key {
            path: $path,
            symbol: "",
            quantity: Quantity::$quantity,
            meaning: $meaning,
            range: $range,
            need: $need,
            get: |case: &Case| Some(case.vehicle.suspension.secondary.air_spring?.$field),
            set: |case: &mut Case, value| {
                let spring = &mut case.vehicle.suspension.secondary.air_spring;
                spring.get_or_insert(NOTHING).$field = value;
            },
        }
    };
}

const NOTHING: AirSpring = AirSpring {
    direct_stiffness: 0.0,
    series_stiffness: 0.0,
    orifice_damping: 0.0,
    reservoir_stiffness: 0.0,
};

/// All or none; what is required here is required of an air spring.
#[rustfmt::skip]
pub(in crate::spec) static AIR_SPRING: &[Key<Case>] = &[
    air!("suspension.secondary.air_spring.direct_stiffness", Stiffness, NonNegative, Required, "direct spring of an air spring (change of effective area), per side", direct_stiffness),
    air!("suspension.secondary.air_spring.series_stiffness", Stiffness, Positive, Required, "air in the bellows, in series with the orifice, per side", series_stiffness),
    air!("suspension.secondary.air_spring.orifice_damping", Damping, NonNegative, Required, "orifice between bellows and reservoir, per side", orifice_damping),
    air!("suspension.secondary.air_spring.reservoir_stiffness", Stiffness, NonNegative, Optional("0"), "air in the reservoir, in parallel with the orifice, per side", reservoir_stiffness),
];
