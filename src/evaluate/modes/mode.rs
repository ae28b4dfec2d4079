//! A mode of vibration: eigenvalue, shape, and shares of kinetic energy.

use nalgebra::{Complex, DMatrix, DVector};

use crate::numerics::{Eigenpairs, LinearSystem};

/// A solution v of D(s) v = 0 with the left vector w of wᴴ D(s) = 0.
#[derive(Debug, Clone)]
pub struct Mode {
    /// s, rad/s.
    pub eigenvalue: Complex<f64>,
    /// v over the coordinates, its largest component 1.
    pub shape: DVector<Complex<f64>>,
    /// w.
    pub left: DVector<Complex<f64>>,
}

/// Number of steps of inverse iteration: one is enough for an eigenvalue accurate to 1e-12, the second
/// removes the rest of other modes.
const INVERSE_ITERATIONS: usize = 2;

impl Mode {
    /// Vectors by inverse iteration at a known eigenvalue. `None` if the matrix is not finite.
    pub fn at(system: &LinearSystem, damping: &DMatrix<f64>, s: Complex<f64>) -> Option<Self> {
        let n = system.order();
        // A shift off the eigenvalue by rounding keeps the factors regular.
        let shift = s * Complex::new(1.0 + 1e-13, 1e-13);
        let d = system.dynamic_stiffness(damping, shift);
        let adjoint = d.adjoint().lu();
        let lu = d.lu();
        // A start vector in no coordinate plane.
        let start = DVector::from_fn(n, |i, _| Complex::new(1.0, 0.3 + 0.1 * i as f64));
        let (mut shape, mut left) = (start.clone(), start);
        for _ in 0..INVERSE_ITERATIONS {
            shape = normalised(&lu.solve(&shape)?)?;
            left = normalised(&adjoint.solve(&left)?)?;
        }
        Some(Self {
            eigenvalue: s,
            shape,
            left,
        })
    }

    /// The eigenpair in a lane. `None` if its vectors are not finite.
    pub fn of_pair(pairs: &Eigenpairs, l: usize) -> Option<Self> {
        let [shape, left] = pairs.vectors(l);
        Some(Self {
            eigenvalue: pairs.s.lane(l),
            shape: normalised(&shape)?,
            left: normalised(&left.conjugate())?,
        })
    }

    /// Share of the kinetic energy Σ mᵢ|s vᵢ|² that coordinates chosen by `of` carry.
    pub fn energy_share(&self, system: &LinearSystem, of: impl Fn(usize) -> bool) -> f64 {
        let energy = |i: usize| system.mass[i] * self.shape[i].norm_sqr();
        let total: f64 = (0..system.order()).map(energy).sum();
        (0..system.order())
            .filter(|&i| of(i))
            .map(energy)
            .sum::<f64>()
            / total
    }
}

fn normalised(v: &DVector<Complex<f64>>) -> Option<DVector<Complex<f64>>> {
    let largest = v
        .iter()
        .copied()
        .max_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()))?;
    (largest.is_finite() && largest.norm_sqr() > 0.0).then(|| v.map(|x| x / largest))
}
