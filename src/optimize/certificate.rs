//! The certificate of a design: multipliers, residual of the first-order conditions, curvature.
//!
//! ```math
//! Σ_ki μ_ki ∇f_ki + Σ_j λ_j ∇c_j − ν^l + ν^u = 0,   Σ_i μ_ki = 1,   μ, λ, ν ≥ 0,
//! λ_j c_j = 0,   μ_ki (max_i f_ki − f_ki) = 0,   ν^l_i x_i = 0,   ν^u_i (1 − x_i) = 0
//! ```
//!
//! The multipliers are those that come nearest to these conditions (Karush 1939; Kuhn, Tucker
//! 1951; for the largest of several functions, Nocedal and Wright: *Numerical Optimization*, 2006,
//! section 12.3), found by a quadratic program of their own rather than taken from the search.

use nalgebra::{DMatrix, DVector};

use super::{
    multipliers::Conditions,
    problem::{FEASIBLE, Point, Values},
    subproblem::{self, Step, lagrangian_hessian},
    surrogate::Surrogate,
};

/// Curvature of the objective in the directions that the active limits leave open.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Curvature {
    /// As many active limits and bounds as variables: no direction is left open.
    Vertex,
    /// It rises in every direction left open; the least second derivative, scaled.
    Minimum(f64),
    /// In some direction it neither rises nor falls to second order.
    Flat(f64),
    /// It falls to second order in some direction: no minimum.
    Saddle(f64),
}

/// First and second order conditions at a design.
#[derive(Debug, Clone, PartialEq)]
pub struct Certificate {
    /// Largest violation of the first-order conditions, in scaled variables; relative to the
    /// multipliers where these are large.
    pub kkt_residual: f64,
    /// μ of every objective piece.
    pub objective_multipliers: Vec<Vec<f64>>,
    /// λ of every constraint piece.
    pub constraint_multipliers: Vec<f64>,
    /// ν^u − ν^l: gain of the objective by moving the bound out, per scaled length.
    pub bound_multipliers: Vec<f64>,
    /// Gradients of the objective pieces.
    pub objective_gradients: Vec<Vec<DVector<f64>>>,
    /// Gradients of the constraint pieces.
    pub constraint_gradients: Vec<DVector<f64>>,
    /// Second-order condition; `None` where curvatures were not measured.
    pub curvature: Option<Curvature>,
}

/// Multiplier above which a constraint counts as active.
pub const HOLDS: f64 = 1e-5;
/// Size of multipliers above which residuals are relative to them (as in Wächter,
/// Biegler: *On the implementation of an interior-point filter line-search algorithm*, 2006, (5)).
const LARGE: f64 = 10.0;
/// Second derivative, as a share of the largest, that counts as zero.
const FLAT_SHARE: f64 = 1e-3;
/// Second derivative that counts as zero, scaled.
const FLAT_ABSOLUTE: f64 = 1e-3;

impl Certificate {
    /// First-order conditions from the surrogates at a design. `None` if Clarabel fails.
    pub(super) fn new(surrogate: &Surrogate, values: &Values, x: &[f64]) -> Option<Self> {
        let n = x.len();
        let conditions = Conditions::new(surrogate, values, x);
        let Conditions { groups, gaps, .. } = &conditions;
        let pieces = groups.len();
        let nf = groups.iter().flatten().count();
        let y = conditions.multipliers()?;
        let stationarity = conditions.gradient_sum(&y).amax();
        let slackness = y.iter().zip(gaps).map(|(y, c)| y * c).fold(0.0, f64::max);
        let largest = y[nf..pieces].iter().copied().fold(0.0, f64::max);
        let scale = (largest / LARGE).max(1.0);
        let mut multipliers = y[..nf].iter().copied();
        Some(Self {
            kkt_residual: stationarity.max(slackness) / scale,
            objective_multipliers: surrogate
                .objectives
                .iter()
                .map(|own| multipliers.by_ref().take(own.len()).collect())
                .collect(),
            constraint_multipliers: y[nf..pieces].to_vec(),
            bound_multipliers: (0..n).map(|i| y[pieces + n + i] - y[pieces + i]).collect(),
            objective_gradients: surrogate
                .objectives
                .iter()
                .map(|pieces| pieces.iter().map(|q| q.gradient.clone()).collect())
                .collect(),
            constraint_gradients: surrogate
                .constraints
                .iter()
                .map(|q| q.gradient.clone())
                .collect(),
            curvature: None,
        })
    }

    /// Certificate of a design without variables.
    pub(super) fn alone(values: &Values) -> Self {
        let zeros = |pieces: &Vec<super::problem::Piece>| vec![0.0; pieces.len()];
        Self {
            kkt_residual: 0.0,
            objective_multipliers: values.objectives.iter().map(zeros).collect(),
            constraint_multipliers: zeros(&values.constraints),
            bound_multipliers: Vec::new(),
            objective_gradients: Vec::new(),
            constraint_gradients: Vec::new(),
            curvature: Some(Curvature::Vertex),
        }
    }

    /// True if it has a multiplier for every piece of a point.
    pub fn is_of(&self, point: &Point) -> bool {
        let Ok(values) = &point.values else {
            return false;
        };
        let own = self.objective_multipliers.iter().map(Vec::len);
        let pieces = values.objectives.iter().map(Vec::len);
        own.eq(pieces) && self.constraint_multipliers.len() == values.constraints.len()
    }

    /// Adds the second-order condition, from surrogates that know all curvatures.
    pub(super) fn with_curvature(mut self, surrogate: &Surrogate, x: &[f64]) -> Self {
        self.curvature = self.reduced_curvature(surrogate, x);
        self
    }

    /// The least eigenvalue of the Lagrangian's Hessian on the directions along which every piece
    /// that holds keeps its value.
    fn reduced_curvature(&self, surrogate: &Surrogate, x: &[f64]) -> Option<Curvature> {
        let n = x.len();
        let mut fixed: Vec<DVector<f64>> = Vec::new();
        for (pieces, multipliers) in surrogate.objectives.iter().zip(&self.objective_multipliers) {
            let mut holding = pieces.iter().zip(multipliers).filter(|(_, m)| **m > HOLDS);
            if let Some((first, _)) = holding.next() {
                fixed.extend(holding.map(|(q, _)| &q.gradient - &first.gradient));
            }
        }
        let constraints = surrogate
            .constraints
            .iter()
            .zip(&self.constraint_multipliers);
        fixed.extend(
            constraints
                .filter(|(_, m)| **m > HOLDS)
                .map(|(q, _)| q.gradient.clone()),
        );
        for (i, x) in x.iter().enumerate() {
            if *x <= FEASIBLE || *x >= 1.0 - FEASIBLE {
                fixed.push(DVector::from_fn(n, |j, _| f64::from(u8::from(i == j))));
            }
        }
        let hessian = lagrangian_hessian(
            surrogate,
            &Step {
                d: DVector::zeros(n),
                objectives: self.objective_multipliers.clone(),
                constraints: self.constraint_multipliers.clone(),
            },
        );
        let open = null_space(&fixed, n)?;
        if open.ncols() == 0 {
            return Some(Curvature::Vertex);
        }
        let reduced = open.transpose() * &hessian * &open;
        let least = subproblem::symmetric(reduced)?.eigenvalues.min();
        let flat = FLAT_ABSOLUTE.max(FLAT_SHARE * hessian.amax());
        Some(if least > flat {
            Curvature::Minimum(least)
        } else if least < -flat {
            Curvature::Saddle(least)
        } else {
            Curvature::Flat(least)
        })
    }
}

/// Orthonormal basis of the directions orthogonal to all of `rows`.
fn null_space(rows: &[DVector<f64>], n: usize) -> Option<DMatrix<f64>> {
    let mut gram = DMatrix::zeros(n, n);
    for row in rows.iter().filter(|r| r.norm() > 0.0) {
        let unit = row.normalize();
        gram += &unit * unit.transpose();
    }
    let eigen = subproblem::symmetric(gram)?;
    let kept: Vec<_> = (0..n)
        // Squares of the sines of angles: directions within 1e-4 rad count as the same.
        .filter(|&i| eigen.eigenvalues[i] < 1e-8)
        .map(|i| eigen.eigenvectors.column(i).into_owned())
        .collect();
    Some(if kept.is_empty() {
        DMatrix::zeros(n, 0)
    } else {
        DMatrix::from_columns(&kept)
    })
}
