//! The speed at which an oscillatory mode loses its damping: det D(iω; V) = 0.

use nalgebra::{Complex, DMatrix, DVector};

use crate::{evaluate::modes::Mode, numerics::LinearSystem};

/// A purely imaginary eigenvalue iω at speed V.
#[derive(Debug, Clone)]
pub struct Hopf {
    /// V, m/s.
    pub speed: f64,
    /// Mode with eigenvalue iω.
    pub mode: Mode,
}

/// Limit on the Newton steps; from a start within a few per cent four are enough.
const MAX_NEWTON_STEPS: usize = 25;
/// Relative change of V and ω at convergence.
const NEWTON_TOLERANCE: f64 = 1e-12;

/// Solves det D(iω; V) = 0 for (V, ω) from a start.
///
/// With v and w refined by inverse iteration, wᴴ[D + ∂D/∂V δV + ∂D/∂ω δω]v = 0 is two real
/// equations for the two steps. `None` if the iteration does not converge.
pub fn hopf(system: &LinearSystem, mut v: f64, mut omega: f64) -> Option<Hopf> {
    let i = Complex::I;
    let start = Mode::at(system, &system.damping_at(v), i * omega)?;
    let (mut shape, mut left) = (start.shape, start.left);
    for _ in 0..MAX_NEWTON_STEPS {
        let damping = system.damping_at(v);
        let d = system.dynamic_stiffness(&damping, i * omega);
        let adjoint = d.adjoint().lu();
        let next = d.lu().solve(&shape)?;
        let scale = next.norm();
        let residual_vector = &shape / Complex::from(scale);
        shape = next / Complex::from(scale);
        left = adjoint.solve(&left)?;
        left /= Complex::from(left.norm());
        let residual = left.dotc(&residual_vector);
        let by_speed = left.dotc(&times(&system.damping_derivative_at(v), &shape)) * i * omega;
        let by_omega =
            left.dotc(&system.stiffness_derivative_times(&damping, i * omega, &shape)) * i;
        let determinant = by_speed.re * by_omega.im - by_speed.im * by_omega.re;
        let step_v = (by_omega.re * residual.im - by_omega.im * residual.re) / determinant;
        let step_omega = (by_speed.im * residual.re - by_speed.re * residual.im) / determinant;
        if !(step_v.is_finite() && step_omega.is_finite()) {
            return None;
        }
        // A step to half or double at most: speeds and frequencies stay positive.
        v = (v + step_v).clamp(v / 2.0, v * 2.0);
        omega = (omega + step_omega).clamp(omega / 2.0, omega * 2.0);
        if step_v.abs() < NEWTON_TOLERANCE * v && step_omega.abs() < NEWTON_TOLERANCE * omega {
            let mode = Mode {
                eigenvalue: i * omega,
                shape,
                left,
            };
            return Some(Hopf { speed: v, mode });
        }
    }
    None
}

/// Real matrix (its first n columns) times complex vector.
fn times(matrix: &DMatrix<f64>, x: &DVector<Complex<f64>>) -> DVector<Complex<f64>> {
    DVector::from_fn(x.len(), |i, _| {
        (0..x.len())
            .map(|j| x[j] * matrix[(i, j)])
            .sum::<Complex<f64>>()
    })
}
