//! Confirms the best known designs by methods other than the search under test.

use bogie::{
    case::Case,
    optimize::{
        archive::{Archive, Silent},
        local,
        solve::{Start, solve},
    },
};
use rayon::prelude::*;

use crate::{
    best::{Known, learn},
    evolution::{Counted, Sample, best, evolve, strategy, uniform},
    problem::{Problem, Profile, Worth},
};

/// Evaluations of differential evolution, per variable.
const EVOLUTION: usize = 600;
/// Starts of the evolution strategy over all profiles; evaluations per variable and first step of each.
const STARTS: usize = 200;
const FIRST: (usize, f64) = (12, 0.1);
/// How many of the best go on for each profile, likewise.
const SECOND: (usize, usize, f64) = (10, 100, 0.03);
const THIRD: (usize, usize, f64) = (4, 1000, 0.01);
/// Starts of the local search of the program.
const LOCAL: usize = 100;
/// Seed of all random numbers: no choice of it was made.
const SEED: u64 = 1981;

/// Adds to the best known designs what the methods come to, with so many `times` the usual starts.
pub fn confirm(problem: &Problem, known: &mut Known, times: usize) {
    let mut spent = 0;
    let mut found: Option<(Case, Worth)> = None;
    for profile in &problem.profiles {
        let (sample, count) = independent(profile, STARTS / problem.profiles.len(), times);
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
    let met = found.as_ref().is_some_and(|(_, worth)| worth.met());
    if let Some((case, count)) = many_local(problem, met) {
        learn(known, problem, "local from everywhere", &case, count);
    }
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
fn independent(profile: &Profile, starts: usize, times: usize) -> (Option<Sample>, usize) {
    let study = Counted::new(&profile.study);
    let found = polished(&study, starts, times);
    let met = found.as_ref().is_some_and(Sample::feasible);
    if met {
        return (found, study.count());
    }
    let short = Counted::new(&profile.shortfall);
    let closest = polished(&short, starts, times);
    let mut count = study.count() + short.count();
    // Where the demands are met after all, the objective decides.
    if let Some(closest) = closest.as_ref().filter(|s| s.objective <= 0.0) {
        let again = Counted::new(&profile.study);
        let n = closest.x.len();
        let from = refined(
            &again,
            std::slice::from_ref(closest),
            (1, THIRD.1 * n, SECOND.2),
        );
        count += again.count();
        return (best(from), count);
    }
    (closest, count)
}

fn polished(study: &Counted, starts: usize, times: usize) -> Option<Sample> {
    let starts = uniform(study, times * starts, SEED);
    let n = starts.first()?.x.len();
    let mut ends = refined(study, &starts, (starts.len(), FIRST.0 * n, FIRST.1));
    ends.extend(best(evolve(study, times * EVOLUTION * n, SEED)));
    for (count, evaluations, sigma) in [SECOND, THIRD] {
        ends.sort_by(|a, b| match (a.better_than(b), b.better_than(a)) {
            (true, _) => std::cmp::Ordering::Less,
            (_, true) => std::cmp::Ordering::Greater,
            _ => std::cmp::Ordering::Equal,
        });
        ends = refined(study, &ends, (times * count, evaluations * n, sigma));
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

/// The best design that the program's own local search comes to from many random designs, each by
/// itself and without a global phase, and the evaluations. Where the demands are out of reach, the least
/// violation is sought.
fn many_local(problem: &Problem, met: bool) -> Option<(Case, usize)> {
    let mut found: Option<(Case, Worth)> = None;
    let mut count = 0;
    for profile in &problem.profiles {
        let study = if met {
            &profile.study
        } else {
            &profile.shortfall
        };
        let count_of_each = LOCAL / problem.profiles.len();
        let starts = uniform(&Counted::new(study), count_of_each, SEED + 1);
        let ends = starts.into_par_iter().map(|start| {
            let archive = Archive::new(&Silent);
            let start = Start {
                radius: local::WIDE,
                ..Start::near(vec![start.x])
            };
            let x = solve(study, &start, &archive).ok().map(|s| s.point.x);
            (x, archive.count())
        });
        for (x, evaluations) in ends.collect::<Vec<_>>() {
            count += evaluations;
            let Some(x) = x else { continue };
            let case = profile.study.design(&x);
            let worth = problem.worth(&case);
            if found
                .as_ref()
                .is_none_or(|(_, best)| worth.behind(*best) < 0.0)
            {
                found = Some((case, worth));
            }
        }
    }
    found.map(|(case, _)| (case, count))
}
