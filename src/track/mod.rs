//! The track: irregularities of tangent track and the geometry of curves (3.4.2).

mod curve;
mod erri;
mod fra;
mod spectrum;

pub use curve::{
    Curve, MAX_DEGREE, SUPERELEVATION_BASE, cant_deficiency, curvature_of_degree,
    curvature_per_degree, degree_of_curvature, fra_speed_limit,
};
pub use fra::{CORNER_WAVENUMBER, FRA_CLASSES};
pub use spectrum::Spectrum;

use serde::Serialize;

/// Irregularities of a tangent track: three independent stationary processes, each given by its
/// one-sided spectral density in wavenumber.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Track {
    /// Name in the spec and in results.
    pub name: String,
    /// Source of the numbers.
    pub source: String,
    /// Vertical profile, mean of the two rails, m²/(rad/m).
    pub vertical: Spectrum,
    /// Alignment, mean of the two rails' lateral positions, m²/(rad/m).
    pub alignment: Spectrum,
    /// Crosslevel, height of the left rail over the right, m²/(rad/m).
    pub crosslevel: Spectrum,
}

/// The independent irregularities of a track.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Irregularity {
    /// Vertical profile.
    Vertical,
    /// Alignment.
    Alignment,
    /// Crosslevel.
    Crosslevel,
}

impl Track {
    /// Spectrum of one irregularity.
    pub fn spectrum(&self, irregularity: Irregularity) -> &Spectrum {
        match irregularity {
            Irregularity::Vertical => &self.vertical,
            Irregularity::Alignment => &self.alignment,
            Irregularity::Crosslevel => &self.crosslevel,
        }
    }

    /// Names of the built-in tracks.
    pub fn names() -> impl Iterator<Item = String> {
        (1..=FRA_CLASSES)
            .map(|class| format!("fra-class-{class}"))
            .chain(["erri-b176-low".into(), "erri-b176-high".into()])
    }

    /// The built-in track of that name.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "erri-b176-low" => Some(Self::erri_low()),
            "erri-b176-high" => Some(Self::erri_high()),
            _ => Self::fra_class(name.strip_prefix("fra-class-")?.parse().ok()?),
        }
    }
}
