//! Damping over a range of speeds: where each lateral mode is least damped.
//!
//! A vehicle is stable up to a speed if no mode's damping ratio falls below zero on the way. The
//! minima of the damping ratios over the speed change smoothly with the design, also where an
//! instability is born at some speed within the range, at which the critical speed jumps.

use nalgebra::Complex;

use super::{
    followed_modes::{Spectrum, sweep},
    lateral_modes::OVERDAMPED,
    mode::{damping_ratio, frequency},
};
use crate::dynamics::{EigenError, LateralModel};

/// Where in the range a minimum lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// At the highest speed.
    Top,
    /// Inside the range.
    Inside,
    /// At the lowest speed.
    Bottom,
}

/// A least damping ratio of one mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DampingMinimum {
    /// Where.
    pub place: Place,
    /// V, m/s.
    pub speed: f64,
    /// |s|/2π, Hz.
    pub frequency: f64,
    /// ζ.
    pub damping_ratio: f64,
}

impl DampingMinimum {
    fn is_about(&self, other: &Self) -> bool {
        self.place == other.place
            && (self.speed / other.speed - 1.0).abs() < TWIN
            && (self.frequency / other.frequency - 1.0).abs() < TWIN
    }
}

/// Damping over a range of speeds.
#[derive(Debug, Clone)]
pub struct DampingRange {
    /// Minima, in no particular order; never empty unless nothing oscillates.
    pub minima: Vec<DampingMinimum>,
    /// Whether a motion without oscillation grows at some speed.
    pub diverges: bool,
}

/// Distance from an end of the range, as a share of the speed, at which its slope is looked up.
const CLOSE: f64 = 1e-3;
/// Ratio of neighbouring speeds in the first look.
const RATIO: f64 = 1.3;
/// Eigenvalues this close, as a share of their size, are a pair.
const TWIN: f64 = 0.01;
/// Steps of successive parabolas, and the change of ζ at which they end: a hundredth of what
/// constraints are kept to.
const STEPS: usize = 12;
const SETTLED: f64 = 1e-11;

impl DampingRange {
    /// Looks through `range`, m/s, for minima with damping ratios `below` a value; the least at
    /// each end is always among them.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if eigenvalues cannot be had.
    pub fn new(model: &LateralModel, range: [f64; 2], below: f64) -> Result<Self, EigenError> {
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
            diverges: sweep.iter().any(|s| s.diverges),
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

    /// The least damping ratio in the range.
    pub fn least(&self) -> Option<DampingMinimum> {
        let minima = self.minima.iter().copied();
        minima.min_by(|a, b| a.damping_ratio.total_cmp(&b.damping_ratio))
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
        let before = a.follow(b);
        for (middle, after) in b.follow(c) {
            let Some((first, _)) = before.iter().find(|(_, s)| *s == middle) else {
                continue;
            };
            // Of modes that nearly coincide the lower counts: which is which depends on the speed.
            let start = [(a, *first), (b, middle), (c, after)]
                .map(|(at, s)| (at.speed, least_damped_near(at, s).unwrap_or(s)));
            let [za, zb, zc] = start.map(|(_, s)| damping_ratio(s));
            if zb <= za && zb <= zc && dip(start) < below {
                let minimum = refine(model, start)?;
                let known = self.minima.iter().any(|m| m.is_about(&minimum));
                if minimum.damping_ratio < below && !known {
                    self.minima.push(minimum);
                }
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

/// The minimum between three speeds, the middle one least damped: successive parabolas through
/// ln V, the mode nearest to where the last ones put it.
pub(super) fn refine(
    model: &LateralModel,
    start: [(f64, Complex<f64>); 3],
) -> Result<DampingMinimum, EigenError> {
    let mut known = start.map(|(v, s)| (v.ln(), s));
    for _ in 0..STEPS {
        let [a, b, c] = known.map(|(x, s)| (x, damping_ratio(s)));
        let (left, right) = (b.0 - a.0, c.0 - b.0);
        let (fall, rise) = ((b.1 - a.1) / left, (c.1 - b.1) / right);
        let curvature = rise - fall;
        // Where the parabola is flat: rounding decides, and the middle is as good.
        let mut x = if curvature > 0.0 {
            b.0 - (left * rise + right * fall) / (2.0 * curvature)
        } else {
            b.0
        };
        // Towards the longer side if the parabola proposes what is known.
        if (x - b.0).abs() < 1e-4 * (left + right) {
            x = b.0 + 0.05 * if right > left { right } else { -left };
        }
        x = x.clamp(a.0 + 0.01 * left, c.0 - 0.01 * right);
        let near = if x > b.0 { &known[2] } else { &known[0] };
        let t = (x - known[1].0) / (near.0 - known[1].0);
        let expected = known[1].1 * (1.0 - t) + near.1 * t;
        let Some(s) = least_damped_near(&Spectrum::at(model, x.exp())?, expected) else {
            break;
        };
        let change = damping_ratio(s) - b.1;
        known = match (x > b.0, change < 0.0) {
            (true, true) => [known[1], (x, s), known[2]],
            (true, false) => [known[0], known[1], (x, s)],
            (false, true) => [known[0], (x, s), known[1]],
            (false, false) => [(x, s), known[1], known[2]],
        };
        if change.abs() < SETTLED {
            break;
        }
    }
    let (x, s) = known[1];
    Ok(DampingMinimum {
        place: Place::Inside,
        speed: x.exp(),
        frequency: frequency(s),
        damping_ratio: damping_ratio(s),
    })
}
