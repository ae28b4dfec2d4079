//! From derivatives by the numbers of a case to gradients over a study's variables.

use super::Study;
use crate::{evaluate::gradients::five_point, optimize::problem::Scale, parameter::Parameter};

/// Derivatives of the numbers of a case by the variables at a design.
pub(super) struct Chain {
    /// Numbers that move.
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

impl Chain {
    /// At scaled coordinates `x`, in a condition.
    pub fn new(study: &Study, x: &[f64], condition: usize) -> Self {
        let count = study.parameters.len();
        let mut values = study.values(x);
        values.truncate(count);
        // Numbers that the case has: the others follow from these.
        let case = study.in_condition(&study.with_values(&values), condition);
        let has = |p: &Parameter| p.key_of_constant().get(&case).is_some();
        let numbers: Vec<Parameter> = Parameter::plain().filter(has).collect();
        let mut by_parameters = vec![vec![0.0; count]; numbers.len()];
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
            let slope = variable.slope(values[i]);
            for (number, by) in numbers.iter().zip(&mut by_parameters) {
                let at = around.each_ref().map(|case| number.get(case));
                let change = slope * five_point(at, step);
                if change.abs() > ROUNDING * at[0].abs() {
                    by[i] = change;
                }
            }
        }
        let (constants, by_parameters) = numbers
            .into_iter()
            .zip(by_parameters)
            .filter(|(_, by)| by.iter().any(|slope| *slope != 0.0))
            .unzip();
        let speed = study.has_epigraph.then(|| {
            let variable = &study.variables[count];
            variable.slope(variable.value(x[count]))
        });
        Self {
            constants,
            by_parameters,
            count,
            speed,
        }
    }

    /// Gradient over the variables of what has such derivatives by the numbers, and behind them
    /// perhaps one by a speed, which counts in an epigraph study.
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
