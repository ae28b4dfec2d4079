//! A system in parts: their eigenvalues cost a fraction of those of the whole, as the cube of their size.
//!
//! Sums and differences of coordinates that mirror each other are moved by different forces: the
//! vertical model falls apart into bounce, pitch, roll and torsion. The lateral model's trucks are alike
//! but do not mirror each other, as all go the same way: there the parts are one truck and the carbody,
//! each with the other held, and their eigenvalues are estimates.

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
        matrices.push(alone(system, [&k, &c], &part).state_matrix(v));
    }
    matrices
}

/// Matrices of the first-order form, at speed `v`, m/s, of one of the two parts of a system that are
/// alike, and of the coordinates that belong to neither, each with all others held. `None` if none are
/// alike.
pub(super) fn held_apart(system: &LinearSystem, v: f64) -> Option<[DMatrix<f64>; 2]> {
    if system.alike.is_empty() {
        return None;
    }
    let one: Vec<usize> = system.alike.iter().map(|pair| pair[0]).collect();
    let of_neither = |i: &usize| !system.alike.iter().flatten().any(|other| other == i);
    let rest: Vec<usize> = (0..system.order()).filter(of_neither).collect();
    let c = system.damping_at(v);
    let matrix = |part: Vec<usize>| alone(system, [&system.stiffness, &c], &part).state_matrix(v);
    Some([one, rest].map(matrix))
}

/// Some coordinates of a system with all others held, at speed `v`, m/s: the equations of that part, whose damping
/// is that at `v` whatever the speed.
pub(super) fn held(system: &LinearSystem, v: f64, part: &[usize]) -> LinearSystem {
    alone(system, [&system.stiffness, &system.damping_at(v)], part)
}

/// Share of the geometric mean of two entries' sizes by which they may differ and yet be the same.
const SAME: f64 = 1e-12;

/// Whether two groups of coordinates have the same masses, stiffness and damping among themselves.
pub(super) fn are_alike(system: &LinearSystem, pairs: &[[usize; 2]]) -> bool {
    let same = |a: f64, b: f64| (a - b).abs() <= SAME * a.abs().max(b.abs());
    let matrices = || std::iter::once(&system.stiffness).chain(&system.damping);
    pairs.iter().all(|[i, j]| {
        same(system.mass[*i], system.mass[*j])
            && pairs
                .iter()
                .all(|[k, l]| matrices().all(|matrix| same(matrix[(*i, *k)], matrix[(*j, *l)])))
    })
}

/// Some coordinates of a system with stiffness `k` and damping `c`, all others held.
fn alone(system: &LinearSystem, [k, c]: [&DMatrix<f64>; 2], part: &[usize]) -> LinearSystem {
    let of = |matrix: &DMatrix<f64>| {
        DMatrix::from_fn(part.len(), part.len(), |i, j| matrix[(part[i], part[j])])
    };
    let mut alone = LinearSystem::new(part.iter().map(|&i| system.mass[i]).collect(), 0);
    alone.stiffness = of(k);
    alone.damping[0] = of(c);
    alone
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
