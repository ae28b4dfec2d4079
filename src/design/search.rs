//! Solving a study; where its demands cannot all be met, the best compromise.

use super::{
    compromise::{compromise, feasible},
    lifted::{Lifted, solve_lifted},
    missed::Missed,
    recovery::recover,
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
    /// The study in whose terms it is solved: the lifted one where the critical speed is an
    /// objective, with the bounds of missed demands relaxed to what can be reached.
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

    /// Whether a demand counts as not met.
    pub fn misses(&self) -> bool {
        self.missed.iter().any(|missed| !missed.met())
    }
}

/// Solves a study. Where no design meets all demands, the solution is the [`compromise`].
///
/// # Errors
///
/// [`NoDesign`] if not one design could be evaluated.
pub fn search(study: &Study, start: &Start, archive: &Archive) -> Result<Searched, NoDesign> {
    let (asked, start, found) = match solve_lifted(study, start, archive) {
        Err(NoDesign::Failed(reason)) => recover(study, start, archive, reason)?,
        other => (study.clone(), start.clone(), other?),
    };
    let (Lifted { study, solved }, missed) = match found.solved.status {
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
    let mut found = solve_lifted(study, start, archive)?;
    if found.solved.status == Status::Infeasible {
        let Some(x) = feasible(study, start, &found.solved, archive)? else {
            return Ok(None);
        };
        found = solve_lifted(study, &Start::near(vec![x]), archive)?;
    }
    let Lifted { study: own, solved } = found;
    Ok(solved.point.feasible().then(|| Searched {
        asked: study.clone(),
        study: own,
        solved,
        missed: Vec::new(),
    }))
}
