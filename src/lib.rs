//! Early design of rail vehicle suspensions from full vehicle models.
//!
//! The problem, for a vehicle whose suspension and wheel profile x are to be chosen:
//!
//! ```math
//! minimise    f(x)
//! subject to  c_j(x) ≤ b_j   (requirements and limits),   low ≤ x ≤ high
//! where       M q̈ + (C + C_V/V) q̇ + K q = B w(t)   are the linear models of the vehicle,
//!             eigenvalues s(V)       give the critical speed: the least V with Re s = 0,
//!             spectra S(ω) of w      give RMS accelerations and strokes: σ² = ∫ |H(iω)|² S dω,
//!             steady curving, q̈ = 0  gives the tightest curve without flange contact or slip.
//! ```
//!
//! f and c_j are performance *indices*: critical speed, degree curve, ride, strokes. A [`Spec`] states
//! the problem in a TOML file, a [`Case`] is one [`Vehicle`] in its use, an [`Evaluation`] has all of
//! its indices, and a [`Design`] is the solution with its certificate. A [`Run`] leads from the
//! spec to the result:
//!
//! ```
//! use bogie::{Case, Evaluation};
//!
//! let prototype = Evaluation::new(&Case::prototype())?;
//! let critical_speed = prototype.stability.critical_speed().unwrap();
//! assert!((critical_speed * 3600.0 / 1609.344 - 280.4).abs() < 0.1); // mph
//! # Ok::<(), bogie::numerics::EigenError>(())
//! ```
//!
//! Data flows in one direction. A [`spec`] gives a case: [`vehicle`] lists elements and their numbers,
//! [`wheel_rail`] and [`track`] are below it. [`dynamics`] turns elements into matrices. [`numerics`] solves
//! matrices and has never heard of a train. [`evaluate`] turns solutions into indices; every fast method
//! answers or steps aside for its plain twin in the next folder. [`design`] finds the suspension with the search
//! of [`optimize`], which knows no rail either. [`chart`] draws the report's charts with [`plot`], [`export`]
//! writes results, [`report`] a page of them. [`closed_form`] and [`comfort`] hold the report's hand formulas
//! and the comfort standards' weightings. Everything is in SI units; [`units`] live at the boundary.
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
pub mod run;
pub mod spec;
pub mod track;
pub mod units;
pub mod vehicle;
pub mod wheel_rail;

pub use case::Case;
pub use design::{outcome::DesignResult as Design, pareto::Front, sensitivity::Sensitivity};
pub use evaluate::Evaluation;
pub use index::{Demands, Index};
pub use parameter::Parameter;
pub use run::{Answer, Input, Run};
pub use spec::Spec;
pub use track::Track;
pub use vehicle::Vehicle;
pub use wheel_rail::WheelRail;

/// The example of the README is tested.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
