//! Solving a study; where its demands cannot all be met, the best compromise.

use super::{
    compromise::{best_beside, compromise, feasible},
    epigraph::{EpigraphSolution, solve_with_epigraph},
    missed::Missed,
    recovery::recover,
    screened::{Screened, Settled, screened},
    study::Study,
};
use crate::optimize::{
    archive::Archive,
    local::Status,
    solve::{NoDesign, Solved, Start},
};

/// A solved study.
#[derive(Debug, Clone)]
pub struct Searched {
    /// The study as asked. Terms that no design has a value of are left out.
    pub asked: Study,
    /// Study of the solution: with the epigraph variable where the critical speed is an objective, and with
    /// the bounds of missed demands relaxed to reachable values.
    pub study: Study,
    /// Its solution.
    pub solved: Solved,
    /// Demands that no design was found to meet together with the rest.
    pub missed: Vec<Missed>,
}

impl Searched {
    /// Largest violation of a demand by the solution, relative.
    pub fn violation(&self) -> f64 {
        let missed = self.missed.iter();
        missed.map(Missed::violation).fold(0.0, f64::max)
    }

    /// Adds the second-order condition.
    pub fn add_curvature(&mut self, archive: &Archive) {
        self.solved = self.solved.clone().with_curvature(&self.study, archive);
    }

    /// True if a demand counts as not met.
    pub fn misses(&self) -> bool {
        self.missed.iter().any(|missed| !missed.met())
    }
}

/// Solves a study. Where no design meets all demands, the solution is the [`compromise`]. With more
/// conditions than [`MANY`](super::screened::MANY) it is searched in working conditions.
///
/// # Errors
///
/// [`NoDesign`] if no design could be evaluated.
pub fn search(study: &Study, start: &Start, archive: &Archive) -> Result<Searched, NoDesign> {
    let solve = |study: &Study, start: &Start| search_in_all(study, start, archive).map(Some);
    let settled = match screened(study, start, archive, solve)? {
        Screened::All | Screened::None => return search_in_all(study, start, archive),
        Screened::Ended(found) => return Ok(found),
        Screened::Settled(settled) => settled,
    };
    let same_terms = settled.found.asked.terms().len() == settled.terms.len();
    let whole = match (settled.found.misses(), same_terms) {
        (true, true) => beside_missed(study, &settled, archive),
        _ => search_in_all(study, &settled.near, archive),
    };
    settled.finish(whole)
}

/// The compromise of working conditions in all conditions.
fn beside_missed(
    study: &Study,
    settled: &Settled,
    archive: &Archive,
) -> Result<Searched, NoDesign> {
    let (missed, x) = (settled.missed(study), settled.near.designs[0].clone());
    let (EpigraphSolution { study: own, solved }, missed) =
        best_beside(study, &settled.near, x, missed, archive)?;
    Ok(Searched {
        asked: study.clone(),
        study: own,
        solved,
        missed,
    })
}

/// As [`search`], in all conditions from the beginning.
///
/// # Errors
///
/// As [`search`].
pub fn search_in_all(
    study: &Study,
    start: &Start,
    archive: &Archive,
) -> Result<Searched, NoDesign> {
    let (asked, start, found) = match solve_with_epigraph(study, start, archive) {
        Err(NoDesign::Failed(reason)) => recover(study, start, archive, reason)?,
        other => (study.clone(), start.clone(), other?),
    };
    let (EpigraphSolution { study, solved }, missed) = match found.solved.status {
        Status::Infeasible => compromise(&asked, &start, &found.solved, archive)?,
        _ => (found, Vec::new()),
    };
    Ok(Searched {
        asked,
        study,
        solved,
        missed,
    })
}

/// As [`search`], among the designs that meet all demands only. `None` if none was found.
///
/// # Errors
///
/// As [`search`].
pub fn search_feasible(
    study: &Study,
    start: &Start,
    archive: &Archive,
) -> Result<Option<Searched>, NoDesign> {
    let solve = |study: &Study, start: &Start| feasible_in_all(study, start, archive);
    let settled = match screened(study, start, archive, solve)? {
        Screened::All => return solve(study, start),
        Screened::None => return Ok(None),
        Screened::Ended(found) => return Ok(Some(found)),
        Screened::Settled(settled) => settled,
    };
    let whole = match solve(study, &settled.near) {
        Ok(None) => return Ok(None),
        Ok(Some(whole)) => Ok(whole),
        Err(error) => Err(error),
    };
    settled.finish(whole).map(Some)
}

fn feasible_in_all(
    study: &Study,
    start: &Start,
    archive: &Archive,
) -> Result<Option<Searched>, NoDesign> {
    let mut found = solve_with_epigraph(study, start, archive)?;
    if found.solved.status == Status::Infeasible {
        let Some(x) = feasible(study, start, &found.solved, archive)? else {
            return Ok(None);
        };
        found = solve_with_epigraph(study, &Start::near(vec![x]), archive)?;
    }
    let EpigraphSolution { study: own, solved } = found;
    Ok(solved.point.feasible().then(|| Searched {
        asked: study.clone(),
        study: own,
        solved,
        missed: Vec::new(),
    }))
}
