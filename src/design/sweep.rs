//! Many designs spread evenly over the design space, each measured once.
//!
//! The designs are a numbered sequence: number 1, 2, 3, … are the same for any number of designs and
//! of threads.

use std::ops::Range;

use super::{
    measure::{Wanted, absence, measure_each, worst},
    sequence::Sequence,
    study::Study,
    tasks::Tasks,
};
use crate::{
    case::Case,
    index::{Demand, Demands, Index},
    optimize::problem::{Failure, Piece, Problem},
    parameter::Parameter,
    spec::Spec,
    track::MAX_DEGREE,
};

/// Design space and measured indices.
#[derive(Debug, Clone)]
pub struct Sweep<'a> {
    spec: &'a Spec,
    indices: Vec<Index>,
    /// A study for each profile to choose from.
    studies: Vec<Study>,
    sequence: Sequence,
    /// Demands in the nominal condition and in the further ones.
    demands: Vec<Demands>,
    /// Wanted measurements in each, the indices first.
    wanted: Vec<Vec<Wanted>>,
}

/// A design of the sweep.
#[derive(Debug, Clone)]
pub struct Design {
    /// Its number, from 1.
    pub number: usize,
    /// The design.
    pub case: Case,
    /// Value of every index, SI, in the nominal condition, or why it has none.
    pub values: Vec<Result<f64, NoValue>>,
    /// True if it meets all demands in every condition; `None` without demands.
    pub meets_all: Option<Meets>,
}

/// Verdict on the demands; a worse one is greater.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Meets {
    /// All of it.
    Yes,
    /// All that the models cover; of the rest they have no verdict.
    NotAssessed,
    /// Not all of it.
    No,
}

impl Meets {
    /// Name in files.
    pub fn code(self) -> &'static str {
        match self {
            Self::Yes => "yes",
            Self::NotAssessed => "not-assessed",
            Self::No => "no",
        }
    }

    /// Verdict of a measured index on a demand; an index without pieces does not exist here and meets it.
    fn new(demand: Demand, measured: Result<Vec<Piece>, Failure>) -> Self {
        match measured.map(|pieces| worst(demand.index, &pieces)) {
            Ok(Some(reached)) if !demand.met_by(reached) => Self::No,
            Ok(None) if !demand.index.needs_service_curve() => Self::No,
            Ok(_) => Self::Yes,
            Err(failure) if failure.is_not_covered() => Self::NotAssessed,
            Err(_) => Self::No,
        }
    }
}

/// Reason why a design has no value of an index.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum NoValue {
    /// It has no such performance.
    #[error(transparent)]
    Failure(#[from] Failure),
    /// Stable over the range of speeds searched; its end, m/s.
    #[error("stable up to {0:.1} m/s")]
    Stable(f64),
    /// It hunts from the start of the range of speeds searched, m/s.
    #[error("hunts already at {0:.1} m/s")]
    Hunts(f64),
    /// No curve is too tight.
    #[error("not limited up to {MAX_DEGREE}°")]
    Unlimited,
}

impl<'a> Sweep<'a> {
    /// Designs of a spec with some of their indices; the seed decides which designs. `None` if the
    /// spec has no open parameter.
    pub fn new(spec: &'a Spec, indices: &[Index], seed: u64) -> Option<Self> {
        let tasks = Tasks::new(spec);
        let studies: Vec<Study> = tasks
            .profiles(&spec.case)
            .iter()
            .map(|conicity| {
                let mut case = spec.case.clone();
                case.wheel_rail.conicity = *conicity;
                tasks.bare(&case, &Index::ALL)
            })
            .collect();
        let demands: Vec<Demands> = (0..=spec.conditions.len())
            .map(|condition| tasks.demands_in(condition))
            .collect();
        let wanted = demands.iter().enumerate().map(|(condition, demands)| {
            let mut all = if condition == 0 {
                indices.to_vec()
            } else {
                Vec::new()
            };
            all.extend(demands.iter().map(|demand| demand.index));
            let mut once: Vec<Index> = Vec::new();
            for index in all {
                if !once.contains(&index) {
                    once.push(index);
                }
            }
            once.into_iter().map(Wanted::Index).collect()
        });
        let sweep = Self {
            spec,
            indices: indices.to_vec(),
            sequence: Sequence::new(seed),
            wanted: wanted.collect(),
            demands,
            studies,
        };
        (sweep.variables() > 0).then_some(sweep)
    }

    /// The indices.
    pub fn indices(&self) -> &[Index] {
        &self.indices
    }

    /// The parameters that the spec's `[design]` names, tied and fixed ones too.
    pub fn parameters(&self) -> impl Iterator<Item = Parameter> {
        self.spec.design.parameters.iter().map(|(p, _)| *p)
    }

    /// True if anything is asked of a design.
    pub fn asks(&self) -> bool {
        self.demands
            .iter()
            .any(|demands| demands.iter().count() > 0)
    }

    /// Dimensions of the space of designs: variables, and the profile where there is a choice.
    fn variables(&self) -> usize {
        let choice = usize::from(self.studies.len() > 1);
        self.studies[0].variables().len() + choice
    }

    /// Designs of some numbers, from 1.
    pub fn designs(&self, numbers: Range<usize>) -> Vec<Design> {
        numbers.map(|number| self.design(number)).collect()
    }

    /// Design of a number, from 1.
    fn design(&self, number: usize) -> Design {
        let mut x = self.sequence.point(number - 1, self.variables());
        let profiles = self.studies.len();
        let profile = if profiles > 1 {
            let at = x.pop().unwrap_or_default();
            // At least 0 and below the number of profiles.
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let profile = (at * profiles as f64) as usize;
            profile.min(profiles - 1)
        } else {
            0
        };
        let study = &self.studies[profile];
        let case = study.design(&x);
        let mut values = Vec::new();
        let mut meets = Meets::Yes;
        for (condition, (demands, wanted)) in self.demands.iter().zip(&self.wanted).enumerate() {
            if wanted.is_empty() {
                continue;
            }
            let applied = study.in_condition(&case, condition);
            let measured = measure_each(&applied, wanted);
            let of = |index: Index| {
                let at = wanted.iter().position(|w| *w == Wanted::Index(index));
                at.map_or(Err(Failure::NoMode), |at| measured[at].clone())
            };
            if condition == 0 {
                let value = |index: &Index| value(&applied, *index, &of(*index)?);
                values = self.indices.iter().map(value).collect();
            }
            for demand in demands.iter() {
                meets = meets.max(Meets::new(demand, of(demand.index)));
            }
        }
        Design {
            number,
            case,
            values,
            meets_all: self.asks().then_some(meets),
        }
    }
}

/// Value of an index from its pieces; an end of the range searched is no value.
fn value(case: &Case, index: Index, pieces: &[Piece]) -> Result<f64, NoValue> {
    let value = worst(index, pieces).ok_or_else(|| absence(index))?;
    if !value.is_finite() {
        return Err(Failure::NotFinite.into());
    }
    let [low, high] = case.model.speed_range;
    match index {
        Index::CriticalSpeed if value <= low => Err(NoValue::Hunts(low)),
        Index::CriticalSpeed if value >= high => Err(NoValue::Stable(high)),
        Index::DegreeCurve | Index::FlangeLimitedCurve | Index::SlipLimitedCurve
            if value >= MAX_DEGREE.to_radians() =>
        {
            Err(NoValue::Unlimited)
        }
        _ => Ok(value),
    }
}
