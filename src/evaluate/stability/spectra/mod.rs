//! The plain methods: full spectra at many speeds, each by the Schur form of the whole matrix.
//!
//! They answer where following the modes cannot, and the fast methods are tested against them. They
//! share with these only the matrices: no refinement of eigenpairs, no mode count.

mod critical_speed;
mod damping_range;
mod hopf;
mod spectrum;
