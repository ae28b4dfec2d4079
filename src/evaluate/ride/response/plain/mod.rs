//! The plain method: a dense pivoted factorisation, one frequency at a time.

mod densities;

pub use densities::densities;
