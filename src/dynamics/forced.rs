//! A linear system on irregular track: which inputs an irregularity drives, which outputs are
//! wanted.

use std::sync::OnceLock;

use super::{LinearSystem, Row, elimination::Stiffness};
use crate::track::Irregularity;

/// A linear system with its track inputs and outputs.
#[derive(Debug, Clone)]
pub struct ForcedModel {
    /// Equations of motion.
    pub system: LinearSystem,
    /// Their elimination, from when it is first asked for: models of which only the matrices matter
    /// have none.
    pub(super) elimination: OnceLock<Stiffness>,
    /// Independent random inputs.
    pub excitations: Vec<Excitation>,
    /// Wanted outputs, in the order of the model's documentation.
    pub outputs: Vec<Output>,
    /// Distance of each wheelset behind the first, m: its input is delayed by this over V.
    pub lags: [f64; 4],
}

impl ForcedModel {
    /// The dynamic stiffness, ready for elimination.
    pub fn stiffness(&self) -> &Stiffness {
        self.elimination
            .get_or_init(|| Stiffness::new(&self.system))
    }
}

/// One irregularity, felt by the four wheelsets one after the other.
#[derive(Debug, Clone)]
pub struct Excitation {
    /// Which irregularity.
    pub irregularity: Irregularity,
    /// Its input at each wheelset, in the numbering of [q, u].
    pub inputs: [usize; 4],
    /// Input per unit of irregularity (1, or 1/(2a) for roll from crosslevel, 1/m).
    pub scale: f64,
}

/// An output p·x + v·ẋ + a·ẍ over x = [q, u].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Output {
    /// p.
    pub displacement: Row,
    /// v.
    pub velocity: Row,
    /// a; over coordinates only.
    pub acceleration: Row,
}

impl Output {
    /// A displacement.
    pub fn displacement(row: Row) -> Self {
        Self {
            displacement: row,
            ..Self::default()
        }
    }

    /// An acceleration.
    pub fn acceleration(row: Row) -> Self {
        Self {
            acceleration: row,
            ..Self::default()
        }
    }

    /// The force of a spring k and damper c with that stretch.
    pub fn force(stretch: &Row, k: f64, c: f64) -> Self {
        Self {
            displacement: k * stretch.clone(),
            velocity: c * stretch.clone(),
            ..Self::default()
        }
    }
}
