//! The best known designs, `best.json`, and how they were confirmed.

use std::{collections::BTreeMap, fs};

use bogie::{case::Case, parameter::Parameter};
use serde::{Deserialize, Serialize};

use crate::problem::{Problem, Worth, folder};

/// The best known design of a problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Best {
    /// Its objective, a cost.
    pub merit: f64,
    /// Largest relative shortfall of a demand, as a logarithm; 0 where all are met.
    pub violation: f64,
    /// Which method found it.
    pub found_by: String,
    /// Values of the open parameters, SI.
    pub design: BTreeMap<String, f64>,
    /// What each method came to.
    pub methods: BTreeMap<String, Reached>,
}

/// What one method came to.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Reached {
    /// Objective; `None` without a design that has a performance.
    pub merit: Option<f64>,
    /// Largest relative shortfall of a demand, as a logarithm; 0 where all are met.
    pub violation: Option<f64>,
    /// Evaluations that it took.
    pub evaluations: usize,
}

/// All best known designs, by name of the problem.
pub type Known = BTreeMap<String, Best>;

/// Merits closer than this are the same: a change of a thousandth of an index is none to an engineer.
pub const SAME: f64 = 1e-3;

/// Reads `best.json`; empty if there is none.
pub fn read() -> Known {
    match fs::read_to_string(folder().join("best.json")) {
        Ok(text) => serde_json::from_str(&text).expect("best.json holds best known designs"),
        Err(_) => Known::new(),
    }
}

/// Writes `best.json`.
pub fn write(known: &Known) {
    let mut text = serde_json::to_string_pretty(known).expect("plain data");
    text.push('\n');
    fs::write(folder().join("best.json"), text).expect("best.json is written");
}

impl Best {
    /// Its worth by today's models.
    pub fn worth(&self, problem: &Problem) -> Worth {
        problem.worth(&problem.case(|name| self.design.get(name).copied()))
    }

    /// Whether a method other than the search under test came to it, within [`SAME`].
    pub fn confirmed(&self) -> bool {
        let best = Worth {
            merit: self.merit,
            violation: self.violation,
        };
        let independent = self.methods.get("independent");
        independent.is_some_and(|reached| reached.worth().behind(best) <= SAME)
    }
}

impl Reached {
    /// Of a worth.
    pub fn new(worth: Worth, evaluations: usize) -> Self {
        let finite = |value: f64| value.is_finite().then_some(value);
        Self {
            merit: finite(worth.merit),
            violation: finite(worth.violation.max(0.0)),
            evaluations,
        }
    }

    fn worth(&self) -> Worth {
        Worth {
            merit: self.merit.unwrap_or(f64::INFINITY),
            violation: self.violation.unwrap_or(f64::INFINITY),
        }
    }
}

/// Takes over what a method came to, and its design if it is better than the best known.
pub fn learn(known: &mut Known, problem: &Problem, method: &str, case: &Case, evaluations: usize) {
    /// Gains below this are rounding.
    const GAIN: f64 = 1e-7;
    let worth = problem.worth(case);
    let reached = Reached::new(worth, evaluations);
    let before = known.get(&problem.name);
    let better = before.is_none_or(|before| worth.behind(before.worth(problem)) < -GAIN);
    if better && worth.merit.is_finite() {
        let value = |p: Parameter| (p.name().to_owned(), p.get(case));
        let methods = before.map(|before| before.methods.clone());
        let best = Best {
            merit: worth.merit,
            violation: worth.violation.max(0.0),
            found_by: method.into(),
            design: problem.open().map(value).collect(),
            methods: methods.unwrap_or_default(),
        };
        known.insert(problem.name.clone(), best);
    }
    let Some(best) = known.get_mut(&problem.name) else {
        return;
    };
    // A method keeps the best that it has come to.
    let own = best.methods.get(method).map(Reached::worth);
    if own.is_none_or(|own| worth.behind(own) < 0.0) {
        best.methods.insert(method.into(), reached);
    }
}
