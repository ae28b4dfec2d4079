//! The two planes of ride, lateral and vertical, with the parameters of their nets.

use super::performance::{lateral_ride, vertical_ride};
use crate::{case::Case, parameter::Parameter};

/// Lateral or vertical.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Plane {
    /// Lateral.
    Lateral,
    /// Vertical.
    Vertical,
}

impl Plane {
    pub fn parameters(self) -> [Parameter; 2] {
        match self {
            Self::Lateral => [
                Parameter::SECONDARY_LATERAL_FREQUENCY,
                Parameter::SECONDARY_LATERAL_DAMPING_RATIO,
            ],
            Self::Vertical => [
                Parameter::SECONDARY_VERTICAL_FREQUENCY,
                Parameter::SECONDARY_VERTICAL_DAMPING_RATIO,
            ],
        }
    }

    /// Lines of constant natural frequency, Hz, and of constant damping ratio.
    pub fn lines(self) -> [&'static [f64]; 2] {
        match self {
            Self::Lateral => [
                &[0.5, 0.6, 0.7, 0.8, 1.0, 1.2, 1.5],
                &[0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.7],
            ],
            Self::Vertical => [
                &[0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.2, 1.4],
                &[0.1, 0.15, 0.2, 0.3, 0.4, 0.6, 0.8],
            ],
        }
    }

    pub fn word(self) -> &'static str {
        match self {
            Self::Lateral => "lateral",
            Self::Vertical => "vertical",
        }
    }

    /// Accelerations at c.g., front, rear and their average, and the average stroke.
    pub fn ride(self, case: &Case) -> Option<([f64; 4], f64)> {
        let ([cg, front, rear], average, stroke) = match self {
            Self::Lateral => {
                let ride = lateral_ride(case)?;
                (
                    ride.acceleration,
                    ride.average_acceleration(),
                    ride.average_stroke(),
                )
            }
            Self::Vertical => {
                let ride = vertical_ride(case)?;
                (
                    ride.acceleration,
                    ride.average_acceleration(),
                    ride.average_stroke(),
                )
            }
        };
        Some(([cg, front, rear, average], stroke))
    }
}

/// Positions in what [`Plane::ride`] gives.
pub(super) const CG: usize = 0;
pub(super) const REAR: usize = 2;
pub(super) const AVERAGE: usize = 3;
