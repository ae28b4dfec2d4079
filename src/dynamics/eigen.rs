//! Eigenvalues of real matrices, with a limit on the iterations.

use nalgebra::{Complex, DMatrix, linalg::Schur};

/// Why no eigenvalues came out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum EigenError {
    /// The matrix holds a NaN or an infinity.
    #[error("the system matrix is not finite")]
    NotFinite,
    /// Neither iteration converged.
    #[error("the eigenvalue iteration did not converge")]
    NotConverged,
}

/// Sweeps allowed per eigenvalue: under 3 is normal; about one vehicle in 3000 never converges and
/// goes to the second iteration.
const SWEEPS_PER_EIGENVALUE: usize = 10;

/// All eigenvalues of a real square matrix, in no particular order.
///
/// Balanced real Schur form by `nalgebra`, which is the faster; where it does not converge,
/// `faer`'s.
///
/// # Errors
///
/// [`EigenError`] for a matrix that is not finite, or if neither iteration converges.
pub fn eigenvalues(mut a: DMatrix<f64>) -> Result<Vec<Complex<f64>>, EigenError> {
    if !a.iter().all(|x| x.is_finite()) {
        return Err(EigenError::NotFinite);
    }
    nalgebra::linalg::balancing::balance_parlett_reinsch(&mut a);
    let sweeps = SWEEPS_PER_EIGENVALUE * a.nrows();
    if let Some(schur) = Schur::try_new(a.clone(), f64::EPSILON, sweeps) {
        let values: Vec<_> = schur.complex_eigenvalues().iter().copied().collect();
        if values.iter().all(|s| s.is_finite()) {
            return Ok(values);
        }
    }
    second_iteration(&a)
}

fn second_iteration(a: &DMatrix<f64>) -> Result<Vec<Complex<f64>>, EigenError> {
    let matrix = faer::Mat::from_fn(a.nrows(), a.ncols(), |i, j| a[(i, j)]);
    let values = matrix.eigenvalues().map_err(|_| EigenError::NotConverged)?;
    Ok(values
        .into_iter()
        .map(|s| Complex::new(s.re, s.im))
        .collect())
}
