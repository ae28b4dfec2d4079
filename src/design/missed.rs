//! Demands that no design found meets together with the rest, and the values reached.

use super::{
    measure::worst,
    study::{Role, Study},
};
use crate::{
    index::{Demand, Index, Scale, Sense},
    optimize::{
        problem::{Detail, Piece, Problem},
        solve::halton,
    },
};

/// A demand that no design was found to meet together with the rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Missed {
    /// Number of its term in the study.
    pub term: usize,
    /// Index.
    pub index: Index,
    /// In which condition; `None` for the nominal one.
    pub condition: Option<String>,
    /// The bound asked for, SI.
    pub required: f64,
    /// Value reached, SI; `None` if the demand has no value to be reached.
    pub reached: Option<f64>,
    /// Number of the group of demands that hold one another, from 0: the worst violated first.
    pub group: usize,
    /// Share in the conflict: the shares of a group add up to one; 0 for a demand that is not active.
    pub share: f64,
    /// True if any design variable changes the index.
    pub influenced: bool,
}

impl Missed {
    fn demand(&self) -> Demand {
        Demand {
            index: self.index,
            bound: self.required,
        }
    }

    /// True if the value reached counts as meeting the demand.
    pub fn met(&self) -> bool {
        self.reached
            .is_some_and(|reached| self.demand().met_by(reached))
    }

    /// How far the value reached falls short of the bound, as [`Demand::shortfall`]; infinite if the
    /// demand has no value.
    pub fn violation(&self) -> f64 {
        let short = |reached| self.demand().shortfall(reached).max(0.0);
        self.reached.map_or(f64::INFINITY, short)
    }

    /// The bound that the compromise keeps, SI: the value reached, and a little room, without which
    /// the designs left would have no interior.
    pub(super) fn relaxed_bound(&self) -> Option<f64> {
        /// A fifth of the tolerance within which a demand counts as met.
        const ROOM: f64 = 2e-5;
        let reached = self.reached?;
        Some(match (self.index.scale(), self.index.sense()) {
            (Scale::Linear, _) => reached - ROOM,
            (Scale::Logarithmic, Sense::AtLeast) => reached * (1.0 - ROOM),
            (Scale::Logarithmic, Sense::AtMost) => reached * (1.0 + ROOM),
        })
    }
}

/// Values of the demands of a shortfall study at a design.
pub(super) struct Reached<'a> {
    open: &'a Study,
    x: Vec<f64>,
    measured: Vec<Piece>,
}

impl<'a> Reached<'a> {
    /// Values reached of the study's demands at scaled coordinates `x`.
    pub fn new(open: &'a Study, x: &[f64]) -> Self {
        Self {
            open,
            x: x.to_vec(),
            measured: open.measure(x, Detail::Values).unwrap_or_default(),
        }
    }

    /// Value of term `k`, SI.
    pub fn value(&self, k: usize) -> Option<f64> {
        let pieces = self.measured.iter();
        let own: Vec<Piece> = pieces
            .filter(|piece| self.open.term_of(piece.index) == k && self.open.counts(piece.index))
            .cloned()
            .collect();
        worst(self.open.terms()[k].index, &own)
    }

    /// Term `k` here and `term` of the study, as a missed demand.
    pub fn missed(&self, study: &Study, [term, k]: [usize; 2], group: usize, share: f64) -> Missed {
        Missed {
            share,
            influenced: self.is_influenced(k),
            ..self.unheld(study, [term, k], group)
        }
    }

    /// As [`Reached::missed`], of a demand without a share in the conflict.
    pub fn unheld(&self, study: &Study, [term, k]: [usize; 2], group: usize) -> Missed {
        let Role::Objective { origin, .. } = self.open.terms()[k].role else {
            unreachable!("the terms of a shortfall are objectives")
        };
        let own = &study.terms()[term];
        Missed {
            term,
            index: own.index,
            condition: study.condition_name(own.condition).map(str::to_owned),
            required: origin,
            reached: self.value(k),
            group,
            share: 0.0,
            influenced: true,
        }
    }

    /// True if a variable changes term `k`: at this design or at some others spread over the box.
    fn is_influenced(&self, k: usize) -> bool {
        /// Designs beside this one: more than any box has corners in two variables.
        const OTHERS: usize = 6;
        let alone = self
            .open
            .with_roles(|i, term| (i == k).then_some(term.role));
        let others = (1..=OTHERS).map(|i| halton(i, self.x.len()));
        let designs = std::iter::once(self.x.clone()).chain(others);
        let mut first: Option<Vec<f64>> = None;
        for x in designs {
            let Ok(measured) = alone.measure(&x, Detail::Gradients) else {
                continue;
            };
            let flat = measured.iter().all(|piece| {
                let gradient = piece.gradient.as_ref();
                gradient.is_some_and(|slopes| slopes.iter().all(|slope| *slope == 0.0))
            });
            let values: Vec<f64> = measured.iter().map(|piece| piece.value).collect();
            let same = first.as_ref().is_none_or(|first| *first == values);
            if !flat || !same {
                return true;
            }
            first = Some(values);
        }
        first.is_none()
    }
}
