//! Critical speed: the lowest speed at which an oscillatory mode loses its damping (3.4.4.2).

use crate::{
    case::Case,
    dynamics::{LateralModel, lateral::Body},
    evaluate::modes::Mode,
    numerics::{EigenError, Poles, frequency},
};

/// Body that hunts.
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
    /// Body that hunts.
    pub kind: Hunting,
    /// Shape and left vector.
    pub mode: Mode,
}

/// Onsets of instability over a range of speeds.
#[derive(Debug, Clone)]
pub struct Stability {
    /// Range searched, m/s.
    pub range: [f64; 2],
    /// Onsets of instability in ascending speed. Empty: stable over the whole range.
    pub onsets: Vec<Crossing>,
    /// True if the vehicle already hunts at the lowest speed searched.
    pub unstable_at_start: bool,
    /// The lowest speed searched, m/s, if a motion without oscillation grows there. Divergence begins at
    /// no higher speed, because det K does not depend on the speed.
    pub divergence: Option<f64>,
}

/// Outcome of the search.
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
    /// Onsets of a case over its range of speeds.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if eigenvalues do not converge.
    pub fn of(case: &Case) -> Result<Self, EigenError> {
        let model = LateralModel::new(case);
        let poles = Poles::at(&model.forced, case.service.speed)?;
        Self::new(&model, &poles, case.model.speed_range, 1.0)
    }

    /// Onsets in `range`, m/s, up to a multiple `reach`, at least one, of the lowest, from the poles at
    /// any speed: by following the modes, or by full spectra where that has no answer.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if eigenvalues do not converge.
    pub fn new(
        model: &LateralModel,
        poles: &Poles,
        range: [f64; 2],
        reach: f64,
    ) -> Result<Self, EigenError> {
        match Self::by_following(model, poles, range, reach) {
            Some(stability) => Ok(stability),
            None => Self::by_spectra(model, range),
        }
    }

    /// Outcome of the search.
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
