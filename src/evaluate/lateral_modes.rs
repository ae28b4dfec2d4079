//! Modes of the lateral model at one speed, named by what moves.

use nalgebra::{Complex, DMatrix};

use super::mode::{Mode, damping_ratio, frequency};
use crate::{
    closed_form::kinematic,
    dynamics::{
        EigenError, LateralModel, eigenvalues,
        lateral::{Body, Coordinate},
    },
    vehicle::Vehicle,
    wheel_rail::Contact,
};

/// Damping ratio above which a pair counts as not oscillating: rounding decides whether it comes
/// out as a pair or as two real roots.
pub const OVERDAMPED: f64 = 0.999;

/// What a mode of the lateral model does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LateralShape {
    /// Carbody lateral and roll, turning about a point below its c.g.
    LowerSway,
    /// Carbody lateral and roll, turning about a point above its c.g.
    UpperSway,
    /// Carbody yaw.
    CarbodyYaw,
    /// The kinematic motion of wheelsets and truck: hunting.
    Kinematic(Phase),
    /// Mostly lateral motion of the truck frames.
    TruckLateral(Phase),
    /// Mostly yaw of the truck frames.
    TruckYaw(Phase),
    /// Mostly roll of the truck frames.
    TruckRoll(Phase),
    /// Mostly lateral motion of the wheelsets.
    WheelsetLateral(Phase),
    /// Mostly yaw of the wheelsets.
    WheelsetYaw(Phase),
}

/// How the two trucks move together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// The same way.
    InPhase,
    /// Opposite ways.
    OutOfPhase,
}

impl std::fmt::Display for LateralShape {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (name, phase) = match self {
            Self::LowerSway => return f.write_str("carbody lower sway"),
            Self::UpperSway => return f.write_str("carbody upper sway"),
            Self::CarbodyYaw => return f.write_str("carbody yaw"),
            Self::Kinematic(phase) => ("truck hunting", phase),
            Self::TruckLateral(phase) => ("truck lateral", phase),
            Self::TruckYaw(phase) => ("truck yaw", phase),
            Self::TruckRoll(phase) => ("truck roll", phase),
            Self::WheelsetLateral(phase) => ("wheelset lateral", phase),
            Self::WheelsetYaw(phase) => ("wheelset yaw", phase),
        };
        let phase = match phase {
            Phase::InPhase => "in phase",
            Phase::OutOfPhase => "out of phase",
        };
        write!(f, "{name}, {phase}")
    }
}

/// An oscillatory mode of the lateral model.
#[derive(Debug, Clone)]
pub struct LateralMode {
    /// |s|/2π, Hz.
    pub frequency: f64,
    /// −Re s/|s|.
    pub damping_ratio: f64,
    /// What it does.
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
}

impl LateralModes {
    /// Computes them at `speed`, m/s.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if the eigenvalues cannot be had.
    pub fn new(
        model: &LateralModel,
        speed: f64,
        kinematic: KinematicBand,
    ) -> Result<Self, EigenError> {
        let system = &model.forced.system;
        let values = eigenvalues(system.state_matrix(speed))?;
        let damping = system.damping_at(speed);
        let mut modes = Self {
            oscillatory: Vec::new(),
            real: Vec::new(),
        };
        for s in values {
            if s.im > 0.0 {
                let mode = LateralMode::new(model, &damping, s, kinematic);
                modes
                    .oscillatory
                    .push(mode.ok_or(EigenError::NotConverged)?);
            } else if s.im == 0.0 {
                modes.real.push(s.re);
            }
        }
        modes
            .oscillatory
            .sort_by(|a, b| a.frequency.total_cmp(&b.frequency));
        modes.real.sort_by(f64::total_cmp);
        Ok(modes)
    }

    /// The least-damped oscillatory mode.
    pub fn least_damped(&self) -> Option<&LateralMode> {
        self.oscillatory
            .iter()
            .min_by(|a, b| a.damping_ratio.total_cmp(&b.damping_ratio))
    }

    /// The kinematic mode, the less damped of its two phases.
    pub fn kinematic(&self) -> Option<&LateralMode> {
        self.oscillatory
            .iter()
            .filter(|m| matches!(m.shape, LateralShape::Kinematic(_)))
            .min_by(|a, b| a.damping_ratio.total_cmp(&b.damping_ratio))
    }

    /// Whether nothing grows.
    pub fn stable(&self) -> bool {
        self.oscillatory.iter().all(|m| m.damping_ratio > 0.0) && self.real.iter().all(|&s| s < 0.0)
    }
}

/// Frequencies between which a truck mode is the kinematic one, Hz.
#[derive(Debug, Clone, Copy)]
pub struct KinematicBand {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl KinematicBand {
    /// From the rigid truck's kinematic frequency (3.5-5) over √2 to the free wheelset's (3.5-2)
    /// times √2, at `speed` in m/s: a truck on springs lies between the two, give or take what
    /// inertia and gravitational stiffness do.
    pub fn new(vehicle: &Vehicle, contact: &Contact, speed: f64) -> Self {
        let w = kinematic::wheelset_frequency(vehicle, contact.conicity, speed);
        let t = kinematic::truck_frequency(vehicle, contact.conicity, speed);
        Self {
            low: t / std::f64::consts::SQRT_2,
            high: w * std::f64::consts::SQRT_2,
        }
    }

    fn holds(self, frequency: f64) -> bool {
        (self.low..=self.high).contains(&frequency)
    }
}

impl LateralMode {
    fn new(
        model: &LateralModel,
        damping: &DMatrix<f64>,
        s: Complex<f64>,
        kinematic: KinematicBand,
    ) -> Option<Self> {
        let mode = Mode::at(&model.forced.system, damping, s)?;
        let of = |body: fn(Body) -> bool| {
            mode.energy_share(&model.forced.system, |i| {
                body(model.coordinates.coordinate(i).body())
            })
        };
        let carbody_share = of(|body| body == Body::Carbody);
        let (frequency, damping_ratio) = (frequency(s), damping_ratio(s));
        let oscillates = damping_ratio < OVERDAMPED && kinematic.holds(frequency);
        let shape = shape(model, &mode, carbody_share, oscillates);
        Some(Self {
            frequency,
            damping_ratio,
            shape,
            carbody_share,
            mode,
        })
    }

    /// Whether the carbody carries most of the energy.
    pub fn is_carbody(&self) -> bool {
        self.carbody_share > 0.5
    }
}

fn shape(model: &LateralModel, mode: &Mode, carbody_share: f64, kinematic: bool) -> LateralShape {
    let q = model.coordinates;
    let system = &model.forced.system;
    let share = |of: fn(Coordinate) -> bool| mode.energy_share(system, |i| of(q.coordinate(i)));
    let amplitude = |of: Coordinate| {
        (0..q.len())
            .find(|&i| q.coordinate(i) == of)
            .map_or(Complex::ZERO, |i| mode.shape[i])
    };
    if carbody_share > 0.5 {
        if share(|c| c == Coordinate::CarbodyYaw) > carbody_share / 2.0 {
            return LateralShape::CarbodyYaw;
        }
        // A point at height z moves by y − zφ: about a point below if y and φ have opposite signs.
        let turn =
            amplitude(Coordinate::CarbodyLateral) * amplitude(Coordinate::CarbodyRoll).conj();
        return if turn.re < 0.0 {
            LateralShape::LowerSway
        } else {
            LateralShape::UpperSway
        };
    }
    let mut together = 0.0;
    for i in 0..q.len() {
        let partner = match q.coordinate(i) {
            Coordinate::WheelsetLateral(i) if i < 2 => Coordinate::WheelsetLateral(i + 2),
            Coordinate::WheelsetYaw(i) if i < 2 => Coordinate::WheelsetYaw(i + 2),
            Coordinate::TruckLateral(0) => Coordinate::TruckLateral(1),
            Coordinate::TruckYaw(0) => Coordinate::TruckYaw(1),
            _ => continue,
        };
        together += system.mass[i] * (mode.shape[i] * amplitude(partner).conj()).re;
    }
    let phase = if together >= 0.0 {
        Phase::InPhase
    } else {
        Phase::OutOfPhase
    };
    if kinematic {
        return LateralShape::Kinematic(phase);
    }
    let candidates = [
        (
            share(|c| matches!(c, Coordinate::TruckLateral(_))),
            LateralShape::TruckLateral(phase),
        ),
        (
            share(|c| matches!(c, Coordinate::TruckYaw(_))),
            LateralShape::TruckYaw(phase),
        ),
        (
            share(|c| matches!(c, Coordinate::TruckRoll(_))),
            LateralShape::TruckRoll(phase),
        ),
        (
            share(|c| matches!(c, Coordinate::WheelsetLateral(_))),
            LateralShape::WheelsetLateral(phase),
        ),
        (
            share(|c| matches!(c, Coordinate::WheelsetYaw(_))),
            LateralShape::WheelsetYaw(phase),
        ),
    ];
    candidates
        .into_iter()
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map_or(LateralShape::TruckLateral(phase), |(_, name)| name)
}
