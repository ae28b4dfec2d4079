//! A study in the terms of the optimiser.

use sha2::{Digest, Sha256};

use super::{
    AMPLE, PIECES, SPEED, Study,
    chain::Chain,
    term::{DAMPING, Role, Term},
};
use crate::{
    design::measure::{Wanted, measure, measure_graded},
    optimize::problem::{Detail, FEASIBLE, Failure, Key, Piece, Problem, Values, Variable},
};

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
        let lifted = if self.is_lifted { "lifted " } else { "" };
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

    fn measure(&self, x: &[f64], detail: Detail) -> Result<Vec<Piece>, Failure> {
        let case = self.design(x);
        let mut measured = Vec::new();
        for condition in 0..self.conditions.len() {
            let numbered = self.terms.iter().enumerate();
            let here: Vec<(usize, &Term)> =
                numbered.filter(|(_, t)| t.condition == condition).collect();
            if here.is_empty() {
                continue;
            }
            let wanted: Vec<Wanted> = here
                .iter()
                .map(|(_, t)| match self.speed(x) {
                    Some(speed) if t.is_speed_objective() => Wanted::DampingTo {
                        speed,
                        below: AMPLE,
                    },
                    _ => t.wanted,
                })
                .collect();
            let case = self.in_condition(&case, condition);
            let chain = match detail {
                Detail::Values => None,
                Detail::Gradients => Chain::new(self, x, condition),
            };
            let all = match &chain {
                None => measure(&case, &wanted)?,
                Some(chain) => measure_graded(&case, &wanted, &chain.constants)?,
            };
            for ((i, _), pieces) in here.iter().zip(all) {
                let is_lifted = self.is_lifted && self.terms[*i].is_speed_objective();
                measured.extend(pieces.into_iter().map(|p| {
                    let gradient = p.gradient.as_ref().zip(chain.as_ref());
                    Piece {
                        index: i * PIECES + p.index,
                        gradient: gradient.map(|(over, chain)| chain.gradient(over, is_lifted)),
                        ..p
                    }
                }));
                if let Some(speed) = self.speed(x).filter(|_| is_lifted) {
                    measured.push(Piece {
                        gradient: chain.as_ref().map(Chain::of_speed),
                        ..Piece::single(i * PIECES + SPEED, speed)
                    });
                }
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
                self.is_lifted && term.is_speed_objective() && piece.index % PIECES != SPEED;
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
