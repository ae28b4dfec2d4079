//! Eigenvalues of real matrices, with a limit on the iterations.

use nalgebra::{Complex, DMatrix, SMatrix, linalg::Schur};

use super::balance::balance;

/// Failure of an eigenvalue computation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum EigenError {
    /// The matrix holds a NaN or an infinity.
    #[error("the system matrix is not finite")]
    NotFinite,
    /// Neither iteration converged.
    #[error("the eigenvalue iteration did not converge")]
    NotConverged,
}

/// Limit on the sweeps per eigenvalue: under 3 is usual; about one matrix in 3000 never converges and
/// goes to the second library.
const SWEEPS_PER_EIGENVALUE: usize = 10;

/// Eigenvalues by the real Schur form, or `None` if it does not converge.
macro_rules! schur_values {
    ($matrix:expr) => {{
        let matrix = $matrix;
        let sweeps = SWEEPS_PER_EIGENVALUE * matrix.nrows();
        let schur = Schur::try_new(matrix, f64::EPSILON, sweeps);
        schur.map(|schur| {
            schur
                .complex_eigenvalues()
                .iter()
                .copied()
                .collect::<Vec<_>>()
        })
    }};
}

/// All eigenvalues of a real square matrix, in no particular order.
///
/// Balanced real Schur form by `nalgebra`, the faster library; where it does not converge, by `faer`.
///
/// # Errors
///
/// [`EigenError`] for a matrix that is not finite, or if neither iteration converges.
pub fn eigenvalues(mut a: DMatrix<f64>) -> Result<Vec<Complex<f64>>, EigenError> {
    if !a.iter().all(|x| x.is_finite()) {
        return Err(EigenError::NotFinite);
    }
    balance(&mut a);
    // Sizes known when compiling are faster.
    let values = match a.nrows() {
        2 => schur_values!(SMatrix::<f64, 2, 2>::from_column_slice(a.as_slice())),
        4 => schur_values!(SMatrix::<f64, 4, 4>::from_column_slice(a.as_slice())),
        6 => schur_values!(SMatrix::<f64, 6, 6>::from_column_slice(a.as_slice())),
        12 => schur_values!(SMatrix::<f64, 12, 12>::from_column_slice(a.as_slice())),
        14 => schur_values!(SMatrix::<f64, 14, 14>::from_column_slice(a.as_slice())),
        30 => schur_values!(SMatrix::<f64, 30, 30>::from_column_slice(a.as_slice())),
        34 => schur_values!(SMatrix::<f64, 34, 34>::from_column_slice(a.as_slice())),
        _ => schur_values!(a.clone()),
    };
    match values {
        Some(values) if values.iter().all(|s: &Complex<f64>| s.is_finite()) => Ok(values),
        _ => second_iteration(&a),
    }
}

fn second_iteration(a: &DMatrix<f64>) -> Result<Vec<Complex<f64>>, EigenError> {
    let matrix = faer::Mat::from_fn(a.nrows(), a.ncols(), |i, j| a[(i, j)]);
    let values = matrix.eigenvalues().map_err(|_| EigenError::NotConverged)?;
    Ok(values
        .into_iter()
        .map(|s| Complex::new(s.re, s.im))
        .collect())
}
