//! Where a search begins.

use super::local;

/// Bound on the share of the space in basins not yet seen, unless told otherwise: with it a search
/// that found w local optima followed about 4.5 w + 2 uniform points.
pub const UNSEEN: f64 = 0.05;
/// The bound of a thorough search.
pub const UNSEEN_THOROUGH: f64 = 0.01;

/// Where a search begins.
#[derive(Debug, Clone)]
pub struct Start {
    /// Search everywhere; otherwise only from `designs`.
    pub everywhere: Option<Everywhere>,
    /// Designs to begin from besides, in scaled coordinates.
    pub designs: Vec<Vec<f64>>,
    /// Trust radius around these; a search everywhere sets its own.
    pub radius: f64,
}

/// A search over the whole of the box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Everywhere {
    /// Seed of the uniform points.
    pub seed: u64,
    /// The search goes on until the estimated share of the space in basins not yet seen is below
    /// this.
    pub unseen: f64,
    /// Whether it is also begun from the far ends of the best design's variables.
    pub turns: bool,
}

impl Start {
    /// Anywhere, with a seed.
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

    /// Near designs that were optimal for a slightly different problem.
    pub fn near(designs: Vec<Vec<f64>>) -> Self {
        Self {
            everywhere: None,
            designs,
            radius: local::NARROW,
        }
    }

    /// With another bound on the share of the space in basins not yet seen.
    #[must_use]
    pub fn until(mut self, unseen: f64) -> Self {
        if let Some(everywhere) = &mut self.everywhere {
            everywhere.unseen = unseen;
        }
        self
    }

    /// Only from uniform points and designs known: enough for the estimate of unseen basins, but less
    /// sure.
    #[must_use]
    pub fn plainly(mut self) -> Self {
        if let Some(everywhere) = &mut self.everywhere {
            everywhere.turns = false;
        }
        self
    }

    /// Looks at these designs too.
    #[must_use]
    pub fn with(mut self, designs: Vec<Vec<f64>>) -> Self {
        self.designs.extend(designs);
        self
    }
}
