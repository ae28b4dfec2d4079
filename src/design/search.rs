//! Solving a study; where its demands cannot all be met, the compromise that comes closest.

use super::study::{Role, Study};
use crate::{
    index::{Index, Scale},
    optimize::{
        archive::Archive,
        local::Status,
        problem::Problem,
        solve::{NoDesign, Solved, Start, solve},
    },
};

/// Solves a study. Infeasible demands give the design whose largest relative violation is least,
/// by the indices themselves: a critical speed counts by the speed, not by the damping at it.
///
/// # Errors
///
/// [`NoDesign`] if not one design could be evaluated.
pub fn search(study: &Study, start: &Start, archive: &Archive) -> Result<Solved, NoDesign> {
    let solved = solve(study, start, archive)?;
    if solved.status != Status::Infeasible {
        return Ok(solved);
    }
    let closest = compromise(study, start, &solved, archive)?;
    if closest
        .point
        .values
        .as_ref()
        .is_ok_and(|v| v.objective() <= 0.0)
    {
        // The compromise meets them all: the search goes on from there.
        let near = Start::near(vec![closest.point.x.clone()]);
        let mut again = solve(study, &near, archive)?;
        again.effort.add(&solved.effort);
        again.effort.add(&closest.effort);
        return Ok(again);
    }
    let x = closest.point.x;
    let mut effort = solved.effort;
    effort.add(&closest.effort);
    Ok(Solved {
        point: crate::optimize::problem::Point {
            values: study.evaluate(&x),
            x,
        },
        status: match closest.status {
            stopped @ (Status::BudgetSpent | Status::Interrupted) => stopped,
            _ => Status::Infeasible,
        },
        certificate: None,
        effort,
        designs: solved.designs,
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

fn compromise(
    study: &Study,
    start: &Start,
    from: &Solved,
    archive: &Archive,
) -> Result<Solved, NoDesign> {
    let shortfall = shortfall(study);
    let start = start.clone().with(vec![from.point.x.clone()]);
    solve(&shortfall, &start, archive)
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
