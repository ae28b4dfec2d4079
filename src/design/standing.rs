//! Ranking of designs by unmet demands.

use super::margin::Margin;
use crate::index::MET;

/// Rank of a design by its unmet demands.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Standing {
    /// Relative shortfalls of the demands that are not met, the largest first.
    shortfalls: Vec<f64>,
    /// True if a search that led to the design found none with a performance.
    failed: bool,
}

impl Standing {
    /// Rank of a design with some margins; `failed`: its search found no design with a performance.
    pub fn new(margins: &[Margin], failed: bool) -> Self {
        let unmet = margins.iter().filter(|margin| !margin.met());
        let mut shortfalls: Vec<f64> = unmet.map(Margin::shortfall).collect();
        shortfalls.sort_by(|a, b| b.total_cmp(a));
        Self { shortfalls, failed }
    }

    /// True if it ranks before another: the largest shortfall decides, then the next, where they differ by
    /// more than [`MET`].
    pub fn is_better_than(&self, other: &Self) -> bool {
        let count = self.shortfalls.len().max(other.shortfalls.len());
        for k in 0..count {
            let [own, others] = [self, other].map(|s| s.shortfalls.get(k).copied().unwrap_or(0.0));
            // Both may be infinite.
            let gain = others - own;
            if gain.abs() > MET {
                return gain > 0.0;
            }
        }
        !self.failed && other.failed
    }
}
