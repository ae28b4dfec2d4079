//! Numerical methods for small second-order systems whose damping depends on one parameter.
//!
//! | module | method |
//! |---|---|
//! | [`LinearSystem`] | M q̈ + C(V) q̇ + K q = f as plain matrices |
//! | [`eigenvalues`] | real Schur form of a balanced matrix, with a limit on the sweeps |
//! | [`Poles`] | full spectrum: Schur form, or Börsch-Supan corrections of estimates |
//! | [`Refiner`] | two-sided Rayleigh quotient iteration on eigenpairs |
//! | [`modes_below`] | count of eigenvalues in a sector by the argument principle |
//! | [`elimination`] | sparse Gauss elimination, several frequencies side by side |
//! | [`cubic`] | Hermite cubics, and roots on them |
//! | [`quadrature`], [`panels`] | adaptive Gauss quadrature on panels laid around known poles |
//!
//! The parameter V is called the speed: C(V) = C0 + C1/V + C2 V.

mod balance;
mod borsch_supan;
pub mod cubic;
mod eigenpairs;
mod eigenvalue;
mod eigenvalues;
pub mod elimination;
mod linear_system;
mod mode_count;
pub mod panels;
pub mod parts;
mod poles;
pub mod quadrature;

pub use eigenpairs::{Eigenpairs, PAIR_CONVERGED, Refiner};
pub use eigenvalue::{Eigenvalue, damping_ratio, damping_ratio_change, frequency, size};
pub use eigenvalues::{EigenError, eigenvalues};
pub use linear_system::LinearSystem;
pub use mode_count::modes_below;
pub use poles::{Poles, diverge};
