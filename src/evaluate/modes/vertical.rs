//! Modes of the vertical model, named by the moving bodies; they do not depend on the speed.

use super::{Mode, OVERDAMPED};
use crate::{
    dynamics::{VerticalModel, vertical::Coordinate},
    numerics::{EigenError, Poles, damping_ratio, frequency},
};

/// Name of a mode of the vertical model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VerticalShape {
    /// Carbody heave.
    CarbodyHeave,
    /// Carbody pitch.
    CarbodyPitch,
    /// Carbody roll.
    CarbodyRoll,
    /// First bending mode of the carbody.
    Bending,
    /// First torsion mode of the carbody.
    Torsion1,
    /// Second torsion mode of the carbody.
    Torsion2,
    /// Truck frames' heave.
    TruckHeave,
    /// Truck frames' pitch.
    TruckPitch,
    /// Truck frames' roll.
    TruckRoll,
}

impl std::fmt::Display for VerticalShape {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::CarbodyHeave => "carbody heave",
            Self::CarbodyPitch => "carbody pitch",
            Self::CarbodyRoll => "carbody roll",
            Self::Bending => "carbody bending",
            Self::Torsion1 => "carbody torsion, first",
            Self::Torsion2 => "carbody torsion, second",
            Self::TruckHeave => "truck bounce",
            Self::TruckPitch => "truck pitch",
            Self::TruckRoll => "truck roll",
        })
    }
}

impl VerticalShape {
    fn of(coordinate: Coordinate) -> Option<Self> {
        Some(match coordinate {
            Coordinate::CarbodyHeave => Self::CarbodyHeave,
            Coordinate::CarbodyRoll => Self::CarbodyRoll,
            Coordinate::CarbodyPitch => Self::CarbodyPitch,
            Coordinate::CarbodyBending => Self::Bending,
            Coordinate::CarbodyTorsion1 => Self::Torsion1,
            Coordinate::CarbodyTorsion2 => Self::Torsion2,
            Coordinate::TruckHeave(_) => Self::TruckHeave,
            Coordinate::TruckRoll(_) => Self::TruckRoll,
            Coordinate::TruckPitch(_) => Self::TruckPitch,
            Coordinate::Inner(_) => return None,
        })
    }

    /// True if it is a flexible mode of the carbody.
    pub fn is_flexible(self) -> bool {
        matches!(self, Self::Bending | Self::Torsion1 | Self::Torsion2)
    }

    /// True if the truck frames carry it.
    pub fn is_truck(self) -> bool {
        matches!(self, Self::TruckHeave | Self::TruckPitch | Self::TruckRoll)
    }
}

/// An oscillatory mode of the vertical model.
#[derive(Debug, Clone)]
pub struct VerticalMode {
    /// |s|/2π, Hz.
    pub frequency: f64,
    /// −Re s/|s|.
    pub damping_ratio: f64,
    /// Name: the motion with most of the kinetic energy.
    pub shape: VerticalShape,
}

/// Oscillatory modes of the vertical model, ascending in frequency; overdamped ones left out.
///
/// # Errors
///
/// [`EigenError`] if the mode shapes are not finite.
pub fn vertical_modes(
    model: &VerticalModel,
    poles: &Poles,
) -> Result<Vec<VerticalMode>, EigenError> {
    let system = &model.forced.system;
    let damping = system.damping_at(poles.speed);
    let mut modes = Vec::new();
    for &s in &poles.values {
        // Relaxation of the air springs' inner points comes out as real roots or, by rounding, as
        // pairs that are as good as real.
        if s.im <= 0.0 || damping_ratio(s) > OVERDAMPED {
            continue;
        }
        let mode = Mode::at(system, &damping, s).ok_or(EigenError::NotConverged)?;
        let share = |shape: VerticalShape| {
            mode.energy_share(system, |i| {
                VerticalShape::of(Coordinate::at(i)) == Some(shape)
            })
        };
        let shape = (0..system.order())
            .filter_map(|i| VerticalShape::of(Coordinate::at(i)))
            .max_by(|a, b| share(*a).total_cmp(&share(*b)))
            .ok_or(EigenError::NotConverged)?;
        modes.push(VerticalMode {
            frequency: frequency(s),
            damping_ratio: damping_ratio(s),
            shape,
        });
    }
    modes.sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
    Ok(modes)
}

/// Separation of a truck mode from a flexible mode of the carbody.
#[derive(Debug, Clone, Copy)]
pub struct Separation {
    /// Frequency of the truck mode, Hz.
    pub truck: f64,
    /// Frequency of the flexible mode, Hz.
    pub flexible: f64,
    /// The higher over the lower.
    pub ratio: f64,
    /// Names of the two.
    pub shapes: [VerticalShape; 2],
}

/// Separations of every truck mode from every flexible mode (4.3).
pub fn flexible_separations(modes: &[VerticalMode]) -> Vec<Separation> {
    let flexible = modes.iter().filter(|m| m.shape.is_flexible());
    flexible
        .flat_map(|flexible| {
            let trucks = modes.iter().filter(|m| m.shape.is_truck());
            trucks.map(move |truck| {
                let ratio = truck.frequency / flexible.frequency;
                Separation {
                    truck: truck.frequency,
                    flexible: flexible.frequency,
                    ratio: ratio.max(1.0 / ratio),
                    shapes: [truck.shape, flexible.shape],
                }
            })
        })
        .collect()
}
