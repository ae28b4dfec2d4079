//! A constrained problem around costly evaluations.
//!
//! ```math
//! minimise  Σ_k max_i f_ki(x)   subject to   c_j(x) ≤ 0,   0 ≤ x ≤ 1
//! ```
//!
//! x are the variables, scaled to their bounds. Every f_ki and c_j is a smooth *piece*: an index that is
//! the least or the greatest of several smooth functions has a piece for each of them.

use serde::{Deserialize, Serialize};

pub use crate::failure::Failure;
use crate::units::Quantity;

/// A design variable between bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Name in tables and files.
    pub name: &'static str,
    /// Symbol in tables.
    pub symbol: &'static str,
    /// Kind of quantity, for units.
    pub quantity: Quantity,
    /// Bounds, SI.
    pub bounds: [f64; 2],
    /// Scale between the bounds.
    pub scale: Scale,
}

/// Scale of a variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Equal ratios are equal steps.
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

    /// Change of the value per change of its scaled coordinate at `value`.
    pub fn slope(&self, value: f64) -> f64 {
        let [low, high] = self.bounds;
        match self.scale {
            Scale::Logarithmic => value * (high / low).ln(),
            Scale::Linear => high - low,
        }
    }
}

/// One smooth piece of an objective or constraint, or of the index that it is made from.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// Its value; in a problem's values scaled to order one.
    pub value: f64,
    /// Number of the index that it belongs to, the same at every design.
    pub index: usize,
    /// Label that identifies it among the pieces of one index: it changes continuously with the design.
    pub label: f64,
    /// Gradient over the variables' scaled coordinates; `None` if not asked for or not known.
    pub gradient: Option<Vec<f64>>,
}

/// Extent of a measurement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Detail {
    /// The pieces' values.
    Values,
    /// Their gradients too.
    Gradients,
}

impl Piece {
    /// The only piece of an index.
    pub fn single(index: usize, value: f64) -> Self {
        Self {
            value,
            index,
            label: 0.0,
            gradient: None,
        }
    }
}

/// Objective and constraint values of a design.
#[derive(Debug, Clone, PartialEq)]
pub struct Values {
    /// f_ki: the objective is the sum over k of the largest piece of each.
    pub objectives: Vec<Vec<Piece>>,
    /// c_j; satisfied where not positive.
    pub constraints: Vec<Piece>,
}

impl Values {
    /// Σ max f_ki.
    pub fn objective(&self) -> f64 {
        self.objectives.iter().map(|pieces| largest(pieces)).sum()
    }

    /// True if the gradients of all pieces are known.
    pub fn has_gradients(&self) -> bool {
        let pieces = self.objectives.iter().flatten().chain(&self.constraints);
        pieces.into_iter().all(|piece| piece.gradient.is_some())
    }

    /// max(0, max c_j).
    pub fn violation(&self) -> f64 {
        largest(&self.constraints).max(0.0)
    }

    /// True if every constraint holds to [`FEASIBLE`].
    pub fn feasible(&self) -> bool {
        self.violation() <= FEASIBLE
    }
}

/// The largest value; minus infinity where there is none.
pub fn largest(pieces: &[Piece]) -> f64 {
    pieces
        .iter()
        .map(|p| p.value)
        .fold(f64::NEG_INFINITY, f64::max)
}

/// Identity of a measurement: equal keys have equal measurements.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Key {
    /// Kind of measurement.
    pub what: String,
    /// Design, SI.
    pub at: Vec<f64>,
}

/// A problem to be minimised.
pub trait Problem: Sync {
    /// Its variables.
    fn variables(&self) -> &[Variable];

    /// Name of the pieces with an index.
    fn piece_name(&self, index: usize) -> String;

    /// Key of the measurement at x.
    fn key(&self, x: &[f64]) -> Key {
        Key {
            what: String::new(),
            at: x.to_vec(),
        }
    }

    /// Evaluates the models at scaled coordinates x: the costly part.
    ///
    /// # Errors
    ///
    /// [`Failure`] where the design has no such performance.
    fn measure(&self, x: &[f64], detail: Detail) -> Result<Vec<Piece>, Failure>;

    /// True if the problem computes gradients.
    fn has_gradients(&self) -> bool {
        false
    }

    /// Objective and constraints from a measurement.
    fn judge(&self, measured: &[Piece]) -> Values;

    /// Measures and judges.
    ///
    /// # Errors
    ///
    /// As [`Problem::measure`].
    fn evaluate(&self, x: &[f64]) -> Result<Values, Failure> {
        Ok(self.judge(&self.measure(x, Detail::Values)?))
    }
}

/// A design that has been evaluated.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Scaled coordinates.
    pub x: Vec<f64>,
    /// Values there, or the reason why there are none.
    pub values: Result<Values, Failure>,
}

/// Tolerance of constraints: a millionth of the bound.
pub const FEASIBLE: f64 = 1e-6;
/// Difference of two objectives below which they are equal: the error that the tolerance on first-order
/// conditions leaves.
pub(super) const EQUAL_OBJECTIVES: f64 = 2e-5;

impl Point {
    /// Exact penalty merit, finite everywhere: evaluated designs by objective and largest
    /// violation, failed ones last.
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

    /// Objective; infinite without values.
    pub fn objective(&self) -> f64 {
        let values = self.values.as_ref();
        values.map_or(f64::INFINITY, Values::objective)
    }

    /// True if it has values and every constraint holds.
    pub fn feasible(&self) -> bool {
        self.values.as_ref().is_ok_and(Values::feasible)
    }

    /// True if it ranks before another: feasible points by objective, then infeasible ones by violation.
    /// Position decides ties, so that the rank does not depend on the order of evaluation.
    pub fn better_than(&self, other: &Self) -> bool {
        self.order(other).is_lt()
    }

    /// The order of [`Point::better_than`], the better first.
    pub(super) fn order(&self, other: &Self) -> std::cmp::Ordering {
        let rank = |p: &Self| match &p.values {
            Ok(v) if v.feasible() => (0, v.objective()),
            Ok(v) => (1, v.violation()),
            Err(_) => (2, 0.0),
        };
        let ((a, x), (b, y)) = (rank(self), rank(other));
        a.cmp(&b)
            .then(x.total_cmp(&y))
            .then_with(|| by_position(&self.x, &other.x))
    }
}

/// A scaled coordinate that is `within` some distance of an end of its range, put on it.
pub fn onto_bound(x: f64, within: f64) -> f64 {
    if x < within {
        0.0
    } else if x > 1.0 - within {
        1.0
    } else {
        x
    }
}

/// Order of two designs, coordinate by coordinate.
pub(super) fn by_position(a: &[f64], b: &[f64]) -> std::cmp::Ordering {
    let pairs = a.iter().zip(b);
    pairs
        .map(|(x, y)| x.total_cmp(y))
        .find(|o| o.is_ne())
        .unwrap_or(std::cmp::Ordering::Equal)
}
