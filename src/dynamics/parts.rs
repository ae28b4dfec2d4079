//! A symmetric system in parts that know nothing of one another.
//!
//! Sums and differences of coordinates that mirror each other are moved by different forces: the
//! vertical model falls apart into bounce, pitch, roll and torsion. Eigenvalues of the parts cost a
//! fraction of those of the whole, as the cube of their size. (The lateral model's trucks are alike but
//! do not mirror each other: all go the same way.)

use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::DMatrix;

use super::LinearSystem;

/// Entries of this share of their diagonals' geometric mean are rounding.
const ROUNDING: f64 = 1e-13;

/// Matrices of the first-order form of the parts of a system at speed `v`, m/s: one if it has no
/// symmetry. Together they have the eigenvalues of [`LinearSystem::state_matrix`].
pub(super) fn state_matrices(system: &LinearSystem, v: f64) -> Vec<DMatrix<f64>> {
    let alike = |[i, j]: &[usize; 2]| system.mass[*i].to_bits() == system.mass[*j].to_bits();
    if system.mirrored.is_empty() || !system.mirrored.iter().all(alike) {
        return vec![system.state_matrix(v)];
    }
    let n = system.order();
    let mut k = system.static_stiffness();
    let mut c = system.damping_at(v).columns(0, n).into_owned();
    for matrix in [&mut k, &mut c] {
        for pair in &system.mirrored {
            turn(matrix, *pair);
        }
        let diagonal = matrix.diagonal();
        for i in 0..n {
            for j in (0..n).filter(|&j| j != i) {
                let size = (diagonal[i] * diagonal[j]).abs().sqrt();
                if matrix[(i, j)].abs() < ROUNDING * size {
                    matrix[(i, j)] = 0.0;
                }
            }
        }
    }
    let mut rest: Vec<usize> = (0..n).collect();
    let mut matrices = Vec::new();
    while let Some(first) = rest.pop() {
        let mut part = vec![first];
        let mut next = 0;
        while next < part.len() {
            let i = part[next];
            let tied = |&j: &usize| {
                let mut both = [&k, &c].into_iter();
                both.any(|matrix| matrix[(i, j)] != 0.0 || matrix[(j, i)] != 0.0)
            };
            part.extend(rest.extract_if(.., |j| tied(j)));
            next += 1;
        }
        let of = |matrix: &DMatrix<f64>| {
            DMatrix::from_fn(part.len(), part.len(), |i, j| matrix[(part[i], part[j])])
        };
        let mut alone = LinearSystem::new(part.iter().map(|&i| system.mass[i]).collect(), 0);
        alone.stiffness = of(&k);
        alone.damping[0] = of(&c);
        matrices.push(alone.state_matrix(v));
    }
    matrices
}

/// Puts the sum and the difference of two coordinates in their places, both over √2.
fn turn(matrix: &mut DMatrix<f64>, [i, j]: [usize; 2]) {
    for l in 0..matrix.nrows() {
        let (a, b) = (matrix[(i, l)], matrix[(j, l)]);
        matrix[(i, l)] = FRAC_1_SQRT_2 * (a + b);
        matrix[(j, l)] = FRAC_1_SQRT_2 * (a - b);
    }
    for l in 0..matrix.nrows() {
        let (a, b) = (matrix[(l, i)], matrix[(l, j)]);
        matrix[(l, i)] = FRAC_1_SQRT_2 * (a + b);
        matrix[(l, j)] = FRAC_1_SQRT_2 * (a - b);
    }
}
