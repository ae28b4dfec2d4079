//! Full spectra, and the matching of their modes from one speed to another.

use nalgebra::Complex;

use crate::{
    dynamics::LateralModel,
    evaluate::modes::OVERDAMPED,
    numerics::{EigenError, Poles, damping_ratio},
};

/// Oscillatory eigenvalues at one speed.
#[derive(Debug, Clone)]
pub(super) struct Spectrum {
    /// V, m/s.
    pub speed: f64,
    /// Eigenvalues with positive imaginary part.
    pub oscillatory: Vec<Complex<f64>>,
    /// True if a motion without oscillation grows.
    pub diverges: bool,
}

/// Damping ratio below which the sweep is refined: between the speeds of a coarse one it may fall below
/// zero and rise again, and modes that veer apart may be confused.
const REFINED_BELOW: f64 = 0.03;
/// Number of parts into which such an interval of the sweep is divided.
const PARTS: i32 = 4;

/// Spectra at `speeds`, m/s, and between them where the least damping ratio lies between `from` and
/// [`REFINED_BELOW`].
pub(super) fn sweep(
    model: &LateralModel,
    speeds: &[f64],
    from: f64,
) -> Result<Vec<Spectrum>, EigenError> {
    let mut sweep: Vec<Spectrum> = Vec::new();
    for &speed in speeds {
        let next = Spectrum::at(model, speed)?;
        let light = |s: &Spectrum| (from..REFINED_BELOW).contains(&s.least_damping());
        if let Some(last) = sweep.last().filter(|last| light(last) || light(&next)) {
            let (start, ratio) = (last.speed, speed / last.speed);
            for part in 1..PARTS {
                let t = f64::from(part) / f64::from(PARTS);
                sweep.push(Spectrum::at(model, start * ratio.powf(t))?);
            }
        }
        sweep.push(next);
    }
    Ok(sweep)
}

impl Spectrum {
    /// Spectrum at `speed`, m/s, by the Schur form of the whole matrix.
    pub fn at(model: &LateralModel, speed: f64) -> Result<Self, EigenError> {
        let poles = Poles::plain(&model.forced.system, speed)?;
        Ok(Self {
            speed,
            diverges: poles.diverge(),
            oscillatory: poles.oscillatory().collect(),
        })
    }

    /// The least damping ratio.
    fn least_damping(&self) -> f64 {
        let ratios = self.oscillatory.iter().map(|s| damping_ratio(*s));
        ratios.fold(f64::INFINITY, f64::min)
    }

    /// Number of growing oscillations.
    pub fn unstable(&self) -> usize {
        self.oscillatory.iter().filter(|s| s.re >= 0.0).count()
    }

    /// The mode nearest to an eigenvalue.
    pub fn nearest(&self, to: Complex<f64>) -> Option<Complex<f64>> {
        self.oscillatory
            .iter()
            .copied()
            .min_by(|a, b| (a - to).norm_sqr().total_cmp(&(b - to).norm_sqr()))
    }

    /// Eigenvalues of the modes that are matched over three speeds.
    pub fn through(&self, next: &Self, last: &Self) -> Vec<[Complex<f64>; 3]> {
        let before = self.follow(next);
        let after = next.follow(last).into_iter();
        after
            .filter_map(|(middle, last)| {
                let (first, _) = before.iter().find(|(_, s)| *s == middle)?;
                Some([*first, middle, last])
            })
            .collect()
    }

    /// Matches of the oscillatory modes with those at another speed, the closest pairs first.
    pub fn follow(&self, other: &Self) -> Vec<(Complex<f64>, Complex<f64>)> {
        let relevant = |s: &&Complex<f64>| damping_ratio(**s) < OVERDAMPED;
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (i, from) in self
            .oscillatory
            .iter()
            .enumerate()
            .filter(|(_, s)| relevant(s))
        {
            for (j, to) in other
                .oscillatory
                .iter()
                .enumerate()
                .filter(|(_, s)| relevant(s))
            {
                pairs.push(((from - to).norm() / (from.norm() + to.norm()), i, j));
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut taken = (
            vec![false; self.oscillatory.len()],
            vec![false; other.oscillatory.len()],
        );
        let mut followed = Vec::new();
        for (_, i, j) in pairs {
            if !taken.0[i] && !taken.1[j] {
                (taken.0[i], taken.1[j]) = (true, true);
                followed.push((self.oscillatory[i], other.oscillatory[j]));
            }
        }
        followed
    }
}
