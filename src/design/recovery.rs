//! A search that begins where no design of its first look has a performance.

use super::{
    epigraph::{EpigraphSolution, solve_with_epigraph},
    study::{Role, Study, Term},
};
use crate::{
    index::{Behaviour, Index},
    optimize::{
        archive::Archive,
        problem::{Detail, Failure, Problem},
        solve::{NoDesign, Start, halton},
    },
};

/// Solves a study of which no design looked at could be evaluated, for `reason`: without the terms
/// that no design has a value of, and from a design that is stable at the operating speed. Returns
/// the study that is left, where its search began, and its solution.
///
/// # Errors
///
/// [`NoDesign`] if there is still no design with a performance.
pub fn recover(
    study: &Study,
    start: &Start,
    archive: &Archive,
    reason: Failure,
) -> Result<(Study, Start, EpigraphSolution), NoDesign> {
    let study = with_values(study, start);
    if !study.terms().iter().any(is_objective) {
        return Err(NoDesign::Failed(reason));
    }
    match solve_with_epigraph(&study, start, archive) {
        Err(NoDesign::Failed(_)) => {}
        found => return Ok((study, start.clone(), found?)),
    }
    let stable = most_damped(&study, start, archive)?;
    let start = start.clone().with(vec![stable]);
    let found = solve_with_epigraph(&study, &start, archive)?;
    Ok((study, start, found))
}

fn is_objective(term: &Term) -> bool {
    matches!(term.role, Role::Objective { .. })
}

/// Reasons that lie in the design rather than in the index.
fn is_of_design(failure: Failure) -> bool {
    matches!(failure, Failure::Unstable | Failure::Diverges)
}

/// The study without the terms that fail at every design looked at, for a reason that another
/// suspension would not mend.
pub(super) fn with_values(study: &Study, start: &Start) -> Study {
    /// Number of designs looked at besides the starts.
    const OTHERS: usize = 4;
    let n = study.variables().len();
    let others = (1..=OTHERS).map(|i| halton(i, n));
    let designs: Vec<Vec<f64>> = start.designs.iter().cloned().chain(others).collect();
    study.with_roles(|i, term| {
        let alone = study.with_roles(|j, term| (i == j).then_some(term.role));
        let fails = designs.iter().all(|x| {
            let measured = alone.measure(x, Detail::Values);
            measured.is_err_and(|failure| !is_of_design(failure))
        });
        (!fails).then_some(term.role)
    })
}

/// Scaled coordinates of the design whose least-damped mode at the operating speed is damped most,
/// in every condition in which the study asks for lateral ride.
fn most_damped(study: &Study, start: &Start, archive: &Archive) -> Result<Vec<f64>, NoDesign> {
    let mut conditions: Vec<usize> = study
        .terms()
        .iter()
        .filter(|term| term.index.behaviour() == Behaviour::LateralRide)
        .map(|term| term.condition)
        .collect();
    conditions.dedup();
    let mut damped = study.with_roles(|_, _| None);
    for condition in conditions {
        damped = damped.optimise_from(condition, Index::LeastDampingRatio, 0, 1.0, 0.0);
    }
    let found = solve_with_epigraph(&damped, start, archive)?;
    Ok(found.solved.point.x)
}
