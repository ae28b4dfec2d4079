//! Starts of a search.

use super::local;

/// Default bound on the share of the space in basins not yet seen: a search that finds w local optima
/// then follows about 4.5 w + 2 uniform points.
pub const UNSEEN: f64 = 0.05;
/// The bound of a thorough search.
pub const UNSEEN_THOROUGH: f64 = 0.01;

/// Starts of a search.
#[derive(Debug, Clone)]
pub struct Start {
    /// Global search; `None`: only from `designs`.
    pub everywhere: Option<Everywhere>,
    /// Designs to start from besides, in scaled coordinates.
    pub designs: Vec<Vec<f64>>,
    /// First trust radius around these; a global search sets its own.
    pub radius: f64,
}

/// A search over the whole of the box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Everywhere {
    /// Seed of the uniform points.
    pub seed: u64,
    /// Bound on the estimated share of the space in basins not yet seen, at which the search ends.
    pub unseen: f64,
    /// True if searches also start from the far ends of the best design's variables.
    pub turns: bool,
}

impl Start {
    /// Global search with a seed.
    pub fn everywhere(seed: u64) -> Self {
        Self {
            everywhere: Some(Everywhere {
                seed,
                unseen: UNSEEN,
                turns: true,
            }),
            designs: Vec::new(),
            radius: local::WIDE,
        }
    }

    /// Local searches near designs that were optimal for a slightly different problem.
    pub fn near(designs: Vec<Vec<f64>>) -> Self {
        Self {
            everywhere: None,
            designs,
            radius: local::NARROW,
        }
    }

    /// Sets the bound on the share of the space in basins not yet seen.
    #[must_use]
    pub fn until(mut self, unseen: f64) -> Self {
        if let Some(everywhere) = &mut self.everywhere {
            everywhere.unseen = unseen;
        }
        self
    }

    /// Without starts from far ends: enough for the estimate of unseen basins, but less reliable.
    #[must_use]
    pub fn plainly(mut self) -> Self {
        if let Some(everywhere) = &mut self.everywhere {
            everywhere.turns = false;
        }
        self
    }

    /// Adds designs to start from.
    #[must_use]
    pub fn with(mut self, designs: Vec<Vec<f64>>) -> Self {
        self.designs.extend(designs);
        self
    }
}
