//! Truck frame with the geometry of the springs above and below it.

use serde::Serialize;

use super::{Vehicle, end::of_end};
use crate::units::{
    Need::Required,
    Range::{Any, Positive},
    Table,
};

/// Truck frame, SI units; subscript t in the report.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Truck {
    /// M_t, frame mass, kg.
    pub mass: f64,
    /// I_tx, kg m².
    pub roll_inertia: f64,
    /// I_ty, kg m².
    pub pitch_inertia: f64,
    /// I_tz, kg m².
    pub yaw_inertia: f64,
    /// b, half of the wheelbase, m.
    pub half_wheelbase: f64,
    /// d_p, half of the lateral spacing of the primary springs, m.
    pub half_primary_spacing: f64,
    /// d_s, half of the lateral spacing of the secondary springs, m.
    pub half_secondary_spacing: f64,
    /// h_tp, height of the frame's c.g. above the primary lateral springs, m.
    pub height_above_primary: f64,
    /// h_ts, depth of the frame's c.g. below the secondary lateral springs, m.
    pub depth_below_secondary: f64,
}

/// Numbers of `[vehicle.truck]`.
#[rustfmt::skip]
pub static TRUCK: Table<Vehicle> = Table {
    path: "vehicle.truck",
    meaning: "One truck frame, without its wheelsets.",
    numbers: &[
        of_end!("vehicle.truck.mass", "M_t", Mass, Positive, Required, "truck frame mass, without wheelsets", truck.mass),
        of_end!("vehicle.truck.roll_inertia", "I_tx", Inertia, Positive, Required, "truck frame roll inertia", truck.roll_inertia),
        of_end!("vehicle.truck.pitch_inertia", "I_ty", Inertia, Positive, Required, "truck frame pitch inertia", truck.pitch_inertia),
        of_end!("vehicle.truck.yaw_inertia", "I_tz", Inertia, Positive, Required, "truck frame yaw inertia", truck.yaw_inertia),
        of_end!("vehicle.truck.half_wheelbase", "b", Length, Positive, Required, "half of the distance between the axles of a truck", truck.half_wheelbase),
        of_end!("vehicle.truck.half_primary_spacing", "d_p", Length, Positive, Required, "half of the lateral distance between the primary springs", truck.half_primary_spacing),
        of_end!("vehicle.truck.half_secondary_spacing", "d_s", Length, Positive, Required, "half of the lateral distance between the secondary springs", truck.half_secondary_spacing),
        of_end!("vehicle.truck.height_above_primary", "h_tp", Length, Any, Required, "height of the frame's c.g. above the primary lateral springs", truck.height_above_primary),
        of_end!("vehicle.truck.depth_below_secondary", "h_ts", Length, Any, Required, "depth of the frame's c.g. below the secondary lateral springs", truck.depth_below_secondary),
    ],
};
