//! Derivatives of models by a number of the case, from models built with other values of it.

use super::five_point_weights;
use crate::{
    case::Case,
    parameter::{Dependence, Parameter},
};

/// Cases whose weighted sum is the derivative by one number. Models are built of them, not solved.
///
/// | dependence of the matrices | cases beside the one at hand | error |
/// |---|---|---|
/// | affine: stiffness, damping, torque | one, far away, against cancellation | none |
/// | quadratic: the conicity between two rows of the table, whose coefficients are linear there | two | none |
/// | smooth: masses, lengths and others | four, of the polynomial through five values | 4 10⁻¹² of the fifth derivative |
#[derive(Debug, Clone)]
pub(super) struct Stencil {
    /// Weight of the case itself.
    own: f64,
    /// Other cases with their weights.
    others: Vec<(f64, Case)>,
}

/// The far case has so many times the value.
const FAR: f64 = 1e6;
/// Step through five values, as a share of the value; SI units where it is zero.
const STEP: f64 = 1e-3;

impl Stencil {
    /// By a number of the case, see [`Parameter::plain`].
    pub fn new(case: &Case, number: Parameter) -> Self {
        let value = number.get(case);
        let at = |value: f64| {
            let mut other = case.clone();
            number.set(&mut other, value);
            other
        };
        match number.dependence(value) {
            Dependence::Affine => {
                let step = FAR * value.abs().max(1.0);
                Self {
                    own: -1.0 / step,
                    others: vec![(1.0 / step, at(value + step))],
                }
            }
            Dependence::QuadraticBetween([low, high]) => {
                let middle = f64::midpoint(low, high);
                let mut ends = [low, high];
                for end in &mut ends {
                    if (*end - value).abs() < (high - low) / 4.0 {
                        *end = middle;
                    }
                }
                let [a, b] = ends;
                Self {
                    own: 1.0 / (value - a) + 1.0 / (value - b),
                    others: vec![
                        ((value - b) / ((a - value) * (a - b)), at(a)),
                        ((value - a) / ((b - value) * (b - a)), at(b)),
                    ],
                }
            }
            Dependence::Smooth => {
                let step = STEP * if value == 0.0 { 1.0 } else { value };
                let others = five_point_weights(step);
                let others = others.map(|(steps, weight)| (weight, at(value + steps * step)));
                Self {
                    own: 0.0,
                    others: others.into(),
                }
            }
        }
    }

    /// Result of a function for every case but the one at hand, with its weight.
    pub fn others<T>(&self, of: impl Fn(&Case) -> T) -> Vec<(f64, T)> {
        let others = self.others.iter();
        others.map(|(weight, case)| (*weight, of(case))).collect()
    }

    /// Weight of the case at hand.
    pub fn own(&self) -> f64 {
        self.own
    }
}
