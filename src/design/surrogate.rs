//! Local quadratic surrogates of the pieces of a problem, fitted to full-model evaluations.

use nalgebra::{DMatrix, DVector};

use super::problem::{Piece, Point};

/// m(d) = value + gᵀd + ½ dᵀH d around a centre.
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
    pub objective: Vec<Quadratic>,
    pub constraints: Vec<Quadratic>,
}

/// Pieces of one index are the same where their labels differ by less than this: hunting
/// frequencies within 20 %.
const SAME: f64 = 0.2;

/// Displacements around `centre` that determine a quadratic: both ways along every axis and one
/// diagonal of every plane, kept inside the unit box.
pub(super) fn pattern(centre: &[f64], step: f64) -> Vec<Vec<f64>> {
    let n = centre.len();
    // Along each axis the two places to look, relative to the step.
    let axis: Vec<[f64; 2]> = centre
        .iter()
        .map(|&x| {
            if x - step < 0.0 {
                [1.0, 0.5]
            } else if x + step > 1.0 {
                [-1.0, -0.5]
            } else {
                [1.0, -1.0]
            }
        })
        .collect();
    let mut points = Vec::new();
    for i in 0..n {
        for shift in axis[i] {
            let mut x = centre.to_vec();
            x[i] += shift * step;
            points.push(x);
        }
        for j in i + 1..n {
            let mut x = centre.to_vec();
            x[i] += axis[i][0] * step;
            x[j] += axis[j][0] * step;
            points.push(x);
        }
    }
    points
}

impl Surrogate {
    /// Fits every piece of `centre` to what it has become at `samples`. Designs that failed and
    /// pieces that vanished are left out; `None` where too few remain even for a gradient.
    pub fn fit(centre: &Point, samples: &[Point]) -> Option<Self> {
        let values = centre.values.as_ref().ok()?;
        let n = centre.x.len();
        let known: Vec<_> = samples
            .iter()
            .filter_map(|p| {
                let d = DVector::from_fn(n, |i, _| p.x[i] - centre.x[i]);
                p.values.as_ref().ok().map(|v| (d, v))
            })
            .collect();
        let fit_all = |pieces: &[Piece], of: fn(&super::problem::Values) -> &[Piece]| {
            pieces
                .iter()
                .enumerate()
                .map(|(k, piece)| {
                    let data: Vec<(&DVector<f64>, f64)> = known
                        .iter()
                        .filter_map(|(d, v)| Some((d, follow(pieces, k, of(v))?)))
                        .collect();
                    fit(piece.value, &data, n)
                })
                .collect::<Option<Vec<_>>>()
        };
        Some(Self {
            objective: fit_all(&values.objective, |v| &v.objective)?,
            constraints: fit_all(&values.constraints, |v| &v.constraints)?,
        })
    }
}

/// Value at another design of piece `k` of the centre. Among candidates of the same index the one
/// with the same rank in order of value is taken (two nearly equal modes), if its label is near.
fn follow(centre: &[Piece], k: usize, other: &[Piece]) -> Option<f64> {
    let piece = &centre[k];
    let near = |p: &&Piece| p.index == piece.index && (p.label - piece.label).abs() < SAME;
    let rank = |p: &Piece| {
        centre
            .iter()
            .filter(near)
            .filter(|q| q.value.total_cmp(&p.value).is_gt())
            .count()
    };
    let mut candidates: Vec<f64> = other.iter().filter(near).map(|p| p.value).collect();
    candidates.sort_by(|a, b| b.total_cmp(a));
    candidates.get(rank(piece)).copied()
}

/// Least squares through the centre: quadratic where the data determine it, linear otherwise.
fn fit(value: f64, data: &[(&DVector<f64>, f64)], n: usize) -> Option<Quadratic> {
    let terms = n + n * (n + 1) / 2;
    let quadratic = data.len() >= terms;
    let columns = if quadratic { terms } else { n };
    if data.len() < columns {
        return None;
    }
    let step = data.iter().map(|(d, _)| d.amax()).fold(0.0, f64::max);
    let row = |d: &DVector<f64>| {
        let mut row: Vec<f64> = d.iter().map(|x| x / step).collect();
        if quadratic {
            for i in 0..n {
                for j in i..n {
                    row.push(d[i] * d[j] / (step * step));
                }
            }
        }
        row
    };
    let a = DMatrix::from_row_iterator(data.len(), columns, data.iter().flat_map(|(d, _)| row(d)));
    let b = DVector::from_iterator(data.len(), data.iter().map(|(_, v)| v - value));
    let coefficients = a.svd(true, true).solve(&b, 1e-10).ok()?;
    let gradient = coefficients.rows(0, n) / step;
    let mut hessian = DMatrix::zeros(n, n);
    if quadratic {
        let mut k = n;
        for i in 0..n {
            for j in i..n {
                let c = coefficients[k] / (step * step);
                hessian[(i, j)] += c;
                hessian[(j, i)] += c;
                k += 1;
            }
        }
    }
    Some(Quadratic {
        value,
        gradient,
        hessian,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::problem::Values;

    #[test]
    fn a_quadratic_is_reproduced_inside_and_at_the_edge() {
        let f = |x: &[f64]| 1.0 + 2.0 * x[0] - x[1] * x[2] + 3.0 * x[1] * x[1] + x[0] * x[2];
        for centre in [[0.5, 0.4, 0.3], [0.0, 1.0, 0.5]] {
            let point = |x: &[f64]| Point {
                x: x.to_vec(),
                values: Ok(Values {
                    objective: vec![Piece::single(0, f(x))],
                    constraints: vec![],
                }),
            };
            let samples: Vec<_> = pattern(&centre, 0.1).iter().map(|x| point(x)).collect();
            let surrogate = Surrogate::fit(&point(&centre), &samples).unwrap();
            let d = DVector::from_vec(vec![0.05, -0.07, 0.02]);
            let x: Vec<f64> = centre.iter().zip(&d).map(|(c, d)| c + d).collect();
            assert!((surrogate.objective[0].at(&d) - f(&x)).abs() < 1e-12);
        }
    }
}
