//! All contact with the library.

pub use bogie::optimize::local::Status;
use bogie::{
    optimize::{
        archive::{Archive, Measured, Silent},
        local::WIDE,
        problem::{Detail, Failure, Piece, Problem, Scale, Values, Variable},
        solve::{self, solve},
    },
    units::Quantity,
};

/// ```math
/// minimise  max_i f_i(x)   subject to   c_j(x) ≤ 0,   low ≤ x ≤ high
/// ```
///
/// Constraints are written as shares of what they allow, as the project's own are.
pub struct Standard {
    /// Name in the table.
    pub name: &'static str,
    /// Where it was published.
    pub source: &'static str,
    /// Low and high of every variable.
    pub bounds: &'static [[f64; 2]],
    /// Published start; moved onto a bound it is beyond.
    pub start: &'static [f64],
    /// f_i.
    pub objective: fn(&[f64]) -> Vec<f64>,
    /// c_j.
    pub constraints: fn(&[f64]) -> Vec<f64>,
    /// f* of the global optimum.
    pub optimum: f64,
    /// Its x*, where it is unique and f* determines it well.
    pub solution: Option<&'static [f64]>,
    /// Other local optima to which the published start may lead: accepted from there only.
    pub local_optima: &'static [f64],
    /// No covering of the box can be expected to tell the global optimum from a local one: the
    /// local one is accepted from anywhere.
    pub hidden: bool,
    /// Where evaluations fail.
    pub fails: fn(&[f64]) -> bool,
    /// Makes the constraints pieces of one index, in order of value, told apart by their labels.
    pub one_index: bool,
    /// Least violation there is: not zero if the problem is infeasible.
    pub least_violation: f64,
}

/// An unconstrained problem without anything special, for the fields a problem leaves out.
pub const PLAIN: Standard = Standard {
    name: "",
    source: "",
    bounds: &[],
    start: &[],
    objective: |_| vec![0.0],
    constraints: |_| vec![],
    optimum: 0.0,
    solution: None,
    local_optima: &[],
    hidden: false,
    fails: |_| false,
    one_index: false,
    least_violation: 0.0,
};

impl Standard {
    /// max f_i.
    pub fn f(&self, x: &[f64]) -> f64 {
        largest((self.objective)(x))
    }

    /// max(0, max c_j).
    pub fn violation(&self, x: &[f64]) -> f64 {
        largest((self.constraints)(x)).max(0.0)
    }

    /// Numbers of variables and constraints.
    pub fn size(&self) -> (usize, usize) {
        (self.bounds.len(), (self.constraints)(self.start).len())
    }

    /// Largest difference of two points, in ranges of the variables.
    pub fn distance(&self, x: &[f64], y: &[f64]) -> f64 {
        let differences = self.bounds.iter().zip(x).zip(y);
        largest(
            differences
                .map(|(([low, high], x), y)| (x - y).abs() / (high - low))
                .collect(),
        )
    }
}

fn largest(values: Vec<f64>) -> f64 {
    values.into_iter().fold(f64::NEG_INFINITY, f64::max)
}

/// A standard problem in the library's terms.
struct Scaled<'a> {
    standard: &'a Standard,
    gradients: bool,
    variables: Vec<Variable>,
}

impl<'a> Scaled<'a> {
    fn new(standard: &'a Standard, gradients: bool) -> Self {
        let variables = standard
            .bounds
            .iter()
            .map(|&bounds| Variable {
                name: "x",
                symbol: "x",
                quantity: Quantity::Length,
                bounds,
                scale: Scale::Linear,
            })
            .collect();
        Self {
            standard,
            gradients,
            variables,
        }
    }

    /// Derivatives of all pieces by one variable: of the polynomial through values at steps that
    /// stay within the bounds, so that they are good to 1e-8.
    fn slopes(&self, x: &[f64], i: usize) -> Vec<f64> {
        const WIDE: f64 = 1e-3;
        const NARROW: f64 = 1e-5;
        let at = |step: f64| {
            let mut x = x.to_vec();
            x[i] += step;
            let pieces = self.pieces(&x);
            pieces
                .into_iter()
                .map(|piece| piece.value)
                .collect::<Vec<f64>>()
        };
        let room = x[i].min(1.0 - x[i]);
        if room > 2.0 * NARROW {
            let h = (room / 2.0).min(WIDE);
            let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|k| at(k * h));
            return (0..a.len())
                .map(|k| ((a[k] - d[k]) + 8.0 * (c[k] - b[k])) / (12.0 * h))
                .collect();
        }
        let h = if x[i] < 0.5 { WIDE } else { -WIDE };
        let [a, b, c, d, e] = [0.0, 1.0, 2.0, 3.0, 4.0].map(|k| at(k * h));
        (0..a.len())
            .map(|k| {
                let sum = -25.0 * a[k] + 48.0 * b[k] - 36.0 * c[k] + 16.0 * d[k] - 3.0 * e[k];
                sum / (12.0 * h)
            })
            .collect()
    }

    /// Objectives are divided by 1 + |f*|: the library expects values of order one.
    fn pieces(&self, x: &[f64]) -> Vec<Piece> {
        let pairs = self.variables.iter().zip(x);
        // As a variable's value, without its limits.
        let x: Vec<f64> = pairs
            .map(|(v, x)| v.bounds[0] + x * (v.bounds[1] - v.bounds[0]))
            .collect();
        let scale = 1.0 + self.standard.optimum.abs();
        let objective = (self.standard.objective)(&x).into_iter().enumerate();
        let objective = objective.map(|(i, f)| Piece::single(i, f / scale));
        let constraints = (self.standard.constraints)(&x).into_iter().enumerate();
        let one = self.standard.one_index;
        let constraints = constraints.map(|(j, value)| Piece {
            label: if one { j as f64 } else { 0.0 },
            ..Piece::single(if one { FIRST } else { FIRST + j }, value)
        });
        objective.chain(constraints).collect()
    }

    fn values(&self, scaled: &[f64]) -> Vec<f64> {
        let pairs = self.variables.iter().zip(scaled);
        pairs.map(|(v, &x)| v.value(x)).collect()
    }
}

impl Problem for Scaled<'_> {
    fn variables(&self) -> &[Variable] {
        &self.variables
    }

    fn piece_name(&self, index: usize) -> String {
        format!("piece {index}")
    }

    fn has_gradients(&self) -> bool {
        self.gradients
    }

    fn measure(&self, x: &[f64], detail: Detail) -> Measured {
        assert!(
            x.iter().all(|x| (0.0..=1.0).contains(x)),
            "{}: outside the bounds",
            self.standard.name
        );
        if (self.standard.fails)(&self.values(x)) {
            return Err(Failure::Unstable);
        }
        let mut pieces = self.pieces(x);
        if detail == Detail::Gradients {
            let slopes: Vec<Vec<f64>> = (0..x.len()).map(|i| self.slopes(x, i)).collect();
            for (k, piece) in pieces.iter_mut().enumerate() {
                piece.gradient = Some(slopes.iter().map(|by| by[k]).collect());
            }
        }
        Ok(pieces)
    }

    fn judge(&self, measured: &[Piece]) -> Values {
        let (objective, mut constraints): (Vec<Piece>, Vec<Piece>) =
            measured.iter().cloned().partition(|p| p.index < FIRST);
        if self.standard.one_index {
            constraints.sort_by(|a, b| b.value.total_cmp(&a.value));
        }
        Values {
            objectives: vec![objective],
            constraints,
        }
    }
}

/// Index of the first constraint.
const FIRST: usize = 100;

/// Where a run begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Start {
    /// A local search from the published start.
    Published,
    /// A global search.
    Anywhere,
}

/// What a run found.
pub struct Run {
    pub x: Vec<f64>,
    pub f: f64,
    pub violation: f64,
    pub status: Status,
    /// Of the first-order conditions, in scaled variables and values.
    pub kkt_residual: f64,
    pub evaluations: usize,
}

/// Solves a problem; the failure of its last evaluation if none succeeded.
pub fn solve_from(problem: &Standard, start: Start, gradients: bool) -> Result<Run, String> {
    let scaled = Scaled::new(problem, gradients);
    let near: Vec<f64> = scaled
        .variables
        .iter()
        .zip(problem.start)
        .map(|(v, &x)| v.coordinate(x))
        .collect();
    let start = match start {
        Start::Published => solve::Start {
            radius: WIDE,
            ..solve::Start::near(vec![near])
        },
        Start::Anywhere if gradients => solve::Start::everywhere(3),
        // Fits to values alone are costly: a few searches will do.
        Start::Anywhere => solve::Start::everywhere(3).until(0.5),
    };
    let archive = Archive::new(&Silent);
    let solved = solve(&scaled, &start, &archive).map_err(|failure| failure.to_string())?;
    let x = scaled.values(&solved.point.x);
    Ok(Run {
        f: problem.f(&x),
        violation: problem.violation(&x),
        x,
        status: solved.status,
        kkt_residual: solved.certificate.map_or(f64::NAN, |c| c.kkt_residual),
        evaluations: solved.effort.evaluations,
    })
}
