//! Equations of motion: the report's models as matrices.

mod balance;
pub mod curving;
mod eigen;
mod eigenpairs;
pub mod element;
pub mod elimination;
mod forced;
pub mod lateral;
mod linear_system;
mod parts;
mod row;
mod simultaneous;
mod suspension;
mod tangent;
pub mod vertical;

pub use eigen::{EigenError, Poles, diverge, eigenvalues};
pub use eigenpairs::{Known, Pairs, Refiner, SETTLED};
pub use forced::{Digest, Excitation, ForcedModel, Output};
pub use lateral::LateralModel;
pub use linear_system::{LinearSystem, Speed};
pub use row::Row;
pub use tangent::{ForcedTangent, SystemTangent, TangentEntry};
pub use vertical::VerticalModel;
