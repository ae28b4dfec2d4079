//! The kinematic mode: hunting of a truck under a carbody at rest.
//!
//! The report keeps the damping ratio of this mode at 0.1–0.2 (4.7); its formula for the truck's critical
//! speed holds the carbody likewise (3.5-6). The model is that of 3.4.4 with the carbody's coordinates
//! held, so that none of its modes can be taken for hunting. One truck remains: 6 coordinates, 7 with
//! roll. Of its motions s_k the slowest, s_1, is hunting where wheels roll. Others count as soon as they
//! are nearly as slow, so that the damping ratio changes continuously where two exchange their parts:
//!
//! ```math
//! ζ = min(1, min_k [ζ_k + p_k²]),   p_k = max(0, ln(|s_k|/|s_1|) − ln √2)
//! ```
//!
//! Within half an octave of the slowest a motion counts as it is, an octave above with 0.12 more, two
//! octaves above with 1.08 more: then only if it grows. Only eigenvalues enter, which are continuous
//! where eigenvectors are not. A motion without oscillation has ζ = 1.

use std::f64::consts::{LN_2, TAU};

use nalgebra::{Complex, DVector};

use super::{
    gradients::modes,
    mode::{Mode, damping_ratio, damping_ratio_change, size},
};
use crate::dynamics::{EigenError, ForcedTangent, LateralModel, diverge, eigenvalues};

/// ln(|s_k|/|s_1|) up to which a motion counts as it is: half an octave.
const AS_SLOW: f64 = LN_2 / 2.0;

/// The kinematic mode at one speed.
#[derive(Debug, Clone)]
pub struct KinematicMode {
    /// |s|/2π of the motion that counts, Hz.
    pub frequency: f64,
    /// ζ as defined for the module; at most 1.
    pub damping_ratio: f64,
    /// The truck's motions with Im s ≥ 0, the slowest first.
    pub motions: Vec<TruckMotion>,
}

/// A motion of a truck under a carbody at rest.
#[derive(Debug, Clone, Copy)]
pub struct TruckMotion {
    /// s, rad/s.
    pub eigenvalue: Complex<f64>,
    /// p: by how much it is faster than those that count as they are, in ln |s|.
    pub faster: f64,
}

impl TruckMotion {
    /// ζ + p².
    pub fn damping_ratio(&self) -> f64 {
        damping_ratio(self.eigenvalue) + self.faster * self.faster
    }

    /// |s|/2π, Hz.
    pub fn frequency(&self) -> f64 {
        size(self.eigenvalue) / TAU
    }

    /// Whether it oscillates.
    pub fn oscillates(&self) -> bool {
        self.eigenvalue.im > 0.0
    }
}

impl KinematicMode {
    /// Of a lateral model at `speed`, m/s. `None` if the truck diverges.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if eigenvalues cannot be had.
    pub fn new(model: &LateralModel, speed: f64) -> Result<Option<Self>, EigenError> {
        let (_, truck) = model.one_truck(speed);
        let mut values = eigenvalues(truck.state_matrix(speed))?;
        if diverge(&values) {
            return Ok(None);
        }
        values.retain(|s| s.im >= 0.0);
        values.sort_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()));
        let Some(slowest) = values.first().map(|s| size(*s)) else {
            return Err(EigenError::NotConverged);
        };
        let motions: Vec<TruckMotion> = values
            .into_iter()
            .map(|s| TruckMotion {
                eigenvalue: s,
                faster: ((size(s) / slowest).ln() - AS_SLOW).max(0.0),
            })
            .collect();
        let counts = motions
            .iter()
            .min_by(|a, b| a.damping_ratio().total_cmp(&b.damping_ratio()));
        Ok(counts.copied().map(|counts| Self {
            frequency: counts.frequency(),
            damping_ratio: counts.damping_ratio().min(1.0),
            motions,
        }))
    }

    /// s of an oscillation with this frequency and damping ratio, rad/s.
    pub fn eigenvalue(&self) -> Complex<f64> {
        let zeta = self.damping_ratio;
        let unit = Complex::new(-zeta, (1.0 - zeta * zeta).max(0.0).sqrt());
        unit * (TAU * self.frequency)
    }

    /// Derivatives of [`TruckMotion::damping_ratio`] by design constants, of every motion, at `speed`, m/s.
    /// `None` if the vectors cannot be had.
    pub fn derivatives(
        &self,
        model: &LateralModel,
        tangents: &[ForcedTangent],
        speed: f64,
    ) -> Option<Vec<Vec<f64>>> {
        let system = &model.forced.system;
        let (numbers, truck) = model.one_truck(speed);
        let damping = truck.damping_at(speed);
        let whole = |part: &DVector<Complex<f64>>| {
            let mut whole = DVector::zeros(system.order());
            for (&number, &value) in numbers.iter().zip(part.iter()) {
                whole[number] = value;
            }
            whole
        };
        // Vectors that are zero where coordinates are held leave all of the model but the truck out.
        let changes = |s: Complex<f64>| {
            let mode = Mode::at(&truck, &damping, s)?;
            let mode = Mode {
                eigenvalue: s,
                shape: whole(&mode.shape),
                left: whole(&mode.left),
            };
            Some(modes::by_constants(system, tangents, speed, &mode))
        };
        let slowest = self.motions.first()?.eigenvalue;
        let of_slowest = changes(slowest)?;
        let derivatives = self.motions.iter().map(|motion| {
            let s = motion.eigenvalue;
            let change = changes(s)?.into_iter().zip(&of_slowest);
            let of = |(change, of_slowest): (Complex<f64>, &Complex<f64>)| {
                let faster = (change / s).re - (of_slowest / slowest).re;
                damping_ratio_change(s, change) + 2.0 * motion.faster * faster
            };
            Some(change.map(of).collect())
        });
        derivatives.collect()
    }
}
