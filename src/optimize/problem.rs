//! A constrained problem around costly evaluations.
//!
//! ```math
//! minimise  Σ_k max_i f_ki(x)   subject to   c_j(x) ≤ 0,   0 ≤ x ≤ 1
//! ```
//!
//! x are the variables, scaled to their bounds. Every f_ki and c_j is a smooth *piece*: the degree
//! curve is the least of several limits and the critical speed the least of several modes', so each
//! of these is a piece of its own.

use serde::{Deserialize, Serialize};

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
    /// What it belongs to: the same index at every design.
    pub index: usize,
    /// Among pieces of one index, what continues it from one design to the next (the logarithm of
    /// a hunting frequency).
    pub label: f64,
    /// Its gradient over the variables' scaled coordinates, where it was asked for and is known.
    pub gradient: Option<Vec<f64>>,
}

/// How much is measured of a design.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Detail {
    /// The pieces' values.
    Values,
    /// Their gradients too.
    Gradients,
}

impl Piece {
    /// A piece that is alone in its index.
    pub fn single(index: usize, value: f64) -> Self {
        Self {
            value,
            index,
            label: 0.0,
            gradient: None,
        }
    }
}

/// What a design is worth to a problem.
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

    /// Whether the gradients of all pieces are known.
    pub fn has_gradients(&self) -> bool {
        let pieces = self.objectives.iter().flatten().chain(&self.constraints);
        pieces.into_iter().all(|piece| piece.gradient.is_some())
    }

    /// max(0, max c_j).
    pub fn violation(&self) -> f64 {
        largest(&self.constraints).max(0.0)
    }

    /// Whether every constraint holds to [`FEASIBLE`].
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

/// Why a design has no performance.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, thiserror::Error,
)]
#[serde(rename_all = "kebab-case")]
pub enum Failure {
    /// No stationary response exists.
    #[error("unstable at the operating speed")]
    Unstable,
    /// A motion without oscillation grows: the carbody overturns, or the trucks diverge.
    #[error("diverges: a static instability")]
    Diverges,
    /// The curving equations are singular.
    #[error("no steady-state solution in a curve")]
    NoCurve,
    /// The load transfer in a curve takes all of the load of the wheels on one side.
    #[error("wheel-lifted: no load on the wheels of one side")]
    WheelLifted,
    /// Beyond flange contact or slip, where the linear model has no verdict.
    #[error("outside-model: beyond flange contact or slip")]
    OutsideModel,
    /// The index belongs to a curve that the service does not give.
    #[error("no curve in [service]")]
    NoServiceCurve,
    /// No mode of the kind asked for exists.
    #[error("no mode of that kind")]
    NoMode,
    /// The eigenvalue iteration gave up.
    #[error("eigenvalues not converged")]
    Eigenvalues,
    /// The random response did not meet its tolerance.
    #[error("random response not converged")]
    #[serde(rename = "not-converged")]
    Integration,
    /// The end of the range searched bounds the index, and no more is known of it.
    #[error("only-bounded: beyond the range searched")]
    OnlyBounded,
    /// An index came out infinite or undefined.
    #[error("an index that is not a number")]
    NotFinite,
}

impl Failure {
    /// Whether the model does not cover what was asked, so that a demand on it is not assessed.
    pub fn is_not_covered(self) -> bool {
        matches!(self, Self::WheelLifted | Self::OutsideModel)
    }
}

/// What identifies a measurement: equal keys, equal measurements.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Key {
    /// What is measured.
    pub what: String,
    /// Of which design, SI.
    pub at: Vec<f64>,
}

/// A problem to be minimised.
pub trait Problem: Sync {
    /// Its variables.
    fn variables(&self) -> &[Variable];

    /// Name of the pieces with an index.
    fn piece_name(&self, index: usize) -> String;

    /// Identifies what [`Problem::measure`] gives at x.
    fn key(&self, x: &[f64]) -> Key {
        Key {
            what: String::new(),
            at: x.to_vec(),
        }
    }

    /// Evaluates the full models at scaled coordinates x: the costly part.
    ///
    /// # Errors
    ///
    /// [`Failure`] where the design has no such performance.
    fn measure(&self, x: &[f64], detail: Detail) -> Result<Vec<Piece>, Failure>;

    /// Whether gradients can be had.
    fn has_gradients(&self) -> bool {
        false
    }

    /// Objective and constraints from what was measured.
    fn judge(&self, measured: &[Piece]) -> Values;

    /// Both.
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
    /// Values there, or why there are none.
    pub values: Result<Values, Failure>,
}

/// Constraint values up to this count as satisfied: a millionth of what is allowed.
pub const FEASIBLE: f64 = 1e-6;
/// Objectives closer than this are the same: what the tolerance on first-order conditions leaves.
pub(super) const SAME: f64 = 2e-5;

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

    /// Its objective; infinite if it could not be evaluated.
    pub fn objective(&self) -> f64 {
        let values = self.values.as_ref();
        values.map_or(f64::INFINITY, Values::objective)
    }

    /// Whether it could be evaluated and every constraint holds.
    pub fn feasible(&self) -> bool {
        self.values.as_ref().is_ok_and(Values::feasible)
    }

    /// Feasible designs before infeasible ones, those by their objective and these by their
    /// violation; ties by position, so that the order never depends on the order of evaluation.
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
