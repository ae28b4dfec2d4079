//! A solved study in an engineer's terms: what holds the design back, at what price, and what the
//! design is sensitive to.

use super::study::{Role, Study};
use crate::{
    index::{Index, Sense},
    optimize::{
        certificate::{Certificate, Curvature, HOLDS},
        local::Status,
        problem::{Piece, Problem, Scale, Values, Variable},
        solve::{Effort, Solved},
    },
    parameter::Parameter,
};

/// A variable and what was chosen for it.
#[derive(Debug, Clone, PartialEq)]
pub struct Chosen {
    /// Which parameter.
    pub parameter: Parameter,
    /// The variable with its bounds.
    pub variable: Variable,
    /// Its value, SI.
    pub value: f64,
    /// Whether it lies on its lower or upper bound.
    pub at_bound: Option<Bound>,
    /// Relative gain of the objective per relative move outwards of the bound that it lies on.
    pub bound_price: f64,
    /// Relative change of the objective per relative change of the value: as it is, whatever
    /// limits it would break.
    pub elasticity: f64,
}

/// An end of a variable's range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// The lower end.
    Lower,
    /// The upper end.
    Upper,
}

/// A demand that holds the design back.
#[derive(Debug, Clone, PartialEq)]
pub struct Price {
    /// On what.
    pub index: Index,
    /// In which condition; `None` for the nominal one.
    pub condition: Option<String>,
    /// The bound, SI.
    pub bound: f64,
    /// Multiplier of the scaled constraint.
    pub multiplier: f64,
    /// Change of the objective, scaled, per SI unit of the bound.
    pub per_unit: f64,
    /// Elasticities of the index with respect to the variables.
    pub elasticities: Vec<f64>,
}

/// A solved study explained.
#[derive(Debug, Clone, PartialEq)]
pub struct Explained {
    /// What was made as good as can be.
    pub goal: String,
    /// The objective's index where it is a single one, and its value, SI.
    pub objective: Option<(Index, f64)>,
    /// Σ of the scaled objectives.
    pub merit: f64,
    /// What was chosen.
    pub chosen: Vec<Chosen>,
    /// How the search ended.
    pub status: Status,
    /// Residual of the first-order conditions, scaled; `None` where they were not verified.
    pub kkt_residual: Option<f64>,
    /// Second-order condition.
    pub curvature: Option<Curvature>,
    /// Largest relative violation of a demand.
    pub violation: f64,
    /// Limits that hold the design back, by name.
    pub active: Vec<String>,
    /// Demands that hold it back, with their prices.
    pub prices: Vec<Price>,
    /// What was spent.
    pub effort: Effort,
}

/// Pieces within this of the largest, or of their limit, count as active: 0.1 %.
const ACTIVE: f64 = 1e-3;

impl Explained {
    /// Explains a solved study whose goal in words is `goal`.
    pub fn new(study: &Study, solved: &Solved, goal: String) -> Self {
        let x = &solved.point.x;
        let values = solved.point.values.as_ref().ok();
        let certificate = solved.certificate.as_ref();
        let mut explained = Self {
            goal,
            objective: None,
            merit: values.map_or(f64::NAN, Values::objective),
            chosen: Vec::new(),
            status: solved.status,
            kkt_residual: certificate.map(|c| c.kkt_residual),
            curvature: certificate.and_then(|c| c.curvature),
            violation: values.map_or(f64::NAN, Values::violation),
            active: Vec::new(),
            prices: Vec::new(),
            effort: solved.effort.clone(),
        };
        let slopes = certificate.map(|c| objective_slopes(c, x.len()));
        let pairs = study.variables().iter().zip(study.parameters());
        for (i, (variable, &parameter)) in pairs.enumerate() {
            let value = variable.value(x[i]);
            let at_bound = if x[i] <= 0.0 {
                Some(Bound::Lower)
            } else if x[i] >= 1.0 {
                Some(Bound::Upper)
            } else {
                None
            };
            let bound = certificate.map_or(0.0, |c| c.bound_multipliers[i].abs());
            let relative = relative(variable, value);
            explained.chosen.push(Chosen {
                parameter,
                variable: variable.clone(),
                value,
                at_bound,
                bound_price: if at_bound.is_some() {
                    bound * relative
                } else {
                    0.0
                },
                elasticity: slopes.as_ref().map_or(0.0, |s| s[i] * relative),
            });
        }
        if let Some(values) = values {
            explained.objective = single_objective(study, values);
            explained.active = active(study, values);
            if let Some(certificate) = certificate
                && solved.point.feasible()
            {
                explained.prices = prices(study, x, values, certificate);
            }
        }
        explained
    }

    /// Relative change of the objective's index per relative change of a variable, whatever limits
    /// that would break; of several objectives, the gain of their sum.
    pub fn gain_per_share(&self, chosen: &Chosen) -> f64 {
        match self.objective {
            Some((index, _)) if index.sense() == Sense::AtMost => chosen.elasticity,
            _ => -chosen.elasticity,
        }
    }

    /// Change of the objective, in SI of its index or as a share, per SI unit of a demand's bound.
    pub fn price(&self, price: &Price) -> f64 {
        match self.objective {
            // f = ± ln v.
            Some((index, value)) => match index.sense() {
                Sense::AtLeast => -value * price.per_unit,
                Sense::AtMost => value * price.per_unit,
            },
            None => price.per_unit,
        }
    }
}

/// Change of a scaled coordinate per relative change of the value.
fn relative(variable: &Variable, value: f64) -> f64 {
    let [low, high] = variable.bounds;
    match variable.scale {
        Scale::Logarithmic => 1.0 / (high / low).ln(),
        Scale::Linear => value / (high - low),
    }
}

/// ∇f by the multipliers of its pieces.
fn objective_slopes(certificate: &Certificate, n: usize) -> Vec<f64> {
    let mut slopes = vec![0.0; n];
    let groups = certificate
        .objective_gradients
        .iter()
        .zip(&certificate.objective_multipliers);
    for (gradients, multipliers) in groups {
        for (gradient, multiplier) in gradients.iter().zip(multipliers) {
            for (slope, g) in slopes.iter_mut().zip(gradient) {
                *slope += multiplier * g;
            }
        }
    }
    slopes
}

/// The index behind the objective, if all of its pieces are of one, and its value.
fn single_objective(study: &Study, values: &Values) -> Option<(Index, f64)> {
    let [pieces] = &values.objectives[..] else {
        return None;
    };
    let worst = pieces.iter().max_by(|a, b| a.value.total_cmp(&b.value))?;
    let term = &study.terms()[study.term_of(worst.index)];
    let same = pieces
        .iter()
        .all(|p| study.terms()[study.term_of(p.index)].index == term.index);
    let value = study.index_at(term, worst.value)?;
    same.then_some((term.index, value))
}

/// Names of the active pieces, each once with all of its conditions, as in "critical speed
/// (nominal, worn)".
fn active(study: &Study, values: &Values) -> Vec<String> {
    let mut active: Vec<(String, Vec<Option<&str>>)> = Vec::new();
    let objectives = values.objectives.iter().flat_map(|pieces| {
        let largest = crate::optimize::problem::largest(pieces);
        let several = pieces.len() > 1;
        pieces
            .iter()
            .filter(move |p| several && p.value > largest - ACTIVE)
    });
    let constraints = values.constraints.iter().filter(|p| p.value > -ACTIVE);
    for piece in objectives.chain(constraints) {
        let name = study.piece_words(piece.index);
        let condition = study.condition_name(study.terms()[study.term_of(piece.index)].condition);
        match active.iter_mut().find(|(known, _)| *known == name) {
            Some((_, conditions)) if conditions.contains(&condition) => {}
            Some((_, conditions)) => conditions.push(condition),
            None => active.push((name, vec![condition])),
        }
    }
    let written = |(name, conditions): (String, Vec<Option<&str>>)| {
        if conditions == [None] {
            return name;
        }
        let conditions = conditions.into_iter().map(|c| c.unwrap_or("nominal"));
        format!("{name} ({})", conditions.collect::<Vec<_>>().join(", "))
    };
    active.into_iter().map(written).collect()
}

fn prices(study: &Study, x: &[f64], values: &Values, certificate: &Certificate) -> Vec<Price> {
    let mut prices: Vec<Price> = Vec::new();
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
        // An evaluation that fails beside the design tells no price.
        let slope = study.slope_of_bound(piece, x).unwrap_or(f64::NAN);
        let per_unit = multiplier * slope;
        let condition = study.condition_name(term.condition).map(str::to_owned);
        let pairs = study.variables().iter().zip(x).zip(gradient);
        let elasticities: Vec<f64> = pairs
            .map(|((variable, &x), g)| g * relative(variable, variable.value(x)))
            .collect();
        let known = prices
            .iter_mut()
            .find(|p| p.index == term.index && p.condition == condition);
        if let Some(known) = known {
            known.per_unit += per_unit;
            known.multiplier += multiplier;
        } else {
            prices.push(Price {
                index: term.index,
                condition,
                bound,
                multiplier,
                per_unit,
                elasticities,
            });
        }
    }
    prices
}

/// The worst value of an index among its pieces.
pub fn worst(index: Index, pieces: &[Piece]) -> Option<f64> {
    let values = pieces.iter().map(|p| p.value);
    match index.sense() {
        Sense::AtLeast => values.min_by(f64::total_cmp),
        Sense::AtMost => values.max_by(f64::total_cmp),
    }
}
