//! Critical speed: the lowest speed at which an oscillatory mode loses its damping (3.4.4.2).

use super::{
    branches::{Branches, Care, Event, Search},
    mode::Mode,
};
use crate::{
    case::Case,
    dynamics::{LateralModel, lateral::Body},
    numerics::{EigenError, Poles, frequency},
};

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
    /// The lowest speed searched, m/s, if a motion without oscillation grows there: none begins to at a
    /// higher speed, as det K does not depend on the speed.
    pub divergence: Option<f64>,
}

/// What the search has come to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// A motion without oscillation grows at the lowest speed searched: there is no critical speed.
    Diverges,
    /// An oscillation grows at the lowest speed searched: the critical speed is not above it.
    Unstable,
    /// Nothing grows over the whole range.
    StableOverRange,
    /// An oscillation loses its damping at a speed within the range.
    CriticalSpeedFound,
}

impl Outcome {
    /// Code in files.
    pub fn code(self) -> &'static str {
        match self {
            Self::Diverges => "diverges",
            Self::Unstable => "unstable",
            Self::StableOverRange => "stable-over-range",
            Self::CriticalSpeedFound => "critical-speed-found",
        }
    }
}

impl std::fmt::Display for Outcome {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Diverges => "a motion without oscillation grows: static instability",
            Self::Unstable => "unstable at the lowest speed searched",
            Self::StableOverRange => "stable over the whole range searched",
            Self::CriticalSpeedFound => "critical speed found",
        })
    }
}

/// Shares of the lowest onset's speed below it at which nothing must grow: the first at which that can be
/// told.
const BEYOND: [f64; 2] = [1e-5, 1e-4];

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
    /// Of a case, over the range of speeds that it names.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if eigenvalues cannot be had.
    pub fn of(case: &Case) -> Result<Self, EigenError> {
        let model = LateralModel::new(case);
        let poles = Poles::at(&model.forced, case.service.speed)?;
        Self::new(&model, &poles, case.model.speed_range, 1.0)
    }

    /// Searches `range`, m/s, up to a multiple `reach`, at least one, of the lowest onset, from the
    /// poles at any speed: by following the modes, or by full spectra where these cannot be told
    /// apart.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if eigenvalues cannot be had.
    pub fn new(
        model: &LateralModel,
        poles: &Poles,
        range: [f64; 2],
        reach: f64,
    ) -> Result<Self, EigenError> {
        match Self::followed(model, poles, range, reach) {
            Some(stability) => Ok(stability),
            None => Self::search(model, range),
        }
    }

    /// By following the modes from the poles at some speed. `None` where they cannot be.
    pub fn followed(
        model: &LateralModel,
        poles: &Poles,
        range: [f64; 2],
        reach: f64,
    ) -> Option<Self> {
        let with = |care| Self::followed_with(care, model, poles, range, reach);
        Care::BOTH.into_iter().find_map(with)
    }

    fn followed_with(
        care: Care,
        model: &LateralModel,
        poles: &Poles,
        range: [f64; 2],
        reach: f64,
    ) -> Option<Self> {
        let [low, high] = range;
        let mut branches = Branches::within(range, model, poles)?;
        let mut search = Search::onsets(care);
        let enough = |events: &[Event], speed: f64| {
            let speeds = events.iter().map(|event| event.at.speed);
            speed > reach * speeds.fold(f64::INFINITY, f64::min)
        };
        let bottom = branches.walk(low, &mut search, |_, _| false)?;
        let bottom = branches.complete(bottom, &mut search)?;
        let unstable_at_start = bottom.iter().any(|known| known.s.re >= 0.0);
        let mut certified = unstable_at_start;
        if !enough(&search.events, branches.start_speed()) {
            let top = branches.walk(high, &mut search, enough)?;
            // The lowest onset is a place to certify, if there is one; the top otherwise.
            certified |= stable_below_lowest(&mut branches, &search.events);
            if !certified {
                branches.complete(top, &mut search)?;
                certified = search.events.is_empty();
            }
        }
        if !certified && !stable_below_lowest(&mut branches, &search.events) {
            return None;
        }
        let mut events = search.events;
        events.sort_by(|a, b| a.at.speed.total_cmp(&b.at.speed));
        let mut onsets = Vec::with_capacity(events.len());
        for event in events {
            onsets.push(Crossing::new(model, event.at.speed, event.mode?));
        }
        // Nearly equal real eigenvalues may come out as a pair.
        let as_good_as_real = || Poles::at(&model.forced, low).is_ok_and(|poles| poles.diverge());
        let diverges = branches.diverges() || unstable_at_start && as_good_as_real();
        Some(Self {
            range,
            onsets,
            unstable_at_start,
            divergence: diverges.then_some(low),
        })
    }

    /// What the search has come to.
    pub fn outcome(&self) -> Outcome {
        if self.divergence.is_some() {
            Outcome::Diverges
        } else if self.unstable_at_start {
            Outcome::Unstable
        } else if self.onsets.is_empty() {
            Outcome::StableOverRange
        } else {
            Outcome::CriticalSpeedFound
        }
    }

    /// The critical speed, m/s: the lowest onset, or the start of the range if the vehicle already
    /// hunts there. `None` if it is stable over the whole range, or diverges.
    pub fn critical_speed(&self) -> Option<f64> {
        match self.outcome() {
            Outcome::Diverges | Outcome::StableOverRange => None,
            Outcome::Unstable => Some(self.range[0]),
            Outcome::CriticalSpeedFound => self.onsets.first().map(|onset| onset.speed),
        }
    }

    /// Lowest onset of one kind of hunting.
    pub fn onset(&self, kind: Hunting) -> Option<&Crossing> {
        self.onsets.iter().find(|onset| onset.kind == kind)
    }
}

/// Whether nothing grows just below the lowest of some onsets; not if there is none.
fn stable_below_lowest(branches: &mut Branches<'_>, onsets: &[Event]) -> bool {
    let lowest = onsets
        .iter()
        .map(|event| &event.at)
        .min_by(|a, b| a.speed.total_cmp(&b.speed));
    lowest.is_some_and(|at| {
        let stable =
            |beyond: f64| branches.stable_at(at.speed * (1.0 - beyond), at.s - at.slope * beyond);
        BEYOND.into_iter().find_map(stable).unwrap_or(false)
    })
}
