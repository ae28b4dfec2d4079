//! Least damping ratios by full spectra on a grid of speeds.

use nalgebra::Complex;

use super::spectrum::{Spectrum, sweep};
use crate::{
    dynamics::LateralModel,
    evaluate::{
        modes::OVERDAMPED,
        stability::{DampingMinimum, DampingRange, Place},
    },
    numerics::{EigenError, damping_ratio, frequency},
};

/// Distance from an end of the range, as a share of the speed, of the spectrum that gives the slope there.
const END_GAP: f64 = 1e-3;
/// Largest ratio of neighbouring speeds of the grid.
const SPEED_RATIO: f64 = 1.3;
/// Relative distance of two eigenvalues below which they count as twins.
const TWIN_DISTANCE: f64 = 0.01;
/// Limit on the steps to a minimum; eight are usual.
const MAX_STEPS: usize = 40;
/// Accuracy of a minimum in ln V; that of ζ is its square.
const LN_SPEED_ACCURACY: f64 = 3e-6;
/// Gain in ζ by a further step below which the parabolas have converged: far below the tolerance of
/// constraints.
const LEAST_GAIN: f64 = 1e-11;
/// Distance from an end of the interval, as a share of that of the start, below which the minimum is
/// taken to lie outside: modes were confused at the end.
const END_SHARE: f64 = 0.02;
/// Share of an interval that a golden-section step takes.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

impl DampingMinimum {
    fn is_about(&self, other: &Self) -> bool {
        self.place == other.place
            && (self.speed / other.speed - 1.0).abs() < TWIN_DISTANCE
            && (self.frequency / other.frequency - 1.0).abs() < TWIN_DISTANCE
    }
}

impl DampingRange {
    /// Minima in `range`, m/s, with damping ratios `below` a value, and the least one at each end, by full
    /// spectra.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if eigenvalues do not converge.
    pub fn by_spectra(
        model: &LateralModel,
        range: [f64; 2],
        below: f64,
    ) -> Result<Self, EigenError> {
        let [low, high] = range;
        let mut speeds = vec![low];
        let least = (high / low).powf(0.5).min(SPEED_RATIO);
        while speeds
            .last()
            .is_some_and(|v| v * least < high * (1.0 - END_GAP))
        {
            speeds.push(low * least.powi(i32::try_from(speeds.len()).unwrap_or(i32::MAX)));
        }
        speeds.push(high);
        let sweep = sweep(model, &speeds, f64::NEG_INFINITY)?;
        let mut found = Self {
            minima: Vec::new(),
            diverges: sweep.first().is_some_and(|s| s.diverges),
        };
        if let [first, .., last] = &sweep[..] {
            found.end(first, Place::Bottom, below);
            found.end(last, Place::Top, below);
        }
        for triple in sweep.windows(3) {
            found.inside(model, triple, below)?;
        }
        // A minimum within the first or last interval shows by the slope at the end of the range.
        if let ([first, second, ..], [.., next, last]) = (&sweep[..], &sweep[..]) {
            let middle = (low * second.speed).sqrt();
            let close = Spectrum::at(model, middle.min(low * (1.0 + END_GAP)))?;
            found.inside(model, &[first.clone(), close, second.clone()], below)?;
            let middle = (next.speed * high).sqrt();
            let close = Spectrum::at(model, middle.max(high * (1.0 - END_GAP)))?;
            found.inside(model, &[next.clone(), close, last.clone()], below)?;
        }
        Ok(found)
    }

    fn end(&mut self, spectrum: &Spectrum, place: Place, below: f64) {
        let oscillatory = spectrum.oscillatory.iter();
        let mut modes: Vec<Complex<f64>> = oscillatory
            .copied()
            .filter(|s| damping_ratio(*s) < OVERDAMPED)
            .collect();
        modes.sort_by(|a, b| damping_ratio(*a).total_cmp(&damping_ratio(*b)));
        for (rank, s) in modes.into_iter().enumerate() {
            if rank == 0 || damping_ratio(s) < below {
                self.minima.push(DampingMinimum {
                    place,
                    speed: spectrum.speed,
                    frequency: frequency(s),
                    damping_ratio: damping_ratio(s),
                });
            }
        }
    }

    fn inside(
        &mut self,
        model: &LateralModel,
        triple: &[Spectrum],
        below: f64,
    ) -> Result<(), EigenError> {
        let [a, b, c] = triple else { return Ok(()) };
        for [first, middle, last] in a.through(b, c) {
            // Of nearly coincident modes the less damped counts; which of them it is depends on the speed.
            let start = [(a, first), (b, middle), (c, last)]
                .map(|(at, s)| (at.speed, least_damped_near(at, s).unwrap_or(s)));
            let [za, zb, zc] = start.map(|(_, s)| damping_ratio(s));
            if zb <= za && zb <= zc && dip(start) < below {
                let minimum = refine(model, start)?;
                let known = |m: &DampingMinimum| self.minima.iter().any(|k| k.is_about(m));
                let new = minimum.filter(|m| m.damping_ratio < below && !known(m));
                self.minima.extend(new);
            }
        }
        Ok(())
    }
}

/// The least damped mode near an expected eigenvalue: the trucks' modes come in nearly coincident pairs,
/// of which the less damped counts.
fn least_damped_near(spectrum: &Spectrum, expected: Complex<f64>) -> Option<Complex<f64>> {
    let nearest = spectrum.nearest(expected)?;
    let reach = (nearest - expected).norm() + TWIN_DISTANCE * nearest.norm();
    let near = spectrum.oscillatory.iter().copied();
    near.filter(|s| (s - expected).norm() <= reach)
        .min_by(|a, b| damping_ratio(*a).total_cmp(&damping_ratio(*b)))
}

/// Lower estimate of the damping ratio between three speeds: twice as far below the middle value as the
/// vertex of the parabola through the three.
pub(super) fn dip(known: [(f64, Complex<f64>); 3]) -> f64 {
    let [a, b, c] = known.map(|(v, s)| (v.ln(), damping_ratio(s)));
    let (left, right) = (b.0 - a.0, c.0 - b.0);
    let (fall, rise) = ((b.1 - a.1) / left, (c.1 - b.1) / right);
    let slope = (left * rise + right * fall) / (left + right);
    let curvature = 2.0 * (rise - fall) / (left + right);
    if curvature > 0.0 {
        b.1 - slope * slope / curvature
    } else {
        b.1
    }
}

/// The minimum between three speeds, the middle one least damped, over ln V: parabolas through the
/// three best, the golden section where these fail (Brent: *Algorithms for Minimization without
/// Derivatives*, 1973, chapter 5). At each speed the mode is the one nearest to the extrapolation of the
/// two best. `None` if the damping ratio falls all the way to an end.
pub(super) fn refine(
    model: &LateralModel,
    start: [(f64, Complex<f64>); 3],
) -> Result<Option<DampingMinimum>, EigenError> {
    let [first, middle, last] = start.map(|(v, s)| (v.ln(), s));
    let (mut a, mut b) = (first.0, last.0);
    let zeta = |known: (f64, Complex<f64>)| damping_ratio(known.1);
    // The best three, and the last two steps.
    let mut x = middle;
    let (mut w, mut v) = if zeta(first) <= zeta(last) {
        (first, last)
    } else {
        (last, first)
    };
    let (mut step, mut before) = (b - a, b - a);
    for _ in 0..MAX_STEPS {
        let centre = f64::midpoint(a, b);
        if (x.0 - centre).abs() <= 2.0 * LN_SPEED_ACCURACY - 0.5 * (b - a) {
            break;
        }
        // A minimum at an end of the interval belongs to the neighbouring one.
        let heads_out = |end: f64, bound: f64, middle: f64| {
            end.to_bits() == bound.to_bits() && (x.0 - end).abs() < END_SHARE * (middle - end).abs()
        };
        if heads_out(a, first.0, middle.0) || heads_out(b, last.0, middle.0) {
            return Ok(None);
        }
        // Of the parabola through the three: the way to its minimum is p / q.
        let r = (x.0 - w.0) * (zeta(x) - zeta(v));
        let q = (x.0 - v.0) * (zeta(x) - zeta(w));
        let p = (x.0 - v.0) * q - (x.0 - w.0) * r;
        let q = 2.0 * (q - r);
        let (p, q) = if q > 0.0 { (-p, q) } else { (p, -q) };
        let inside = p > q * (a - x.0) && p < q * (b - x.0);
        if before.abs() > LN_SPEED_ACCURACY && inside && p.abs() < (0.5 * q * before).abs() {
            // The next step gains the error of the last parabola.
            let gain = 0.5 * p * p / q / ((x.0 - w.0) * (x.0 - v.0) * (w.0 - v.0)).abs();
            if gain < LEAST_GAIN && (p / q).abs() < 0.1 * step.abs() {
                break;
            }
            (step, before) = (p / q, step);
            let u = x.0 + step;
            if u - a < 2.0 * LN_SPEED_ACCURACY || b - u < 2.0 * LN_SPEED_ACCURACY {
                step = LN_SPEED_ACCURACY.copysign(centre - x.0);
            }
        } else {
            before = if x.0 >= centre { a - x.0 } else { b - x.0 };
            step = GOLDEN * before;
        }
        let u = x.0 + step.abs().max(LN_SPEED_ACCURACY).copysign(step);
        let expected = x.1 + (w.1 - x.1) * ((u - x.0) / (w.0 - x.0));
        let Some(s) = least_damped_near(&Spectrum::at(model, u.exp())?, expected) else {
            break;
        };
        let u = (u, s);
        if zeta(u) <= zeta(x) {
            (a, b) = if u.0 >= x.0 { (x.0, b) } else { (a, x.0) };
            (v, w, x) = (w, x, u);
        } else {
            (a, b) = if u.0 < x.0 { (u.0, b) } else { (a, u.0) };
            if zeta(u) <= zeta(w) {
                (v, w) = (w, u);
            } else if zeta(u) <= zeta(v) {
                v = u;
            }
        }
    }
    Ok(Some(DampingMinimum {
        place: Place::Inside,
        speed: x.0.exp(),
        frequency: frequency(x.1),
        damping_ratio: zeta(x),
    }))
}
