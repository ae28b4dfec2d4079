//! A linear system on irregular track: which inputs an irregularity drives, which outputs are
//! wanted.

use std::sync::OnceLock;

use sha2::{Digest as _, Sha256};

use super::Row;
use crate::{
    numerics::{LinearSystem, elimination::Stiffness},
    track::Irregularity,
};

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

/// Digest of all numbers of a model: SHA-256.
pub type Digest = [u8; 32];

impl ForcedModel {
    /// Digest of the model's equations, inputs and outputs, and of some numbers beside it, by their bits.
    pub fn digest(&self, beside: &[f64]) -> Digest {
        let Self {
            system,
            elimination: _,
            excitations,
            outputs,
            lags,
        } = self;
        let LinearSystem {
            mass,
            inputs,
            stiffness,
            damping,
            mirrored,
            alike,
        } = system;
        let mut bytes: Vec<u8> = Vec::with_capacity(1 << 13);
        let mut whole = |number: usize| bytes.extend((number as u64).to_le_bytes());
        whole(*inputs);
        for pairs in [mirrored, alike] {
            whole(pairs.len());
            for i in pairs.iter().flatten() {
                whole(*i);
            }
        }
        for excitation in excitations {
            whole(excitation.irregularity as usize);
            for i in excitation.inputs {
                whole(i);
            }
        }
        let mut real = |number: f64| bytes.extend(number.to_bits().to_le_bytes());
        let scales = excitations.iter().map(|excitation| &excitation.scale);
        for number in beside.iter().chain(mass).chain(lags).chain(scales) {
            real(*number);
        }
        // Most entries are zero: the others count with their places.
        for matrix in std::iter::once(stiffness).chain(damping) {
            let entries = matrix
                .iter()
                .enumerate()
                .filter(|(_, entry)| **entry != 0.0);
            for (place, entry) in entries {
                real(place as f64);
                real(*entry);
            }
            real(f64::NAN);
        }
        for output in outputs {
            let Output {
                displacement,
                velocity,
                acceleration,
            } = output;
            for row in [displacement, velocity, acceleration] {
                for (index, coefficient) in row.terms() {
                    real(*index as f64);
                    real(*coefficient);
                }
                real(f64::NAN);
            }
        }
        Sha256::digest(&bytes).into()
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
