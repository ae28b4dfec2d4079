//! Early design of rail vehicle suspensions from full vehicle models.
//!
//! Data flow in one direction: a [`spec`] gives a [`case::Case`] ([`vehicle`], [`wheel_rail`],
//! [`track`]), which the [`dynamics`] turn into equations of motion, [`evaluate`] into performance
//! indices and [`design`] into the suspension that is best within given limits; [`export`] writes
//! results, [`report`] a page of them. [`closed_form`] and [`comfort`] hold the report's hand formulas and the comfort
//! standards' weightings.
//!
//! Everything is in SI units; [`units`] live at the boundary.
//!
//! ```
//! use bogie::{case::Case, evaluate::Evaluation};
//!
//! let prototype = Evaluation::new(&Case::prototype())?;
//! let critical_speed = prototype.stability.critical_speed().unwrap();
//! assert!((critical_speed * 3600.0 / 1609.344 - 280.4).abs() < 0.1); // mph
//! # Ok::<(), bogie::dynamics::EigenError>(())
//! ```
//!
//! Equation and table numbers in the documentation are those of the report that the models come
//! from: *Rail Passenger Vehicle Truck Design Methodology*, FRA/MIT, 1981.

pub mod case;
pub mod chart;
pub mod closed_form;
pub mod comfort;
pub mod design;
pub mod dynamics;
pub mod evaluate;
pub mod export;
pub mod index;
pub mod optimize;
pub mod parameter;
pub mod report;
pub mod spec;
pub mod track;
pub mod units;
pub mod vehicle;
pub mod wheel_rail;
