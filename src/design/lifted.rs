//! Studies solved with the critical speed as an epigraph variable, where it is an objective.

use super::study::Study;
use crate::optimize::{
    archive::Archive,
    local::WIDE,
    solve::{NoDesign, Solved, Start, solve},
};

/// A solution with the study in whose terms it is: the lifted one where the critical speed is an
/// objective.
#[derive(Debug, Clone)]
pub struct Lifted {
    /// The study.
    pub study: Study,
    /// Its solution.
    pub solved: Solved,
}

/// Loss of objective against the solution of the plain study that the lifted one may have: the
/// start value of the lifted speed lies as much below the critical speed.
const LOSS: f64 = 1e-4;

/// Solves a study; where the critical speed is an objective, by its modes' speeds first and then,
/// from the designs these led to, lifted.
///
/// # Errors
///
/// [`NoDesign`] if not one design could be evaluated.
pub fn solve_lifted(study: &Study, start: &Start, archive: &Archive) -> Result<Lifted, NoDesign> {
    let solved = solve(study, start, archive)?;
    let plain = |solved| Lifted {
        study: study.clone(),
        solved,
    };
    let Some(lifted) = study.lifted() else {
        return Ok(plain(solved));
    };
    if archive.stopped().is_some() {
        return Ok(plain(solved));
    }
    let optima = solved.optima.iter().map(|optimum| &optimum.found.point.x);
    let designs = optima.chain([&solved.point.x]);
    let designs: Vec<Vec<f64>> = designs.filter_map(|x| study.lift(x).ok()).collect();
    let start = Start {
        radius: WIDE / 4.0,
        ..Start::near(designs)
    };
    let Ok(mut better) = solve(&lifted, &start, archive) else {
        return Ok(plain(solved));
    };
    let worse = better.point.objective() > solved.point.objective() + LOSS;
    if !better.point.feasible() || (solved.point.feasible() && worse) {
        return Ok(plain(solved));
    }
    better.effort.add(&solved.effort);
    better.followed_from(&solved);
    Ok(Lifted {
        study: lifted,
        solved: better,
    })
}
