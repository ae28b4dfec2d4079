//! Studies solved with the critical speed as an epigraph variable, where it is an objective.

use super::study::Study;
use crate::optimize::{
    archive::Archive,
    local::WIDE,
    solve::{NoDesign, Solved, Start, solve},
};

/// A solution with the study in whose terms it is: the epigraph study where the critical speed is an
/// objective.
#[derive(Debug, Clone)]
pub struct EpigraphSolution {
    /// The study.
    pub study: Study,
    /// Its solution.
    pub solved: Solved,
}

/// Loss of objective against the solution of the plain study that the epigraph study may have: the
/// start value of the epigraph speed lies as much below the critical speed.
const LOSS: f64 = 1e-4;

/// Solves a study. Where the critical speed is an objective, the modes' critical speeds are the pieces of
/// a first search, whose designs start a second one with the epigraph variable.
///
/// # Errors
///
/// [`NoDesign`] if no design could be evaluated.
pub fn solve_with_epigraph(
    study: &Study,
    start: &Start,
    archive: &Archive,
) -> Result<EpigraphSolution, NoDesign> {
    let solved = solve(study, start, archive)?;
    let plain = |solved| EpigraphSolution {
        study: study.clone(),
        solved,
    };
    let Some(with_epigraph) = study.with_epigraph() else {
        return Ok(plain(solved));
    };
    if archive.stopped().is_some() {
        return Ok(plain(solved));
    }
    let optima = solved.optima.iter().map(|optimum| &optimum.found.point.x);
    let designs = optima.chain([&solved.point.x]);
    let designs: Vec<Vec<f64>> = designs
        .filter_map(|x| study.epigraph_start(x).ok())
        .collect();
    let start = Start {
        radius: WIDE / 4.0,
        ..Start::near(designs)
    };
    let Ok(mut better) = solve(&with_epigraph, &start, archive) else {
        return Ok(plain(solved));
    };
    let worse = better.point.objective() > solved.point.objective() + LOSS;
    if !better.point.feasible() || (solved.point.feasible() && worse) {
        return Ok(plain(solved));
    }
    better.effort.add(&solved.effort);
    better.followed_from(&solved);
    Ok(EpigraphSolution {
        study: with_epigraph,
        solved: better,
    })
}
