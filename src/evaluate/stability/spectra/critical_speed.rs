//! The critical speed by full spectra on a grid of speeds.
//!
//! Each mode is matched from one speed to the next. Where it changes from damped to growing, Newton's
//! method finds the speed. Where its damping ratio has a minimum between grid points, the minimum is
//! refined, so that a narrow range of instability is not stepped over. Last, the spectrum just below
//! the lowest onset must be stable.

use super::{
    damping_range::{dip, refine},
    hopf::{Hopf, hopf},
    spectrum::{Spectrum, sweep},
};
use crate::{
    dynamics::LateralModel,
    evaluate::stability::{Crossing, Stability},
    numerics::{EigenError, damping_ratio},
};

/// Number of speeds in the grid.
const GRID_SPEEDS: usize = 20;
/// Estimate of a least damping ratio below which the minimum is refined.
const REFINED_BELOW: f64 = 0.02;
/// Limit on the divisions of an interval in which several modes lose their damping.
const MAX_DIVISIONS: usize = 12;
/// Limit on the halvings of a speed interval: to 1e-12 of it.
const MAX_BISECTIONS: usize = 40;

impl Stability {
    /// Onsets in `range`, m/s, by full spectra.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if eigenvalues do not converge.
    pub fn by_spectra(model: &LateralModel, range: [f64; 2]) -> Result<Self, EigenError> {
        let ratio = range[1] / range[0];
        let speeds: Vec<f64> = (0..GRID_SPEEDS)
            .map(|k| range[0] * ratio.powf(k as f64 / (GRID_SPEEDS - 1) as f64))
            .collect();
        // A refinement of the sweep above the first onset finds no lower one.
        let sweep = sweep(model, &speeds, 0.0)?;
        let mut stability = Self {
            range,
            onsets: Vec::new(),
            unstable_at_start: sweep[0].unstable() > 0,
            divergence: sweep[0].diverges.then_some(range[0]),
        };
        for pair in sweep.windows(2) {
            stability.cross(model, &pair[0], &pair[1], MAX_DIVISIONS)?;
        }
        for triple in sweep.windows(3) {
            stability.look_between(model, triple)?;
        }
        stability.onsets.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        stability.certify(model, &sweep[0])?;
        Ok(stability)
    }

    /// Adds the onsets between two speeds. An interval in which two modes lose their damping (the trucks'
    /// modes nearly coincide) is divided first.
    fn cross(
        &mut self,
        model: &LateralModel,
        low: &Spectrum,
        high: &Spectrum,
        divisions: usize,
    ) -> Result<(), EigenError> {
        let lost: Vec<_> = low
            .follow(high)
            .into_iter()
            .filter(|(from, to)| from.re < 0.0 && to.re >= 0.0)
            .map(|(from, to)| {
                let t = -from.re / (to.re - from.re);
                let v = low.speed + t * (high.speed - low.speed);
                (v, from.im + t * (to.im - from.im))
            })
            .collect();
        if lost.len() > 1 && divisions > 0 {
            let mean = lost.iter().map(|(v, _)| v).sum::<f64>() / lost.len() as f64;
            let middle = Spectrum::at(model, mean)?;
            self.cross(model, low, &middle, divisions - 1)?;
            return self.cross(model, &middle, high, divisions - 1);
        }
        for (v, omega) in lost {
            let found = hopf(&model.forced.system, v, omega)
                .filter(|h| h.speed >= low.speed && h.speed <= high.speed);
            let found = match found {
                Some(found) => Some(found),
                None => bisect(model, low, high)?,
            };
            if let Some(found) = found {
                self.add(model, found);
            }
        }
        Ok(())
    }

    fn add(&mut self, model: &LateralModel, found: Hopf) {
        let omega = found.mode.eigenvalue.im;
        let known = |c: &Crossing| {
            (c.speed / found.speed - 1.0).abs() < 1e-9
                && (c.mode.eigenvalue.im / omega - 1.0).abs() < 1e-9
        };
        if !self.onsets.iter().any(known) {
            self.onsets
                .push(Crossing::new(model, found.speed, found.mode));
        }
    }

    /// Adds the onsets of an instability that begins and ends between grid points: of a mode whose damping
    /// ratio has a minimum there below zero.
    fn look_between(
        &mut self,
        model: &LateralModel,
        triple: &[Spectrum],
    ) -> Result<(), EigenError> {
        let [a, b, c] = triple else { return Ok(()) };
        for [first, middle, last] in a.through(b, c) {
            let known = [(a.speed, first), (b.speed, middle), (c.speed, last)];
            let [za, zb, zc] = known.map(|(_, s)| damping_ratio(s));
            if zb > 0.0 && zb <= za && zb <= zc && dip(known) < REFINED_BELOW {
                let minimum = refine(model, known)?;
                if let Some(minimum) = minimum.filter(|m| m.damping_ratio < 0.0) {
                    let unstable = Spectrum::at(model, minimum.speed)?;
                    self.cross(model, a, &unstable, MAX_DIVISIONS)?;
                }
            }
        }
        Ok(())
    }

    /// Adds onsets until every motion decays just below the lowest.
    fn certify(&mut self, model: &LateralModel, first: &Spectrum) -> Result<(), EigenError> {
        for _ in 0..MAX_BISECTIONS {
            let Some(lowest) = self.onsets.first() else {
                break;
            };
            if self.unstable_at_start {
                break;
            }
            let below = Spectrum::at(model, lowest.speed * (1.0 - 1e-6))?;
            if below.unstable() == 0 {
                break;
            }
            let Some(found) = bisect(model, first, &below)? else {
                break;
            };
            let known = self.onsets.len();
            self.add(model, found);
            self.onsets.sort_by(|a, b| a.speed.total_cmp(&b.speed));
            if self.onsets.len() == known {
                break;
            }
        }
        Ok(())
    }
}

/// Lowest speed at which the number of growing modes increases, by bisection between two speeds and then
/// Newton's method.
fn bisect(
    model: &LateralModel,
    low: &Spectrum,
    high: &Spectrum,
) -> Result<Option<Hopf>, EigenError> {
    let (mut low, mut high) = (low.clone(), high.clone());
    let count = low.unstable();
    if high.unstable() <= count {
        return Ok(None);
    }
    for _ in 0..MAX_BISECTIONS {
        let middle = Spectrum::at(model, f64::midpoint(low.speed, high.speed))?;
        if middle.unstable() > count {
            high = middle;
        } else {
            low = middle;
        }
        let candidate = high
            .oscillatory
            .iter()
            .filter(|s| s.re >= 0.0)
            .min_by(|a, b| a.re.total_cmp(&b.re));
        if let Some(s) = candidate
            && let Some(found) = hopf(&model.forced.system, high.speed, s.im)
            && found.speed >= low.speed * (1.0 - 1e-9)
            && found.speed <= high.speed * (1.0 + 1e-9)
        {
            return Ok(Some(found));
        }
    }
    Ok(None)
}
