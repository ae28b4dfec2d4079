//! Constrained optimisation around costly evaluations.
//!
//! A [`problem`] measures designs with the full models and judges the measurements. The
//! [`archive`] keeps every measurement: it counts them against the budget, serves them again, and
//! writes the [`journal`] from which a run can be resumed. [`solve`] searches locally from
//! many designs (argmin drives the multistart; a trust-region method, whose subproblems are
//! quadratic programs on surrogates, follows each start) until basins not yet seen are unlikely,
//! and hands over the best design with its [`certificate`].

pub mod archive;
mod basins;
pub mod certificate;
mod effort;
mod evaluations;
mod global;
pub mod journal;
pub mod local;
mod multipliers;
pub mod problem;
mod secants;
pub mod solve;
mod start;
mod subproblem;
mod surrogate;
mod violation;
pub mod within;

pub(crate) use surrogate::follow;
