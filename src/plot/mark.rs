//! Marks: points, limits and shaded ranges.

use serde::Serialize;

use super::Ink;

/// Look of a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Symbol {
    /// The chosen point, a disc in a ring.
    Design,
    /// A disc.
    Disc,
    /// A ring.
    Ring,
    /// A square.
    Square,
    /// A triangle.
    Triangle,
    /// A small dot on a curve.
    Dot,
}

/// A point with its label.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mark {
    /// Where, SI.
    pub at: [f64; 2],
    /// Look.
    pub symbol: Symbol,
    /// Colour.
    pub ink: Ink,
    /// Label; may be empty.
    pub label: String,
}

impl Mark {
    /// A point.
    pub fn new(at: [f64; 2], symbol: Symbol, ink: Ink, label: impl Into<String>) -> Self {
        Self {
            at,
            symbol,
            ink,
            label: label.into(),
        }
    }

    /// The chosen point, labelled as the design.
    pub fn design(at: [f64; 2]) -> Self {
        Self::new(at, Symbol::Design, Ink::Vermilion, "design")
    }
}

/// Along which axis something is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// A value of x.
    X,
    /// A value of y.
    Y,
}

/// A value that must be reached or kept within.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Limit {
    /// On which axis.
    pub axis: Direction,
    /// Where, SI.
    pub value: f64,
    /// Whether smaller values are forbidden; otherwise greater ones are.
    pub at_least: bool,
    /// Label.
    pub label: String,
}

/// A shaded range of one axis.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Shade {
    /// On which axis.
    pub axis: Direction,
    /// From where to where, SI.
    pub range: [f64; 2],
    /// Label within it; may be empty.
    pub label: String,
}
