//! Least damping ratios by full spectra on a grid of speeds.

use nalgebra::Complex;

use super::spectrum::{Spectrum, sweep};
use crate::{
    dynamics::LateralModel,
    evaluate::{
        damping_range::{DampingMinimum, DampingRange, Place},
        lateral_modes::OVERDAMPED,
    },
    numerics::{EigenError, damping_ratio, frequency},
};

/// Distance from an end of the range, as a share of the speed, at which its slope is looked up.
const CLOSE: f64 = 1e-3;
/// Ratio of neighbouring speeds in the first look.
const RATIO: f64 = 1.3;
/// Eigenvalues this close, as a share of their size, are a pair.
const TWIN: f64 = 0.01;
/// Steps to a minimum, eight are normal, and how close they come to its ln V: ζ is then
/// right to its square.
const STEPS: usize = 40;
const SETTLED: f64 = 3e-6;
/// Gain of ζ by a further step at which the parabolas have converged: far below what constraints
/// are kept to.
const GAIN: f64 = 1e-11;
/// A search this close to an end, as a share of the way to it, is on its way out: the modes at the
/// end were taken for others.
const EDGE: f64 = 0.02;
/// Share of an interval that the golden section takes.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

impl DampingMinimum {
    fn is_about(&self, other: &Self) -> bool {
        self.place == other.place
            && (self.speed / other.speed - 1.0).abs() < TWIN
            && (self.frequency / other.frequency - 1.0).abs() < TWIN
    }
}

impl DampingRange {
    /// Looks through `range`, m/s, for minima with damping ratios `below` a value; the least at
    /// each end is always among them. By full spectra.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if eigenvalues cannot be had.
    pub fn search(model: &LateralModel, range: [f64; 2], below: f64) -> Result<Self, EigenError> {
        let [low, high] = range;
        let mut speeds = vec![low];
        let least = (high / low).powf(0.5).min(RATIO);
        while speeds
            .last()
            .is_some_and(|v| v * least < high * (1.0 - CLOSE))
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
        // A minimum in the first or last interval hides behind the end of the range: a speed close
        // to the end tells.
        if let ([first, second, ..], [.., next, last]) = (&sweep[..], &sweep[..]) {
            let middle = (low * second.speed).sqrt();
            let close = Spectrum::at(model, middle.min(low * (1.0 + CLOSE)))?;
            found.inside(model, &[first.clone(), close, second.clone()], below)?;
            let middle = (next.speed * high).sqrt();
            let close = Spectrum::at(model, middle.max(high * (1.0 - CLOSE)))?;
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
            // Of modes that nearly coincide the lower counts: which is which depends on the speed.
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

/// The least damped of the modes near an expected eigenvalue: the trucks' modes come in pairs that
/// nearly coincide, and the lower one counts.
fn least_damped_near(spectrum: &Spectrum, expected: Complex<f64>) -> Option<Complex<f64>> {
    let nearest = spectrum.nearest(expected)?;
    let reach = (nearest - expected).norm() + TWIN * nearest.norm();
    let near = spectrum.oscillatory.iter().copied();
    near.filter(|s| (s - expected).norm() <= reach)
        .min_by(|a, b| damping_ratio(*a).total_cmp(&damping_ratio(*b)))
}

/// How low the damping ratio may fall between three speeds: twice as far below the middle one as
/// the parabola through them does.
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
/// Derivatives*, 1973, chapter 5). The mode is the one nearest to where the two best put it. `None`
/// if it goes on down to one of the ends.
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
    for _ in 0..STEPS {
        let centre = f64::midpoint(a, b);
        if (x.0 - centre).abs() <= 2.0 * SETTLED - 0.5 * (b - a) {
            break;
        }
        // Down to an end of the interval: there it is another one's to find.
        let heads_out = |end: f64, bound: f64, middle: f64| {
            end.to_bits() == bound.to_bits() && (x.0 - end).abs() < EDGE * (middle - end).abs()
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
        if before.abs() > SETTLED && inside && p.abs() < (0.5 * q * before).abs() {
            // What the last parabola is off, the next one gains.
            let gain = 0.5 * p * p / q / ((x.0 - w.0) * (x.0 - v.0) * (w.0 - v.0)).abs();
            if gain < GAIN && (p / q).abs() < 0.1 * step.abs() {
                break;
            }
            (step, before) = (p / q, step);
            let u = x.0 + step;
            if u - a < 2.0 * SETTLED || b - u < 2.0 * SETTLED {
                step = SETTLED.copysign(centre - x.0);
            }
        } else {
            before = if x.0 >= centre { a - x.0 } else { b - x.0 };
            step = GOLDEN * before;
        }
        let u = x.0 + step.abs().max(SETTLED).copysign(step);
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
