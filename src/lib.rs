//! Early design of rail vehicle suspensions from full vehicle models.

pub mod case;
pub mod spec;
pub mod track;
pub mod units;
pub mod vehicle;
pub mod wheel_rail;
