//! Elimination in the order that the vehicle's structure suggests.
//!
//! A wheelset is tied to its truck, a truck to the carbody, and nothing else to one another. Gauss
//! elimination from the wheelsets to the carbody therefore touches few entries: the pattern is
//! worked out once for a model, and then run for many frequencies at once.

pub mod lanes;
mod pattern;
mod stiffness;

pub use lanes::{LANES, Lanes, Reals};
pub use pattern::ALL;
pub use stiffness::{Factors, Stiffness};
