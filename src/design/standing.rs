//! How designs stand to the demands, one against another.

use super::margin::{Margin, Verdict};
use crate::index::MET;

/// How a design stands to the demands.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Standing {
    /// Largest relative shortfall; infinite where a demand has no value.
    shortfall: f64,
    /// Whether a search that led to the design found none with a performance.
    failed: bool,
    /// Demands that the models do not cover at the design.
    not_assessed: usize,
}

impl Standing {
    /// Of a design with such margins, which came from a search that `failed` or did not.
    pub fn new(margins: &[Margin], failed: bool) -> Self {
        let is_assessed = |margin: &&Margin| margin.verdict() != Verdict::NotAssessed;
        let assessed = margins.iter().filter(is_assessed);
        Self {
            shortfall: assessed.map(Margin::shortfall).fold(0.0, f64::max),
            failed,
            not_assessed: margins.iter().filter(|m| !is_assessed(m)).count(),
        }
    }

    /// Whether it is better than another: by the shortfall, if that differs by more than is seen.
    pub fn is_better_than(&self, other: &Self) -> bool {
        let gain = other.shortfall - self.shortfall;
        // Both may be infinite.
        let same = gain.is_nan() || gain.abs() <= MET;
        let rest = |standing: &Self| (standing.failed, standing.not_assessed);
        gain > MET || same && rest(self) < rest(other)
    }
}
