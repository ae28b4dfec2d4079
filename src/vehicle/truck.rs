//! Truck frame with the geometry of the springs above and below it.

use serde::Serialize;

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
