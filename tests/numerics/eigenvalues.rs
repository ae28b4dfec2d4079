//! Matrices on which unlimited eigenvalue iterations have run for ever.

use bogie::numerics::{EigenError, eigenvalues};
use nalgebra::{Complex, DMatrix};

fn slow(text: &str) -> DMatrix<f64> {
    let rows: Vec<Vec<f64>> = text
        .lines()
        .filter(|line| !line.starts_with('#') && !line.trim().is_empty())
        .map(|line| line.split(',').map(|x| x.trim().parse().unwrap()).collect())
        .collect();
    DMatrix::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j])
}

/// Smallest singular value of A − sI over the norm of A: zero for an exact eigenvalue.
fn distance(a: &DMatrix<f64>, s: Complex<f64>) -> f64 {
    let shifted = a.map(Complex::from) - DMatrix::identity(a.nrows(), a.ncols()) * s;
    shifted.singular_values().min() / a.norm()
}

#[test]
fn slow_matrices_are_solved() {
    for text in [
        include_str!("../data/slow-schur-1.csv"),
        include_str!("../data/slow-schur-2.csv"),
        include_str!("../data/slow-schur-3.csv"),
    ] {
        let a = slow(text);
        let values = eigenvalues(a.clone()).unwrap();
        assert_eq!(values.len(), a.nrows());
        for s in values {
            assert!(distance(&a, s) < 1e-12, "{s}");
        }
    }
}

#[test]
fn what_is_not_finite_is_refused() {
    let mut a = DMatrix::identity(4, 4);
    a[(2, 1)] = f64::NAN;
    assert_eq!(eigenvalues(a), Err(EigenError::NotFinite));
}
