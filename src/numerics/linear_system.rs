//! Second-order linear systems whose damping depends on a speed: plain matrices.

use nalgebra::{Complex, DMatrix, DVector};

use super::parts;

/// Equations of motion of n coordinates q under m inputs u, at any speed V.
///
/// ```math
/// M q̈ + (C0 + C1/V + C2 V) q̇ + K q = −(C0u + C1u/V + C2u V) u̇ − K_u u
/// ```
///
/// C and K are stored over [q, u], n × (n + m). M is diagonal; a zero marks a coordinate
/// without mass.
#[derive(Debug, Clone)]
pub struct LinearSystem {
    /// Diagonal of M, kg or kg m².
    pub mass: Vec<f64>,
    /// Number of inputs m.
    pub inputs: usize,
    /// K over [q, u].
    pub stiffness: DMatrix<f64>,
    /// C0, C1, C2 over [q, u]: constant, inverse and proportional to V.
    pub damping: [DMatrix<f64>; 3],
    /// Pairs of coordinates that a reflection exchanges, one plane of symmetry after another.
    pub mirrored: Vec<[usize; 2]>,
    /// Pairs of coordinates that correspond to each other in two parts of one shape.
    pub alike: Vec<[usize; 2]>,
}

impl LinearSystem {
    /// A system with diagonal `mass`, K = 0 and C = 0.
    pub fn new(mass: Vec<f64>, inputs: usize) -> Self {
        let zero = DMatrix::zeros(mass.len(), mass.len() + inputs);
        Self {
            mass,
            inputs,
            stiffness: zero.clone(),
            damping: [zero.clone(), zero.clone(), zero],
            mirrored: Vec::new(),
            alike: Vec::new(),
        }
    }

    /// Records pairs of coordinates of two parts as [`LinearSystem::alike`] if both parts have one shape.
    pub fn find_alike(&mut self, pairs: Vec<[usize; 2]>) {
        if parts::have_one_shape(self, &pairs) {
            self.alike = pairs;
        }
    }

    /// Number of coordinates n.
    pub fn order(&self) -> usize {
        self.mass.len()
    }

    /// C at speed V (m/s) over [q, u].
    pub fn damping_at(&self, v: f64) -> DMatrix<f64> {
        let [c0, c1, c2] = &self.damping;
        c0 + c1 / v + c2 * v
    }

    /// dC/dV at speed V over [q, u].
    pub fn damping_derivative_at(&self, v: f64) -> DMatrix<f64> {
        let [_, c1, c2] = &self.damping;
        c1 * (-1.0 / (v * v)) + c2
    }

    /// Matrix of the first-order form ẋ = A x with u = 0 at speed V.
    ///
    /// x = [q_m, q̇_m, q_0]: coordinates with mass, their rates, and coordinates without, whose own
    /// rates follow from C_00 q̇_0 = −C_0m q̇_m − K_0m q_m − K_00 q_0.
    pub fn state_matrix(&self, v: f64) -> DMatrix<f64> {
        let c = self.damping_at(v);
        let k = &self.stiffness;
        let (massive, massless): (Vec<usize>, Vec<usize>) =
            (0..self.order()).partition(|&i| self.mass[i] > 0.0);
        let (nm, n0) = (massive.len(), massless.len());
        // State index of a coordinate and of its rate.
        let mut position = vec![0; self.order()];
        for (s, &i) in massive.iter().enumerate() {
            position[i] = s;
        }
        for (s, &i) in massless.iter().enumerate() {
            position[i] = 2 * nm + s;
        }
        let mut a = DMatrix::zeros(2 * nm + n0, 2 * nm + n0);
        if n0 > 0 {
            let c00 = c.select_rows(&massless).select_columns(&massless);
            let mut rates = DMatrix::zeros(n0, 2 * nm + n0);
            for (r, &i) in massless.iter().enumerate() {
                for j in 0..self.order() {
                    rates[(r, position[j])] -= k[(i, j)];
                }
                for (s, &j) in massive.iter().enumerate() {
                    rates[(r, nm + s)] -= c[(i, j)];
                }
            }
            // C_00 is singular if a massless coordinate has no damper.
            if let Some(solution) = c00.lu().solve(&rates) {
                a.rows_mut(2 * nm, n0).copy_from(&solution);
            } else {
                a.rows_mut(2 * nm, n0).fill(f64::NAN);
            }
        }
        for (s, &i) in massive.iter().enumerate() {
            a[(s, nm + s)] = 1.0;
            for j in 0..self.order() {
                a[(nm + s, position[j])] -= k[(i, j)] / self.mass[i];
            }
            for (t, &j) in massive.iter().enumerate() {
                a[(nm + s, nm + t)] -= c[(i, j)] / self.mass[i];
            }
            for (t, &j) in massless.iter().enumerate() {
                let rate = a.row(2 * nm + t) * (c[(i, j)] / self.mass[i]);
                let mut row = a.row_mut(nm + s);
                row -= rate;
            }
        }
        a
    }

    /// Stiffness of the coordinates alone, n × n.
    pub fn static_stiffness(&self) -> DMatrix<f64> {
        self.stiffness.columns(0, self.order()).into_owned()
    }

    /// Dynamic stiffness D(s) = s² M + s C(V) + K of the coordinates, n × n.
    pub fn dynamic_stiffness(
        &self,
        damping: &DMatrix<f64>,
        s: Complex<f64>,
    ) -> DMatrix<Complex<f64>> {
        let n = self.order();
        let mut d = DMatrix::from_fn(n, n, |i, j| s * damping[(i, j)] + self.stiffness[(i, j)]);
        for i in 0..n {
            d[(i, i)] += s * s * self.mass[i];
        }
        d
    }

    /// dD/ds = 2 s M + C(V) applied to a vector.
    pub fn stiffness_derivative_times(
        &self,
        damping: &DMatrix<f64>,
        s: Complex<f64>,
        x: &DVector<Complex<f64>>,
    ) -> DVector<Complex<f64>> {
        let n = self.order();
        DVector::from_fn(n, |i, _| {
            (0..n).map(|j| x[j] * damping[(i, j)]).sum::<Complex<f64>>()
                + s * x[i] * (2.0 * self.mass[i])
        })
    }
}
