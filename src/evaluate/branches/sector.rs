//! How many modes are less damped than a given ratio, by the argument principle.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Complex;
use pulp::{Scalar, Simd, WithSimd};

use super::pairs::Refiner;
use crate::dynamics::elimination::{Factors, LANES, Lanes, Stiffness};

/// Step of ln |s| as a share of the distance to the nearest mode known, and at most, among these
/// and away from them.
const SHARE: f64 = 0.5;
const FINE: f64 = 0.15;
const COARSE: f64 = 0.4;
/// Least step: a mode known may lie on the ray itself.
const SMALLEST: f64 = 1e-5;
/// Range of |s| that counts as among the modes, as a factor beyond theirs.
const MARGIN: f64 = 2.0;
/// |s| at which the walk ends: far above any mode's, rad/s.
const FAR: f64 = 1e6;
/// Start as a share of the lowest |s| of the modes.
const START: f64 = 1e-3;
/// Change of direction from one step to the next above which the walk may have missed a turn, rad.
const SHARP: f64 = 2.4;
/// Distance of the count from a whole number that is put down to the end of the walk.
const UNSURE: f64 = 0.15;

/// Number of eigenvalues in the upper half plane with damping ratios below `zeta` at `speed`, m/s,
/// those on the positive real axis counted half. Where the modes `known` are, the walk goes in small
/// steps, and if it is inconclusive in smaller ones. `None` if it still is.
///
/// ```math
/// Along s = r e^{iθ}, θ = π/2 + asin ζ:   Δarg det D(s) = 2 n θ − 2π N
/// ```
pub fn modes_below(
    refiner: &mut Refiner,
    speed: f64,
    zeta: f64,
    known: &[Complex<f64>],
) -> Option<f64> {
    let carefully = |steps: f64| walk(refiner, speed, zeta, known, steps);
    [1.0, 0.3].into_iter().find_map(carefully)
}

fn walk(
    refiner: &mut Refiner,
    speed: f64,
    zeta: f64,
    known: &[Complex<f64>],
    share: f64,
) -> Option<f64> {
    let angle = FRAC_PI_2 + zeta.asin();
    let order = refiner.order();
    let (stiffness, factors, arch) = refiner.parts();
    let modes: Vec<(f64, f64)> = known.iter().map(|s| (s.norm().ln(), s.arg())).collect();
    let sizes = modes.iter().map(|(size, _)| *size);
    let low = sizes.clone().fold(f64::INFINITY, f64::min);
    let among = low - MARGIN.ln()..sizes.fold(f64::NEG_INFINITY, f64::max) + MARGIN.ln();
    let step = |at: f64| {
        let near = modes
            .iter()
            .map(|(size, direction)| (size - at).powi(2) + (direction - angle).powi(2))
            .fold(f64::INFINITY, f64::min);
        let widest = if among.contains(&at) { FINE } else { COARSE };
        share * (SHARE * near.sqrt()).clamp(SMALLEST, widest)
    };
    // ln |s|
    let mut at = low + START.ln();
    stiffness.set_speeds(Scalar::new(), &[speed; LANES], factors);
    let mut walk = Walk {
        turned: 0.0,
        last: None,
        sure: true,
    };
    while at < FAR.ln() && walk.sure {
        let mut radii = [0.0; LANES];
        for radius in &mut radii {
            *radius = at.exp();
            at += step(at);
        }
        arch.dispatch(Steps {
            stiffness,
            factors,
            radii,
            direction: (angle.cos(), angle.sin()),
            walk: &mut walk,
        });
    }
    let count = (2.0 * order as f64 * angle - walk.turned) / TAU;
    // A positive real eigenvalue counts half.
    let whole = (2.0 * count).round() / 2.0;
    (walk.sure && (count - whole).abs() < UNSURE).then_some(whole)
}

/// A walk along the ray: how far det D has turned.
struct Walk {
    turned: f64,
    last: Option<(f64, f64)>,
    sure: bool,
}

struct Steps<'r> {
    stiffness: &'r Stiffness,
    factors: &'r mut Factors,
    radii: [f64; LANES],
    direction: (f64, f64),
    walk: &'r mut Walk,
}

impl WithSimd for Steps<'_> {
    type Output = ();

    #[allow(clippy::inline_always)] // Where the vector unit is known.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut s = Lanes::ZERO;
        for l in 0..LANES {
            s.re[l] = self.radii[l] * self.direction.0;
            s.im[l] = self.radii[l] * self.direction.1;
        }
        self.stiffness.factor(simd, &s, self.factors);
        let determinant = self.stiffness.determinant(simd, self.factors);
        for l in 0..LANES {
            let (re, im) = (determinant.re[l], determinant.im[l]);
            let turn = match self.walk.last {
                Some((a, b)) => (im * a - re * b).atan2(re * a + im * b),
                // det D(0) = det K is real.
                None => nearest_real(im.atan2(re)),
            };
            self.walk.sure &= turn.abs() < SHARP && self.factors.sound[l];
            self.walk.turned += turn;
            self.walk.last = Some((re, im));
        }
    }
}

/// Angle from the nearer half of the real axis.
fn nearest_real(angle: f64) -> f64 {
    angle - PI * (angle / PI).round()
}
