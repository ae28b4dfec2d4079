//! How many modes are less damped than a given ratio, by the argument principle.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Complex;
use pulp::{Simd, WithSimd};

use crate::{
    dynamics::{
        Refiner,
        elimination::{
            Factors, LANES, Lanes, Reals, Stiffness,
            lanes::{abs, add, div, mul, neg},
        },
    },
    evaluate::mode::{damping_ratio, size},
};

/// Steps of ln |s|: among the modes known, above them where the creep forces' fast decay is, and
/// where nothing is expected.
const FINE: f64 = 0.15;
const MIDDLE: f64 = 0.2;
const COARSE: f64 = 0.4;
/// Shares of these steps that are tried. The second time steps are at most a share of the distance to
/// the nearest mode known, but for the least: there may be another like it.
const CARE: [(f64, f64); 2] = [(1.0, f64::INFINITY), (0.3, 0.15)];
const SMALLEST: f64 = 3e-6;
/// Range of |s| that counts as among the modes, as a factor beyond theirs.
const MARGIN: f64 = 2.0;
/// Where the walk ends, as a multiple of the fastest decay: what directions there are lies within a
/// few hundredths of a turn of that at infinity.
const FAR: f64 = 100.0;
/// Start as a share of the lowest |s| of the modes.
const START: f64 = 1e-3;
/// Change of direction from one step to the next above which the walk may have missed a turn, rad.
const SHARP: f64 = 2.4;
/// Distance of the count from a whole number that is put down to the end of the walk.
const UNSURE: f64 = 0.15;

/// Number of eigenvalues in the upper half plane with damping ratios below `zeta` at `speed`, m/s,
/// those on the positive real axis counted half. `None` if the count is inconclusive.
///
/// ```math
/// Along s = r e^{iθ}, θ = π/2 + asin ζ:   Δarg det D(s) = 2 n θ − 2π N
/// ```
///
/// det D is divided by the factors of the modes `known`, which are counted by themselves: what is
/// left turns slowly. If they are not quite right, or some are missing, that only takes more steps.
pub fn modes_below(
    refiner: &mut Refiner,
    speed: f64,
    zeta: f64,
    known: &[Complex<f64>],
) -> Option<f64> {
    let below = known.iter().filter(|s| damping_ratio(**s) < zeta).count();
    let carefully = |care| walk(refiner, speed, zeta, known, care);
    let others = CARE.into_iter().find_map(carefully)?;
    Some(others + below as f64)
}

/// Number of those that are not known.
fn walk(
    refiner: &mut Refiner,
    speed: f64,
    zeta: f64,
    known: &[Complex<f64>],
    (share, of_distance): (f64, f64),
) -> Option<f64> {
    let angle = FRAC_PI_2 + zeta.asin();
    let (stiffness, factors, arch) = refiner.parts();
    let modes: Vec<(f64, f64)> = known.iter().map(|s| (size(*s).ln(), s.arg())).collect();
    let sizes = modes.iter().map(|(size, _)| *size);
    stiffness.set_speed(speed, factors);
    let fastest = stiffness.fastest(factors).ln();
    let low = sizes.clone().fold(fastest, f64::min);
    let high = sizes.fold(low, f64::max);
    let top = fastest.max(high);
    let step = |at: f64| {
        let widest = if at < low - MARGIN.ln() || at > top + MARGIN.ln() {
            COARSE
        } else if at > high + MARGIN.ln() {
            MIDDLE
        } else {
            FINE
        };
        let widest = share * widest;
        if of_distance.is_infinite() {
            return widest;
        }
        let apart = modes
            .iter()
            .map(|(size, direction)| (size - at).hypot(direction - angle));
        let near = apart.fold(f64::INFINITY, f64::min);
        (of_distance * near).clamp(SMALLEST, widest)
    };
    // ln |s|
    let mut at = low + START.ln();
    let mut walk = Walk {
        turned: 0.0,
        last: None,
        sure: true,
    };
    while at < top + FAR.ln() && walk.sure {
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
            known,
            walk: &mut walk,
        });
    }
    let degree = stiffness.degree() as f64 - 2.0 * known.len() as f64;
    let count = (degree * angle - walk.turned) / TAU;
    // A positive real eigenvalue counts half.
    let whole = (2.0 * count).round() / 2.0;
    (walk.sure && (count - whole).abs() < UNSURE).then_some(whole)
}

/// A walk along the ray: how far what is left of det D has turned.
struct Walk {
    turned: f64,
    last: Option<(f64, f64)>,
    sure: bool,
}

struct Steps<'r> {
    stiffness: &'r Stiffness,
    factors: &'r mut Factors,
    radii: Reals,
    direction: (f64, f64),
    known: &'r [Complex<f64>],
    walk: &'r mut Walk,
}

impl WithSimd for Steps<'_> {
    type Output = ();

    #[allow(clippy::inline_always)] // Where the vector unit is known.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let s = Lanes {
            re: mul(simd, &self.radii, &[self.direction.0; LANES]),
            im: mul(simd, &self.radii, &[self.direction.1; LANES]),
        };
        self.stiffness.factor(simd, &s, self.factors);
        let mut left = self.stiffness.determinant(simd, self.factors);
        for (k, known) in self.known.iter().enumerate() {
            for mode in [*known, known.conj()] {
                // Divided by s − λ, but for its size.
                let mut factor = s.minus(simd, mode);
                factor.im = neg(simd, &factor.im);
                left = left.times(simd, &factor);
            }
            // Four take it to 1e48 at most.
            if k % 4 == 3 {
                let size = add(simd, &abs(simd, &left.re), &abs(simd, &left.im));
                left = left.scaled(simd, &div(simd, &[1.0; LANES], &size));
            }
        }
        for l in 0..LANES {
            let (re, im) = (left.re[l], left.im[l]);
            let turn = match self.walk.last {
                Some((a, b)) => (im * a - re * b).atan2(re * a + im * b),
                // At s = 0 it is real.
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
