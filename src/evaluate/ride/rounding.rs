//! Resonances so lightly damped that rounding decides their height.
//!
//! The entries of the stored dynamic stiffness D are rounded. To first order, a pole s of it lies within
//!
//! ```math
//! δ = ε |w|ᵀ(|s|²M + |s||C| + |K|)|v| / |wᴴD′v|
//! ```
//!
//! of the exact pole, ε being the rounding of a number (Tisseur 2000, *Backward error and condition of
//! polynomial eigenvalue problems*, with the entries' own sizes as weights). Near the pole an output's
//! response to an irregularity of density S is R/(iω − s), with R = (output of v)(wᴴ force)/(wᴴD′v), and
//!
//! ```math
//! ∫ |R|² S/|iω − s|² df = |R|² S/(2 |Re s|)
//! ```
//!
//! is its contribution to the mean square, uncertain by the share δ/|Re s|.

use std::{f64::consts::TAU, ops::Range};

use nalgebra::{Complex, DMatrix, DVector};

use crate::{
    case::Case,
    dynamics::{Excitation, ForcedModel, Output, Row},
    evaluate::modes::Mode,
    numerics::{LinearSystem, Poles, damping_ratio, size},
};

/// Damping ratio above which rounding is neglected: δ would have to be 10⁶ ε|s| for a share of
/// [`UNCERTAIN_SHARE`].
const LIGHTLY_DAMPED: f64 = 1e-6;
/// Share of a mean square that rounding may decide: RMS values are then accurate to half of it.
const UNCERTAIN_SHARE: f64 = 1e-4;

/// True if rounding decides more than [`UNCERTAIN_SHARE`] of the mean square of any of some outputs of a
/// model; `total` gives the mean squares.
pub(super) fn decides(
    model: &ForcedModel,
    case: &Case,
    poles: &Poles,
    outputs: Range<usize>,
    total: impl Fn(usize) -> f64,
) -> bool {
    let [low, high] = case.model.frequency_band;
    let in_band = |s: &Complex<f64>| (low..=high).contains(&(s.im / TAU));
    let lightly_damped = |s: &Complex<f64>| damping_ratio(*s).abs() < LIGHTLY_DAMPED && in_band(s);
    let found = poles.values.iter().filter(|s| lightly_damped(s));
    let resonances = found.map(|s| Resonance::new(model, case.service.speed, *s));
    let mut uncertain = vec![0.0; outputs.len()];
    for resonance in resonances {
        let Some(resonance) = resonance else {
            return true;
        };
        for (sum, output) in uncertain.iter_mut().zip(&model.outputs[outputs.clone()]) {
            *sum += resonance.uncertain(model, case, output);
        }
    }
    let mut uncertain = uncertain.iter().enumerate();
    uncertain.any(|(k, sum)| *sum > UNCERTAIN_SHARE * total(k))
}

/// True if every growing mode grows by no more than rounding and is reached by a damper. A mode that no
/// damper reaches certainly does not decay.
pub(super) fn makes_grow(model: &ForcedModel, poles: &Poles) -> bool {
    let mut growing = poles.values.iter().filter(|s| s.re >= 0.0 && s.im >= 0.0);
    growing.all(|s| {
        let resonance = Resonance::new(model, poles.speed, *s);
        let by_rounding = |found: &Resonance| found.mode.eigenvalue.re <= found.rounding;
        s.im > 0.0 && resonance.is_some_and(|found| by_rounding(&found) && found.is_damped())
    })
}

/// A lightly damped pole with its rounding error.
struct Resonance {
    mode: Mode,
    /// wᴴD′v.
    weight: Complex<f64>,
    damping: DMatrix<f64>,
    /// δ, rad/s.
    rounding: f64,
}

impl Resonance {
    /// Resonance of a model at `speed`, m/s, at a pole. `None` if its vectors are not finite.
    fn new(model: &ForcedModel, speed: f64, s: Complex<f64>) -> Option<Self> {
        let system = &model.system;
        let damping = system.damping_at(speed);
        let mut mode = Mode::at(system, &damping, s)?;
        let slope = system.stiffness_derivative_times(&damping, s, &mode.shape);
        let weight = mode.left.dotc(&slope);
        // The eigenvalue itself comes from an iteration that rounds by more: δ stays after a Newton step.
        let stiffness = system.dynamic_stiffness(&damping, s);
        mode.eigenvalue -= mode.left.dotc(&(stiffness * &mode.shape)) / weight;
        let rounding = f64::EPSILON * sizes(system, &damping, &mode) / size(weight);
        rounding.is_finite().then_some(Self {
            mode,
            weight,
            damping,
            rounding,
        })
    }

    /// True if a damper reaches it.
    fn is_damped(&self) -> bool {
        let (left, shape) = (&self.mode.left, &self.mode.shape);
        let n = shape.len();
        let pairs = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        pairs
            .into_iter()
            .any(|(i, j)| size(left[i]) * size(shape[j]) * self.damping[(i, j)].abs() > 0.0)
    }

    /// Part of an output's mean square that rounding decides.
    fn uncertain(&self, model: &ForcedModel, case: &Case, output: &Output) -> f64 {
        let (s, speed) = (self.mode.eigenvalue, case.service.speed);
        let seen = seen(output, s, &self.mode.shape);
        let squares = model.excitations.iter().map(|excitation| {
            let transfer = seen * self.excited(model, excitation, speed) / self.weight;
            let spectrum = case.service.track.spectrum(excitation.irregularity);
            transfer.norm_sqr() * spectrum.density(s.im / speed) * TAU / speed
        });
        let square = squares.sum::<f64>();
        if square > 0.0 && self.rounding >= s.re.abs() {
            // There may be no damping at all.
            return f64::INFINITY;
        }
        square / (2.0 * s.re.abs()) * (self.rounding / s.re.abs())
    }

    /// wᴴ force of an excitation with the irregularity one.
    fn excited(&self, model: &ForcedModel, excitation: &Excitation, speed: f64) -> Complex<f64> {
        let (system, s) = (&model.system, self.mode.eigenvalue);
        let inputs = excitation.inputs.iter().zip(&model.lags);
        let forces = inputs.map(|(&j, lag)| {
            let u = Complex::from_polar(excitation.scale, -s.im * lag / speed);
            let rows = 0..system.order();
            let force = rows.map(|i| {
                let transmitted = s * self.damping[(i, j)] + system.stiffness[(i, j)];
                self.mode.left[i].conj() * transmitted
            });
            -u * force.sum::<Complex<f64>>()
        });
        forces.sum()
    }
}

/// |w|ᵀ(|s|²M + |s||C| + |K|)|v|.
fn sizes(system: &LinearSystem, damping: &DMatrix<f64>, mode: &Mode) -> f64 {
    let (n, s) = (system.order(), size(mode.eigenvalue));
    let row = |i: usize| -> f64 {
        let inertia = s * s * system.mass[i] * size(mode.shape[i]);
        let terms = (0..n).map(|j| {
            let entry = s * damping[(i, j)].abs() + system.stiffness[(i, j)].abs();
            entry * size(mode.shape[j])
        });
        inertia + terms.sum::<f64>()
    };
    (0..n).map(|i| size(mode.left[i]) * row(i)).sum()
}

/// An output of a shape that goes with e^{st}.
fn seen(output: &Output, s: Complex<f64>, shape: &DVector<Complex<f64>>) -> Complex<f64> {
    let of = |row: &Row| -> Complex<f64> {
        let terms = row.terms().iter().filter(|(i, _)| *i < shape.len());
        terms.map(|&(i, c)| shape[i] * c).sum()
    };
    of(&output.displacement) + of(&output.velocity) * s + of(&output.acceleration) * s * s
}
