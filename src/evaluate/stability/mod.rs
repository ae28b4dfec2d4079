//! Stability over a range of speeds: critical speed and least damping ratios.
//!
//! Two methods answer each question. The fast one follows the modes (`following`), and where it has
//! no answer steps aside for the plain one, by full spectra at many speeds (`spectra`).

mod critical_speed;
mod damping_range;
mod following;
mod spectra;

pub use critical_speed::{Crossing, Hunting, Outcome, Stability};
pub use damping_range::{DampingMinimum, DampingRange, Place};
