//! The trust-region subproblem: surrogates minimised inside a box, by quadratic programs.
//!
//! ```math
//! minimise  w Σ_k t_k + ½ sᵀH s + ρ e
//! subject to  f_ki + ∇f_kiᵀ s ≤ t_k,   c_j + ∇c_jᵀ s ≤ e,   e ≥ 0,   l ≤ s ≤ u
//! ```
//!
//! t_k is the epigraph variable of the largest piece of an objective. H is the Hessian of the
//! surrogates' Lagrangian, made positive definite (Clarabel does not notice an indefinite matrix).
//! The slack e keeps every program feasible; ρ is the price of the merit function. Programs are
//! solved until the step inside the surrogate settles. Lengths and values are measured in trust
//! radii: Clarabel wants numbers of order one.

use clarabel::{
    algebra::CscMatrix,
    solver::{
        DefaultSettingsBuilder, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus, ZeroConeT,
    },
};
use nalgebra::{DMatrix, DVector, Dyn, SymmetricEigen};

use super::surrogate::{Quadratic, Surrogate};

/// Limit on the programs solved for one subproblem.
const MAX_PROGRAMS: usize = 12;
/// Least curvature of H, per radius.
const LEAST_CURVATURE: f64 = 1e-6;
/// Change of the step, in radii, at which the programs have converged: below the error of the surrogate.
const STEP_CONVERGED: f64 = 1e-3;

/// Solution of a subproblem.
#[derive(Debug, Clone)]
pub(super) struct Step {
    /// Displacement from the centre.
    pub d: DVector<f64>,
    /// Multipliers of the pieces of each objective (they sum to w).
    pub objectives: Vec<Vec<f64>>,
    /// Multipliers of the constraints (they sum to ρ at most).
    pub constraints: Vec<f64>,
}

impl Step {
    /// True if two steps have equally many multipliers.
    fn is_like(&self, other: &Self) -> bool {
        let pieces = |step: &Self| step.objectives.iter().map(Vec::len).collect::<Vec<_>>();
        pieces(self) == pieces(other) && self.constraints.len() == other.constraints.len()
    }
}

/// Weights of objective and violation in a subproblem.
#[derive(Debug, Clone, Copy)]
pub(super) struct Weights {
    /// w: 1, or 0 to look for feasibility alone.
    pub objective: f64,
    /// ρ.
    pub penalty: f64,
}

impl Weights {
    /// Merit of a displacement.
    pub fn merit(self, surrogate: &Surrogate, d: &DVector<f64>) -> f64 {
        self.objective * surrogate.objective(d) + self.penalty * surrogate.violation(d)
    }
}

/// Minimises the surrogate inside the box `lower` ≤ d ≤ `upper`, whose size is `radius`. The
/// multipliers of a step `before` are a warm start. `None` if Clarabel fails.
pub(super) fn minimise(
    surrogate: &Surrogate,
    lower: &DVector<f64>,
    upper: &DVector<f64>,
    radius: f64,
    weights: Weights,
    before: Option<&Step>,
) -> Option<Step> {
    let equal =
        |pieces: &Vec<Quadratic>| vec![weights.objective / pieces.len() as f64; pieces.len()];
    let mut step = Step {
        d: DVector::zeros(lower.len()),
        objectives: surrogate.objectives.iter().map(equal).collect(),
        constraints: vec![0.0; surrogate.constraints.len()],
    };
    if let Some(before) = before.filter(|before| before.is_like(&step)) {
        step.objectives.clone_from(&before.objectives);
        step.constraints.clone_from(&before.constraints);
    }
    let mut best: Option<(f64, Step)> = None;
    let mut damping = 0.0;
    for _ in 0..MAX_PROGRAMS {
        let Some(mut next) = program(surrogate, &step, lower, upper, radius, weights, damping)
        else {
            break;
        };
        let moved = (&next.d - &step.d).amax();
        let value = weights.merit(surrogate, &next.d);
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
        if moved < STEP_CONVERGED * radius {
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
    radius: f64,
    weights: Weights,
    damping: f64,
) -> Option<Step> {
    let n = lower.len();
    let groups = surrogate.objectives.len();
    let linear = |piece: &Quadratic| Linear::new(piece, from, lower, upper);
    let mut objectives: Vec<Vec<Linear>> = surrogate
        .objectives
        .iter()
        .map(|pieces| pieces.iter().map(linear).collect())
        .collect();
    for pieces in &mut objectives {
        // Lower bound of the largest piece over the box.
        let least = pieces.iter().map(|piece| piece.range[0]);
        let least = least.fold(f64::NEG_INFINITY, f64::max);
        leave_out_below(pieces, least);
    }
    let mut constraints: Vec<Linear> = surrogate.constraints.iter().map(linear).collect();
    leave_out_below(&mut constraints, 0.0);
    // Column of the epigraph variable of each piece, and the value that is subtracted from both: the
    // largest piece of an objective, because differences between the pieces are small beside it.
    let slack = n + groups;
    let of_objectives = objectives.iter().enumerate().flat_map(|(k, pieces)| {
        let values = pieces.iter().map(|piece| piece.value);
        let base = values.fold(f64::NEG_INFINITY, f64::max);
        pieces.iter().map(move |piece| (n + k, base, piece))
    });
    let of_constraints = constraints.iter().map(|piece| (slack, 0.0, piece));
    let mut pieces: Vec<(usize, f64, &Linear)> = of_objectives.chain(of_constraints).collect();
    pieces.retain(|(.., piece)| piece.matters);
    // Variables: s (n), t (groups), e. In radii.
    let columns = slack + 1;
    let rows = pieces.len() + 1 + 2 * n;
    let mut p = DMatrix::zeros(columns, columns);
    let hessian = lagrangian_hessian(surrogate, from) * radius;
    p.view_mut((0, 0), (n, n))
        .copy_from(&convex(hessian, LEAST_CURVATURE, damping)?);
    let mut q = vec![0.0; columns];
    q[n..n + groups].fill(weights.objective);
    q[slack] = weights.penalty;
    let mut a = DMatrix::zeros(rows, columns);
    let mut b = vec![0.0; rows];
    for (row, (column, base, piece)) in pieces.iter().enumerate() {
        a.view_mut((row, 0), (1, n))
            .copy_from(&piece.gradient.transpose());
        a[(row, *column)] = -1.0;
        b[row] = (base - piece.value) / radius;
    }
    a[(pieces.len(), slack)] = -1.0;
    for i in 0..n {
        let row = pieces.len() + 1 + 2 * i;
        a[(row, i)] = 1.0;
        b[row] = (upper[i] - from.d[i]) / radius;
        a[(row + 1, i)] = -1.0;
        b[row + 1] = (from.d[i] - lower[i]) / radius;
    }
    let (x, z) = solve(&p, &q, &a, &b, 0)?;
    let s = DVector::from_column_slice(&x[..n]) * radius;
    let mut found = z.into_iter();
    // A piece left out has no multiplier.
    let mut multiplier = |piece: &Linear| {
        let own = if piece.matters { found.next() } else { None };
        own.unwrap_or(0.0)
    };
    Some(Step {
        d: (&from.d + s).zip_zip_map(lower, upper, f64::clamp),
        objectives: objectives
            .iter()
            .map(|pieces| pieces.iter().map(&mut multiplier).collect())
            .collect(),
        constraints: constraints.iter().map(multiplier).collect(),
    })
}

/// Leaves out pieces that stay below a value over the whole box.
fn leave_out_below(pieces: &mut [Linear], value: f64) {
    for piece in pieces {
        piece.matters = piece.range[1] >= value;
    }
}

/// A piece linearised at a step, and its range of values over the box.
struct Linear {
    value: f64,
    gradient: DVector<f64>,
    range: [f64; 2],
    matters: bool,
}

impl Linear {
    fn new(piece: &Quadratic, from: &Step, lower: &DVector<f64>, upper: &DVector<f64>) -> Self {
        let (value, gradient) = (piece.at(&from.d), piece.gradient_at(&from.d));
        let mut range = [value; 2];
        for (i, slope) in gradient.iter().enumerate() {
            let ends = [lower[i], upper[i]].map(|end| slope * (end - from.d[i]));
            range[0] += ends[0].min(ends[1]);
            range[1] += ends[0].max(ends[1]);
        }
        Self {
            value,
            gradient,
            range,
            matters: true,
        }
    }
}

/// Solves min ½ xᵀPx + qᵀx subject to Ax = b in the first `equalities` rows and Ax ≤ b in the rest;
/// x and the multipliers. `None` if Clarabel does not solve it.
pub(super) fn solve(
    p: &DMatrix<f64>,
    q: &[f64],
    a: &DMatrix<f64>,
    b: &[f64],
    equalities: usize,
) -> Option<(Vec<f64>, Vec<f64>)> {
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .max_iter(100)
        .build()
        .ok()?;
    let cones = [
        ZeroConeT(equalities),
        NonnegativeConeT(b.len() - equalities),
    ];
    let upper = triplets(p, |i, j| i <= j);
    let mut solver =
        DefaultSolver::new(&upper, q, &triplets(a, |_, _| true), b, &cones, settings).ok()?;
    solver.solve();
    let solution = &solver.solution;
    let solved = matches!(
        solution.status,
        SolverStatus::Solved | SolverStatus::AlmostSolved
    );
    (solved && solution.x.iter().all(|x| x.is_finite()))
        .then(|| (solution.x.clone(), solution.z.clone()))
}

/// Σ μ_ki ∇²f_ki + Σ λ_j ∇²c_j.
pub(super) fn lagrangian_hessian(surrogate: &Surrogate, step: &Step) -> DMatrix<f64> {
    let n = step.d.len();
    let mut h = DMatrix::zeros(n, n);
    let objectives = surrogate.objectives.iter().flatten();
    let objectives = objectives.zip(step.objectives.iter().flatten());
    let constraints = surrogate.constraints.iter().zip(&step.constraints);
    for (piece, &multiplier) in objectives.chain(constraints) {
        h += &piece.hessian * multiplier;
    }
    h
}

/// A symmetric matrix with its eigenvalues raised to `floor`, and `damping` added.
fn convex(h: DMatrix<f64>, floor: f64, damping: f64) -> Option<DMatrix<f64>> {
    let mut eigen = symmetric(h)?;
    for value in &mut eigen.eigenvalues {
        *value = value.max(floor) + damping;
    }
    Some(eigen.recompose())
}

/// Eigenvalues and vectors of a symmetric matrix, with a limit on iterations.
pub(super) fn symmetric(h: DMatrix<f64>) -> Option<SymmetricEigen<f64, Dyn>> {
    SymmetricEigen::try_new(h, f64::EPSILON, 1000)
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
