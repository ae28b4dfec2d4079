//! The procedure and the fronts on random studies, written as specs and read by the reader: what may
//! vary and how, what is asked, in which conditions, of which vehicle. Whatever the study, what comes out
//! keeps what the results promise.

mod promises;
mod study;
use std::{
    collections::BTreeMap,
    panic::{AssertUnwindSafe, catch_unwind},
    time::Instant,
};

use bogie::{export::check, spec::Spec};
use rayon::prelude::*;

/// Random studies: as many as two cores do in a minute.
const STUDIES: u64 = 1200;
/// One in so many is a front, whose points take more than a design does.
const FRONTS: u64 = 6;
/// One in so many is run twice.
const TWICE: u64 = 20;
/// One in so many is searched until most searches end by themselves.
const THOROUGH: u64 = 50;
/// Kinds of broken promises that are shown with a small study; the others are counted.
const SHOWN: usize = 12;

/// What a study breaks; a panic is a broken promise, too.
fn broken(source: &str, seed: u64) -> Vec<String> {
    let Ok(spec) = Spec::read(source.as_bytes()) else {
        return Vec::new();
    };
    let budget = budget(seed);
    let twice = seed.is_multiple_of(TWICE);
    let run = || match seed % FRONTS {
        0 => promises::of_front(&spec, budget, twice),
        _ => promises::of_design(&spec, budget, twice),
    };
    catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
        vec![format!("panic: {}", text.unwrap_or_default())]
    })
}

/// The kind of a broken promise, without its numbers.
fn kind(broken: &str) -> &str {
    broken.split(':').next().unwrap_or(broken)
}

/// The lines of a study without which it does not break the same promise.
fn smallest(source: &str, seed: u64, kind_of: &str) -> String {
    let mut lines: Vec<&str> = source.lines().collect();
    loop {
        let fewer = (0..lines.len()).find_map(|i| {
            let mut fewer = lines.clone();
            fewer.remove(i);
            let same = broken(&fewer.join("\n"), seed);
            same.iter()
                .any(|text| kind(text) == kind_of)
                .then_some(fewer)
        });
        match fewer {
            Some(fewer) => lines = fewer,
            None => return lines.join("\n"),
        }
    }
}

/// Evaluations of a study: from a single design to the covering of two variables, or enough to end.
fn budget(seed: u64) -> usize {
    let given = std::env::var("BUDGET").map(|text| text.parse().expect("a number"));
    let few = if seed % THOROUGH == 1 {
        250
    } else {
        1 + (seed % 37) as usize
    };
    given.unwrap_or(few)
}

fn seeds() -> std::ops::Range<u64> {
    let number = |name| std::env::var(name).map(|text| text.parse().expect("a number"));
    number("FROM").unwrap_or(0)..number("TO").unwrap_or(STUDIES)
}

#[test]
fn designs_and_fronts_keep_their_promises() {
    let clock = Instant::now();
    let found: Vec<(u64, String, Vec<String>)> = seeds()
        .into_par_iter()
        .map(|seed| {
            let source = study::readable(seed);
            let broken = broken(&source, seed);
            (seed, source, broken)
        })
        .filter(|(_, _, broken)| !broken.is_empty())
        .collect();
    eprintln!("{:?}", clock.elapsed());
    for (seed, _, broken) in &found {
        eprintln!("study {seed}: {broken:?}");
    }
    let mut kinds: BTreeMap<&str, Vec<(u64, &str, &str)>> = BTreeMap::new();
    for (seed, source, broken) in &found {
        for text in broken {
            let of_kind = kinds.entry(kind(text)).or_default();
            of_kind.push((*seed, source, text));
        }
    }
    let counts: Vec<(&str, usize)> = kinds.iter().map(|(kind, all)| (*kind, all.len())).collect();
    let shown = kinds.iter().take(SHOWN).map(|(kind, all)| {
        let (seed, source, text) = all[0];
        let spec = smallest(source, seed, kind);
        format!("\nstudy {seed}: {text}\n{spec}\n")
    });
    let shown: String = shown.collect();
    assert!(
        found.is_empty(),
        "{} of {:?}: {counts:?}{shown}",
        found.len(),
        seeds()
    );
}

/// What the reader makes of a study, broken or not: mistakes and doubts have places in the text, and what
/// is accepted is what `bogie check` calls valid.
#[test]
fn every_study_is_read_or_answered() {
    let (mut accepted, mut refused) = (0, 0);
    for seed in 0..STUDIES {
        let source = study::text(seed, seed.is_multiple_of(2));
        let read = Spec::read(source.as_bytes());
        let answer = check::json("study", &source, &read);
        assert_eq!(answer["valid"], read.is_ok(), "study {seed}");
        let list = |key: &str| answer[key].as_array().expect("a list").clone();
        let (mistakes, warnings) = (list("mistakes"), list("warnings"));
        assert_eq!(mistakes.is_empty(), read.is_ok(), "study {seed}:\n{source}");
        let lines = source.lines().count() as u64;
        for entry in mistakes.iter().chain(&warnings) {
            // What a spec lacks has no place.
            let line = entry["line"].as_u64();
            assert!(
                line.is_none_or(|n| (1..=lines + 1).contains(&n)),
                "study {seed}: {entry}"
            );
            assert!(!entry["message"].as_str().expect("words").is_empty());
        }
        match &read {
            Ok(spec) => {
                accepted += 1;
                spec.doubts.render("study", &source, false);
                check::text("study", spec);
            }
            Err(mistakes) => {
                refused += 1;
                assert!(mistakes.render("study", &source, true).contains("study"));
            }
        }
    }
    // Half of the studies are spoilt; of the others most hold together.
    let both = accepted.min(refused);
    assert!(both > STUDIES / 8, "{accepted} accepted, {refused} refused");
}
