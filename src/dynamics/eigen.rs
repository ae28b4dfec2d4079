//! Eigenvalues of real matrices, with a limit on the iterations.

use nalgebra::{Complex, DMatrix, SMatrix, linalg::Schur};

use super::{ForcedModel, balance::balance, parts, simultaneous};

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

/// All eigenvalues of a system at one speed.
#[derive(Debug, Clone)]
pub struct Poles {
    /// V, m/s.
    pub speed: f64,
    /// s, rad/s, in no particular order.
    pub values: Vec<Complex<f64>>,
}

impl Poles {
    /// Of a model without input at `speed`, m/s.
    ///
    /// # Errors
    ///
    /// As [`eigenvalues`].
    pub fn at(model: &ForcedModel, speed: f64) -> Result<Self, EigenError> {
        let system = &model.system;
        if let Some(values) = from_estimates(model, speed) {
            return Ok(Self { speed, values });
        }
        let mut values = Vec::with_capacity(2 * system.order());
        for matrix in parts::state_matrices(system, speed) {
            values.extend(eigenvalues(matrix)?);
        }
        Ok(Self { speed, values })
    }

    /// Those with positive imaginary part.
    pub fn oscillatory(&self) -> impl Iterator<Item = Complex<f64>> + '_ {
        self.values.iter().copied().filter(|s| s.im > 0.0)
    }

    /// Whether a motion without oscillation grows: divergence. What drifts, at s = 0 but for rounding,
    /// does not.
    pub fn diverge(&self) -> bool {
        diverge(&self.values)
    }

    /// Whether nothing grows or stays as it is.
    pub fn stable(&self) -> bool {
        self.values.iter().all(|s| s.re < 0.0)
    }
}

/// Rounding of an eigenvalue, as a share of the largest of its matrix: of the backward error of the Schur
/// form, a small multiple of the machine's (Golub, Van Loan: *Matrix Computations*, 2013, section 7.5.6).
const ROUNDING: f64 = 100.0 * f64::EPSILON;

/// Re s/|s| above which what grows does not oscillate: whether two nearly equal ones, as those of two trucks
/// are, come out as a pair is a matter of rounding.
const REAL: f64 = 0.999;

/// Whether some eigenvalue is positive and real, or as good as real.
pub fn diverge(values: &[Complex<f64>]) -> bool {
    let largest = values
        .iter()
        .map(|s| s.norm_sqr())
        .fold(0.0, f64::max)
        .sqrt();
    let growing = |s: &Complex<f64>| s.re > ROUNDING * largest && s.re > REAL * s.norm_sqr().sqrt();
    values.iter().any(growing)
}

/// How far apart the eigenvalues of two parts that are alike are put at first, relative.
const SPLIT: f64 = 1e-6;

/// Eigenvalues refined from those of the parts of a system that has two that are alike. `None` if it
/// has not, or they do not come out for sure.
fn from_estimates(model: &ForcedModel, speed: f64) -> Option<Vec<Complex<f64>>> {
    let [one, rest] = parts::held_apart(&model.system, speed)?.map(eigenvalues);
    let mut estimates = rest.ok()?;
    for s in one.ok()? {
        estimates.extend([s * (1.0 + SPLIT), s * (1.0 - SPLIT)]);
    }
    simultaneous::refined(model, speed, &estimates)
}

/// Sweeps allowed per eigenvalue: under 3 is normal; about one vehicle in 3000 never converges and
/// goes to the second iteration.
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
    balance(&mut a);
    // The models' own sizes are known when compiling, which makes them faster.
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
