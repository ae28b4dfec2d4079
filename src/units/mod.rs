//! Units at the boundary; SI inside.
//!
//! A dimensional value is written as a number and a unit expression, in SI or US customary units:
//!
//! ```
//! use bogie::units::Quantity;
//!
//! let mass = Quantity::Mass.parse("2500 slug").unwrap();
//! assert!((mass - 36_485.0).abs() < 1.0); // kg
//! assert!(Quantity::Mass.parse("2500 lbf").is_err());
//! ```

mod dimension;
mod error;
mod expression;
mod key;
pub mod number;
mod quantity;
mod range;
mod symbol;
pub mod us;

pub use dimension::Dimension;
pub use error::UnitError;
pub use expression::{LONGEST, Measure, Unit, pattern};
pub(crate) use key::number;
pub use key::{Key, Need, Number, Slot, Table};
pub use quantity::{DisplayUnit, Quantity};
pub use range::Range;

/// Standard acceleration of gravity, m/s² (CGPM 1901).
pub const GRAVITY: f64 = 9.806_65;
