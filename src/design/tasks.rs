//! The studies that a spec asks for: one per trade-off of the report, and all at once.

use super::study::{Rule, Study};
use crate::{
    case::Case,
    index::{Behaviour, Demands, Index},
    parameter::{Parameter, TradeOff},
    spec::{Condition, DesignSpace, Freedom, Goal, Spec},
};

/// A study with its goal in words.
#[derive(Debug, Clone)]
pub struct Task {
    /// The trade-off; `None` for all at once.
    pub trade_off: Option<TradeOff>,
    /// Goal.
    pub goal: String,
    /// The problem.
    pub study: Study,
}

/// Tasks of a spec.
pub struct Tasks<'a> {
    space: &'a DesignSpace,
    objective: &'a [Goal],
    demands: &'a Demands,
    conditions: &'a [Condition],
}

/// Ratio to flange contact or slip up to which the linear model covers a curve.
const WITHIN_MODEL: f64 = 1.0;

/// Pieces of an index that a trade-off's parameters decide: it keeps the demand on them.
enum Concern {
    None,
    All,
    Pieces(&'static [usize]),
}

fn concern(trade_off: TradeOff, index: Index) -> Concern {
    use TradeOff::{Lateral, StabilityCurving, Vertical};
    let concerned = match (trade_off, index) {
        // Pieces of the frequency separation: lateral, vertical, roll, yaw, pitch.
        (Vertical, Index::FrequencySeparation) => return Concern::Pieces(&[1, 4]),
        (Lateral, Index::FrequencySeparation) => return Concern::Pieces(&[0, 2]),
        (StabilityCurving, Index::FrequencySeparation) => return Concern::Pieces(&[3]),
        (Vertical, _) => matches!(
            index.behaviour(),
            Behaviour::VerticalRide | Behaviour::Statics
        ),
        (Lateral, _) => index.behaviour() == Behaviour::LateralRide,
        (
            StabilityCurving,
            Index::PrimaryLateralStroke
            | Index::PrimaryLongitudinalStroke
            | Index::WheelsetExcursion,
        ) => true,
        (StabilityCurving, _) => {
            matches!(index.behaviour(), Behaviour::Stability | Behaviour::Curving)
        }
    };
    if concerned {
        Concern::All
    } else {
        Concern::None
    }
}

impl<'a> Tasks<'a> {
    /// The tasks of a spec.
    pub fn new(spec: &'a Spec) -> Self {
        Self {
            space: &spec.design,
            objective: &spec.objective,
            demands: &spec.demands,
            conditions: &spec.conditions,
        }
    }

    /// The case nearest to one given that the design space allows: open parameters within their bounds,
    /// one of the profiles, and all rules applied.
    pub fn admissible(&self, given: &Case) -> Case {
        let mut case = given.clone();
        // A rule may depend on a value set after it.
        for _ in 0..=self.space.parameters.len().max(1) {
            for (parameter, freedom) in self.space.in_setting_order() {
                let value = parameter.get(&case);
                let allowed = match freedom {
                    Freedom::Between(bounds) => value.clamp(bounds.lower, bounds.upper),
                    Freedom::Choices(_) => self.profiles(&case)[0],
                    Freedom::Fixed(fixed) => *fixed,
                    Freedom::Tied { to, ratio } => ratio * to.get(&case),
                };
                // An allowed value keeps its bits.
                if (allowed - value).abs() > 0.0 {
                    parameter.set(&mut case, allowed);
                }
            }
        }
        case
    }

    /// True if a trade-off has anything to choose.
    pub fn open(&self, trade_off: TradeOff) -> bool {
        self.space.parameters.iter().any(|(parameter, freedom)| {
            parameter.trade_off() == trade_off
                && matches!(freedom, Freedom::Between(_) | Freedom::Choices(_))
        })
    }

    /// True if a tie reaches from one trade-off into another, so that they cannot be taken in turn.
    pub fn entangled(&self) -> bool {
        self.space.parameters.iter().any(|(parameter, freedom)| {
            matches!(freedom, Freedom::Tied { to, .. } if to.trade_off() != parameter.trade_off())
        })
    }

    /// Conicities of the profiles to choose from, the present one first. Without a choice: the case's own.
    pub fn profiles(&self, case: &Case) -> Vec<f64> {
        let own = case.wheel_rail.conicity;
        let mut profiles = match self.space.freedom(Parameter::CONICITY) {
            Some(Freedom::Choices(choices)) => choices.clone(),
            _ => vec![own],
        };
        profiles.sort_by(|a, b| (a - own).abs().total_cmp(&(b - own).abs()));
        profiles
    }

    /// Demands in a condition; the nominal one has number 0.
    pub(super) fn demands_in(&self, condition: usize) -> Demands {
        match condition.checked_sub(1) {
            None => self.demands.clone(),
            Some(i) => self.demands.overridden(&self.conditions[i].demands),
        }
    }

    /// A study of the parameters that `varies` selects, with all rules and no terms yet.
    fn study(&self, case: &Case, varies: impl Fn(Parameter) -> bool) -> Study {
        let mut study = Study::new(case, self.conditions);
        for (parameter, freedom) in &self.space.parameters {
            study = match freedom {
                Freedom::Between(bounds) if varies(*parameter) => study.vary(*parameter, *bounds),
                Freedom::Between(_) | Freedom::Choices(_) => study,
                Freedom::Fixed(value) => study.rule(*parameter, Rule::Fixed(*value)),
                Freedom::Tied { to, ratio } => study.rule(
                    *parameter,
                    Rule::Tied {
                        to: *to,
                        ratio: *ratio,
                    },
                ),
            };
        }
        study
    }

    /// The objective of a trade-off, its goal in words, and the demands that become objectives.
    fn objective_of(&self, study: Study, trade_off: TradeOff, group: usize) -> (Study, String) {
        let ride = |acceleration: Index, stroke: Index| {
            // With a limit on the stroke, the least acceleration within it decides whether a
            // required acceleration can be had; without one, the required acceleration allows the
            // least stroke.
            if self.demands.get(acceleration).is_some() && self.demands.get(stroke).is_none() {
                (
                    vec![(stroke, 1.0)],
                    "least secondary stroke with the required acceleration",
                )
            } else {
                (
                    vec![(acceleration, 1.0)],
                    "least average RMS acceleration within the limits",
                )
            }
        };
        let (indices, goal) = match trade_off {
            TradeOff::Vertical => ride(Index::VerticalAcceleration, Index::SecondaryVerticalStroke),
            TradeOff::Lateral => ride(Index::LateralAcceleration, Index::SecondaryLateralStroke),
            TradeOff::StabilityCurving => {
                let speed = self.demands.get(Index::CriticalSpeed);
                let curve = self.demands.get(Index::DegreeCurve);
                match (speed, curve) {
                    (Some(speed), Some(curve)) => (
                        vec![(Index::CriticalSpeed, speed), (Index::DegreeCurve, curve)],
                        "largest smaller margin of critical speed and degree curve",
                    ),
                    (None, Some(_)) => (
                        vec![(Index::CriticalSpeed, 1.0)],
                        "highest critical speed with the required degree curve",
                    ),
                    _ => (
                        vec![(Index::DegreeCurve, 1.0)],
                        "highest degree curve with the required critical speed",
                    ),
                }
            }
        };
        let mut study = study;
        for condition in 0..study.conditions() {
            let demands = self.demands_in(condition);
            for (index, origin) in &indices {
                // With several indices in one group margins over the demands are compared.
                let origin = match indices.len() {
                    1 => *origin,
                    _ => demands.get(*index).unwrap_or(*origin),
                };
                study = study.optimise_from(condition, *index, group, 1.0, origin);
            }
        }
        (study, goal.into())
    }

    /// Task of one trade-off of a case, whose other parameters stay.
    pub fn trade_off(&self, case: &Case, trade_off: TradeOff) -> Task {
        let study = self.study(case, |parameter| parameter.trade_off() == trade_off);
        let (mut study, goal) = self.objective_of(study, trade_off, 0);
        for condition in 0..study.conditions() {
            for demand in self.demands_in(condition).iter() {
                study = match concern(trade_off, demand.index) {
                    Concern::None => study,
                    Concern::All => study.demand(condition, demand.index, demand.bound),
                    Concern::Pieces(pieces) => {
                        study.demand_of(condition, demand.index, demand.bound, pieces)
                    }
                };
            }
        }
        if trade_off == TradeOff::StabilityCurving {
            study = self.within_model(study, case, &[]);
        }
        Task {
            trade_off: Some(trade_off),
            goal,
            study,
        }
    }

    /// The study with the demand that the linear model covers the service curve, in every condition in
    /// which it, or one of the indices beside it, asks for forces or strokes there.
    fn within_model(&self, mut study: Study, case: &Case, also: &[Index]) -> Study {
        for condition in 0..study.conditions() {
            let here = study
                .terms()
                .iter()
                .filter(|term| term.condition == condition);
            let mut asks = here.map(|term| term.index).chain(also.iter().copied());
            let asked = asks.any(Index::is_in_service_curve);
            let service = study.in_condition(case, condition).service;
            // The tightest curve without contact or slip is within the model without more.
            let is_given = service.curve.is_some() || service.cant_deficiency() != 0.0;
            let own = self.demands_in(condition).get(Index::CurveLimitRatio);
            let own = own.is_some_and(|own| own <= WITHIN_MODEL);
            if asked && is_given && !own && !also.contains(&Index::CurveLimitRatio) {
                study = study.imply(condition, Index::CurveLimitRatio, WITHIN_MODEL);
            }
        }
        study
    }

    /// Everything at once: the spec's own objective, or the sum of the trade-offs'.
    pub fn joint(&self, case: &Case) -> Task {
        let mut study = self.study(case, |_| true);
        let goal;
        if self.objective.is_empty() {
            let open: Vec<TradeOff> = [
                TradeOff::Vertical,
                TradeOff::StabilityCurving,
                TradeOff::Lateral,
            ]
            .into_iter()
            .filter(|t| self.open(*t))
            .collect();
            let mut goals = Vec::new();
            for (group, trade_off) in open.iter().enumerate() {
                let (next, words) = self.objective_of(study, *trade_off, group);
                study = next;
                goals.push(words);
            }
            goal = match goals.len() {
                1 => goals.remove(0),
                _ => "greatest sum of the trade-offs' relative gains".into(),
            };
        } else {
            for (group, aim) in self.objective.iter().enumerate() {
                for condition in 0..study.conditions() {
                    study = study.optimise(condition, aim.index, group, aim.weight);
                }
            }
            goal = in_words(self.objective);
        }
        for condition in 0..study.conditions() {
            for demand in self.demands_in(condition).iter() {
                study = study.demand(condition, demand.index, demand.bound);
            }
        }
        Task {
            trade_off: None,
            goal,
            study: self.within_model(study, case, &[]),
        }
    }

    /// All parameters and demands, with objectives of the caller's.
    pub fn bare(&self, case: &Case, drop: &[Index]) -> Study {
        let mut study = self.study(case, |_| true);
        for condition in 0..study.conditions() {
            for demand in self.demands_in(condition).iter() {
                if !drop.contains(&demand.index) {
                    study = study.demand(condition, demand.index, demand.bound);
                }
            }
        }
        self.within_model(study, case, drop)
    }
}

fn in_words(goals: &[Goal]) -> String {
    let names: Vec<String> = goals
        .iter()
        .map(|goal| {
            let name = goal.index.words();
            let adjective = match goal.index.sense() {
                crate::index::Sense::AtLeast => "highest",
                crate::index::Sense::AtMost => "least",
            };
            match goals.len() {
                1 => format!("{adjective} {name}"),
                _ => format!("{adjective} {name} (weight {})", goal.weight),
            }
        })
        .collect();
    names.join(", ")
}
