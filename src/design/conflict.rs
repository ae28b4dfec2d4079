//! Demands that cannot all be met: which of them conflict, and how far each alone would have to
//! give way.

use super::{
    explain::worst,
    search::{relaxing, search, shortfall},
    study::{Role, Study},
};
use crate::{
    index::Index,
    optimize::{
        archive::Archive,
        certificate::HOLDS,
        local::Status,
        problem::{Detail, Problem},
        solve::{Start, solve},
    },
};

/// Demands in conflict.
#[derive(Debug, Clone, PartialEq)]
pub struct Conflict {
    /// Those that hold one another back at the compromise.
    pub demands: Vec<Opposed>,
}

/// One of the demands in conflict.
#[derive(Debug, Clone, PartialEq)]
pub struct Opposed {
    /// On what.
    pub index: Index,
    /// In which condition; `None` for the nominal one.
    pub condition: Option<String>,
    /// What is asked for, SI.
    pub required: f64,
    /// Its share in the conflict: the shares add up to one.
    pub share: f64,
    /// The bound, SI, at which the rest could be met if it alone gave way; `None`: the rest cannot
    /// be met even without it.
    pub alone: Option<f64>,
}

/// Finds the conflict in a study whose compromise is at scaled coordinates `x`. `None` if the run
/// was stopped before it was known.
pub fn conflict(study: &Study, x: &[f64], seed: u64, archive: &Archive) -> Option<Conflict> {
    let short = shortfall(study);
    let near = Start::near(vec![x.to_vec()]);
    let compromise = solve(&short, &near, archive).ok()?;
    let values = compromise.point.values.ok()?;
    let multipliers = compromise.certificate.map(|c| c.objective_multipliers);
    // The terms of the shortfall are the demands, in the same order.
    let demands: Vec<usize> = (0..study.terms().len())
        .filter(|i| matches!(study.terms()[*i].role, Role::Constraint { .. }))
        .collect();
    let mut shares = vec![0.0; demands.len()];
    for (group, pieces) in values.objectives.iter().enumerate() {
        let worst = crate::optimize::problem::largest(pieces);
        for (k, piece) in pieces.iter().enumerate() {
            // Without a certificate the worst stand for those that hold one another.
            let share = match &multipliers {
                Some(multipliers) => multipliers[group][k],
                None => f64::from(u8::from(piece.value > worst - 1e-3)),
            };
            shares[short.term_of(piece.index)] += share;
        }
    }
    let total: f64 = shares.iter().sum();
    let mut opposed = Vec::new();
    for (k, &demand) in demands.iter().enumerate() {
        if shares[k] <= HOLDS {
            continue;
        }
        let term = &study.terms()[demand];
        let Role::Constraint { bound } = term.role else {
            continue;
        };
        opposed.push(Opposed {
            index: term.index,
            condition: study.condition_name(term.condition).map(str::to_owned),
            required: bound,
            share: shares[k] / total,
            alone: alone(study, demand, &compromise.point.x, seed, archive),
        });
    }
    Some(Conflict { demands: opposed })
}

/// The bound of one demand at which all others can be met.
fn alone(study: &Study, demand: usize, x: &[f64], seed: u64, archive: &Archive) -> Option<f64> {
    let relaxed = relaxing(study, demand);
    let start = Start::everywhere(seed).with(vec![x.to_vec()]);
    let found = search(&relaxed, &start, archive).ok()?;
    if found.solved.status == Status::Infeasible || !found.solved.point.feasible() {
        return None;
    }
    let term = &study.terms()[demand];
    let x = &found.solved.point.x[..study.parameters().len()];
    let measured = relaxed.measure(x, Detail::Values).ok()?;
    let pieces: Vec<_> = measured
        .into_iter()
        .filter(|p| {
            let of = &relaxed.terms()[relaxed.term_of(p.index)];
            of.index == term.index && of.condition == term.condition
        })
        .filter(|p| {
            matches!(
                relaxed.terms()[relaxed.term_of(p.index)].role,
                Role::Objective { .. }
            )
        })
        .collect();
    worst(term.index, &pieces)
}
