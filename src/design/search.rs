//! Solving a study; where its demands cannot all be met, the compromise that comes closest.

use super::study::{Role, Study};
use crate::{
    index::{Index, Scale},
    optimize::{
        archive::Archive,
        local::{Status, WIDE},
        problem::{Point, Problem, Values},
        solve::{NoDesign, Solved, Start, solve},
    },
};

/// A solved study.
#[derive(Debug, Clone)]
pub struct Searched {
    /// The study in whose terms it is solved: where the critical speed is an objective, the lifted
    /// one.
    pub study: Study,
    /// Its solution.
    pub solved: Solved,
}

/// Solves a study. Infeasible demands give the design whose largest relative violation is least,
/// by the indices themselves: a critical speed counts by the speed, not by the damping at it.
///
/// # Errors
///
/// [`NoDesign`] if not one design could be evaluated.
pub fn search(study: &Study, start: &Start, archive: &Archive) -> Result<Searched, NoDesign> {
    let found = solve_lifted(study, start, archive)?;
    if found.solved.status != Status::Infeasible {
        return Ok(found);
    }
    let mut effort = found.solved.effort.clone();
    let from = study.parameters().len();
    let start = start
        .clone()
        .with(vec![found.solved.point.x[..from].to_vec()])
        .thoroughly();
    let closest = solve_lifted(&shortfall(study), &start, archive)?.solved;
    effort.add(&closest.effort);
    let x = closest.point.x[..from].to_vec();
    let values = study.evaluate(&x);
    if values.as_ref().is_ok_and(Values::feasible) {
        // The compromise meets them all: the search goes on from there.
        let mut again = solve_lifted(study, &Start::near(vec![x]), archive)?;
        again.solved.effort.add(&effort);
        return Ok(again);
    }
    Ok(Searched {
        study: study.clone(),
        solved: Solved {
            status: match closest.status {
                stopped @ (Status::BudgetSpent | Status::Interrupted) => stopped,
                _ => Status::Infeasible,
            },
            point: Point { x, values },
            certificate: None,
            effort,
            ends: Vec::new(),
        },
    })
}

/// The lifted speed may stay this much below; what is truly worse is not taken.
const HAIR: f64 = 1e-4;

/// Solves a study; where the critical speed is an objective, by its modes' speeds first and then,
/// from the designs these led to, lifted.
fn solve_lifted(study: &Study, start: &Start, archive: &Archive) -> Result<Searched, NoDesign> {
    let solved = solve(study, start, archive)?;
    let plain = |solved| Searched {
        study: study.clone(),
        solved,
    };
    let Some(lifted) = study.lifted() else {
        return Ok(plain(solved));
    };
    if archive.stopped().is_some() {
        return Ok(plain(solved));
    }
    let designs = solved.ends.iter().chain([&solved.point.x]);
    let designs: Vec<Vec<f64>> = designs.filter_map(|x| study.lift(x).ok()).collect();
    let start = Start {
        radius: WIDE / 4.0,
        ..Start::near(designs)
    };
    let Ok(mut better) = solve(&lifted, &start, archive) else {
        return Ok(plain(solved));
    };
    let objective = |s: &Solved| {
        s.point
            .values
            .as_ref()
            .map_or(f64::INFINITY, Values::objective)
    };
    let worse = objective(&better) > objective(&solved) + HAIR;
    if !better.point.feasible() || (solved.point.feasible() && worse) {
        return Ok(plain(solved));
    }
    let first = solved.effort;
    better.effort.add(&first);
    better.effort.starts = first.starts;
    better.effort.agreed = first.agreed;
    Ok(Searched {
        study: lifted,
        solved: better,
    })
}

/// The demands of a study as its objective: the largest relative shortfall.
pub fn shortfall(study: &Study) -> Study {
    study.with_roles(|_, term| match term.role {
        Role::Objective { .. } => None,
        Role::Constraint { bound } => Some(Role::Objective {
            group: 0,
            weight: 1.0,
            origin: bound,
        }),
    })
}

/// One demand of a study as its objective, the others kept.
pub fn relaxing(study: &Study, demand: usize) -> Study {
    study.with_roles(|i, term| match term.role {
        Role::Objective { .. } => None,
        Role::Constraint { bound } if i == demand => Some(Role::Objective {
            group: 0,
            weight: 1.0,
            origin: bound,
        }),
        constraint @ Role::Constraint { .. } => Some(constraint),
    })
}

/// Whether a shortfall, as the objective of [`shortfall`] has it, is one that an engineer would
/// see: a ten-thousandth.
pub fn falls_short(index: Index, required: f64, reached: f64) -> bool {
    const MET: f64 = 1e-4;
    let worse = match index.sense() {
        crate::index::Sense::AtLeast => required - reached,
        crate::index::Sense::AtMost => reached - required,
    };
    let scale = match index.scale() {
        Scale::Logarithmic => required,
        Scale::Linear => 1.0,
    };
    worse > MET * scale
}
