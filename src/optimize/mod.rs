//! Constrained optimisation around costly evaluations.
//!
//! A [`problem`] measures designs with the full models and judges what was measured. The
//! [`archive`] keeps every measurement: it counts them against the budget, serves them again, and
//! writes the [`journal`] from which a run can be resumed. [`solve`] searches globally (an even
//! covering and argmin's particle swarm), then locally from the best designs met (a trust-region
//! method whose subproblems are quadratic programs on fitted surrogates), and hands over the best
//! design with its [`certificate`].

pub mod archive;
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

pub(crate) use surrogate::follow;
