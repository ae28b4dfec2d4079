//! Confirms the best known designs by methods other than the search under test.

use bogie::{
    case::Case,
    design::search::search,
    optimize::{
        archive::{Archive, Silent},
        local,
        solve::Start,
    },
};
use rayon::prelude::*;

use crate::{
    best::{Known, learn},
    evolution::{Counted, Sample, best, evolve, strategy, uniform},
    problem::{Problem, Profile, Worth},
};

/// Evaluations of differential evolution, per variable.
const EVOLUTION: usize = 1200;
/// Starts of the evolution strategy; evaluations per variable and first step of each.
const STARTS: usize = 200;
const FIRST: (usize, f64) = (20, 0.1);
/// Of these the best go on, with smaller steps.
const SECOND: (usize, usize, f64) = (16, 150, 0.03);
const THIRD: (usize, usize, f64) = (5, 300, 0.01);
/// Starts of the local search of the program.
const LOCAL: usize = 200;
/// Seed of all random numbers: no choice of it was made.
const SEED: u64 = 1981;

/// Adds to the best known designs what the methods come to.
pub fn confirm(problem: &Problem, known: &mut Known) {
    let mut spent = 0;
    let mut found: Option<(Case, Worth)> = None;
    for profile in &problem.profiles {
        let (sample, count) = independent(profile);
        spent += count;
        if let Some(sample) = sample {
            let case = profile.study.design(&sample.x);
            let worth = problem.worth(&case);
            if found
                .as_ref()
                .is_none_or(|(_, best)| worth.behind(*best) < 0.0)
            {
                found = Some((case, worth));
            }
        }
    }
    if let Some((case, _)) = &found {
        learn(known, problem, "independent", case, spent);
    }
    if let Some((case, count)) = many_local(problem) {
        learn(known, problem, "local from everywhere", &case, count);
    }
    // A start that came close to the best design by other ways is followed to its end.
    let best = known.get(&problem.name).map(|best| best.worth(problem));
    let short = found.zip(best).map(|((_, own), best)| own.behind(best));
    let short = short.map_or_else(String::new, |short| format!(", independent {short:+.6}"));
    eprintln!(
        "{}: {:?}{short}, {spent} evaluations",
        problem.name,
        best.unwrap_or(Worth::NONE)
    );
}

/// The best design of a profile by differential evolution and the evolution strategy, with the
/// evaluations that they took. Where none meets all demands, the one of least violation.
fn independent(profile: &Profile) -> (Option<Sample>, usize) {
    let study = Counted::new(&profile.study);
    let found = polished(&study);
    let met = found.as_ref().is_some_and(Sample::feasible);
    if met {
        return (found, study.count());
    }
    let short = Counted::new(&profile.shortfall);
    let closest = polished(&short);
    let mut count = study.count() + short.count();
    // Where the demands are met after all, the objective decides.
    if let Some(closest) = closest.as_ref().filter(|s| s.objective <= 0.0) {
        let again = Counted::new(&profile.study);
        let n = closest.x.len();
        let from = refined(&again, &[closest.clone()], (1, 10 * THIRD.1 * n, SECOND.2));
        count += again.count();
        return (best(from), count);
    }
    (closest, count)
}

fn polished(study: &Counted) -> Option<Sample> {
    let starts = uniform(study, STARTS, SEED);
    let n = starts.first()?.x.len();
    let mut ends = refined(study, &starts, (STARTS, FIRST.0 * n, FIRST.1));
    ends.extend(best(evolve(study, EVOLUTION * n, SEED)));
    for (count, evaluations, sigma) in [SECOND, THIRD] {
        ends.sort_by(|a, b| match (a.better_than(b), b.better_than(a)) {
            (true, _) => std::cmp::Ordering::Less,
            (_, true) => std::cmp::Ordering::Greater,
            _ => std::cmp::Ordering::Equal,
        });
        ends = refined(study, &ends, (count, evaluations * n, sigma));
    }
    best(ends)
}

/// Where the evolution strategy comes to from the first of some designs: (how many, evaluations of
/// each, first step).
fn refined(study: &Counted, from: &[Sample], how: (usize, usize, f64)) -> Vec<Sample> {
    let (count, evaluations, sigma) = how;
    let first = from.par_iter().take(count).enumerate();
    first
        .map(|(i, start)| strategy(study, start, sigma, evaluations, SEED + i as u64))
        .collect()
}

/// The best design that the program's own local search comes to from many random designs, without its
/// global phase, and the evaluations.
fn many_local(problem: &Problem) -> Option<(Case, usize)> {
    let archive = Archive::new(&Silent);
    let mut found: Option<(Case, Worth)> = None;
    for profile in &problem.profiles {
        let starts = uniform(&Counted::new(&profile.study), LOCAL, SEED + 1);
        let start = Start {
            radius: local::WIDE,
            ..Start::near(starts.into_iter().map(|s| s.x).collect())
        };
        let Ok(searched) = search(&profile.study, &start, &archive) else {
            continue;
        };
        let n = profile.study.parameters().len();
        let case = profile.study.design(&searched.solved.point.x[..n]);
        let worth = problem.worth(&case);
        if found
            .as_ref()
            .is_none_or(|(_, best)| worth.behind(*best) < 0.0)
        {
            found = Some((case, worth));
        }
    }
    found.map(|(case, _)| (case, archive.count()))
}
