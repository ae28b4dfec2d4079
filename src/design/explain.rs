//! A solved study in an engineer's terms: active limits, their prices, and sensitivities.

use super::{
    price::{Price, prices, relative},
    search::Searched,
    study::Study,
};
use crate::{
    index::Index,
    optimize::{
        certificate::Curvature,
        local::Status,
        problem::{Detail, Piece, Problem, Values, Variable, largest},
        solve::{Coverage, Effort, Optimum},
    },
    parameter::Parameter,
};

/// A variable and its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Chosen {
    /// Variable.
    pub parameter: Parameter,
    /// The variable with its bounds.
    pub variable: Variable,
    /// Its value, SI.
    pub value: f64,
    /// True if it lies on its lower or upper bound.
    pub at_bound: Option<Bound>,
    /// Relative gain of the objective per relative move outwards of the bound that it lies on.
    pub bound_price: f64,
    /// Change of the scaled objective per relative increase of the value: as it is, whatever limits
    /// it would break. `None` where it is not known.
    pub elasticity: Option<f64>,
}

/// An end of a variable's range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bound {
    /// The lower end.
    Lower,
    /// The upper end.
    Upper,
}

/// The single index behind an objective.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Objective {
    /// Index.
    pub index: Index,
    /// Its value, SI.
    pub value: f64,
    /// Its change, SI, with that of the scaled objective.
    pub per_merit: f64,
}

/// A local optimum of the objective.
#[derive(Debug, Clone, PartialEq)]
pub struct LocalOptimum {
    /// Σ of the scaled objectives; `None` for the design of least violation, where searches ended
    /// without a feasible one.
    pub merit: Option<f64>,
    /// Value of the objective's index, SI, where it is a single one and a design is feasible.
    pub value: Option<f64>,
    /// Values of the variables, SI, in the order of [`Explained::chosen`].
    pub at: Vec<f64>,
    /// Local searches that came to it.
    pub searches: usize,
}

/// A solved study explained.
#[derive(Debug, Clone, PartialEq)]
pub struct Explained {
    /// Goal: the objective in words.
    pub goal: String,
    /// The objective's index where it is a single one.
    pub objective: Option<Objective>,
    /// Σ of the scaled objectives; `None` if the design has none.
    pub merit: Option<f64>,
    /// Variables with their values.
    pub chosen: Vec<Chosen>,
    /// Status of the search.
    pub status: Status,
    /// Residual of the first-order conditions, scaled; `None` where they were not verified.
    pub kkt_residual: Option<f64>,
    /// Second-order condition.
    pub curvature: Option<Curvature>,
    /// Largest relative violation of a demand; `None` if the design has no performance.
    pub violation: Option<f64>,
    /// True if bounds of missed demands are relaxed: multipliers are then neither prices nor gains.
    pub is_relaxed: bool,
    /// Limits that hold the design back, by name.
    pub active: Vec<String>,
    /// Demands that hold it back, with their prices.
    pub prices: Vec<Price>,
    /// Different local optima that were found, the best first.
    pub optima: Vec<LocalOptimum>,
    /// Coverage of the space; `None` if the search stayed near known designs.
    pub coverage: Option<Coverage>,
    /// Effort.
    pub effort: Effort,
}

/// Pieces within this of the largest, or of their limit, count as active: 0.1 %.
const ACTIVE: f64 = 1e-3;

impl Explained {
    /// Explains a solved study whose goal in words is `goal`.
    pub fn new(searched: &Searched, goal: String) -> Self {
        let Searched { study, solved, .. } = searched;
        let x = &solved.point.x;
        let values = solved.point.values.as_ref().ok();
        let certificate = solved.certificate.as_ref();
        let mut explained = Self {
            goal,
            objective: None,
            merit: values.map(Values::objective),
            chosen: Vec::new(),
            status: solved.status,
            kkt_residual: certificate.map(|c| c.kkt_residual),
            curvature: certificate.and_then(|c| c.curvature),
            violation: values.map(|v| v.violation().max(searched.violation())),
            is_relaxed: !searched.missed.is_empty(),
            active: Vec::new(),
            prices: Vec::new(),
            optima: optima(study, &solved.optima),
            coverage: solved.coverage,
            effort: solved.effort.clone(),
        };
        let slopes = objective_slopes(study, x);
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
                elasticity: slopes.as_ref().map(|slopes| slopes[i] * relative),
            });
        }
        if let Some(values) = values {
            explained.objective = single_objective(study, values);
            explained.active = active(study, values);
            if let Some(certificate) = certificate
                && solved.point.feasible()
            {
                explained.prices = prices(searched, values, certificate);
            }
        }
        explained
    }

    /// Relative change of the objective's index per relative increase of a variable, whatever limits
    /// that would break; of several objectives, the gain of their sum. `None` where it is not known.
    pub fn gain_per_share(&self, chosen: &Chosen) -> Option<f64> {
        let elasticity = chosen.elasticity?;
        Some(match self.objective {
            Some(objective) => objective.per_merit * elasticity / objective.value,
            None => -elasticity,
        })
    }

    /// Change of the objective, in SI of its index or as a share, per SI unit of a demand's bound.
    pub fn price(&self, price: &Price) -> f64 {
        self.objective.map_or(1.0, |o| o.per_merit) * price.per_unit
    }

    /// Relative gain of the objective's index, or gain of the sum, per relative move of a bound of
    /// `[design]` outwards.
    pub fn bound_gain(&self, chosen: &Chosen) -> f64 {
        let share = self
            .objective
            .map_or(1.0, |o| (o.per_merit / o.value).abs());
        share * chosen.bound_price
    }
}

/// The local optima of a study in its own terms.
fn optima(study: &Study, found: &[Optimum]) -> Vec<LocalOptimum> {
    let place = |x: &[f64]| {
        let pairs = study
            .variables()
            .iter()
            .zip(x)
            .take(study.parameters().len());
        pairs.map(|(variable, x)| variable.value(*x)).collect()
    };
    let optimum = |optimum: &Optimum| {
        let point = &optimum.found.point;
        let values = point
            .values
            .as_ref()
            .ok()
            .filter(|values| values.feasible());
        let objective = values.and_then(|values| single_objective(study, values));
        LocalOptimum {
            merit: values.map(Values::objective),
            value: objective.map(|objective| objective.value),
            at: place(&point.x),
            searches: optimum.searches,
        }
    };
    found.iter().map(optimum).collect()
}

/// Pieces this close to the largest decide with it which way the objective goes.
const TIED: f64 = 1e-6;

/// Derivative of the objective with each scaled coordinate as that increases: of pieces that are largest
/// together, the greatest. The critical speed counts as itself, whether
/// or not the study has an epigraph variable. `None` where gradients are not known.
fn objective_slopes(study: &Study, x: &[f64]) -> Option<Vec<f64>> {
    let study = study.without_epigraph();
    let n = study.variables().len();
    let measured = study.measure(&x[..n], Detail::Gradients).ok()?;
    let mut slopes = vec![0.0; n];
    for pieces in study.judge(&measured).objectives {
        let worst = largest(&pieces);
        let tied = pieces.iter().filter(|piece| piece.value >= worst - TIED);
        let gradients: Vec<&Vec<f64>> = tied
            .map(|piece| piece.gradient.as_ref())
            .collect::<Option<_>>()?;
        for (i, slope) in slopes.iter_mut().enumerate() {
            let along = gradients.iter().map(|gradient| gradient[i]);
            *slope += along.fold(f64::NEG_INFINITY, f64::max);
        }
    }
    Some(slopes)
}

/// The index behind the objective, if all of its pieces are of one.
fn single_objective(study: &Study, values: &Values) -> Option<Objective> {
    let [pieces] = &values.objectives[..] else {
        return None;
    };
    objective_of(study, pieces)
}

/// The index behind the pieces of one objective, if all are of one.
pub(super) fn objective_of(study: &Study, pieces: &[Piece]) -> Option<Objective> {
    let worst = pieces.iter().max_by(|a, b| a.value.total_cmp(&b.value))?;
    let term = &study.terms()[study.term_of(worst.index)];
    let same = pieces
        .iter()
        .all(|p| study.terms()[study.term_of(p.index)].index == term.index);
    let [value, per_merit] = study.index_at(term, worst.value)?;
    same.then_some(Objective {
        index: term.index,
        value,
        per_merit,
    })
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
