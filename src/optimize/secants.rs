//! Surrogates from gradients: exact to first order at the centre, with curvature from the gradients at
//! other designs.
//!
//! ```math
//! m(d) = v + gᵀd + ½ dᵀH d,   min_H Σ_p |H d_p − (g_p − g)|²/σ_p² + ‖H‖²/τ²,   σ_p = ν + |d_p|²
//! ```
//!
//! Every design with a gradient gives a secant condition, weighted by its error: third derivatives
//! contribute the square of the distance, rounding ν. In directions without a design the least
//! curvature is taken, as in [`super::surrogate`]. All conditions are kept
//! at once, so that no order of updates matters. The normal equations are the same for all pieces that
//! are known at the same designs, and factorised once for these.

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::{
    problem::{Piece, Point, Values},
    surrogate::{ByIndex, Quadratic, Surrogate, displacement},
};

/// ν: rounding of gradients, in scaled units.
const GRADIENT_ROUNDING: f64 = 1e-6;
/// τ: usual size of second derivatives.
const USUAL_CURVATURE: f64 = 100.0;
/// Number of designs used per variable.
const DESIGNS_PER_VARIABLE: usize = 4;
/// Largest distance of a design that is used.
const FARTHEST_DESIGN: f64 = 0.5;

impl Surrogate {
    /// Surrogates from the gradients of the pieces of `centre` and of the same pieces at the designs
    /// `around` it, given with their distances, the nearest first. `None` if a gradient at the centre is
    /// missing.
    pub fn from_gradients(centre: &Point, around: &[(f64, Point)]) -> Option<Self> {
        let values = centre.values.as_ref().ok()?;
        let n = centre.x.len();
        let known: Vec<(DVector<f64>, &Values)> = around
            .iter()
            .take_while(|(distance, _)| *distance <= FARTHEST_DESIGN)
            .filter_map(|(_, p)| Some((displacement(centre, p), p.values.as_ref().ok()?)))
            .filter(|(_, values)| values.has_gradients())
            .take(DESIGNS_PER_VARIABLE * n)
            .collect();
        let mut secants = Secants::new(known.iter().map(|(d, _)| d.clone()).collect(), n);
        let mut of_pieces = |pieces: &[Piece], there: &[Option<&[Piece]>]| {
            let here = ByIndex::new(pieces);
            let there: Vec<Option<ByIndex>> = there.iter().map(|p| p.map(ByIndex::new)).collect();
            let of_piece = |piece: &Piece| {
                let gradient = DVector::from_column_slice(piece.gradient.as_ref()?);
                let change = |others: &Option<ByIndex>| {
                    let other = here.follow(piece, others.as_ref()?)?;
                    let other = DVector::from_column_slice(other.gradient.as_ref()?);
                    Some(other - &gradient)
                };
                let changes: Vec<Option<DVector<f64>>> = there.iter().map(change).collect();
                Some(Quadratic {
                    value: piece.value,
                    hessian: secants.hessian(&changes)?,
                    gradient,
                })
            };
            pieces.iter().map(of_piece).collect::<Option<Vec<_>>>()
        };
        let mut objectives = Vec::new();
        for (group, pieces) in values.objectives.iter().enumerate() {
            let there = known
                .iter()
                .map(|(_, v)| v.objectives.get(group).map(Vec::as_slice));
            objectives.push(of_pieces(pieces, &there.collect::<Vec<_>>())?);
        }
        let there = known.iter().map(|(_, v)| Some(v.constraints.as_slice()));
        let constraints = of_pieces(&values.constraints, &there.collect::<Vec<_>>())?;
        Some(Self {
            objectives,
            constraints,
        })
    }
}

/// Factor of normal equations; `None` where they are singular.
type Factor = Option<Cholesky<f64, Dyn>>;

/// The least-squares problems for the curvatures of pieces that are known at some designs.
struct Secants {
    n: usize,
    /// Displacements of the designs.
    displacements: Vec<DVector<f64>>,
    /// Factors by the designs at which a piece is known.
    factors: Vec<(Vec<bool>, Factor)>,
}

impl Secants {
    fn new(displacements: Vec<DVector<f64>>, n: usize) -> Self {
        Self {
            n,
            displacements,
            factors: Vec::new(),
        }
    }

    /// H with H d = change at every design whose change is known.
    fn hessian(&mut self, changes: &[Option<DVector<f64>>]) -> Option<DMatrix<f64>> {
        let mut right = DVector::zeros(self.n * (self.n + 1) / 2);
        for (d, change) in self.displacements.iter().zip(changes) {
            let Some(change) = change else {
                continue;
            };
            let weight = weight(d);
            for i in 0..self.n {
                for j in 0..self.n {
                    right[position(i, j)] += weight * d[j] * change[i];
                }
            }
        }
        let at: Vec<bool> = changes.iter().map(Option::is_some).collect();
        let known = self.factors.iter().position(|(known, _)| *known == at);
        let known = known.unwrap_or_else(|| {
            let normal = self.normal(&at);
            self.factors.push((at, normal.cholesky()));
            self.factors.len() - 1
        });
        let h = self.factors[known].1.as_ref()?.solve(&right);
        Some(DMatrix::from_fn(self.n, self.n, |i, j| h[position(i, j)]))
    }

    /// The normal equations of a piece that is known at some designs.
    fn normal(&self, at: &[bool]) -> DMatrix<f64> {
        let n = self.n;
        let count = n * (n + 1) / 2;
        let mut normal = DMatrix::identity(count, count);
        for i in 0..n {
            for j in 0..=i {
                // Off the diagonal an entry stands for two of H.
                let times = if i == j { 1.0 } else { 2.0 };
                let at = position(i, j);
                normal[(at, at)] = times / (USUAL_CURVATURE * USUAL_CURVATURE);
            }
        }
        let designs = self.displacements.iter().zip(at).filter(|(_, at)| **at);
        for (d, _) in designs {
            let weight = weight(d);
            for i in 0..n {
                for j in 0..n {
                    for k in 0..n {
                        normal[(position(i, j), position(i, k))] += weight * d[j] * d[k];
                    }
                }
            }
        }
        normal
    }
}

/// 1/σ² of a design at a displacement.
fn weight(d: &DVector<f64>) -> f64 {
    1.0 / (GRADIENT_ROUNDING + d.norm_squared()).powi(2)
}

/// Position of entry (i, j) of a symmetric matrix.
fn position(i: usize, j: usize) -> usize {
    let (low, high) = (i.min(j), i.max(j));
    high * (high + 1) / 2 + low
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: &[f64]) -> Point {
        let value = 1.0 + 2.0 * x[0] - x[1] * x[2] + 3.0 * x[1] * x[1];
        let gradient = vec![2.0, 6.0 * x[1] - x[2], -x[1]];
        Point {
            x: x.to_vec(),
            values: Ok(Values {
                objectives: vec![vec![Piece {
                    gradient: Some(gradient),
                    ..Piece::single(0, value)
                }]],
                constraints: vec![],
            }),
        }
    }

    /// One gradient elsewhere shows the curvature along the way to it, and nothing is made up about
    /// the other directions; three show all of it.
    #[test]
    fn curvature_is_what_gradients_show() {
        let centre = point(&[0.5, 0.4, 0.3]);
        let at = |d: [f64; 3]| (0.1, point(&[0.5 + d[0], 0.4 + d[1], 0.3 + d[2]]));
        let h = |around: &[(f64, Point)]| {
            Surrogate::from_gradients(&centre, around)
                .unwrap()
                .objectives[0][0]
                .hessian
                .clone()
        };
        assert!(h(&[]).amax() == 0.0);
        let one = h(&[at([0.0, 0.1, 0.0])]);
        // 1e-4: the prior gives way by (σ/τ|d|)².
        assert!((one[(1, 1)] - 6.0).abs() < 1e-4 && (one[(1, 2)] + 1.0).abs() < 1e-4);
        assert!(one[(2, 2)].abs() < 1e-9 && one[(0, 0)].abs() < 1e-9);
        let all = h(&[
            at([0.1, 0.0, 0.0]),
            at([0.0, 0.1, 0.0]),
            at([0.0, 0.0, 0.1]),
        ]);
        assert!((all[(1, 1)] - 6.0).abs() < 1e-4 && all[(2, 2)].abs() < 1e-4);
    }
}
