//! Early design of rail vehicle suspensions from full vehicle models.

pub mod case;
pub mod closed_form;
pub mod comfort;
pub mod design;
pub mod dynamics;
pub mod evaluate;
pub mod export;
pub mod spec;
pub mod track;
pub mod units;
pub mod vehicle;
pub mod wheel_rail;
