//! Global sensitivity: which parameters and inputs matter to the performance indices, and which do
//! not.
//!
//! [`factors`] says what varies and within which bounds. Two methods move all factors at once over
//! these ranges: [`morris`] screens many factors with few evaluations, [`sobol`] splits the variance
//! of an index among them. Both take any function on the unit cube; [`analysis`] applies them to the
//! full models of a case.
//!
//! All results depend on the seed only, not on the number of threads.

pub mod analysis;
pub mod factors;
pub mod morris;
mod random;
pub mod ranking;
pub mod runs;
pub mod sobol;

pub use analysis::{IndexSensitivity, Method, Sensitivity, Settings, screen};
pub use factors::{Factor, Factors};
pub use ranking::{Effects, Ranking};
pub use runs::{Outcome, Output, Watch};
