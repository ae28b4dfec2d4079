//! Linear forms in coordinates and inputs: what a spring feels, where its force acts.

use std::ops::{Add, Mul, Neg, Sub};

use smallvec::{SmallVec, smallvec};

/// A linear form Σ cᵢ xᵢ over the coordinates q and the inputs u of a model, in one numbering.
///
/// Written as algebra: `y_c() + l_s * psi_c() - y_t(0)`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Row(SmallVec<[(usize, f64); 6]>);

impl Row {
    /// The form xᵢ.
    pub fn unit(index: usize) -> Self {
        Self(smallvec![(index, 1.0)])
    }

    /// Terms (index, coefficient); an index may recur.
    pub fn terms(&self) -> &[(usize, f64)] {
        &self.0
    }
}

impl Add for Row {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        self.0.extend(other.0);
        self
    }
}

impl Neg for Row {
    type Output = Self;

    fn neg(self) -> Self {
        -1.0 * self
    }
}

impl Sub for Row {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul<Row> for f64 {
    type Output = Row;

    fn mul(self, mut row: Row) -> Row {
        for (_, coefficient) in &mut row.0 {
            *coefficient *= self;
        }
        row
    }
}
