//! Wheelset: two profiled wheels on a rigid axle.

use serde::Serialize;

use super::{Vehicle, end::of_end};
use crate::units::{
    Need::{Optional, Required},
    Range::Positive,
    Table, number,
};

/// Wheelset, SI units; subscript w in the report.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Wheelset {
    /// M_w, kg.
    pub mass: f64,
    /// I_wz, kg m².
    pub yaw_inertia: f64,
    /// I_wy, about the axle, kg m².
    pub spin_inertia: f64,
    /// I_wx, kg m². Wheelset roll is prescribed by the rails, so no model uses it.
    pub roll_inertia: f64,
    /// r0, centred rolling radius, m.
    pub rolling_radius: f64,
    /// a, half of the distance between the contact points, m.
    pub half_contact_distance: f64,
}

/// Numbers of `[vehicle.wheelset]`.
#[rustfmt::skip]
pub static WHEELSET: Table<Vehicle> = Table {
    path: "vehicle.wheelset",
    meaning: "One wheelset.",
    numbers: &[
        of_end!("vehicle.wheelset.mass", "M_w", Mass, Positive, Required, "mass of one wheelset", wheelset.mass),
        of_end!("vehicle.wheelset.yaw_inertia", "I_wz", Inertia, Positive, Required, "wheelset yaw inertia", wheelset.yaw_inertia),
        of_end!("vehicle.wheelset.spin_inertia", "I_wy", Inertia, Positive, Required, "wheelset inertia about its axle", wheelset.spin_inertia),
        of_end!("vehicle.wheelset.roll_inertia", "I_wx", Inertia, Positive, Optional("yaw_inertia"), "wheelset roll inertia; the models prescribe that roll and do not use it", wheelset.roll_inertia),
        number!("vehicle.wheelset.rolling_radius", "r_0", Length, Positive, Required, "rolling radius of the centred wheelset", wheelset.rolling_radius),
        number!("vehicle.wheelset.half_contact_distance", "a", Length, Positive, Required, "half of the distance between the two contact points", wheelset.half_contact_distance),
    ],
};
