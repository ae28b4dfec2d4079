//! Wheelset: two profiled wheels on a rigid axle.

use serde::Serialize;

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
