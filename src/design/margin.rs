//! Margins of a design against its demands, in every condition.

use rayon::prelude::*;

use super::measure::{Wanted, absence, measure_each, worst};
use crate::{
    case::Case,
    evaluate::curving::{CurveStatus, ServiceCurve},
    index::{Demand, Demands, Index},
    optimize::problem::Failure,
    spec::Condition,
};

/// A demand and the value that a design reaches.
#[derive(Debug, Clone, PartialEq)]
pub struct Margin {
    /// Index.
    pub index: Index,
    /// In which condition; `None` for the nominal one.
    pub condition: Option<String>,
    /// Bound, SI.
    pub required: f64,
    /// Value reached, SI, or the reason why there is none.
    pub reached: Result<f64, Failure>,
    /// Status of the curve of the service, where the model does not cover it and the demand is on a
    /// force or stroke there.
    pub curve: Option<CurveStatus>,
    /// Largest ratio to flange contact or slip there, if it is known.
    pub curve_ratio: Option<f64>,
}

/// Verdict on a demand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// It keeps the bound.
    Met,
    /// It does not, or it has no such performance.
    NotMet,
    /// The model does not cover the index there.
    NotAssessed,
}

impl Margin {
    fn demand(&self) -> Demand {
        Demand {
            index: self.index,
            bound: self.required,
        }
    }

    /// Verdict on the design.
    pub fn verdict(&self) -> Verdict {
        match self.reached {
            Ok(reached) if self.demand().met_by(reached) => Verdict::Met,
            Err(failure) if failure.is_not_covered() => Verdict::NotAssessed,
            _ => Verdict::NotMet,
        }
    }

    /// True if the demand is met.
    pub fn met(&self) -> bool {
        self.verdict() == Verdict::Met
    }

    /// Shortfall of the value reached against the bound, relative, or absolute for damping ratios; 0 if
    /// the demand is met. The shortfall of a demand that is not assessed is larger than that of any value
    /// and grows with the distance of the curve from the model's limits; without a value it is infinite.
    pub fn shortfall(&self) -> f64 {
        /// More than any value falls short by.
        const NOT_ASSESSED: f64 = 1e9;
        match (&self.reached, self.curve_ratio) {
            (Ok(_), _) if self.met() => 0.0,
            (Ok(reached), _) => self.demand().shortfall(*reached).min(NOT_ASSESSED),
            (Err(_), Some(ratio)) => NOT_ASSESSED * (1.0 + ratio),
            (Err(_), None) => f64::INFINITY,
        }
    }

    /// Path of the demand in the spec.
    pub fn key(&self) -> String {
        match &self.condition {
            Some(name) => format!("conditions.{name}.{}", self.index.path()),
            None => self.index.path().into(),
        }
    }
}

/// Value of an index in a case, SI.
///
/// # Errors
///
/// [`Failure`] where the case has no such performance.
pub fn value(case: &Case, index: Index) -> Result<f64, Failure> {
    let measured = measure_each(case, &[Wanted::Index(index)]);
    let pieces = measured.into_iter().next();
    let pieces = pieces.unwrap_or_else(|| Err(absence(index)))?;
    worst(index, &pieces).ok_or_else(|| absence(index))
}

/// The worst value of an index over the nominal and further conditions, SI. A condition without the
/// curve that an index belongs to does not count.
///
/// # Errors
///
/// [`Failure`] where the case has no such performance in one of them.
pub fn worst_value(case: &Case, conditions: &[Condition], index: Index) -> Result<f64, Failure> {
    let further = conditions.par_iter().map(|condition| condition.apply(case));
    let values = rayon::iter::once(case.clone()).chain(further);
    let values: Vec<_> = values.map(|case| value(&case, index)).collect();
    let values = values
        .into_iter()
        .filter(|value| *value != Err(Failure::NoServiceCurve));
    let all: Vec<f64> = values.collect::<Result<_, _>>()?;
    index.worst(all.into_iter()).ok_or(Failure::NoServiceCurve)
}

/// All demands on a design. A demand on an index of a curve is none where there is no curve.
pub fn margins(case: &Case, demands: &Demands, conditions: &[Condition]) -> Vec<Margin> {
    let nominal = std::iter::once((None, case.clone(), demands.clone()));
    let further = conditions.iter().map(|condition| {
        let demands = demands.overridden(&condition.demands);
        (Some(condition.name.clone()), condition.apply(case), demands)
    });
    let all: Vec<_> = nominal.chain(further).collect();
    all.into_par_iter()
        .flat_map_iter(|(condition, case, demands)| {
            let margins: Vec<Margin> = demands
                .iter()
                .map(|demand| {
                    let reached = value(&case, demand.index);
                    let curve = match reached {
                        Err(failure) if failure.is_not_covered() => ServiceCurve::of(&case).ok(),
                        _ => None,
                    };
                    let ratios = curve.as_ref().and_then(|curve| curve.state.as_ref());
                    let ratios = ratios.map(|state| state.limit_ratios);
                    Margin {
                        curve_ratio: ratios.map(|all| all.into_iter().fold(0.0, f64::max)),
                        index: demand.index,
                        condition: condition.clone(),
                        required: demand.bound,
                        reached,
                        curve: curve.map(|curve| curve.status),
                    }
                })
                .filter(|margin| margin.reached != Err(Failure::NoServiceCurve))
                .collect();
            margins
        })
        .collect()
}
