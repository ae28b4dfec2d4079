//! Where the passengers sit whose ride is computed.

use serde::Serialize;

use super::Vehicle;
use crate::units::{
    Need::{Optional, Required},
    Range::{Any, NonNegative},
    Table, number,
};

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

/// Numbers of `[passenger]`.
#[rustfmt::skip]
pub static PASSENGER: Table<Vehicle> = Table {
    path: "passenger",
    meaning: "Where ride is judged: at the carbody's c.g. and at a point towards either end.",
    numbers: &[
        number!("passenger.longitudinal_offset", "p_x", Length, NonNegative, Required, "distance of the end passenger points from the carbody c.g.", passenger.longitudinal_offset),
        number!("passenger.lateral_offset", "p_y", Length, Any, Required, "distance of the end passenger points from the centre line, vertical model", passenger.lateral_offset),
        number!("passenger.height_above_carbody_cg", "h", Length, Any, Optional("the floor, −height_above_secondary"), "height of the passenger points above the carbody c.g., lateral model", passenger.height_above_carbody_cg),
    ],
};
