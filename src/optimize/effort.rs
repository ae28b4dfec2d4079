//! What a search has spent.

use std::collections::BTreeMap;

use super::problem::Failure;

/// What a search has spent.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Effort {
    /// Full-model evaluations; what the archive knew is not counted.
    pub evaluations: usize,
    /// Of which without a result, by reason.
    pub failures: BTreeMap<Failure, usize>,
    /// Local searches.
    pub starts: usize,
    /// How many of them came to the design that was returned.
    pub agreed: usize,
    /// Seconds.
    pub seconds: f64,
}

impl Effort {
    /// Adds what another search has spent; local searches stay those of this one.
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
