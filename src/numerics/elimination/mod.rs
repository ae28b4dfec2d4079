//! Sparse Gauss elimination without pivoting, several frequencies side by side.
//!
//! Bodies that are coupled in chains give sparse matrices, and an elimination from the ends of the
//! chains inwards fills few entries. The pattern is found once for a system and then run for many
//! frequencies. Lanes that lose digits are marked; a pivoted factorisation answers for them.

pub mod lanes;
mod pattern;
mod stiffness;

pub use lanes::{LANES, Lanes, Reals};
pub use pattern::{ALL, CoordinateSet, MOST};
pub use stiffness::{Factors, Stiffness};
