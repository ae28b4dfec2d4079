//! Full spectra: all eigenvalues of a second-order system at one speed.

use nalgebra::Complex;

use super::{
    EigenError, LinearSystem, borsch_supan, eigenvalues, elimination::Stiffness, parts, size,
};

/// All eigenvalues of a system at one speed.
#[derive(Debug, Clone)]
pub struct Poles {
    /// V, m/s.
    pub speed: f64,
    /// s, rad/s, in no particular order.
    pub values: Vec<Complex<f64>>,
}

impl Poles {
    /// The fast path: a system with two parts of one shape by Börsch-Supan corrections of the
    /// eigenvalues of its parts; a symmetric one by the Schur forms of its parts; any other, and where
    /// the corrections do not converge, by the Schur form of the whole. `stiffness` gives the dynamic
    /// stiffness of the same system, and is asked only for corrections.
    ///
    /// # Errors
    ///
    /// As [`eigenvalues`].
    pub fn fast<'s>(
        system: &LinearSystem,
        stiffness: impl FnOnce() -> &'s Stiffness,
        speed: f64,
    ) -> Result<Self, EigenError> {
        if let Some(values) = from_estimates(system, stiffness, speed) {
            return Ok(Self { speed, values });
        }
        let mut values = Vec::with_capacity(2 * system.order());
        for matrix in parts::state_matrices(system, speed) {
            values.extend(eigenvalues(matrix)?);
        }
        Ok(Self { speed, values })
    }

    /// The plain path: the Schur form of the whole first-order matrix.
    ///
    /// # Errors
    ///
    /// As [`eigenvalues`].
    pub fn plain(system: &LinearSystem, speed: f64) -> Result<Self, EigenError> {
        let values = eigenvalues(system.state_matrix(speed))?;
        Ok(Self { speed, values })
    }

    /// Eigenvalues with positive imaginary part.
    pub fn oscillatory(&self) -> impl Iterator<Item = Complex<f64>> + '_ {
        self.values.iter().copied().filter(|s| s.im > 0.0)
    }

    /// True if a motion without oscillation grows: divergence ([`diverge`]).
    pub fn diverge(&self) -> bool {
        diverge(&self.values)
    }

    /// True if every motion decays.
    pub fn stable(&self) -> bool {
        self.values.iter().all(|s| s.re < 0.0)
    }
}

/// Rounding error of an eigenvalue, as a share of the largest one of its matrix: a small multiple of the
/// backward error of the Schur form (Golub, Van Loan: *Matrix Computations*, 2013, section 7.5.6).
const SCHUR_ROUNDING: f64 = 100.0 * f64::EPSILON;

/// Least Re s/|s| of a growing eigenvalue that counts as real. Rounding decides whether two nearly
/// equal real eigenvalues come out as a complex pair.
const AS_GOOD_AS_REAL: f64 = 0.999;

/// True if an eigenvalue is positive and real, or as good as real. A drift, s = 0 but for rounding, does
/// not count.
pub fn diverge(values: &[Complex<f64>]) -> bool {
    let largest = values
        .iter()
        .map(|s| s.norm_sqr())
        .fold(0.0, f64::max)
        .sqrt();
    let growing =
        |s: &Complex<f64>| s.re > SCHUR_ROUNDING * largest && s.re > AS_GOOD_AS_REAL * size(*s);
    values.iter().any(growing)
}

/// Relative distance by which the equal eigenvalues of two parts of one shape are first set apart.
const TWIN_SPLIT: f64 = 1e-6;

/// Eigenvalues of a system with two parts of one shape, corrected from those of its parts. `None` for
/// any other system, or if the corrections do not converge.
fn from_estimates<'s>(
    system: &LinearSystem,
    stiffness: impl FnOnce() -> &'s Stiffness,
    speed: f64,
) -> Option<Vec<Complex<f64>>> {
    let [one, rest] = parts::held_apart(system, speed)?.map(eigenvalues);
    let mut estimates = rest.ok()?;
    for s in one.ok()? {
        estimates.extend([s * (1.0 + TWIN_SPLIT), s * (1.0 - TWIN_SPLIT)]);
    }
    borsch_supan::refined(stiffness(), &system.mass, speed, &estimates)
}
