//! Decomposition of a system into parts. Eigenvalues cost the cube of the order, so parts are cheaper.
//!
//! In a symmetric system the sums and the differences of mirrored coordinates are decoupled: the
//! eigenvalues of the parts are those of the whole. A system with two parts of one shape that do not
//! mirror each other is not decoupled: the eigenvalues of one part and of the rest, each with the other
//! held, are estimates.

use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::DMatrix;

use super::LinearSystem;

/// Size of a coupling entry, as a share of the geometric mean of its two diagonal entries, below which
/// it is rounding.
const DECOUPLED: f64 = 1e-13;

/// First-order matrices of the decoupled parts of a system at speed `v`, m/s: one if it has no
/// symmetry. Together they have the eigenvalues of [`LinearSystem::state_matrix`].
pub fn state_matrices(system: &LinearSystem, v: f64) -> Vec<DMatrix<f64>> {
    let equal_mass = |[i, j]: &[usize; 2]| system.mass[*i].to_bits() == system.mass[*j].to_bits();
    if system.mirrored.is_empty() || !system.mirrored.iter().all(equal_mass) {
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
                if matrix[(i, j)].abs() < DECOUPLED * size {
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
        matrices.push(held(system, [&k, &c], &part).state_matrix(v));
    }
    matrices
}

/// First-order matrices, at speed `v`, m/s, of one of two parts of one shape, and of the coordinates
/// that belong to neither, each with all other coordinates held. `None` if there are no such parts.
pub fn held_apart(system: &LinearSystem, v: f64) -> Option<[DMatrix<f64>; 2]> {
    if system.alike.is_empty() {
        return None;
    }
    let one: Vec<usize> = system.alike.iter().map(|pair| pair[0]).collect();
    let of_neither = |i: &usize| !system.alike.iter().flatten().any(|other| other == i);
    let rest: Vec<usize> = (0..system.order()).filter(of_neither).collect();
    let c = system.damping_at(v);
    let matrix = |part: Vec<usize>| held(system, [&system.stiffness, &c], &part).state_matrix(v);
    Some([one, rest].map(matrix))
}

/// Some coordinates of a system with all others held, at speed `v`, m/s: the equations of that part, whose damping
/// is constant at its value for `v`.
pub fn part_at(system: &LinearSystem, v: f64, part: &[usize]) -> LinearSystem {
    held(system, [&system.stiffness, &system.damping_at(v)], part)
}

/// Share of the geometric mean of two entries' sizes by which they may differ and yet be the same.
const SAME_ENTRY: f64 = 1e-12;

/// Whether two groups of coordinates have the same masses, stiffness and damping among themselves.
pub(super) fn have_one_shape(system: &LinearSystem, pairs: &[[usize; 2]]) -> bool {
    let same = |a: f64, b: f64| (a - b).abs() <= SAME_ENTRY * a.abs().max(b.abs());
    let matrices = || std::iter::once(&system.stiffness).chain(&system.damping);
    pairs.iter().all(|[i, j]| {
        same(system.mass[*i], system.mass[*j])
            && pairs
                .iter()
                .all(|[k, l]| matrices().all(|matrix| same(matrix[(*i, *k)], matrix[(*j, *l)])))
    })
}

/// System of some coordinates, with stiffness `k` and damping `c`, all other coordinates held.
fn held(system: &LinearSystem, [k, c]: [&DMatrix<f64>; 2], part: &[usize]) -> LinearSystem {
    let of = |matrix: &DMatrix<f64>| {
        DMatrix::from_fn(part.len(), part.len(), |i, j| matrix[(part[i], part[j])])
    };
    let mut held = LinearSystem::new(part.iter().map(|&i| system.mass[i]).collect(), 0);
    held.stiffness = of(k);
    held.damping[0] = of(c);
    held
}

/// Replaces two coordinates by their sum and their difference, both over √2.
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
