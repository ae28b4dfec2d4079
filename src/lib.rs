//! Early design of rail vehicle suspensions from full vehicle models.
//!
//! Data flow in one direction: a [`spec`] gives a [`case::Case`]. [`vehicle`] lists elements,
//! [`wheel_rail`] and [`track`] what they run on. [`dynamics`] turns elements into matrices.
//! [`numerics`] solves matrices and has never heard of a train. [`evaluate`] turns solutions into
//! indices; every fast method answers or steps aside for its plain twin in the next folder.
//! [`design`] finds the suspension that is best within given limits, with the search of
//! [`optimize`], which knows no rail either. [`chart`] draws the report's charts with [`plot`],
//! [`export`] writes results, [`report`] a page of them. [`closed_form`] and [`comfort`] hold the
//! report's hand formulas and the comfort standards' weightings.
//!
//! No module imports one above it: [`units`], [`track`], [`wheel_rail`], [`vehicle`], [`case`],
//! [`numerics`], [`dynamics`], [`closed_form`], [`comfort`], [`parameter`], [`evaluate`], [`index`],
//! [`failure`], [`optimize`], [`spec`], [`design`], [`plot`], [`chart`], [`export`], [`report`].
//!
//! Everything is in SI units; [`units`] live at the boundary.
//!
//! ```
//! use bogie::{case::Case, evaluate::Evaluation};
//!
//! let prototype = Evaluation::new(&Case::prototype())?;
//! let critical_speed = prototype.stability.critical_speed().unwrap();
//! assert!((critical_speed * 3600.0 / 1609.344 - 280.4).abs() < 0.1); // mph
//! # Ok::<(), bogie::numerics::EigenError>(())
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
pub mod failure;
pub mod index;
pub mod numerics;
pub mod optimize;
pub mod parameter;
pub mod plot;
pub mod report;
pub mod spec;
pub mod track;
pub mod units;
pub mod vehicle;
pub mod wheel_rail;
