//! From the scaled values of a study back to indices and bounds.

use super::{
    AMPLE, PIECES, Study,
    term::{DAMPING, Role, Term},
};
use crate::{
    design::measure::{Wanted, measure},
    index::{Index, Scale, Sense},
    optimize::{
        follow,
        problem::{Failure, Piece},
    },
};

impl Study {
    /// Change of a term's constraint value per change of its bound, at scaled coordinates `x`.
    ///
    /// # Errors
    ///
    /// [`Failure`] as of any measurement: for the critical speed damping is looked up a little
    /// faster.
    pub fn slope_of_bound(&self, piece: &Piece, x: &[f64]) -> Result<f64, Failure> {
        let term = &self.terms[self.term_of(piece.index)];
        let Role::Constraint { bound } = term.role else {
            return Ok(0.0);
        };
        if term.index == Index::CriticalSpeed {
            const STEP: f64 = 1e-4;
            let case = self.in_condition(&self.design(x), term.condition);
            let at = |speed: f64| {
                let below = AMPLE;
                Ok(measure(&case, &[Wanted::DampingTo { speed, below }])?.remove(0))
            };
            let (now, faster) = (at(bound)?, at(bound * (1.0 + STEP))?);
            let same = |p: &&Piece| p.index == piece.index % PIECES;
            let far = |p: &Piece| (term.scaled(p.value) - piece.value).abs();
            let own = now
                .iter()
                .filter(same)
                .min_by(|a, b| far(a).total_cmp(&far(b)));
            let change = own.and_then(|own| {
                let k = now.iter().position(|p| p == own)?;
                Some(-DAMPING * (follow(&now, k, &faster)? - own.value))
            });
            return Ok(change.map_or(0.0, |change| change / (STEP * bound)));
        }
        Ok(match (term.index.scale(), term.index.sense()) {
            (Scale::Linear, _) => DAMPING,
            (Scale::Logarithmic, Sense::AtLeast) => 1.0 / bound,
            (Scale::Logarithmic, Sense::AtMost) => -1.0 / bound,
        })
    }

    /// Value of a term at which objective pieces come out as `value`, and its derivative by that,
    /// SI. `None` if the term is no objective.
    pub fn index_at(&self, term: &Term, value: f64) -> Option<[f64; 2]> {
        let Role::Objective { weight, origin, .. } = term.role else {
            return None;
        };
        let worse = value / weight;
        Some(match (term.index.scale(), term.index.sense()) {
            (Scale::Linear, _) => [origin - worse / DAMPING, -1.0 / (DAMPING * weight)],
            (Scale::Logarithmic, Sense::AtLeast) => {
                let index = origin * (-worse).exp();
                [index, -index / weight]
            }
            (Scale::Logarithmic, Sense::AtMost) => {
                let index = origin * worse.exp();
                [index, index / weight]
            }
        })
    }
}
