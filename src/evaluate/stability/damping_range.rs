//! Least damping ratios of the lateral modes over a range of speeds.
//!
//! A vehicle is stable up to a speed if no mode's damping ratio falls below zero on the way. The
//! minima of the damping ratios over the speed change smoothly with the design, also where an
//! instability is born at some speed within the range, at which the critical speed jumps.

use std::f64::consts::TAU;

use nalgebra::Complex;

use crate::{
    dynamics::LateralModel,
    numerics::{EigenError, Eigenvalue, Poles, damping_ratio, frequency},
};

/// Position of a minimum in the range of speeds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// At the highest speed.
    Top,
    /// Inside the range.
    Inside,
    /// At the lowest speed.
    Bottom,
}

/// Least damping ratio of one mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DampingMinimum {
    /// Position in the range.
    pub place: Place,
    /// V, m/s.
    pub speed: f64,
    /// |s|/2π, Hz.
    pub frequency: f64,
    /// ζ.
    pub damping_ratio: f64,
}

/// Least damping ratios over a range of speeds.
#[derive(Debug, Clone)]
pub struct DampingRange {
    /// Minima, in no particular order; never empty unless nothing oscillates.
    pub minima: Vec<DampingMinimum>,
    /// True if a motion without oscillation grows at the lowest speed. Divergence begins at no higher one.
    pub diverges: bool,
}

impl DampingRange {
    /// Minima in `range`, m/s, with damping ratios `below` a value, and the least one at each end, from
    /// the poles at any speed: by following the modes, or by full spectra where that has no answer.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if eigenvalues do not converge.
    pub fn new(
        model: &LateralModel,
        poles: &Poles,
        range: [f64; 2],
        below: f64,
    ) -> Result<Self, EigenError> {
        match Self::by_following(model, poles, range, below) {
            Some(damping) => Ok(damping),
            None => Self::by_spectra(model, range, below),
        }
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

    /// Damping ratio and frequency of an eigenvalue.
    pub(super) fn new(place: Place, known: &Eigenvalue) -> Self {
        Self {
            place,
            speed: known.speed,
            frequency: frequency(known.s),
            damping_ratio: damping_ratio(known.s),
        }
    }
}
