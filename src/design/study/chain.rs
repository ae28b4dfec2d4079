//! From derivatives by the constants of Table 4.1.1 to gradients over a study's variables.

use super::Study;
use crate::{
    case::Case, evaluate::gradients::five_point, optimize::problem::Scale, parameter::Parameter,
};

/// How the constants of a case follow the variables at a design.
pub(super) struct Chain {
    /// Constants that move.
    pub constants: Vec<Parameter>,
    /// Derivative of each by the scaled coordinate of each parameter.
    by_parameters: Vec<Vec<f64>>,
    /// Number of parameters.
    count: usize,
    /// Derivative of the epigraph speed by its own coordinate, if there is one, m/s.
    speed: Option<f64>,
}

/// Step in the derivative of the polynomial through five values, as a share of the value or, on a
/// linear scale, of the range. Constants are powers and products of the parameters: it leaves 1e-12.
const STEP: f64 = 1e-3;
/// A relative change over the whole range below this is rounding.
const ROUNDING: f64 = 1e-10;

/// Whether a case that has been moved is another one with its constants of Table 4.1.1.
fn follows_from_the_ten(case: &Case, moved: &Case) -> bool {
    let mut set = case.clone();
    for constant in Parameter::TEN {
        constant.set(&mut set, constant.get(moved));
    }
    set == *moved
}

impl Chain {
    /// At scaled coordinates `x`, in a condition. `None` if a variable changes anything but the
    /// constants of Table 4.1.1: derivatives by these are then not the whole.
    pub fn new(study: &Study, x: &[f64], condition: usize) -> Option<Self> {
        let count = study.parameters.len();
        let mut values = study.values(x);
        values.truncate(count);
        let case = study.in_condition(&study.with_values(&values), condition);
        let mut by_parameters = vec![vec![0.0; count]; Parameter::TEN.len()];
        for (i, variable) in study.variables.iter().take(count).enumerate() {
            let [low, high] = variable.bounds;
            let step = STEP
                * match variable.scale {
                    Scale::Logarithmic => values[i],
                    Scale::Linear => high - low,
                };
            if step == 0.0 {
                continue;
            }
            let at = |k: f64| {
                let mut moved = values.clone();
                moved[i] += k * step;
                study.in_condition(&study.with_values(&moved), condition)
            };
            let around = [-2.0, -1.0, 1.0, 2.0].map(at);
            if !around
                .iter()
                .all(|moved| follows_from_the_ten(&case, moved))
            {
                return None;
            }
            let around = around.map(|case| Parameter::TEN.map(|constant| constant.get(&case)));
            let slope = variable.slope(values[i]);
            for (k, by) in by_parameters.iter_mut().enumerate() {
                let at = around.map(|constants| constants[k]);
                let change = slope * five_point(at, step);
                if change.abs() > ROUNDING * at[0].abs() {
                    by[i] = change;
                }
            }
        }
        let moves = |k: &usize| by_parameters[*k].iter().any(|slope| *slope != 0.0);
        let moving: Vec<usize> = (0..Parameter::TEN.len()).filter(moves).collect();
        let speed = study.has_epigraph.then(|| {
            let variable = &study.variables[count];
            variable.slope(variable.value(x[count]))
        });
        Some(Self {
            constants: moving.iter().map(|k| Parameter::TEN[*k]).collect(),
            by_parameters: moving.iter().map(|k| by_parameters[*k].clone()).collect(),
            count,
            speed,
        })
    }

    /// Gradient over the variables of what has such derivatives by the constants, and behind them
    /// perhaps one by a speed, which is the epigraph study or is not.
    pub fn gradient(&self, derivatives: &[f64], has_epigraph: bool) -> Vec<f64> {
        let mut gradient = vec![0.0; self.count];
        for (derivative, by) in derivatives.iter().zip(&self.by_parameters) {
            for (sum, slope) in gradient.iter_mut().zip(by) {
                *sum += derivative * slope;
            }
        }
        if let Some(slope) = self.speed {
            let by_speed = derivatives
                .get(self.constants.len())
                .filter(|_| has_epigraph);
            gradient.push(by_speed.map_or(0.0, |derivative| derivative * slope));
        }
        gradient
    }

    /// Gradient of the epigraph speed itself.
    pub fn of_speed(&self) -> Vec<f64> {
        let mut gradient = vec![0.0; self.count];
        gradient.extend(self.speed);
        gradient
    }
}
