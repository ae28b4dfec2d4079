//! Where a search begins.

use super::local;

/// Local searches that follow a global phase, unless told otherwise, and where an index has many
/// local optima.
const STARTS: usize = 2;
const MANY_STARTS: usize = 8;

/// Where a search begins.
#[derive(Debug, Clone)]
pub struct Start {
    /// Search everywhere with this seed; otherwise only from `designs`.
    pub everywhere: Option<u64>,
    /// Local searches that follow a global phase, beside one per variable.
    pub starts: usize,
    /// Designs worth a look, in scaled coordinates.
    pub designs: Vec<Vec<f64>>,
    /// Trust radius around these; a global phase sets its own.
    pub radius: f64,
    /// Objective that another problem has reached: one local search will do where this one has no
    /// hope to beat it.
    pub beat: f64,
    /// Then not even one.
    pub gives_up: bool,
}

impl Start {
    /// Anywhere, with a seed.
    pub fn everywhere(seed: u64) -> Self {
        Self {
            everywhere: Some(seed),
            starts: STARTS,
            designs: Vec::new(),
            radius: local::WIDE,
            beat: f64::INFINITY,
            gives_up: false,
        }
    }

    /// Near designs that were optimal for a slightly different problem.
    pub fn near(designs: Vec<Vec<f64>>) -> Self {
        Self {
            everywhere: None,
            starts: STARTS,
            designs,
            radius: local::NARROW,
            beat: f64::INFINITY,
            gives_up: false,
        }
    }

    /// Searches locally from many of the designs that the global phase met.
    #[must_use]
    pub fn thoroughly(self) -> Self {
        Self {
            starts: MANY_STARTS,
            ..self
        }
    }

    /// Looks at these designs too.
    #[must_use]
    pub fn with(mut self, designs: Vec<Vec<f64>>) -> Self {
        self.designs.extend(designs);
        self
    }
}
