//! Does every fast method agree with its plain twin, and do solvers find what is known?

mod eigenvalues;
mod fast_and_plain;
mod gradients;
mod resonances;
mod standard_problems;
#[path = "../support/mod.rs"]
mod support;
