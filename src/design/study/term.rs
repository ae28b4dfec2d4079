//! Role of an index in a study, and how its values count.

use crate::{
    design::measure::Wanted,
    index::{Index, Scale, Sense},
    optimize::problem::FEASIBLE,
};

/// A difference of damping ratio of 1/3 counts as much as a factor e: near the critical speed of
/// passenger trucks that is about what doubling the speed costs.
pub const DAMPING: f64 = 3.0;
/// Share of a bound below which a value counts as that share.
const LEAST: f64 = 1e-9;

/// Role of an index in a study.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Role {
    /// Part of objective number `group`: the worst of a group counts, the groups add up.
    Objective {
        /// Which.
        group: usize,
        /// Weight of its relative change.
        weight: f64,
        /// Value from which the change is counted, SI.
        origin: f64,
    },
    /// Must keep a bound, SI.
    Constraint {
        /// Least or greatest value.
        bound: f64,
    },
}

/// Kind of a demand, by which demands are met one after another where not all can be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rank {
    /// On an index that the models always cover.
    Plain,
    /// That the linear model covers the service curve.
    Coverage,
    /// On a force or stroke in the service curve, assessed only where that is covered.
    InCurve,
}

/// An index in an operating condition, and what it is to the study.
#[derive(Debug, Clone, PartialEq)]
pub struct Term {
    /// Which condition.
    pub condition: usize,
    /// Which index.
    pub index: Index,
    /// Its role.
    pub role: Role,
    /// Pieces that count; `None`: all.
    pub only: Option<&'static [usize]>,
    /// Whether it is a demand that the spec does not state, but without which others cannot be
    /// assessed.
    pub implied: bool,
    pub(super) wanted: Wanted,
}

impl Term {
    /// Its kind among demands that cannot all be met.
    pub fn rank(&self) -> Rank {
        if self.implied {
            Rank::Coverage
        } else if self.index.is_in_service_curve() {
            Rank::InCurve
        } else {
            Rank::Plain
        }
    }

    pub(super) fn is_speed_objective(&self) -> bool {
        self.index == Index::CriticalSpeed && matches!(self.role, Role::Objective { .. })
    }

    /// Derivative of [`Term::scaled`].
    pub(super) fn slope(&self, value: f64) -> f64 {
        let worse = |origin: f64| match (self.index.scale(), self.index.sense()) {
            (Scale::Linear, _) => -DAMPING,
            _ if value / origin < LEAST => 0.0,
            (Scale::Logarithmic, Sense::AtLeast) => -1.0 / value,
            (Scale::Logarithmic, Sense::AtMost) => 1.0 / value,
        };
        match self.role {
            Role::Objective { weight, origin, .. } => weight * worse(origin),
            Role::Constraint { bound } => match self.wanted {
                Wanted::DampingTo { .. } if self.index == Index::CriticalSpeed => -DAMPING,
                _ => worse(bound),
            },
        }
    }

    pub(super) fn scaled(&self, value: f64) -> f64 {
        let worse_than = |origin: f64| match (self.index.scale(), self.index.sense()) {
            (Scale::Linear, _) => DAMPING * (origin - value),
            (Scale::Logarithmic, Sense::AtLeast) => -(value / origin).max(LEAST).ln(),
            (Scale::Logarithmic, Sense::AtMost) => (value / origin).max(LEAST).ln(),
        };
        match self.role {
            Role::Objective { weight, origin, .. } => weight * worse_than(origin),
            Role::Constraint { bound } => {
                // What the optimiser lets pass lies on the right side of the bound.
                FEASIBLE
                    + match self.wanted {
                        Wanted::DampingTo { .. } if self.index == Index::CriticalSpeed => {
                            -DAMPING * value
                        }
                        _ => worse_than(bound),
                    }
            }
        }
    }
}
