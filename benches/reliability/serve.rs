//! Answers for other programs' methods: designs in, values out, one line of JSON each.
//!
//! The first line describes the problem; then each line read, a list of designs in scaled coordinates,
//! is answered by a list of values. Where there are profiles to choose from, a coordinate after the
//! variables, 0…1, chooses one: equal parts for each.

use std::io::{BufRead, Write};

use bogie::optimize::problem::{Problem as _, Values};
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::{
    best,
    problem::{Problem, Profile},
};

/// What a value counts as where a design has no performance: worse than any that has one.
const FAILED: f64 = 10.0;
/// Value of a demand of which no piece comes near its bound.
const AMPLE: f64 = -0.15;

/// Serves a problem until standard input ends.
pub fn serve(problem: &Problem) -> std::io::Result<()> {
    let known = best::read();
    let best = known.get(&problem.name).map(|best| best.worth(problem));
    let study = &problem.profiles[0].study;
    let head = json!({
        "name": problem.name,
        "variables": study.variables().iter().map(|v| v.name).collect::<Vec<_>>(),
        "profiles": problem.profiles.len(),
        "demands": study.demands().count(),
        "given": study.coordinates(&problem.spec.case),
        "merit": best.map(|best| best.merit),
        "violation": best.map(|best| best.violation.max(0.0)),
    });
    let mut out = std::io::stdout().lock();
    writeln!(out, "{head}")?;
    for line in std::io::stdin().lock().lines() {
        let designs: Vec<Vec<f64>> = serde_json::from_str(&line?)?;
        let answers: Vec<Value> = designs.par_iter().map(|x| answer(problem, x)).collect();
        writeln!(out, "{}", Value::Array(answers))?;
        out.flush()?;
    }
    Ok(())
}

fn answer(problem: &Problem, x: &[f64]) -> Value {
    let profile = choose(problem, x);
    let n = profile.study.variables().len();
    let demands: Vec<usize> = profile.study.demands().collect();
    match profile.study.evaluate(&x[..n]) {
        Ok(values) => json!({
            "objective": values.objective(),
            "constraints": demands.iter().map(|i| constraint(profile, &values, *i)).collect::<Vec<_>>(),
        }),
        Err(failure) => json!({
            "objective": FAILED,
            "constraints": vec![FAILED; demands.len()],
            "failure": failure.to_string(),
        }),
    }
}

/// The profile that the coordinate after the variables stands for; the first without one.
fn choose<'a>(problem: &'a Problem, x: &[f64]) -> &'a Profile {
    let count = problem.profiles.len();
    let n = problem.variables();
    // Truncation is meant: equal parts of 0…1.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let number = x.get(n).map_or(0, |u| (u * count as f64).max(0.0) as usize);
    &problem.profiles[number.min(count - 1)]
}

/// The largest piece of a demand.
fn constraint(profile: &Profile, values: &Values, term: usize) -> f64 {
    let own = values.constraints.iter();
    let own = own.filter(|piece| profile.study.term_of(piece.index) == term);
    let largest = own
        .map(|piece| piece.value)
        .fold(f64::NEG_INFINITY, f64::max);
    if largest.is_finite() { largest } else { AMPLE }
}
