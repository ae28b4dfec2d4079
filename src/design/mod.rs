//! The design procedure: constrained optimisation around the full models.

mod evaluations;
pub mod form;
mod global;
pub mod local;
pub mod outcome;
pub mod problem;
pub mod procedure;
pub mod ride;
pub mod solve;
pub mod stability_curving;
mod subproblem;
mod surrogate;
pub mod unmet;
