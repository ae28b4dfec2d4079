//! Damping over a range of speeds: where each lateral mode is least damped.
//!
//! A vehicle is stable up to a speed if no mode's damping ratio falls below zero on the way. The
//! minima of the damping ratios over the speed change smoothly with the design, also where an
//! instability is born at some speed within the range, at which the critical speed jumps.

use std::f64::consts::TAU;

use nalgebra::Complex;

use super::branches::{Branches, COMPLETE, Care, Search};
use crate::{
    dynamics::LateralModel,
    numerics::{EigenError, Eigenvalue, Poles, damping_ratio, diverge, frequency},
};

/// Where in the range a minimum lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// At the highest speed.
    Top,
    /// Inside the range.
    Inside,
    /// At the lowest speed.
    Bottom,
}

/// A least damping ratio of one mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DampingMinimum {
    /// Where.
    pub place: Place,
    /// V, m/s.
    pub speed: f64,
    /// |s|/2π, Hz.
    pub frequency: f64,
    /// ζ.
    pub damping_ratio: f64,
}

/// Damping over a range of speeds.
#[derive(Debug, Clone)]
pub struct DampingRange {
    /// Minima, in no particular order; never empty unless nothing oscillates.
    pub minima: Vec<DampingMinimum>,
    /// Whether a motion without oscillation grows at the lowest speed: then none begins to at a higher one.
    pub diverges: bool,
}

impl DampingRange {
    /// Looks through `range`, m/s, for minima with damping ratios `below` a value, from the poles at
    /// any speed: by following the modes, or by full spectra where these cannot be told apart, or
    /// strongly damped ones are of interest too. The least at each end is always among what is
    /// found.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if eigenvalues cannot be had.
    pub fn new(
        model: &LateralModel,
        poles: &Poles,
        range: [f64; 2],
        below: f64,
    ) -> Result<Self, EigenError> {
        let followed = if below <= COMPLETE {
            Self::followed(model, poles, range, below)
        } else {
            None
        };
        followed.map_or_else(|| Self::search(model, range, below), Ok)
    }

    /// By following the modes from the poles at some speed. `None` where they cannot be.
    pub fn followed(
        model: &LateralModel,
        poles: &Poles,
        range: [f64; 2],
        below: f64,
    ) -> Option<Self> {
        let with = |care| Self::followed_with(care, model, poles, range, below);
        Care::BOTH.into_iter().find_map(with)
    }

    fn followed_with(
        care: Care,
        model: &LateralModel,
        poles: &Poles,
        range: [f64; 2],
        below: f64,
    ) -> Option<Self> {
        let [low, high] = range;
        let mut branches = Branches::within(range, model, poles)?;
        let mut search = Search::minima(below, care);
        let bottom = branches.walk(low, &mut search, |_, _| false)?;
        let bottom = branches.complete(bottom, &mut search)?;
        let top = branches.walk(high, &mut search, |_, _| false)?;
        let top = branches.complete(top, &mut search)?;
        let grown: Vec<Complex<f64>> = bottom.iter().map(|known| known.s).collect();
        let diverges = branches.diverges() || diverge(&grown);
        let mut minima = Vec::new();
        for (place, modes) in [(Place::Bottom, bottom), (Place::Top, top)] {
            let mut ends: Vec<DampingMinimum> = modes
                .iter()
                .map(|known| DampingMinimum::new(place, known))
                .collect();
            ends.sort_by(|a, b| a.damping_ratio.total_cmp(&b.damping_ratio));
            let among = ends.iter().filter(|m| m.damping_ratio < below).count();
            ends.truncate(among.max(1));
            minima.extend(ends);
        }
        let inside = search.events.iter();
        minima.extend(
            inside
                .map(|event| DampingMinimum::new(Place::Inside, &event.at))
                .filter(|minimum| minimum.damping_ratio < below),
        );
        Some(Self { minima, diverges })
    }

    /// The least damping ratio in the range.
    pub fn least(&self) -> Option<DampingMinimum> {
        let minima = self.minima.iter().copied();
        minima.min_by(|a, b| a.damping_ratio.total_cmp(&b.damping_ratio))
    }
}

impl DampingMinimum {
    /// s, rad/s.
    pub fn eigenvalue(&self) -> Complex<f64> {
        let (zeta, size) = (self.damping_ratio, TAU * self.frequency);
        Complex::new(-zeta, (1.0 - zeta * zeta).max(0.0).sqrt()) * size
    }

    fn new(place: Place, known: &Eigenvalue) -> Self {
        Self {
            place,
            speed: known.speed,
            frequency: frequency(known.s),
            damping_ratio: damping_ratio(known.s),
        }
    }
}
