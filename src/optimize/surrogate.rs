//! Local quadratic surrogates of the pieces of a problem, fitted to full-model evaluations.
//!
//! ```math
//! m(d) = v + gᵀd + ½ dᵀH d,   min_{g,H} Σ_p w_p² (m(d_p) − v_p)² + μ² ‖H‖²
//! ```
//!
//! All evaluated designs near the centre are used. The error of a quadratic grows with the cube of the
//! distance, and the weight falls with it: near designs decide the gradient, farther ones only the
//! curvature that the near ones leave open. The small μ picks the
//! least curvature where the data determine none, as in Powell's minimum-norm models (Conn,
//! Scheinberg, Vicente: *Introduction to Derivative-Free Optimization*, 2009, section 5.3).

use std::collections::HashMap;

use nalgebra::{DMatrix, DVector, SVD};

use super::problem::{Piece, Point, Values};

/// A quadratic around a centre.
#[derive(Debug, Clone)]
pub(super) struct Quadratic {
    pub value: f64,
    pub gradient: DVector<f64>,
    pub hessian: DMatrix<f64>,
}

impl Quadratic {
    pub fn at(&self, d: &DVector<f64>) -> f64 {
        self.value + self.gradient.dot(d) + d.dot(&(&self.hessian * d)) / 2.0
    }

    pub fn gradient_at(&self, d: &DVector<f64>) -> DVector<f64> {
        &self.gradient + &self.hessian * d
    }
}

/// Surrogates of all pieces at a centre.
#[derive(Debug, Clone)]
pub(super) struct Surrogate {
    pub objectives: Vec<Vec<Quadratic>>,
    pub constraints: Vec<Quadratic>,
}

/// Difference of the labels of two pieces of one index below which they may be the same piece.
const SAME_LABEL: f64 = 0.2;
/// Distance of a constraint piece below its limit from which it is far from it.
const FAR_FROM_LIMIT: f64 = 0.2;
/// Largest distance, in radii, of a design that is used.
const FARTHEST_DESIGN: f64 = 30.0;
/// Number of designs used per coefficient of a quadratic.
const DESIGNS_PER_COEFFICIENT: usize = 2;
/// μ over the weight of a design one radius away.
const RIDGE_SHARE: f64 = 1e-5;
/// Component of a displacement orthogonal to the known directions, as a share of the radius, above which
/// it adds a direction.
const KNOWN_DIRECTION: f64 = 0.2;

/// Axes along which the designs within twice `radius` determine no derivative. `around` has the
/// displacements from the centre.
pub(super) fn unknown_directions(around: &[DVector<f64>], n: usize, radius: f64) -> Vec<usize> {
    let mut basis: Vec<DVector<f64>> = Vec::new();
    for d in around {
        if d.amax() > 2.0 * radius {
            continue;
        }
        let rest = residual(d, &basis);
        if rest.norm() >= KNOWN_DIRECTION * radius {
            basis.push(rest.normalize());
        }
    }
    // The coordinate directions least covered complete the basis.
    let mut missing = Vec::new();
    while basis.len() < n {
        let axis = |i: usize| DVector::from_fn(n, |j, _| f64::from(u8::from(i == j)));
        let Some(best) = (0..n)
            .filter(|i| !missing.contains(i))
            .map(|i| (residual(&axis(i), &basis), i))
            .max_by(|(a, i), (b, j)| a.norm().total_cmp(&b.norm()).then(j.cmp(i)))
        else {
            break;
        };
        basis.push(best.0.normalize());
        missing.push(best.1);
    }
    missing
}

/// Component of `d` orthogonal to an orthonormal basis.
fn residual(d: &DVector<f64>, basis: &[DVector<f64>]) -> DVector<f64> {
    let mut rest = d.clone();
    for b in basis {
        rest -= b * b.dot(&rest);
    }
    rest
}

/// Steps along axis `i` from `x` that stay in the unit box: both ways, or twice the same way.
fn axis_steps(x: f64, step: f64) -> [f64; 2] {
    if x - step < 0.0 {
        [step, step / 2.0]
    } else if x + step > 1.0 {
        [-step, -step / 2.0]
    } else {
        [step, -step]
    }
}

/// Designs a `step` away from `centre` along the given axes, one each.
pub(super) fn along(centre: &[f64], step: f64, axes: &[usize]) -> Vec<Vec<f64>> {
    let one = |&i: &usize| {
        let mut x = centre.to_vec();
        x[i] += axis_steps(x[i], step)[0];
        x
    };
    axes.iter().map(one).collect()
}

/// Designs both ways along every axis, and if `cross` one diagonal of every plane: with the
/// diagonals they determine a quadratic, without them its gradient to second order.
pub(super) fn pattern(centre: &[f64], step: f64, cross: bool) -> Vec<Vec<f64>> {
    let n = centre.len();
    let steps: Vec<[f64; 2]> = centre.iter().map(|&x| axis_steps(x, step)).collect();
    let mut points = Vec::new();
    for i in 0..n {
        for shift in steps[i] {
            let mut x = centre.to_vec();
            x[i] += shift;
            points.push(x);
        }
        if cross {
            for j in i + 1..n {
                let mut x = centre.to_vec();
                x[i] += steps[i][0];
                x[j] += steps[j][0];
                points.push(x);
            }
        }
    }
    points
}

impl Surrogate {
    /// Least-squares fit of every piece of `centre` to its values at the designs `around` it, given with
    /// their distances, the nearest first. Failed designs and vanished pieces are left out. `None` if too
    /// few remain for a gradient.
    pub fn fit(centre: &Point, around: &[(f64, Point)], radius: f64) -> Option<Self> {
        let values = centre.values.as_ref().ok()?;
        let n = centre.x.len();
        let terms = n + n * (n + 1) / 2;
        let known: Vec<(DVector<f64>, &Values)> = around
            .iter()
            .take_while(|(distance, _)| *distance <= FARTHEST_DESIGN * radius)
            .filter_map(|(_, p)| Some((displacement(centre, p), p.values.as_ref().ok()?)))
            .take(DESIGNS_PER_COEFFICIENT * terms)
            .collect();
        if known.len() < n {
            return None;
        }
        let all = Fit::new(known.iter().map(|(d, _)| d), n, radius)?;
        let fit_piece = |piece: &Piece, here: &ByIndex, there: &[ByIndex]| {
            let found = there.iter().map(|other| here.follow(piece, other));
            let found: Vec<Option<f64>> = found.map(|p| p.map(|p| p.value)).collect();
            let value = piece.value;
            if found.iter().all(Option::is_some) {
                return Some(all.solve(value, &found));
            }
            // A piece that is missing somewhere has a fit of its own.
            let present: Vec<&DVector<f64>> = known
                .iter()
                .zip(&found)
                .filter_map(|((d, _), f)| f.map(|_| d))
                .collect();
            let found: Vec<Option<f64>> = found.into_iter().flatten().map(Some).collect();
            if present.len() < n {
                return None;
            }
            Some(Fit::new(present.into_iter(), n, radius)?.solve(value, &found))
        };
        let constant = |value: f64| Quadratic {
            value,
            gradient: DVector::zeros(n),
            hessian: DMatrix::zeros(n, n),
        };
        let mut objectives = Vec::new();
        for (group, pieces) in values.objectives.iter().enumerate() {
            let there = known.iter().map(|(_, v)| v.objectives.get(group));
            let there: Vec<ByIndex> = there
                .map(|pieces| ByIndex::new(pieces.map_or(&[], Vec::as_slice)))
                .collect();
            let here = ByIndex::new(pieces);
            let fits = pieces.iter().map(|piece| fit_piece(piece, &here, &there));
            objectives.push(fits.collect::<Option<Vec<_>>>()?);
        }
        let there = known.iter().map(|(_, v)| ByIndex::new(&v.constraints));
        let (here, there) = (ByIndex::new(&values.constraints), there.collect::<Vec<_>>());
        let constraints = values.constraints.iter().map(|piece| {
            // A vanishing piece far from its limit stays inactive.
            fit_piece(piece, &here, &there)
                .or_else(|| (piece.value < -FAR_FROM_LIMIT).then(|| constant(piece.value)))
        });
        let constraints = constraints.collect::<Option<Vec<_>>>()?;
        Some(Self {
            objectives,
            constraints,
        })
    }

    /// Σ max m_fk.
    pub fn objective(&self, d: &DVector<f64>) -> f64 {
        self.objectives.iter().map(|pieces| worst(pieces, d)).sum()
    }

    /// max(0, max m_c).
    pub fn violation(&self, d: &DVector<f64>) -> f64 {
        worst(&self.constraints, d).max(0.0)
    }
}

fn worst(pieces: &[Quadratic], d: &DVector<f64>) -> f64 {
    pieces
        .iter()
        .map(|q| q.at(d))
        .fold(f64::NEG_INFINITY, f64::max)
}

/// Displacement of a design from the centre.
pub(super) fn displacement(centre: &Point, point: &Point) -> DVector<f64> {
    DVector::from_fn(centre.x.len(), |i, _| point.x[i] - centre.x[i])
}

/// Value at another design of piece `k` of the centre, see [`ByIndex::follow`].
pub(crate) fn follow(centre: &[Piece], k: usize, other: &[Piece]) -> Option<f64> {
    let found = ByIndex::new(centre).follow(&centre[k], &ByIndex::new(other));
    found.map(|piece| piece.value)
}

/// Pieces by their index, for a quick search.
pub(super) struct ByIndex<'p>(HashMap<usize, Vec<&'p Piece>>);

impl<'p> ByIndex<'p> {
    /// Index of the pieces of one objective, or of the constraints.
    pub fn new(pieces: &'p [Piece]) -> Self {
        let mut by_index: HashMap<usize, Vec<&'p Piece>> = HashMap::new();
        for piece in pieces {
            by_index.entry(piece.index).or_default().push(piece);
        }
        Self(by_index)
    }

    /// Match of a `piece` of this design among the pieces of an `other`: the piece of the same index with a
    /// near label and the same rank. Pieces are ranked by label if the labels are further apart than they
    /// move (values that cross), otherwise by value (values that nearly coincide).
    pub fn follow<'q>(&self, piece: &Piece, other: &ByIndex<'q>) -> Option<&'q Piece> {
        let near = |p: &&Piece| (p.label - piece.label).abs() < SAME_LABEL;
        let mut own: Vec<&Piece> = self.0.get(&piece.index).cloned().unwrap_or_default();
        own.retain(near);
        let mut others: Vec<&'q Piece> = other.0.get(&piece.index).cloned().unwrap_or_default();
        others.retain(near);
        own.sort_by(|a, b| a.label.total_cmp(&b.label));
        others.sort_by(|a, b| a.label.total_cmp(&b.label));
        let apart = own.windows(2).map(|w| w[1].label - w[0].label);
        let apart = apart.fold(f64::INFINITY, f64::min);
        let pairs = own.iter().zip(&others);
        let moved = pairs.map(|(a, b)| (b.label - a.label).abs());
        if own.len() != others.len() || moved.fold(0.0, f64::max) >= 0.5 * apart {
            own.sort_by(|a, b| b.value.total_cmp(&a.value));
            others.sort_by(|a, b| b.value.total_cmp(&a.value));
        }
        let rank = own.iter().position(|p| std::ptr::eq(*p, piece))?;
        others.get(rank).copied()
    }
}

/// The weighted least-squares problem for one set of designs, factorised once for all pieces.
struct Fit {
    svd: SVD<f64, nalgebra::Dyn, nalgebra::Dyn>,
    weights: Vec<f64>,
    radius: f64,
    n: usize,
}

impl Fit {
    fn new<'d>(
        designs: impl Iterator<Item = &'d DVector<f64>>,
        n: usize,
        radius: f64,
    ) -> Option<Self> {
        let designs: Vec<DVector<f64>> = designs.map(|d| d / radius).collect();
        let weights: Vec<f64> = designs
            .iter()
            .map(|d| 1.0 / (0.1 + d.norm().powi(3)))
            .collect();
        let curvatures = n * (n + 1) / 2;
        let rows = designs.len() + curvatures;
        let mut a = DMatrix::zeros(rows, n + curvatures);
        for (p, (d, w)) in designs.iter().zip(&weights).enumerate() {
            let mut column = n;
            for i in 0..n {
                a[(p, i)] = w * d[i];
                for j in i..n {
                    a[(p, column)] = w * d[i] * d[j] * if i == j { 0.5 } else { 1.0 };
                    column += 1;
                }
            }
        }
        for k in 0..curvatures {
            a[(designs.len() + k, n + k)] = RIDGE_SHARE;
        }
        let svd = SVD::try_new(a, true, true, f64::EPSILON, 1000)?;
        Some(Self {
            svd,
            weights,
            radius,
            n,
        })
    }

    fn solve(&self, value: f64, found: &[Option<f64>]) -> Quadratic {
        let n = self.n;
        let curvatures = n * (n + 1) / 2;
        let differences = found.iter().map(|v| v.unwrap_or(value) - value);
        let b = DVector::from_iterator(
            found.len() + curvatures,
            differences
                .zip(&self.weights)
                .map(|(v, w)| v * w)
                .chain(std::iter::repeat_n(0.0, curvatures)),
        );
        let coefficients = self
            .svd
            .solve(&b, 1e-12)
            .unwrap_or_else(|_| DVector::zeros(n + curvatures));
        let mut hessian = DMatrix::zeros(n, n);
        let mut column = n;
        for i in 0..n {
            for j in i..n {
                let c = coefficients[column] / (self.radius * self.radius);
                hessian[(i, j)] = c;
                hessian[(j, i)] = c;
                column += 1;
            }
        }
        Quadratic {
            value,
            gradient: coefficients.rows(0, n) / self.radius,
            hessian,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(x: &[f64], value: f64) -> Point {
        Point {
            x: x.to_vec(),
            values: Ok(Values {
                objectives: vec![vec![Piece::single(0, value)]],
                constraints: vec![],
            }),
        }
    }

    #[test]
    fn a_quadratic_is_reproduced_inside_and_at_the_edge() {
        let f = |x: &[f64]| 1.0 + 2.0 * x[0] - x[1] * x[2] + 3.0 * x[1] * x[1] + x[0] * x[2];
        for centre in [[0.5, 0.4, 0.3], [0.0, 1.0, 0.5]] {
            let around: Vec<(f64, Point)> = pattern(&centre, 0.1, true)
                .iter()
                .map(|x| (0.1, point(x, f(x))))
                .collect();
            let surrogate = Surrogate::fit(&point(&centre, f(&centre)), &around, 0.1).unwrap();
            let d = DVector::from_vec(vec![0.05, -0.07, 0.02]);
            let x: Vec<f64> = centre.iter().zip(&d).map(|(c, d)| c + d).collect();
            // 1e-9: the ridge gives way by its square.
            assert!((surrogate.objectives[0][0].at(&d) - f(&x)).abs() < 1e-9);
        }
    }

    #[test]
    fn without_diagonals_the_gradient_is_exact_and_unknown_curvature_is_none() {
        let f = |x: &[f64]| x[0] + 2.0 * x[1] + 5.0 * x[0] * x[0] + 3.0 * x[0] * x[1];
        let centre = [0.5, 0.5];
        let around: Vec<(f64, Point)> = pattern(&centre, 0.1, false)
            .iter()
            .map(|x| (0.1, point(x, f(x))))
            .collect();
        let fitted = Surrogate::fit(&point(&centre, f(&centre)), &around, 0.1).unwrap();
        let q = &fitted.objectives[0][0];
        assert!((q.gradient[0] - 7.5).abs() < 1e-8 && (q.gradient[1] - 3.5).abs() < 1e-8);
        assert!((q.hessian[(0, 0)] - 10.0).abs() < 1e-6 && q.hessian[(0, 1)].abs() < 1e-9);
    }

    #[test]
    fn directions_that_no_design_shows_are_found() {
        let d = |v: [f64; 3]| DVector::from_row_slice(&v);
        let around = [d([0.1, 0.1, 0.0]), d([0.1, 0.0, 0.0]), d([0.5, 0.5, 9.0])];
        assert_eq!(unknown_directions(&around, 3, 0.1), [2]);
        assert_eq!(unknown_directions(&[], 2, 0.1), [0, 1]);
    }
}
