//! Exact derivatives of what is a polynomial of low degree in a design constant.

use crate::{case::Case, parameter::Parameter, wheel_rail};

/// Cases whose weighted sum is the derivative by one constant of Table 4.1.1.
///
/// The matrices of all models are affine in every stiffness, damping and torque, so two cases give the
/// slope exactly, and the further apart they are the less is lost by cancellation. Between two rows of
/// the table of wheel profiles every coefficient is linear in the conicity and the matrices hold
/// products of at most two, so three cases do. The models are built, not solved.
#[derive(Debug, Clone)]
pub(super) struct Stencil {
    /// Weight of the case itself.
    own: f64,
    /// Other cases with their weights.
    others: Vec<(f64, Case)>,
}

/// The other case has so many times the constant.
const FAR: f64 = 1e6;

impl Stencil {
    /// By a constant (of [`Parameter::TEN`]) at a case.
    pub fn new(case: &Case, constant: Parameter) -> Self {
        let value = constant.get(case);
        let at = |value: f64| {
            let mut other = case.clone();
            constant.set(&mut other, value);
            other
        };
        if constant != Parameter::Conicity {
            let step = FAR * value.abs().max(1.0);
            return Self {
                own: -1.0 / step,
                others: vec![(1.0 / step, at(value + step))],
            };
        }
        let [low, high] = wheel_rail::rows_around(value);
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

    /// What a function of the case becomes, with its weight, at every case but the one at hand.
    pub fn others<T>(&self, of: impl Fn(&Case) -> T) -> Vec<(f64, T)> {
        let others = self.others.iter();
        others.map(|(weight, case)| (*weight, of(case))).collect()
    }

    /// Weight of the case at hand.
    pub fn own(&self) -> f64 {
        self.own
    }
}
