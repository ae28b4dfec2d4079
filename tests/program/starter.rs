//! The spec that `bogie init` writes: whatever of it is put in force reads without a doubt and can be
//! designed.

use bogie::{
    design::{outcome::DesignResult, pareto::pareto, procedure::design},
    optimize::archive::{Archive, Silent},
    parameter::Parameter,
    spec::{STARTER, Spec},
};

/// Evaluations that reach the local searches of every trade-off.
const BUDGET: usize = 60;

/// A commented line that is part of a spec.
struct Commented {
    /// Its place among the lines.
    at: usize,
    /// Place of the header of its table, where that is commented too.
    header: Option<usize>,
}

/// The entry in a comment: a table's header or a key with its value.
fn entry(line: &str) -> Option<&str> {
    let text = line.strip_prefix("# ")?;
    let is_header = text.starts_with('[');
    let name = text.split(" = ").next()?;
    let is_key = name.len() < text.len()
        && name
            .chars()
            .all(|c| c.is_ascii_lowercase() || matches!(c, '_' | '.'));
    (is_header || is_key).then_some(text)
}

fn commented() -> Vec<Commented> {
    let mut header = None;
    let mut found = Vec::new();
    for (at, line) in STARTER.lines().enumerate() {
        match entry(line) {
            Some(text) if text.starts_with('[') => {
                header = Some(at);
                found.push(Commented { at, header: None });
            }
            Some(_) => found.push(Commented { at, header }),
            // A table ends where the text does.
            None if line.is_empty() => header = None,
            None => {}
        }
    }
    found
}

/// The starter with some of its commented lines in force.
fn with(lines: &[usize]) -> String {
    let line = |(at, line): (usize, &str)| match entry(line) {
        Some(text) if lines.contains(&at) => format!("{text}\n"),
        _ => format!("{line}\n"),
    };
    STARTER.lines().enumerate().map(line).collect()
}

/// Reads a spec without a mistake or a doubt, and designs it.
fn designed(what: &str, source: &str) -> (Spec, DesignResult) {
    let spec = Spec::parse(source)
        .unwrap_or_else(|mistakes| panic!("{what}: {}", mistakes.render("starter", source, false)));
    let archive = Archive::new(&Silent).with_budget(Some(BUDGET));
    let result = design(&spec, &archive).unwrap_or_else(|error| panic!("{what}: {error}"));
    (spec, result)
}

fn without_doubts(what: &str, spec: &Spec) {
    let doubts: Vec<String> = spec.doubts.sentences().collect();
    assert!(doubts.is_empty(), "{what}: {doubts:?}");
}

#[test]
fn every_commented_line_alone_and_all_together() {
    let commented = commented();
    // Five in [design], three of the objective, two requirements, five of conditions, four of a front.
    assert_eq!(commented.len(), 19);
    let mut sets: Vec<Vec<usize>> = commented
        .iter()
        .map(|line| line.header.into_iter().chain([line.at]).collect())
        .collect();
    sets.push(commented.iter().map(|line| line.at).collect());
    for set in sets {
        let source = with(&set);
        let last = set.last().and_then(|at| STARTER.lines().nth(*at));
        let what = format!("{} lines to {:?}", set.len(), last.unwrap_or_default());
        let (spec, _) = designed(&what, &source);
        without_doubts(&what, &spec);
        if spec.front.asked {
            let archive = Archive::new(&Silent).with_budget(Some(BUDGET));
            let failure = pareto(&spec, &archive).failure;
            assert_eq!(failure, None, "{what}");
        }
    }
}

/// As the starter says: a plain value in place of bounds sets the parameter.
#[test]
fn a_plain_value_in_place_of_any_bounds() {
    let mut count = 0;
    for parameter in Parameter::of_table() {
        let name = parameter.name();
        let Some(line) = STARTER
            .lines()
            .find(|l| l.starts_with(&format!("{name} = [")))
        else {
            continue;
        };
        let [_, bounds] = line.split_once('[').map(|(a, b)| [a, b]).expect("bounds");
        let lower = bounds.split(", ").next().expect("a lower bound");
        let source = STARTER.replace(line, &format!("{name} = {lower}"));
        let (spec, result) = designed(name, &source);
        let wanted = match spec.design.freedom(parameter) {
            Some(bogie::spec::Freedom::Fixed(value)) => *value,
            other => panic!("{name}: {other:?}"),
        };
        let got = parameter.get(&result.case);
        // Frequencies and ratios go through stiffness and damping and back.
        assert!((got / wanted - 1.0).abs() < 1e-12, "{name}: {got} {wanted}");
        count += 1;
    }
    assert_eq!(count, 6);
}
