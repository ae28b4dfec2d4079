//! Critical speed: the lowest speed at which an oscillatory mode loses its damping (3.4.4.2).

use super::{
    branches::{Branches, Event, Known, Search, Sought, onset},
    mode::{Mode, frequency},
};
use crate::dynamics::{LateralModel, Poles, lateral::Body};

/// Which body hunts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hunting {
    /// The wheelsets and truck frames carry most of the energy.
    Truck,
    /// The carbody does.
    Carbody,
}

impl std::fmt::Display for Hunting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Truck => "truck hunting",
            Self::Carbody => "carbody hunting",
        })
    }
}

/// A speed at which a mode loses its damping.
#[derive(Debug, Clone)]
pub struct Crossing {
    /// V, m/s.
    pub speed: f64,
    /// Hunting frequency, Hz.
    pub frequency: f64,
    /// Which body hunts.
    pub kind: Hunting,
    /// Shape and left vector.
    pub mode: Mode,
}

/// Outcome of the search.
#[derive(Debug, Clone)]
pub struct Stability {
    /// Range searched, m/s.
    pub range: [f64; 2],
    /// Onsets of instability in ascending speed. Empty: stable over the whole range.
    pub onsets: Vec<Crossing>,
    /// The vehicle already hunts at the lowest speed searched.
    pub unstable_at_start: bool,
    /// Lowest grid speed with a growing non-oscillatory motion, m/s.
    pub divergence: Option<f64>,
}

/// Share of the lowest onset's speed below it at which nothing must grow.
const BEYOND: f64 = 1e-4;

impl Crossing {
    /// A mode that loses its damping at `speed`, m/s.
    pub(super) fn new(model: &LateralModel, speed: f64, mode: Mode) -> Self {
        let carbody = mode.energy_share(&model.forced.system, |i| {
            model.coordinates.coordinate(i).body() == Body::Carbody
        });
        Self {
            speed,
            frequency: frequency(mode.eigenvalue),
            kind: if carbody > 0.5 {
                Hunting::Carbody
            } else {
                Hunting::Truck
            },
            mode,
        }
    }
}

impl Stability {
    /// By following the modes from the poles at some speed, up to a multiple `reach` of the lowest
    /// onset: much quicker than [`Stability::search`], but an instability that begins and ends
    /// between two of its speeds is passed over. `None` where the modes cannot be followed.
    pub fn followed(
        model: &LateralModel,
        poles: &Poles,
        range: [f64; 2],
        reach: f64,
    ) -> Option<Self> {
        let [low, high] = range;
        let mut branches = Branches::within(range, model, poles)?;
        let wants = |sought, a: &Known, b: &Known| sought == Sought::Onset && onset(a, b);
        let mut search = Search {
            wants: &wants,
            events: Vec::new(),
        };
        let lowest = |events: &[Event]| {
            let speeds = events.iter().map(|event| event.at.speed);
            speeds.fold(f64::INFINITY, f64::min)
        };
        let start = branches.walk(low, &mut search, |_, _| false)?;
        branches.walk(high, &mut search, |events, speed| {
            speed > reach * lowest(events)
        })?;
        let unstable_at_start = start.iter().any(|known| known.s.re >= 0.0);
        search
            .events
            .sort_by(|a, b| a.at.speed.total_cmp(&b.at.speed));
        if let Some(Event { at, .. }) = search.events.first().filter(|_| !unstable_at_start) {
            let below = at.s - at.slope * BEYOND;
            if !branches.stable_at(at.speed * (1.0 - BEYOND), below) {
                return None;
            }
        }
        let mut onsets = Vec::with_capacity(search.events.len());
        for event in search.events {
            onsets.push(Crossing::new(model, event.at.speed, event.mode?));
        }
        Some(Self {
            range,
            onsets,
            unstable_at_start,
            divergence: None,
        })
    }

    /// The critical speed, m/s: the lowest onset, or the start of the range if the vehicle already
    /// hunts there. `None`: stable over the whole range.
    pub fn critical_speed(&self) -> Option<f64> {
        if self.unstable_at_start {
            return Some(self.range[0]);
        }
        self.onsets.first().map(|onset| onset.speed)
    }

    /// Lowest onset of one kind of hunting.
    pub fn onset(&self, kind: Hunting) -> Option<&Crossing> {
        self.onsets.iter().find(|onset| onset.kind == kind)
    }
}
