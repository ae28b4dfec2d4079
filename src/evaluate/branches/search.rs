//! What is looked for on the way over the speeds, and how carefully.

use super::events::{Event, Sought};

/// What to look for on the way.
pub struct Search {
    /// Kind of event; `None`: nothing.
    pub(super) sought: Option<Sought>,
    /// Damping ratio below which minima are of interest.
    pub(super) below: f64,
    /// How far an eigenvalue may be found from where it was expected, as a share of its size: this
    /// share of its damping ratio, but not less than the second value. The step's own cubic is
    /// then off by a small part of that.
    pub(super) surprise: [f64; 2],
    /// Damping ratio above which modes may be lost sight of for a moment.
    pub(super) clear_of: f64,
    /// What was found.
    pub events: Vec<Event>,
}

/// How close to its expectation a mode must be found: usually, and where the modes could not be told
/// apart so. With a share of one, brief instabilities have been passed over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Care {
    /// Long steps.
    Usual,
    /// Short ones.
    Great,
}

impl Care {
    /// In the order in which they are tried.
    pub const BOTH: [Self; 2] = [Self::Usual, Self::Great];

    const fn surprise(self) -> [f64; 2] {
        match self {
            Self::Usual => [0.2, 0.003],
            Self::Great => [0.05, 0.001],
        }
    }
}
/// How far above the damping ratios of interest modes that cannot be told apart for a moment stay
/// clear of these.
const MARGIN: f64 = 0.02;

impl Search {
    /// For onsets of instability.
    pub fn onsets(care: Care) -> Self {
        Self::of(Sought::Onset, 0.0, care)
    }

    /// For minima of damping ratios below a value.
    pub fn minima(below: f64, care: Care) -> Self {
        Self::of(Sought::Minimum, below, care)
    }

    fn of(sought: Sought, below: f64, care: Care) -> Self {
        Self {
            sought: Some(sought),
            below,
            surprise: care.surprise(),
            clear_of: below + MARGIN,
            events: Vec::new(),
        }
    }

    /// For nothing: on the way to where a search begins.
    pub(super) fn idle() -> Self {
        Self {
            sought: None,
            below: f64::NEG_INFINITY,
            surprise: [1.0, 0.1],
            clear_of: f64::NEG_INFINITY,
            events: Vec::new(),
        }
    }
}
