//! A constrained design problem around full-model evaluations.
//!
//! ```math
//! minimise  max_i f_i(x)   subject to   c_j(x) ≤ 0,   0 ≤ x ≤ 1
//! ```
//!
//! x are the design variables, scaled to their bounds. The degree curve is the least of several
//! limits and the critical speed the least of several modes': each is a piece of its own, so that
//! f_i and c_j are smooth.

use crate::units::Quantity;

/// A design variable between bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Name in tables and files.
    pub name: &'static str,
    /// Symbol in the report.
    pub symbol: &'static str,
    /// Kind of quantity, for units.
    pub quantity: Quantity,
    /// Bounds, SI.
    pub bounds: [f64; 2],
    /// How the variable is scaled between them.
    pub scale: Scale,
}

/// Scale of a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Equal ratios are equal steps: stiffnesses, frequencies, damping ratios.
    Logarithmic,
    /// Equal differences are equal steps.
    Linear,
}

impl Variable {
    /// Value at scaled coordinate `x` in 0…1.
    pub fn value(&self, x: f64) -> f64 {
        let [low, high] = self.bounds;
        match self.scale {
            Scale::Logarithmic => low * (high / low).powf(x),
            Scale::Linear => low + x * (high - low),
        }
        .clamp(low, high)
    }

    /// Scaled coordinate of a value, within 0…1.
    pub fn coordinate(&self, value: f64) -> f64 {
        let [low, high] = self.bounds;
        let x = match self.scale {
            Scale::Logarithmic => (value / low).ln() / (high / low).ln(),
            Scale::Linear => (value - low) / (high - low),
        };
        x.clamp(0.0, 1.0)
    }
}

/// One smooth piece of an objective or constraint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Its value, scaled to order one.
    pub value: f64,
    /// What it belongs to: the same index at every design.
    pub index: usize,
    /// Among pieces of one index, what continues it from one design to the next (the logarithm of
    /// a hunting frequency).
    pub label: f64,
}

impl Piece {
    /// A piece that is alone in its index.
    pub fn single(index: usize, value: f64) -> Self {
        Self {
            value,
            index,
            label: 0.0,
        }
    }
}

/// What a full-model evaluation gives an optimiser.
#[derive(Debug, Clone, PartialEq)]
pub struct Values {
    /// f_i.
    pub objective: Vec<Piece>,
    /// c_j; satisfied where not positive.
    pub constraints: Vec<Piece>,
}

impl Values {
    /// max f_i.
    pub fn objective(&self) -> f64 {
        largest(&self.objective)
    }

    /// max(0, max c_j).
    pub fn violation(&self) -> f64 {
        largest(&self.constraints).max(0.0)
    }
}

fn largest(pieces: &[Piece]) -> f64 {
    pieces
        .iter()
        .map(|p| p.value)
        .fold(f64::NEG_INFINITY, f64::max)
}

/// Why a design could not be evaluated.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Failure {
    /// No stationary response exists.
    #[error("the vehicle is unstable at its operating speed")]
    Unstable,
    /// The numerical method gave up.
    #[error("{0}")]
    Numerical(String),
}

/// A problem to be minimised.
pub trait Problem: Sync {
    /// Its variables.
    fn variables(&self) -> &[Variable];

    /// What is maximised or minimised, subject to what, in words.
    fn goal(&self) -> String;

    /// Name of the piece with an index, of the objective or the constraints.
    fn piece_name(&self, index: usize) -> String;

    /// Evaluates the full models at scaled coordinates x.
    ///
    /// # Errors
    ///
    /// [`Failure`] where the design has no such performance.
    fn evaluate(&self, x: &[f64]) -> Result<Values, Failure>;
}

/// A design that has been evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Scaled coordinates.
    pub x: Vec<f64>,
    /// Values there, or why there are none.
    pub values: Result<Values, Failure>,
}

/// Constraint values up to this count as satisfied: a millionth of what is allowed.
pub const FEASIBLE: f64 = 1e-6;

impl Point {
    /// Exact penalty merit, finite everywhere: feasible designs by their objective, the others by
    /// objective and violation, failed ones last.
    pub fn merit(&self, penalty: f64) -> f64 {
        /// Above every merit of an evaluated design.
        const FAILED: f64 = 1e6;
        match &self.values {
            Ok(values) => {
                let merit = values.objective() + penalty * values.violation();
                if merit.is_finite() {
                    merit.min(FAILED)
                } else {
                    FAILED
                }
            }
            Err(_) => FAILED,
        }
    }

    /// Feasible designs before infeasible ones, those by their objective and these by their
    /// violation; ties by position, so that the order never depends on the order of evaluation.
    pub fn better_than(&self, other: &Self) -> bool {
        let rank = |p: &Self| match &p.values {
            Ok(v) if v.violation() <= FEASIBLE => (0, v.objective()),
            Ok(v) => (1, v.violation()),
            Err(_) => (2, 0.0),
        };
        let ((a, x), (b, y)) = (rank(self), rank(other));
        a.cmp(&b)
            .then(x.total_cmp(&y))
            .then_with(|| {
                let pairs = self.x.iter().zip(&other.x);
                pairs
                    .map(|(p, q)| p.total_cmp(q))
                    .find(|o| o.is_ne())
                    .unwrap_or(std::cmp::Ordering::Equal)
            })
            .is_lt()
    }
}
