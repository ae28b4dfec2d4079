//! Response of a forced model to the irregularities of the track, frequency by frequency.
//!
//! ```math
//! D(iω) q = −(iω C_u + K_u) Σᵢ uᵢ e^{−iωτᵢ},   D = −ω² M + iω C + K
//! ```
//!
//! Input reaches wheelset i delayed by its distance behind the first wheelset over V, exactly.

pub mod plain;
mod terms;

use std::{f64::consts::TAU, ops::Range};

use pulp::{Arch, Simd, WithSimd};

use crate::{
    dynamics::{
        ForcedModel,
        elimination::{Factors, LANES, Lanes, Stiffness, each},
    },
    track::Track,
};
use terms::{Force, OutputTerms, Source};

/// A forced model at one speed, ready to be evaluated at many frequencies, [`LANES`] at a time,
/// without allocation.
pub struct Response<'a> {
    model: &'a ForcedModel,
    track: &'a Track,
    speed: f64,
    outputs: Range<usize>,
    arch: Arch,
    stiffness: Stiffness,
    factors: Factors,
    excitations: Vec<Excited>,
}

/// One excitation: what it puts on the coordinates, what outputs it reaches, and the response.
struct Excited {
    forces: Vec<Force>,
    outputs: Vec<OutputTerms>,
    q: Vec<Lanes>,
}

impl<'a> Response<'a> {
    /// All outputs of the model on a track at `speed`, m/s.
    pub fn new(model: &'a ForcedModel, track: &'a Track, speed: f64) -> Self {
        Self::of(model, track, speed, 0..model.outputs.len())
    }

    /// Some of its outputs.
    pub fn of(model: &'a ForcedModel, track: &'a Track, speed: f64, outputs: Range<usize>) -> Self {
        let system = &model.system;
        let stiffness = Stiffness::new(system);
        let mut factors = stiffness.factors();
        stiffness.set_speeds(&[speed; LANES], &mut factors);
        let excitations = model.excitations.iter().map(|excitation| Excited {
            forces: terms::forces(system, excitation, speed),
            outputs: terms::outputs(model, excitation, outputs.clone()),
            q: vec![Lanes::ZERO; system.order()],
        });
        Self {
            excitations: excitations.collect(),
            factors,
            arch: Arch::new(),
            stiffness,
            model,
            track,
            speed,
            outputs,
        }
    }

    /// Number of its outputs.
    pub fn outputs(&self) -> usize {
        self.outputs.len()
    }

    /// Power spectral densities of the outputs at frequencies `f` in Hz, one-sided, per Hz.
    pub fn densities(&mut self, f: &[f64; LANES], densities: &mut [[f64; LANES]]) {
        let arch = self.arch;
        arch.dispatch(Batch {
            response: self,
            f,
            densities,
        });
        if self.factors.sound != [true; LANES] {
            self.mend(f, densities);
        }
    }

    /// Goes over the frequencies at which the elimination lost digits.
    #[cold]
    fn mend(&self, f: &[f64; LANES], densities: &mut [[f64; LANES]]) {
        let mut plain = vec![0.0; self.model.outputs.len()];
        for l in (0..LANES).filter(|&l| !self.factors.sound[l]) {
            plain::densities(self.model, self.track, self.speed, f[l], &mut plain);
            for (density, value) in densities.iter_mut().zip(&plain[self.outputs.clone()]) {
                density[l] = *value;
            }
        }
    }
}

struct Batch<'r, 'a> {
    response: &'r mut Response<'a>,
    f: &'r [f64; LANES],
    densities: &'r mut [[f64; LANES]],
}

impl WithSimd for Batch<'_, '_> {
    type Output = ();

    #[allow(clippy::inline_always)] // Where the vector unit is known.
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Response {
            model,
            track,
            speed,
            stiffness,
            factors,
            excitations,
            ..
        } = self.response;
        let omega = self.f.map(|f| TAU * f);
        let s = Lanes {
            re: [0.0; LANES],
            im: omega,
        };
        stiffness.factor(s, factors);
        let phases = phases(&omega, &model.lags, *speed);
        self.densities.fill([0.0; LANES]);
        for (excited, excitation) in excitations.iter_mut().zip(&model.excitations) {
            let Excited { forces, outputs, q } = excited;
            q.fill(Lanes::ZERO);
            for force in forces.iter() {
                let transmitted = Lanes {
                    re: [force.k; LANES],
                    im: each(|l| omega[l] * force.c),
                };
                let q = &mut q[force.coordinate];
                *q = q.plus_product(transmitted, phases[force.wheelset]);
            }
            stiffness.solve(factors, q);
            // S in time frequency: S(Ω) dΩ/df with Ω = 2πf/V (3.4.2-5, 6).
            let spectrum = track.spectrum(excitation.irregularity);
            let input = omega.map(|omega| spectrum.density(omega / *speed) * TAU / *speed);
            for (density, output) in self.densities.iter_mut().zip(outputs.iter()) {
                let transfer = output.transfer(omega, |source| match source {
                    Source::Coordinate(i) => q[i],
                    Source::Wheelset(i) => phases[i],
                });
                let square = transfer.norm_sqr();
                let sum = *density;
                *density = each(|l| square[l].mul_add(input[l], sum[l]));
            }
        }
    }
}

/// e^{−iωτ} of the four wheelsets. Wheelset 4 is as far behind 3 as 2 behind 1.
#[allow(clippy::inline_always)] // Compiled into the caller, where the vector unit is known.
#[inline(always)]
fn phases(omega: &[f64; LANES], lags: &[f64; 4], speed: f64) -> [Lanes; 4] {
    let delayed = |lag: f64| {
        let mut phase = Lanes::ZERO;
        for l in 0..LANES {
            let (sin, cos) = (omega[l] * lag / speed).sin_cos();
            (phase.re[l], phase.im[l]) = (cos, -sin);
        }
        phase
    };
    let (wheelbase, trucks) = (delayed(lags[1] - lags[0]), delayed(lags[2] - lags[0]));
    let mut first = Lanes::ZERO;
    first.re = [1.0; LANES];
    [first, wheelbase, trucks, trucks.times(wheelbase)]
}
