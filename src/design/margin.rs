//! How a design stands to what is asked of it, in every condition.

use super::measure::{Wanted, measure, worst};
use crate::{
    case::Case,
    index::{Demand, Demands, Index, Sense},
    optimize::problem::Failure,
    spec::Condition,
};

/// A demand and what a design reaches.
#[derive(Debug, Clone, PartialEq)]
pub struct Margin {
    /// On what.
    pub index: Index,
    /// In which condition; `None` for the nominal one.
    pub condition: Option<String>,
    /// What is asked for, SI.
    pub required: f64,
    /// What is reached, SI, or why there is no such performance.
    pub reached: Result<f64, Failure>,
}

impl Margin {
    fn demand(&self) -> Demand {
        Demand {
            index: self.index,
            bound: self.required,
        }
    }

    /// Whether the demand is met.
    pub fn met(&self) -> bool {
        self.reached
            .as_ref()
            .is_ok_and(|reached| self.demand().met_by(*reached))
    }

    /// How far the value reached falls short of the bound, relative, or as it is for damping ratios;
    /// 0 if the demand is met, infinite if it has no value.
    pub fn shortfall(&self) -> f64 {
        match &self.reached {
            Ok(_) if self.met() => 0.0,
            Ok(reached) => self.demand().shortfall(*reached),
            Err(_) => f64::INFINITY,
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
    let pieces = measure(case, &[Wanted::Index(index)])?;
    pieces
        .first()
        .and_then(|pieces| worst(index, pieces))
        .ok_or(Failure::NoMode)
}

/// The worst value of an index over the nominal and further conditions, SI.
///
/// # Errors
///
/// [`Failure`] where the case has no such performance in one of them.
pub fn worst_value(case: &Case, conditions: &[Condition], index: Index) -> Result<f64, Failure> {
    let nominal = value(case, index)?;
    conditions.iter().try_fold(nominal, |worst, condition| {
        let value = value(&condition.apply(case), index)?;
        Ok(match index.sense() {
            Sense::AtLeast => worst.min(value),
            Sense::AtMost => worst.max(value),
        })
    })
}

/// All demands on a design.
pub fn margins(case: &Case, demands: &Demands, conditions: &[Condition]) -> Vec<Margin> {
    let nominal = std::iter::once((None, case.clone(), demands.clone()));
    let further = conditions.iter().map(|condition| {
        let demands = demands.overridden(&condition.demands);
        (Some(condition.name.clone()), condition.apply(case), demands)
    });
    nominal
        .chain(further)
        .flat_map(|(condition, case, demands)| {
            let margins: Vec<Margin> = demands
                .iter()
                .map(|demand| Margin {
                    index: demand.index,
                    condition: condition.clone(),
                    required: demand.bound,
                    reached: value(&case, demand.index),
                })
                .collect();
            margins
        })
        .collect()
}
