//! Balancing of a matrix before its eigenvalues are computed.

use nalgebra::DMatrix;

/// Limit on the sweeps over the matrix; two or three are usual.
const MAX_SWEEPS: usize = 100;
/// Ratio of a row's and a column's sum of squares after and before a change, above which the change is
/// not made.
const LEAST_GAIN: f64 = 0.95;

/// Scales row and column i of a square matrix by 1/f and f, powers of two, for every i, until their
/// norms without the diagonal are alike. Eigenvalues do not change; their error, proportional to the
/// norm of the matrix, becomes smaller.
///
/// B. N. Parlett, C. Reinsch, *Balancing a matrix for calculation of eigenvalues and eigenvectors*,
/// Numer. Math. 13 (1969), with the 2-norm. The scales leave the diagonal alone, so it is left out of
/// the norms: the sum of all squares then falls with every change, and the process ends. With the
/// diagonal in the norms it can go on for ever.
pub(super) fn balance(a: &mut DMatrix<f64>) {
    for _ in 0..MAX_SWEEPS {
        let mut changed = false;
        for i in 0..a.nrows() {
            let diagonal = a[(i, i)];
            a[(i, i)] = 0.0;
            let (column, row) = (a.column(i).norm_squared(), a.row(i).norm_squared());
            if column > 0.0 && row > 0.0 {
                // f² = row norm over column norm, to the nearest power of two.
                let f = ((row / column).log2() / 4.0).round().exp2();
                let f2 = f * f;
                if column * f2 + row / f2 < LEAST_GAIN * (column + row) {
                    a.column_mut(i).scale_mut(f);
                    a.row_mut(i).scale_mut(1.0 / f);
                    changed = true;
                }
            }
            a[(i, i)] = diagonal;
        }
        if !changed {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn norms(a: &DMatrix<f64>, i: usize) -> [f64; 2] {
        let mut a = a.clone();
        a[(i, i)] = 0.0;
        [a.column(i).norm(), a.row(i).norm()]
    }

    /// A companion matrix of widely spread roots: afterwards rows and columns are alike to a factor of
    /// two either way, and trace and determinant are untouched.
    #[test]
    fn rows_and_columns_become_alike() {
        let mut a = DMatrix::from_row_slice(
            3,
            3,
            &[0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1e9, -1.001e9, 1.001e3],
        );
        let before = a.clone();
        balance(&mut a);
        for i in 0..3 {
            let [column, row] = norms(&a, i);
            assert!((0.4..2.5).contains(&(column / row)), "{i}: {column} {row}");
        }
        assert_eq!(a.diagonal(), before.diagonal());
        assert!((a.determinant() / before.determinant() - 1.0).abs() < 1e-12);
    }

    /// Scales of 2⁶⁰ and a large diagonal: nothing but powers of two changes, and it ends.
    #[test]
    fn far_scales_are_brought_together() {
        let plain = DMatrix::from_fn(4, 4, |i, j| {
            if i == j {
                1e6
            } else {
                1.0 + (i + 2 * j) as f64
            }
        });
        let mut a = DMatrix::from_fn(4, 4, |i, j| {
            plain[(i, j)] * (20.0 * (i as f64 - j as f64)).exp2()
        });
        balance(&mut a);
        for i in 0..4 {
            let [column, row] = norms(&a, i);
            assert!((0.25..4.0).contains(&(column / row)), "{i}: {column} {row}");
            assert_eq!(a[(i, i)].to_bits(), plain[(i, i)].to_bits());
        }
    }
}
