//! The kinematic mode: hunting of a truck under a carbody at rest.
//!
//! The report keeps the damping ratio of this mode at 0.1–0.2 (4.7); its formula for the truck's critical
//! speed holds the carbody likewise (3.5-6). The model is that of 3.4.4 with the carbody's coordinates
//! held, so that no carbody mode can be confused with hunting. One truck remains: 6 coordinates, 7 with
//! roll. The damping ratio is the least of its motions s_k, weighted by a factor w_k that grows with the
//! distance of the motion's frequency from the band of kinematic motion:
//!
//! ```math
//! ζ = min(1, min_k ζ_k w_k),   w_k = 1 + 8 p_k² if ζ_k > 0, else 1
//! p_k = max(0, ln(f_low/f_k), ln(f_k/f_high)),   f_k = |s_k|/2π
//! ```
//!
//! f_low is the frequency of the rigid truck, f_high that of the free wheelset, each moved outwards by half
//! an octave ([`KinematicBand`]). The weight is 4.8 an octave outside the band and 16 two octaves outside.
//! A growing motion has the weight 1, so that ζ < 0 exactly if a truck hunts under a carbody at rest. Only
//! eigenvalues enter: they are continuous where eigenvectors are not. A motion without oscillation has
//! ζ = 1.

use std::f64::consts::{SQRT_2, TAU};

use nalgebra::{Complex, DVector};

use super::Mode;
use crate::{
    case::Case,
    closed_form::kinematic,
    dynamics::{ForcedTangent, LateralModel},
    evaluate::gradients::modes,
    numerics::{EigenError, damping_ratio, damping_ratio_change, diverge, eigenvalues, size},
};

/// Growth of the weight of a damping ratio with the square of the distance from the band, in ln f.
const RAISED: f64 = 8.0;

/// Frequencies of kinematic motion, Hz.
#[derive(Debug, Clone, Copy)]
pub struct KinematicBand {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl KinematicBand {
    /// Band from the rigid truck's kinematic frequency (3.5-5) over √2 to the free wheelset's (3.5-2)
    /// times √2, at `speed` in m/s: a truck on springs lies between the two but for the effects of
    /// inertia and gravitational stiffness.
    pub fn new(case: &Case, speed: f64) -> Self {
        let (vehicle, conicity) = (&case.vehicle, case.wheel_rail.conicity);
        Self {
            low: kinematic::truck_frequency(vehicle, conicity, speed) / SQRT_2,
            high: kinematic::wheelset_frequency(vehicle, conicity, speed) * SQRT_2,
        }
    }

    /// True if it holds a frequency, Hz.
    pub fn holds(self, frequency: f64) -> bool {
        (self.low..=self.high).contains(&frequency)
    }

    /// Distance of a frequency, Hz, from the band, in ln f: negative below it.
    fn outside(self, frequency: f64) -> f64 {
        (frequency / self.low).ln().min(0.0) + (frequency / self.high).ln().max(0.0)
    }
}

/// The kinematic mode at one speed.
#[derive(Debug, Clone)]
pub struct KinematicMode {
    /// |s|/2π of the motion that counts, Hz.
    pub frequency: f64,
    /// ζ as defined for the module; at most 1.
    pub damping_ratio: f64,
    /// Damping ratio of that motion itself.
    pub own_damping_ratio: f64,
    /// Motions of each truck with Im s ≥ 0, the slowest first; of one truck where both are alike.
    pub motions: Vec<TruckMotion>,
}

/// A motion of a truck under a carbody at rest.
#[derive(Debug, Clone, Copy)]
pub struct TruckMotion {
    /// Number of the truck; 0 stands for both where they are alike.
    pub truck: usize,
    /// s, rad/s.
    pub eigenvalue: Complex<f64>,
    /// Distance from the band of kinematic motion, in ln f: negative below it.
    pub outside: f64,
}

impl TruckMotion {
    /// ζ w.
    pub fn damping_ratio(&self) -> f64 {
        damping_ratio(self.eigenvalue) * self.weight()
    }

    /// w.
    fn weight(&self) -> f64 {
        if damping_ratio(self.eigenvalue) > 0.0 {
            1.0 + RAISED * self.outside * self.outside
        } else {
            1.0
        }
    }

    /// Change of ζ w with that of the eigenvalue and of the band's logarithm.
    fn change(&self, change: Complex<f64>, band: f64) -> f64 {
        let s = self.eigenvalue;
        let own = damping_ratio_change(s, change) * self.weight();
        let zeta = damping_ratio(s);
        if zeta <= 0.0 {
            return own;
        }
        own + zeta * 2.0 * RAISED * self.outside * ((change / s).re - band)
    }

    /// |s|/2π, Hz.
    pub fn frequency(&self) -> f64 {
        size(self.eigenvalue) / TAU
    }

    /// True if it oscillates.
    pub fn oscillates(&self) -> bool {
        self.eigenvalue.im > 0.0
    }
}

impl KinematicMode {
    /// Kinematic mode of the lateral model of a case at `speed`, m/s. `None` if the truck diverges.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if eigenvalues do not converge.
    pub fn new(model: &LateralModel, case: &Case, speed: f64) -> Result<Option<Self>, EigenError> {
        let band = KinematicBand::new(case, speed);
        let mut motions: Vec<TruckMotion> = Vec::new();
        for (truck, (_, held)) in model.trucks(speed).iter().enumerate() {
            let mut values = eigenvalues(held.state_matrix(speed))?;
            if diverge(&values) {
                return Ok(None);
            }
            values.retain(|s| s.im >= 0.0);
            values.sort_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()));
            motions.extend(values.into_iter().map(|s| TruckMotion {
                truck,
                eigenvalue: s,
                outside: band.outside(size(s) / TAU),
            }));
        }
        let counts = motions
            .iter()
            .min_by(|a, b| a.damping_ratio().total_cmp(&b.damping_ratio()))
            .ok_or(EigenError::NotConverged)?;
        Ok(Some(Self {
            frequency: counts.frequency(),
            damping_ratio: counts.damping_ratio().min(1.0),
            own_damping_ratio: damping_ratio(counts.eigenvalue),
            motions,
        }))
    }

    /// s of an oscillation with this frequency and damping ratio, rad/s.
    pub fn eigenvalue(&self) -> Complex<f64> {
        let zeta = self.damping_ratio;
        let unit = Complex::new(-zeta, (1.0 - zeta * zeta).max(0.0).sqrt());
        unit * (TAU * self.frequency)
    }

    /// Derivatives of [`TruckMotion::damping_ratio`] by design constants, of every motion, at `speed`, m/s;
    /// `band` has the derivatives of the logarithm of the band's frequencies. `None` if the vectors are
    /// not finite.
    pub fn derivatives(
        &self,
        model: &LateralModel,
        tangents: &[ForcedTangent],
        band: &[f64],
        speed: f64,
    ) -> Option<Vec<Vec<f64>>> {
        let system = &model.forced.system;
        let trucks = model.trucks(speed);
        // Vectors that are zero where coordinates are held leave all of the model but the truck out.
        let changes = |motion: &TruckMotion| {
            let (numbers, truck) = &trucks[motion.truck];
            let whole = |part: &DVector<Complex<f64>>| {
                let mut whole = DVector::zeros(system.order());
                for (&number, &value) in numbers.iter().zip(part.iter()) {
                    whole[number] = value;
                }
                whole
            };
            let mode = Mode::at(truck, &truck.damping_at(speed), motion.eigenvalue)?;
            let mode = Mode {
                eigenvalue: motion.eigenvalue,
                shape: whole(&mode.shape),
                left: whole(&mode.left),
            };
            Some(modes::by_constants(system, tangents, speed, &mode))
        };
        let derivatives = self.motions.iter().map(|motion| {
            let all = changes(motion)?.into_iter().zip(band);
            Some(
                all.map(|(change, band)| motion.change(change, *band))
                    .collect(),
            )
        });
        derivatives.collect()
    }
}
