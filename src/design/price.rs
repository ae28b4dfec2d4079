//! Prices of the active demands.

use super::{search::Searched, study::Role};
use crate::{
    index::Index,
    optimize::{
        certificate::{Certificate, HOLDS},
        problem::{Problem, Scale, Values, Variable},
    },
};

/// A demand that holds the design back.
#[derive(Debug, Clone, PartialEq)]
pub struct Price {
    /// Index.
    pub index: Index,
    /// In which conditions the bound holds the design back; `None` for the nominal one. Conditions that
    /// share a bound share its price.
    pub conditions: Vec<Option<String>>,
    /// The bound, SI.
    pub bound: f64,
    /// Change of the objective, scaled, per relative change of the bound; for damping ratios per
    /// change of the ratio as it is scaled.
    pub multiplier: f64,
    /// Change of the objective, scaled, per SI unit of the bound.
    pub per_unit: f64,
    /// Relative change of the index at the bound per relative change of each variable; `None` where
    /// the bound is zero or the index jumps.
    pub elasticities: Vec<Option<f64>>,
}

/// Change of a scaled coordinate per relative change of the value.
pub(super) fn relative(variable: &Variable, value: f64) -> f64 {
    let [low, high] = variable.bounds;
    match variable.scale {
        Scale::Logarithmic => 1.0 / (high / low).ln(),
        Scale::Linear => value / (high - low),
    }
}

/// Prices of the demands that hold a solution back; none beside relaxed bounds, which nobody asked for.
pub(super) fn prices(
    searched: &Searched,
    values: &Values,
    certificate: &Certificate,
) -> Vec<Price> {
    let Searched { study, solved, .. } = searched;
    let x = &solved.point.x;
    let mut prices: Vec<Price> = Vec::new();
    if !searched.missed.is_empty() {
        return prices;
    }
    let held = values
        .constraints
        .iter()
        .zip(&certificate.constraint_multipliers)
        .zip(&certificate.constraint_gradients);
    for ((piece, &multiplier), gradient) in held {
        if multiplier < HOLDS {
            continue;
        }
        let term = &study.terms()[study.term_of(piece.index)];
        let Role::Constraint { bound } = term.role else {
            continue;
        };
        let condition = study.condition_name(term.condition).map(str::to_owned);
        // An evaluation that fails beside the design tells no price.
        let Ok(slope) = study.slope_of_bound(piece, x) else {
            continue;
        };
        let per_unit = multiplier * slope;
        // The critical speed is kept by a damping ratio: its price is that of the speed.
        let multiplier = match term.index {
            Index::CriticalSpeed => per_unit * bound,
            _ => multiplier,
        };
        let pairs = study.variables().iter().zip(x).zip(gradient);
        // c(v, bound) = 0 gives dv = −∂c/∂x dx / (∂c/∂bound).
        let elasticities: Vec<Option<f64>> = pairs
            .map(|((variable, &x), g)| -g / slope * relative(variable, variable.value(x)) / bound)
            .map(|elasticity| elasticity.is_finite().then_some(elasticity))
            .take(study.parameters().len())
            .collect();
        let known = prices
            .iter_mut()
            .find(|p| p.index == term.index && p.bound.to_bits() == bound.to_bits());
        if let Some(known) = known {
            known.per_unit += per_unit;
            known.multiplier += multiplier;
            if !known.conditions.contains(&condition) {
                known.conditions.push(condition);
            }
        } else {
            prices.push(Price {
                index: term.index,
                conditions: vec![condition],
                bound,
                multiplier,
                per_unit,
                elasticities,
            });
        }
    }
    prices
}
