//! Equations of motion: elements become matrices, which [`crate::numerics`] solves.

mod assembly;
pub mod curving;
pub mod element;
mod forced;
pub mod lateral;
mod poles;
mod row;
pub mod suspension;
mod tangent;
pub mod vertical;

pub use assembly::Speed;
pub use forced::{Digest, Excitation, ForcedModel, Output};
pub use lateral::LateralModel;
pub use row::Row;
pub use tangent::{ForcedTangent, SystemTangent, TangentEntry};
pub use vertical::VerticalModel;

use crate::numerics::{LinearSystem, parts};
