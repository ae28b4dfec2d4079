//! The trust-region subproblem: surrogates minimised inside a box, by quadratic programs.
//!
//! ```math
//! minimise  t + ½ sᵀH s + ρ Σ e_j
//! subject to  f_i + ∇f_iᵀ s ≤ t,   c_j + ∇c_jᵀ s ≤ e_j,   e ≥ 0,   l ≤ s ≤ u
//! ```
//!
//! H is the Hessian of the surrogates' Lagrangian, made positive definite (Clarabel does not
//! notice an indefinite matrix). The slacks e keep every program feasible. Programs are solved
//! until the step inside the surrogate settles.

use clarabel::{
    algebra::CscMatrix,
    solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus},
};
use nalgebra::{DMatrix, DVector};

use super::surrogate::Surrogate;

/// Price of a violation in the subproblem.
const PENALTY: f64 = 100.0;
/// Programs solved for one subproblem.
const PROGRAMS: usize = 12;
/// Smallest curvature of H.
const CURVATURE: f64 = 1e-6;

/// Solution of a subproblem.
#[derive(Debug, Clone)]
pub(super) struct Step {
    /// Displacement from the centre.
    pub d: DVector<f64>,
    /// Multipliers of objective pieces (they sum to one) and constraints.
    pub objective_multipliers: Vec<f64>,
    pub constraint_multipliers: Vec<f64>,
}

/// Minimises the surrogate inside the box `lower` ≤ d ≤ `upper`. `None` if Clarabel fails.
pub(super) fn minimise(
    surrogate: &Surrogate,
    lower: &DVector<f64>,
    upper: &DVector<f64>,
) -> Option<Step> {
    let n = lower.len();
    let mut step = Step {
        d: DVector::zeros(n),
        objective_multipliers: vec![
            1.0 / surrogate.objective.len() as f64;
            surrogate.objective.len()
        ],
        constraint_multipliers: vec![0.0; surrogate.constraints.len()],
    };
    let merit = |d: &DVector<f64>| {
        let worst = |pieces: &[super::surrogate::Quadratic]| {
            pieces
                .iter()
                .map(|q| q.at(d))
                .fold(f64::NEG_INFINITY, f64::max)
        };
        let excess: f64 = surrogate.constraints.iter().map(|q| q.at(d).max(0.0)).sum();
        worst(&surrogate.objective) + PENALTY * excess
    };
    let mut best: Option<(f64, Step)> = None;
    let mut damping = 0.0;
    for _ in 0..PROGRAMS {
        let mut next = program(surrogate, &step, lower, upper, damping)?;
        let moved = (&next.d - &step.d).amax();
        let value = merit(&next.d);
        if best.as_ref().is_none_or(|(least, _)| value < *least) {
            best = Some((value, next.clone()));
        } else {
            // The program overshoots the surrogate: keep the multipliers, shorten the step.
            damping = if damping == 0.0 { 1.0 } else { damping * 4.0 };
            if let Some((_, kept)) = &best {
                next.d.clone_from(&kept.d);
            }
        }
        step = next;
        if moved < 1e-10 {
            break;
        }
    }
    best.map(|(_, step)| step)
}

/// One quadratic program, linearised at `from`.
fn program(
    surrogate: &Surrogate,
    from: &Step,
    lower: &DVector<f64>,
    upper: &DVector<f64>,
    damping: f64,
) -> Option<Step> {
    let n = lower.len();
    let (nf, nc) = (surrogate.objective.len(), surrogate.constraints.len());
    let hessian = lagrangian_hessian(surrogate, from, damping);
    // Variables: s (n), t, e (nc).
    let columns = n + 1 + nc;
    let rows = nf + 2 * nc + 2 * n;
    let mut p = DMatrix::zeros(columns, columns);
    p.view_mut((0, 0), (n, n)).copy_from(&hessian);
    let mut q = vec![0.0; columns];
    q[n] = 1.0;
    q[n + 1..].fill(PENALTY);
    let mut a = DMatrix::zeros(rows, columns);
    let mut b = vec![0.0; rows];
    for (i, piece) in surrogate.objective.iter().enumerate() {
        a.view_mut((i, 0), (1, n))
            .copy_from(&piece.gradient_at(&from.d).transpose());
        a[(i, n)] = -1.0;
        b[i] = -piece.at(&from.d);
    }
    for (j, piece) in surrogate.constraints.iter().enumerate() {
        let row = nf + j;
        a.view_mut((row, 0), (1, n))
            .copy_from(&piece.gradient_at(&from.d).transpose());
        a[(row, n + 1 + j)] = -1.0;
        b[row] = -piece.at(&from.d);
        a[(nf + nc + j, n + 1 + j)] = -1.0;
    }
    for i in 0..n {
        let row = nf + 2 * nc + 2 * i;
        a[(row, i)] = 1.0;
        b[row] = upper[i] - from.d[i];
        a[(row + 1, i)] = -1.0;
        b[row + 1] = from.d[i] - lower[i];
    }
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .max_iter(100)
        .build()
        .ok()?;
    let cones = [NonnegativeConeT(rows)];
    let mut solver =
        DefaultSolver::new(&sparse_upper(&p), &q, &sparse(&a), &b, &cones, settings).ok()?;
    solver.solve();
    let solution = &solver.solution;
    let solved = matches!(
        solution.status,
        SolverStatus::Solved | SolverStatus::AlmostSolved
    );
    if !solved || !solution.x.iter().all(|x| x.is_finite()) {
        return None;
    }
    let s = DVector::from_column_slice(&solution.x[..n]);
    let d = (&from.d + s).zip_zip_map(lower, upper, f64::clamp);
    Some(Step {
        d,
        objective_multipliers: solution.z[..nf].to_vec(),
        constraint_multipliers: solution.z[nf..nf + nc].to_vec(),
    })
}

/// Σ μ_i ∇²f_i + Σ λ_j ∇²c_j with its eigenvalues raised to a positive floor.
fn lagrangian_hessian(surrogate: &Surrogate, step: &Step, damping: f64) -> DMatrix<f64> {
    let n = step.d.len();
    let mut h = DMatrix::zeros(n, n);
    let pieces = surrogate.objective.iter().zip(&step.objective_multipliers);
    for (piece, &multiplier) in pieces.chain(
        surrogate
            .constraints
            .iter()
            .zip(&step.constraint_multipliers),
    ) {
        h += &piece.hessian * multiplier;
    }
    let mut eigen = nalgebra::SymmetricEigen::new(h);
    for value in &mut eigen.eigenvalues {
        *value = value.max(CURVATURE) + damping;
    }
    eigen.recompose()
}

fn sparse(m: &DMatrix<f64>) -> CscMatrix<f64> {
    triplets(m, |_, _| true)
}

fn sparse_upper(m: &DMatrix<f64>) -> CscMatrix<f64> {
    triplets(m, |i, j| i <= j)
}

fn triplets(m: &DMatrix<f64>, keep: impl Fn(usize, usize) -> bool) -> CscMatrix<f64> {
    let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for j in 0..m.ncols() {
        for i in 0..m.nrows() {
            if keep(i, j) && m[(i, j)] != 0.0 {
                rows.push(i);
                columns.push(j);
                values.push(m[(i, j)]);
            }
        }
    }
    CscMatrix::new_from_triplets(m.nrows(), m.ncols(), rows, columns, values)
}
