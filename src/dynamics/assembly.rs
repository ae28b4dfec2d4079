//! Elements in the matrices of a linear system: springs, dampers, creep and gyroscopic terms.

use nalgebra::DMatrix;

use super::Row;
use crate::numerics::LinearSystem;

/// Dependence of a damping constant on the speed V.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Speed {
    /// Independent of V: a damper.
    Constant = 0,
    /// ∝ 1/V: creep.
    Inverse = 1,
    /// ∝ V: gyroscopic.
    Proportional = 2,
}

impl LinearSystem {
    /// Adds a spring and damper: k·row⊗stretch to K, c·row⊗stretch to C0. `row` is where the
    /// restoring force acts, `stretch` what the element feels.
    pub fn add_element(&mut self, row: &Row, stretch: &Row, k: f64, c: f64) {
        self.add_stiffness(row, stretch, k);
        self.add_damping(Speed::Constant, row, stretch, c);
    }

    /// Adds k·row⊗stretch to K.
    pub fn add_stiffness(&mut self, row: &Row, stretch: &Row, k: f64) {
        add(&mut self.stiffness, row, stretch, k);
    }

    /// Adds c·row⊗stretch to C0, C1 or C2.
    pub fn add_damping(&mut self, speed: Speed, row: &Row, stretch: &Row, c: f64) {
        add(&mut self.damping[speed as usize], row, stretch, c);
    }
}

/// Adds constant·row⊗stretch. Terms of `row` in inputs act on the rails, which have no equation.
fn add(matrix: &mut DMatrix<f64>, row: &Row, stretch: &Row, constant: f64) {
    let n = matrix.nrows();
    for &(i, r) in row.terms().iter().filter(|(i, _)| *i < n) {
        for &(j, s) in stretch.terms() {
            matrix[(i, j)] += constant * r * s;
        }
    }
}
