//! The design procedure: constrained optimisation around the full models.
//!
//! [`tasks`] turns a spec into studies; a [`study`] measures indices ([`measure`]) and judges them;
//! [`search`](search()) solves it, [`explain`] puts the solution into an engineer's terms, [`procedure`]
//! runs the report's trade-offs and the joint optimisation, [`freedom`] tells how far the design may move
//! from the optimum, [`delivered`] picks the design to hand over, [`conflict`] tells which demands stand
//! against one another where they cannot all be met. A [`sweep`] measures many designs without a search.

pub mod compromise;
pub mod conflict;
pub mod delivered;
pub mod doubts;
mod epigraph;
pub mod explain;
pub mod form;
pub mod freedom;
pub mod margin;
pub mod measure;
pub mod missed;
pub mod outcome;
pub mod pareto;
pub mod price;
pub mod procedure;
mod recovery;
pub mod screened;
pub mod search;
pub mod sensitivity;
pub mod sequence;
mod stage;
mod standing;
pub mod study;
pub mod sweep;
pub mod tasks;
mod unused;

pub use search::{search, search_in_all};
