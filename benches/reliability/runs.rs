//! Runs of the search under test, and their table.

use std::fmt::Write as _;

use bogie::{
    design::procedure::design,
    optimize::archive::{Archive, Silent},
};
use rayon::prelude::*;
use serde::Serialize;

use crate::{
    best::{Known, SAME, learn},
    problem::{Problem, Worth},
};

/// Merit by which a design must be better than the best known to take its place: less is what the
/// tolerance on first-order conditions leaves.
const GAIN: f64 = 1e-5;

/// One run.
#[derive(Debug, Clone, Serialize)]
pub struct Run {
    /// Seed of the search.
    pub seed: u64,
    /// Objective of the optimum found.
    pub merit: Option<f64>,
    /// Its largest relative shortfall of a demand.
    pub violation: Option<f64>,
    /// How far it is behind the best known design; `None` if it is not comparable.
    pub behind: Option<f64>,
    /// Whether it reached that design.
    pub reached: bool,
    /// Status that the search gave it.
    pub status: String,
    /// Full-model evaluations.
    pub evaluations: usize,
    /// Seconds, on a machine with other work.
    pub seconds: f64,
}

/// The runs of a problem.
#[derive(Debug, Serialize)]
pub struct Runs {
    /// Its name.
    pub name: String,
    /// Variables, profiles to choose from, and conditions.
    pub size: [usize; 3],
    /// Objective of the best known design.
    pub merit: f64,
    /// Its largest relative shortfall of a demand.
    pub violation: f64,
    /// Whether it was confirmed by an independent method.
    pub confirmed: bool,
    /// One for each seed.
    pub seeds: Vec<Run>,
}

/// Runs a problem with seeds from 1 up. What is better than the best known design takes its place.
pub fn run(problem: &Problem, seeds: u64, known: &mut Known) -> Runs {
    let designs: Vec<_> = (1..=seeds)
        .into_par_iter()
        .map(|seed| {
            let mut spec = problem.spec.clone();
            spec.design.seed = seed;
            let archive = Archive::new(&Silent);
            let result = design(&spec, &archive);
            (seed, result.expect("a spec with something to choose"))
        })
        .collect();
    for (_, result) in &designs {
        let worth = problem.worth(&result.optimum);
        let before = known.get(&problem.name).map(|best| best.worth(problem));
        if before.is_none_or(|before| worth.behind(before) < -GAIN) {
            let count = result.effort.evaluations;
            learn(known, problem, "bogie", &result.optimum, count);
        }
    }
    let best = known.get(&problem.name);
    let target = best.map_or(Worth::NONE, |best| best.worth(problem));
    let runs = designs.iter().map(|(seed, result)| {
        let worth = problem.worth(&result.optimum);
        let behind = worth.behind(target);
        let stage = result.delivered_stages().last();
        let status = stage.map(|stage| format!("{:?}", stage.explained.status));
        let finite = |value: f64| value.is_finite().then_some(value);
        Run {
            seed: *seed,
            merit: finite(worth.merit),
            violation: finite(worth.violation.max(0.0)),
            behind: finite(behind),
            reached: behind <= SAME,
            status: status.unwrap_or_default(),
            evaluations: result.effort.evaluations,
            seconds: result.effort.seconds,
        }
    });
    Runs {
        name: problem.name.clone(),
        size: [
            problem.variables(),
            problem.profiles.len(),
            problem.conditions(),
        ],
        merit: target.merit,
        violation: target.violation.max(0.0),
        confirmed: best.is_some_and(|best| best.confirmed()),
        seeds: runs.collect(),
    }
}

impl Runs {
    fn reached(&self) -> usize {
        self.seeds.iter().filter(|run| run.reached).count()
    }

    /// The best known merit, or the violation where demands are out of reach.
    fn known(&self) -> String {
        let unconfirmed = if self.confirmed { "" } else { " ?" };
        if self.violation > bogie::index::MET {
            format!("violation {:.4}{unconfirmed}", self.violation)
        } else {
            format!("{:.4}{unconfirmed}", self.merit)
        }
    }

    /// Largest distance behind the best known design.
    fn worst(&self) -> String {
        let missed = |run: &Run| run.behind.unwrap_or(f64::INFINITY);
        let worst = self.seeds.iter().map(missed).fold(0.0, f64::max);
        match worst {
            _ if worst <= SAME => "–".into(),
            _ if worst.is_finite() => format!("{worst:.4}"),
            _ => "demand missed".into(),
        }
    }

    fn failures(&self) -> String {
        let missed = self.seeds.iter().filter(|run| !run.reached);
        let seeds: Vec<String> = missed.map(|run| run.seed.to_string()).collect();
        if seeds.is_empty() {
            "–".into()
        } else {
            seeds.join(", ")
        }
    }
}

/// Median and largest.
fn spread(mut values: Vec<f64>, digits: usize) -> String {
    values.sort_by(f64::total_cmp);
    let (median, largest) = (values[(values.len() - 1) / 2], values[values.len() - 1]);
    format!("{median:.digits$} ({largest:.digits$})")
}

/// A table in Markdown, and what it comes to.
pub fn table(all: &[Runs]) -> String {
    let mut text = String::from(
        "| problem | variables | profiles | conditions | best known | reached | evaluations | seconds \
         | furthest behind | seeds that miss |\n\
         | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
    );
    let mut total = [0; 2];
    let [mut always, mut confirmed] = [0; 2];
    for runs in all {
        let [variables, profiles, conditions] = runs.size;
        let of = |value: fn(&Run) -> f64| runs.seeds.iter().map(value).collect();
        let (reached, count) = (runs.reached(), runs.seeds.len());
        total[0] += reached;
        total[1] += count;
        always += usize::from(reached == count);
        confirmed += usize::from(runs.confirmed);
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "| {} | {variables} | {profiles} | {conditions} | {} | {reached} of {count} | {} | {} | {} | {} |",
            runs.name,
            runs.known(),
            spread(of(|run| run.evaluations as f64), 0),
            spread(of(|run| run.seconds), 1),
            runs.worst(),
            runs.failures(),
        );
    }
    let [reached, count] = total;
    let _ = writeln!(
        text,
        "\n{} problems, {confirmed} of them with a best known design that the independent methods came \
         to; {reached} of {count} runs reached it ({:.2} %), in {always} problems every one.",
        all.len(),
        100.0 * reached as f64 / count as f64
    );
    text
}
