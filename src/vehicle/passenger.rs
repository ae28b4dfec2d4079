//! Where the passengers sit whose ride is computed.

use serde::Serialize;

/// Passenger points: the carbody c.g. and one point near either end.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Passenger {
    /// p_x, distance of the end points ahead of and behind the c.g., m.
    pub longitudinal_offset: f64,
    /// p_y, distance of the end points from the centre line, m (vertical model).
    pub lateral_offset: f64,
    /// h, height of all three points above the carbody c.g., m (lateral model). The report does
    /// not give it; at the floor, h = −h_cs, its numbers are met best.
    pub height_above_carbody_cg: f64,
}
