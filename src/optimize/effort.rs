//! Effort of a search.

use std::collections::BTreeMap;

use super::problem::Failure;

/// Effort of a search.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Effort {
    /// Full-model evaluations, without those served by the archive.
    pub evaluations: usize,
    /// Number of them without values, by reason.
    pub failures: BTreeMap<Failure, usize>,
    /// Number of local searches.
    pub starts: usize,
    /// Number of them that came to the design returned.
    pub agreed: usize,
    /// Time, s.
    pub seconds: f64,
}

impl Effort {
    /// Adds evaluations, failures and time of another search.
    pub fn add(&mut self, other: &Self) {
        self.evaluations += other.evaluations;
        for (failure, count) in &other.failures {
            *self.failures.entry(*failure).or_default() += count;
        }
        self.seconds += other.seconds;
    }

    /// Evaluations without a result.
    pub fn failed(&self) -> usize {
        self.failures.values().sum()
    }
}
