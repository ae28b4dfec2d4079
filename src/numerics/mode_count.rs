//! Mode count by the argument principle: eigenvalues less damped than a given ratio.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::Complex;
use pulp::{Simd, WithSimd};

use super::{
    Refiner, damping_ratio,
    elimination::{
        Factors, LANES, Lanes, Reals, Stiffness,
        lanes::{abs, add, div, mul, neg},
    },
    size,
};

/// Step of ln |s| among the known modes.
const FINE_STEP: f64 = 0.15;
/// Step of ln |s| above them, up to the fastest decay.
const MIDDLE_STEP: f64 = 0.2;
/// Step of ln |s| below and beyond, where no eigenvalue is expected.
const COARSE_STEP: f64 = 0.4;
/// Two attempts: factor on the steps, and bound on a step as a share of the distance to the nearest
/// known mode. The second attempt resolves an unknown mode beside a known one.
const ATTEMPTS: [(f64, f64); 2] = [(1.0, f64::INFINITY), (0.3, 0.15)];
/// Least step of ln |s|, whatever the distance to the nearest known mode.
const LEAST_STEP: f64 = 3e-6;
/// Factor in |s| below and above the known modes within which steps are fine.
const FINE_MARGIN: f64 = 2.0;
/// End of the path as a multiple of the fastest decay: det D has there its direction at infinity to a
/// few hundredths of a turn.
const PATH_END: f64 = 100.0;
/// Start of the path as a share of the lowest |s| of the known modes.
const PATH_START: f64 = 1e-3;
/// Largest turn of det D in one step, rad; a larger one may hide a whole turn.
const LARGEST_TURN: f64 = 2.4;
/// Largest distance of the count from a half or whole number: the error of ending the path.
const COUNT_ERROR: f64 = 0.15;

/// Number of eigenvalues in the upper half plane with damping ratios below `zeta` at `speed`, m/s; an
/// eigenvalue on the positive real axis counts half. `None` if the count is inconclusive.
///
/// ```math
/// Along s = r e^{iθ}, θ = π/2 + asin ζ:   Δarg det D(s) = 2 n θ − 2π N
/// ```
///
/// det D is divided by the factors of the `known` modes, which are counted directly; the quotient turns
/// slowly. Errors in the known modes, or missing ones, cost steps but not accuracy.
pub fn modes_below(
    refiner: &mut Refiner,
    speed: f64,
    zeta: f64,
    known: &[Complex<f64>],
) -> Option<f64> {
    let below = known.iter().filter(|s| damping_ratio(**s) < zeta).count();
    let attempt = |steps| count_others(refiner, speed, zeta, known, steps);
    let others = ATTEMPTS.into_iter().find_map(attempt)?;
    Some(others + below as f64)
}

/// Number of such eigenvalues besides the known ones; `None` if the count is inconclusive.
fn count_others(
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
        let widest = if at < low - FINE_MARGIN.ln() || at > top + FINE_MARGIN.ln() {
            COARSE_STEP
        } else if at > high + FINE_MARGIN.ln() {
            MIDDLE_STEP
        } else {
            FINE_STEP
        };
        let widest = share * widest;
        if of_distance.is_infinite() {
            return widest;
        }
        let apart = modes
            .iter()
            .map(|(size, direction)| (size - at).hypot(direction - angle));
        let near = apart.fold(f64::INFINITY, f64::min);
        (of_distance * near).clamp(LEAST_STEP, widest)
    };
    // ln |s|
    let mut at = low + PATH_START.ln();
    let mut path = Path {
        turned: 0.0,
        last: None,
        sure: true,
    };
    while at < top + PATH_END.ln() && path.sure {
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
            path: &mut path,
        });
    }
    let degree = stiffness.degree() as f64 - 2.0 * known.len() as f64;
    let count = (degree * angle - path.turned) / TAU;
    // A positive real eigenvalue counts half.
    let whole = (2.0 * count).round() / 2.0;
    (path.sure && (count - whole).abs() < COUNT_ERROR).then_some(whole)
}

/// Progress along the ray.
struct Path {
    /// Turn of the quotient so far, rad.
    turned: f64,
    /// Its last value, scaled.
    last: Option<(f64, f64)>,
    /// False once a step turned too far or an elimination lost digits.
    sure: bool,
}

struct Steps<'r> {
    stiffness: &'r Stiffness,
    factors: &'r mut Factors,
    radii: Reals,
    direction: (f64, f64),
    known: &'r [Complex<f64>],
    path: &'r mut Path,
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
            let turn = match self.path.last {
                Some((a, b)) => (im * a - re * b).atan2(re * a + im * b),
                // At s = 0 it is real.
                None => nearest_real(im.atan2(re)),
            };
            self.path.sure &= turn.abs() < LARGEST_TURN && self.factors.sound[l];
            self.path.turned += turn;
            self.path.last = Some((re, im));
        }
    }
}

/// Angle from the nearer half of the real axis, rad.
fn nearest_real(angle: f64) -> f64 {
    angle - PI * (angle / PI).round()
}
