//! Modes of the lateral model at one speed, named by the moving bodies.

use super::{KinematicBand, KinematicMode, Mode};
use crate::{
    case::Case,
    dynamics::{
        LateralModel,
        lateral::{Body, Coordinate},
    },
    numerics::{EigenError, Poles, damping_ratio, frequency},
};

/// Damping ratio above which a pair counts as two real eigenvalues: rounding decides how it comes out.
pub const OVERDAMPED: f64 = 0.999;

/// Name of a mode of the lateral model, for readers: no number depends on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LateralShape {
    /// Carbody lateral and roll, turning about a point below its c.g.
    LowerSway,
    /// Carbody lateral and roll, turning about a point above its c.g.
    UpperSway,
    /// Carbody yaw.
    CarbodyYaw,
    /// The kinematic motion of wheelsets and truck: hunting.
    Kinematic,
    /// Mostly lateral motion of the truck frames.
    TruckLateral,
    /// Mostly yaw of the truck frames.
    TruckYaw,
    /// Mostly roll of the truck frames.
    TruckRoll,
    /// Mostly lateral motion of the wheelsets.
    WheelsetLateral,
    /// Mostly yaw of the wheelsets.
    WheelsetYaw,
}

impl std::fmt::Display for LateralShape {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::LowerSway => "carbody lower sway",
            Self::UpperSway => "carbody upper sway",
            Self::CarbodyYaw => "carbody yaw",
            Self::Kinematic => "truck hunting",
            Self::TruckLateral => "truck lateral",
            Self::TruckYaw => "truck yaw",
            Self::TruckRoll => "truck roll",
            Self::WheelsetLateral => "wheelset lateral",
            Self::WheelsetYaw => "wheelset yaw",
        })
    }
}

/// An oscillatory mode of the lateral model.
#[derive(Debug, Clone)]
pub struct LateralMode {
    /// |s|/2π, Hz.
    pub frequency: f64,
    /// −Re s/|s|.
    pub damping_ratio: f64,
    /// Name.
    pub shape: LateralShape,
    /// Share of the kinetic energy in the carbody.
    pub carbody_share: f64,
    /// Eigenvalue and vectors.
    pub mode: Mode,
}

/// All modes of the lateral model at one speed.
#[derive(Debug, Clone)]
pub struct LateralModes {
    /// Oscillatory modes, ascending in frequency.
    pub oscillatory: Vec<LateralMode>,
    /// Real eigenvalues, 1/s, ascending; a positive one is a divergence.
    pub real: Vec<f64>,
    /// True if a motion without oscillation grows.
    pub diverge: bool,
    /// Hunting of a truck under a carbody at rest; `None` if the truck or the vehicle diverges.
    pub kinematic: Option<KinematicMode>,
}

impl LateralModes {
    /// Modes from the poles at some speed.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if the mode shapes, or the eigenvalues of a truck, do not converge.
    pub fn new(model: &LateralModel, case: &Case, poles: &Poles) -> Result<Self, EigenError> {
        let mut modes = Self::of_vehicle(model, case, poles)?;
        if !modes.diverge {
            modes.kinematic = KinematicMode::new(model, case, poles.speed)?;
        }
        Ok(modes)
    }

    /// As [`LateralModes::new`], without the kinematic mode.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if the mode shapes do not converge.
    pub fn of_vehicle(
        model: &LateralModel,
        case: &Case,
        poles: &Poles,
    ) -> Result<Self, EigenError> {
        let kinematic = KinematicBand::new(case, poles.speed);
        let system = &model.forced.system;
        let damping = system.damping_at(poles.speed);
        let mut modes = Self {
            oscillatory: Vec::new(),
            real: Vec::new(),
            diverge: poles.diverge(),
            kinematic: None,
        };
        let mut found = Vec::new();
        for &s in &poles.values {
            if s.im > 0.0 {
                let mode = Mode::at(system, &damping, s).ok_or(EigenError::NotConverged)?;
                let carbody_share = mode.energy_share(system, |i| {
                    model.coordinates.coordinate(i).body() == Body::Carbody
                });
                found.push((carbody_share, mode));
            } else if s.im == 0.0 {
                modes.real.push(s.re);
            }
        }
        // The carbody has three degrees of freedom. At low speed and conicity the heavy carbody
        // takes most of the energy in the kinematic modes too: these come after its own.
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (rank, (carbody_share, mode)) in found.into_iter().enumerate() {
            let carbody = rank < 3 && carbody_share > 0.5;
            let mode = LateralMode::new(model, mode, carbody_share, carbody, kinematic);
            modes.oscillatory.push(mode);
        }
        modes
            .oscillatory
            .sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
        modes.real.sort_by(f64::total_cmp);
        Ok(modes)
    }

    /// The least-damped oscillatory mode; `None` if the vehicle diverges.
    pub fn least_damped(&self) -> Option<&LateralMode> {
        let modes = self.oscillatory.iter();
        modes
            .filter(|_| !self.diverge)
            .min_by(|a, b| a.damping_ratio.total_cmp(&b.damping_ratio))
    }

    /// Stability at the speed.
    pub fn status(&self) -> AtSpeed {
        if self.diverge {
            AtSpeed::Diverges
        } else if self.stable() {
            AtSpeed::Stable
        } else {
            AtSpeed::Unstable
        }
    }

    /// True if every motion decays.
    pub fn stable(&self) -> bool {
        self.oscillatory.iter().all(|m| m.damping_ratio > 0.0) && self.real.iter().all(|&s| s < 0.0)
    }
}

/// Stability at one speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AtSpeed {
    /// Every motion decays.
    Stable,
    /// An oscillation grows, or a coordinate drifts.
    Unstable,
    /// A motion without oscillation grows.
    Diverges,
}

impl AtSpeed {
    /// Code in files.
    pub fn code(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Unstable => "unstable",
            Self::Diverges => "diverges",
        }
    }
}

impl std::fmt::Display for AtSpeed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Stable => "stable at the speed",
            Self::Unstable => "unstable at the speed",
            Self::Diverges => "a motion without oscillation grows: static instability",
        })
    }
}

impl LateralMode {
    fn new(
        model: &LateralModel,
        mode: Mode,
        carbody_share: f64,
        carbody: bool,
        kinematic: KinematicBand,
    ) -> Self {
        let (frequency, damping_ratio) =
            (frequency(mode.eigenvalue), damping_ratio(mode.eigenvalue));
        let shape = if carbody {
            carbody_shape(model, &mode)
        } else if damping_ratio < OVERDAMPED && kinematic.holds(frequency) {
            LateralShape::Kinematic
        } else {
            truck_shape(model, &mode)
        };
        Self {
            frequency,
            damping_ratio,
            shape,
            carbody_share,
            mode,
        }
    }
}

fn carbody_shape(model: &LateralModel, mode: &Mode) -> LateralShape {
    let q = &model.coordinates;
    let index = |of: Coordinate| (0..q.len()).find(|&i| q.coordinate(i) == of).unwrap_or(0);
    let [y, psi, phi] = [
        Coordinate::CarbodyLateral,
        Coordinate::CarbodyYaw,
        Coordinate::CarbodyRoll,
    ]
    .map(index);
    let share = |i: usize| mode.energy_share(&model.forced.system, |j| i == j);
    if share(psi) > share(y) + share(phi) {
        return LateralShape::CarbodyYaw;
    }
    // A point at height z moves by y − zφ: about a point below if y and φ have opposite signs.
    if (mode.shape[y] * mode.shape[phi].conj()).re < 0.0 {
        LateralShape::LowerSway
    } else {
        LateralShape::UpperSway
    }
}

/// Name by the coordinates with the most kinetic energy.
fn truck_shape(model: &LateralModel, mode: &Mode) -> LateralShape {
    let share = |of: fn(Coordinate) -> bool| {
        mode.energy_share(&model.forced.system, |i| {
            of(model.coordinates.coordinate(i))
        })
    };
    [
        (
            share(|c| matches!(c, Coordinate::TruckLateral(_))),
            LateralShape::TruckLateral,
        ),
        (
            share(|c| matches!(c, Coordinate::TruckYaw(_))),
            LateralShape::TruckYaw,
        ),
        (
            share(|c| matches!(c, Coordinate::TruckRoll(_))),
            LateralShape::TruckRoll,
        ),
        (
            share(|c| matches!(c, Coordinate::WheelsetLateral(_))),
            LateralShape::WheelsetLateral,
        ),
        (
            share(|c| matches!(c, Coordinate::WheelsetYaw(_))),
            LateralShape::WheelsetYaw,
        ),
    ]
    .into_iter()
    .max_by(|a, b| a.0.total_cmp(&b.0))
    .map_or(LateralShape::TruckLateral, |(_, shape)| shape)
}
