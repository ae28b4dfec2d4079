//! Demands that cannot all be met: which of them conflict, and how far each alone would have to
//! give way.

use super::{
    measure::worst,
    missed::Missed,
    search::{Searched, search},
    study::{Role, Study},
};
use crate::{
    index::Index,
    optimize::{
        archive::Archive,
        local::Status,
        problem::{Detail, Piece, Problem},
        solve::Start,
    },
};

/// Demands in conflict, in groups that hold one another.
#[derive(Debug, Clone, PartialEq)]
pub struct Conflict {
    /// The demands, group by group, the group with the largest violation first.
    pub demands: Vec<Opposed>,
}

/// A demand in conflict.
#[derive(Debug, Clone, PartialEq)]
pub struct Opposed {
    /// Index.
    pub index: Index,
    /// In which condition; `None` for the nominal one.
    pub condition: Option<String>,
    /// Bound, SI.
    pub required: f64,
    /// Number of its group, from 0.
    pub group: usize,
    /// Share in the conflict: the shares of a group add up to one.
    pub share: f64,
    /// True if any design variable changes the index.
    pub influenced: bool,
    /// The bound, SI, at which the rest could be met if it alone gave way; `None`: the rest cannot
    /// be met even without it.
    pub alone: Option<f64>,
}

/// The conflict among the demands that a search has missed. `None` if it has missed none.
pub fn conflict(searched: &Searched, seed: u64, archive: &Archive) -> Option<Conflict> {
    let holds = |missed: &&Missed| !missed.met() && missed.share > 0.0;
    let missed: Vec<&Missed> = searched.missed.iter().filter(holds).collect();
    let n = searched.asked.parameters().len();
    let x = &searched.solved.point.x[..n];
    let opposed = |missed: &&Missed| Opposed {
        index: missed.index,
        condition: missed.condition.clone(),
        required: missed.required,
        group: missed.group,
        share: missed.share,
        influenced: missed.influenced,
        alone: if missed.influenced {
            alone(searched, missed, x, seed, archive)
        } else {
            missed.reached
        },
    };
    let demands: Vec<Opposed> = missed.iter().map(opposed).collect();
    (!demands.is_empty()).then_some(Conflict { demands })
}

/// The bound of one demand at which all others of its group can be met; demands of other groups are
/// relaxed to the values reached.
fn alone(
    searched: &Searched,
    missed: &Missed,
    x: &[f64],
    seed: u64,
    archive: &Archive,
) -> Option<f64> {
    let relaxed = relaxing(searched, missed);
    let start = Start::everywhere(seed).with(vec![x.to_vec()]);
    let found = search(&relaxed, &start, archive).ok()?;
    if found.solved.status == Status::Infeasible || !found.solved.point.feasible() {
        return None;
    }
    let x = &found.solved.point.x[..relaxed.parameters().len()];
    let measured = relaxed.measure(x, Detail::Values).ok()?;
    let is_own = |piece: &Piece| {
        let term = &relaxed.terms()[relaxed.term_of(piece.index)];
        matches!(term.role, Role::Objective { .. }) && relaxed.counts(piece.index)
    };
    let pieces: Vec<Piece> = measured.into_iter().filter(is_own).collect();
    worst(missed.index, &pieces)
}

/// Study with one demand as its objective, demands of other groups relaxed, the others kept.
fn relaxing(searched: &Searched, alone: &Missed) -> Study {
    searched.asked.with_roles(|i, term| match term.role {
        Role::Objective { .. } => None,
        Role::Constraint { bound } if i == alone.term => Some(Role::Objective {
            group: 0,
            weight: 1.0,
            origin: bound,
        }),
        constraint @ Role::Constraint { .. } => {
            let other = searched.missed.iter().find(|m| m.term == i);
            match other.filter(|other| other.group != alone.group) {
                Some(other) => other
                    .relaxed_bound()
                    .map(|bound| Role::Constraint { bound }),
                None => Some(constraint),
            }
        }
    })
}
