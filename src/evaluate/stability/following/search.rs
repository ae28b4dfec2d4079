//! Search for events along the followed modes: kind of event and step size.

use super::events::{Event, EventKind};

/// Search for events, and the events found.
pub struct EventSearch {
    /// Kind of event; `None`: modes are followed without a search.
    pub(super) kind: Option<EventKind>,
    /// Damping ratio below which minima count.
    pub(super) below: f64,
    /// Largest relative deviation of an eigenvalue from its extrapolation: the first value times its
    /// damping ratio, but not less than the second. The error of the cubic over a step is a small part
    /// of the deviation.
    pub(super) deviation: [f64; 2],
    /// Damping ratio above which modes need not be distinguished where two meet.
    pub(super) clear_of: f64,
    /// Events found.
    pub events: Vec<Event>,
}

/// Step size over the speed, by the deviation from the extrapolation that a step may have. Modes that
/// long steps cannot distinguish are followed again with short ones. A share of one for the deviation
/// over the damping ratio would step over brief instabilities.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepSize {
    /// For most vehicles.
    Long,
    /// For vehicles where long steps fail.
    Short,
}

impl StepSize {
    /// Both, in the order in which they are tried.
    const BOTH: [Self; 2] = [Self::Long, Self::Short];

    /// Answer with the first step size that has one.
    pub fn first_answer<T>(answer: impl FnMut(Self) -> Option<T>) -> Option<T> {
        Self::BOTH.into_iter().find_map(answer)
    }

    const fn deviation(self) -> [f64; 2] {
        match self {
            Self::Long => [0.2, 0.003],
            Self::Short => [0.05, 0.001],
        }
    }
}
/// Margin in damping ratio between the modes that count and those that need not be distinguished.
const CLEARANCE: f64 = 0.02;

impl EventSearch {
    /// Search for onsets of instability.
    pub fn onsets(steps: StepSize) -> Self {
        Self::of(EventKind::Onset, 0.0, steps)
    }

    /// Search for minima of damping ratios below a value.
    pub fn minima(below: f64, steps: StepSize) -> Self {
        Self::of(EventKind::Minimum, below, steps)
    }

    fn of(kind: EventKind, below: f64, steps: StepSize) -> Self {
        Self {
            kind: Some(kind),
            below,
            deviation: steps.deviation(),
            clear_of: below + CLEARANCE,
            events: Vec::new(),
        }
    }

    /// No search: for the way to the start of one.
    pub(super) fn idle() -> Self {
        Self {
            kind: None,
            below: f64::NEG_INFINITY,
            deviation: [1.0, 0.1],
            clear_of: f64::NEG_INFINITY,
            events: Vec::new(),
        }
    }
}
