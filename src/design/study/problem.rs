//! A study in the terms of the optimiser.

use rayon::prelude::*;
use sha2::{Digest, Sha256};

use super::{
    AMPLE, PIECES, SPEED, Study,
    chain::Chain,
    term::{DAMPING, Role},
};
use crate::{
    case::Case,
    design::measure::{Wanted, measure, measure_graded},
    optimize::problem::{Detail, FEASIBLE, Failure, Key, Piece, Problem, Values, Variable},
};

/// Conditions that are measured side by side.
const SIDE_BY_SIDE: usize = 16;

impl Study {
    /// Conditions in which the study asks for something, each with the numbers of its terms.
    fn by_condition(&self) -> Vec<(usize, Vec<usize>)> {
        let mut terms: Vec<Vec<usize>> = vec![Vec::new(); self.conditions.len()];
        for (i, term) in self.terms.iter().enumerate() {
            terms[term.condition].push(i);
        }
        let numbered = terms.into_iter().enumerate();
        numbered.filter(|(_, terms)| !terms.is_empty()).collect()
    }

    /// Numbers of the conditions in which the study asks for something.
    pub fn conditions_asked(&self) -> Vec<usize> {
        let asked = self.by_condition();
        asked.into_iter().map(|(condition, _)| condition).collect()
    }

    /// Numbers of the conditions in which the design at scaled coordinates `x` has no result.
    pub fn failing(&self, x: &[f64]) -> Vec<usize> {
        let case = self.design(x);
        let conditions = self.by_condition();
        let fails = |(condition, terms): &(usize, Vec<usize>)| {
            let measured = self.measure_in(*condition, terms, &case, x, Detail::Values);
            measured.err().map(|_| *condition)
        };
        conditions.par_iter().filter_map(fails).collect()
    }

    /// Pieces of some terms, all of one condition, for the design `case` at scaled coordinates `x`.
    fn measure_in(
        &self,
        condition: usize,
        terms: &[usize],
        case: &Case,
        x: &[f64],
        detail: Detail,
    ) -> Result<Vec<Piece>, Failure> {
        let wanted: Vec<Wanted> = terms
            .iter()
            .map(|i| match (self.speed(x), &self.terms[*i]) {
                (Some(speed), term) if term.is_speed_objective() => Wanted::DampingTo {
                    speed,
                    below: AMPLE,
                },
                (_, term) => term.wanted,
            })
            .collect();
        let case = self.in_condition(case, condition);
        let chain = match detail {
            Detail::Values => None,
            Detail::Gradients => Some(Chain::new(self, x, condition)),
        };
        let all = match &chain {
            None => measure(&case, &wanted)?,
            Some(chain) => measure_graded(&case, &wanted, &chain.constants)?,
        };
        let mut measured = Vec::new();
        for (i, pieces) in terms.iter().zip(all) {
            let has_epigraph = self.has_epigraph && self.terms[*i].is_speed_objective();
            measured.extend(pieces.into_iter().map(|p| {
                let gradient = p.gradient.as_ref().zip(chain.as_ref());
                Piece {
                    index: i * PIECES + p.index,
                    gradient: gradient.map(|(over, chain)| chain.gradient(over, has_epigraph)),
                    ..p
                }
            }));
            if let Some(speed) = self.speed(x).filter(|_| has_epigraph) {
                measured.push(Piece {
                    gradient: chain.as_ref().map(Chain::of_speed),
                    ..Piece::single(i * PIECES + SPEED, speed)
                });
            }
        }
        Ok(measured)
    }
}

impl Problem for Study {
    fn variables(&self) -> &[Variable] {
        &self.variables
    }

    fn piece_name(&self, index: usize) -> String {
        let name = self.piece_words(index);
        let term = &self.terms[self.term_of(index)];
        match self.condition_name(term.condition) {
            Some(condition) => format!("{name} ({condition})"),
            None => name,
        }
    }

    fn key(&self, x: &[f64]) -> Key {
        let terms = self.terms.iter();
        let lifted = if self.has_epigraph { "lifted " } else { "" };
        let what: Vec<String> = terms
            .map(|t| match self.condition_name(t.condition) {
                Some(name) => format!("{}/{name}", t.wanted),
                None => t.wanted.to_string(),
            })
            .collect();
        // A design follows from the case, the rules, and the values of the variables.
        let follows = format!("{} {:?} {:?}", self.identity, self.parameters, self.rules);
        Key {
            what: format!(
                "{lifted}{} of {:x}",
                what.join(" "),
                Sha256::digest(follows.as_bytes())
            ),
            at: self.values(x),
        }
    }

    fn has_gradients(&self) -> bool {
        true
    }

    /// Conditions are measured side by side, a few at a time; none further once one fails.
    fn measure(&self, x: &[f64], detail: Detail) -> Result<Vec<Piece>, Failure> {
        let case = self.design(x);
        let mut measured = Vec::new();
        for conditions in self.by_condition().chunks(SIDE_BY_SIDE) {
            let all: Vec<Result<Vec<Piece>, Failure>> = conditions
                .par_iter()
                .map(|(condition, terms)| self.measure_in(*condition, terms, &case, x, detail))
                .collect();
            for pieces in all {
                measured.extend(pieces?);
            }
        }
        Ok(measured)
    }

    fn judge(&self, measured: &[Piece]) -> Values {
        let groups = self.terms.iter().filter_map(|t| match t.role {
            Role::Objective { group, .. } => Some(group + 1),
            Role::Constraint { .. } => None,
        });
        let mut values = Values {
            objectives: vec![Vec::new(); groups.max().unwrap_or(0)],
            constraints: Vec::new(),
        };
        for piece in measured {
            let term = &self.terms[self.term_of(piece.index)];
            if !self.counts(piece.index) {
                continue;
            }
            let damping =
                self.has_epigraph && term.is_speed_objective() && piece.index % PIECES != SPEED;
            let (value, slope) = if damping {
                (FEASIBLE - DAMPING * piece.value, -DAMPING)
            } else {
                (term.scaled(piece.value), term.slope(piece.value))
            };
            let gradient = piece.gradient.as_ref();
            let scaled = Piece {
                value,
                index: piece.index,
                label: piece.label,
                gradient: gradient.map(|g| g.iter().map(|d| slope * d).collect()),
            };
            match term.role {
                Role::Objective { group, .. } if !damping => values.objectives[group].push(scaled),
                _ => values.constraints.push(scaled),
            }
        }
        // A group without pieces is no objective.
        values.objectives.retain(|pieces| !pieces.is_empty());
        values
    }
}
