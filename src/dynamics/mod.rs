//! Equations of motion: elements become matrices, which [`crate::numerics`] solves.

pub mod curving;
mod elements;
mod forced;
pub mod lateral;
mod poles;
mod row;
mod tangent;
pub mod vertical;

pub use elements::Speed;
pub use forced::{Digest, Excitation, ForcedModel, Output};
pub use lateral::LateralModel;
pub use row::Row;
pub use tangent::{ForcedTangent, SystemTangent, TangentEntry};
pub use vertical::VerticalModel;

use crate::numerics::{LinearSystem, parts};
