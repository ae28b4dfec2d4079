//! Panels of integration over frequency, laid where the response calls for them.
//!
//! The error of a Gauss rule on a panel falls with the size of the ellipse around it, foci at its
//! ends, within which the integrand has no pole (Davis, Rabinowitz: *Methods of Numerical
//! Integration*, 1984, section 4.6). The poles are known: the vehicle's, and the corners of the
//! track's spectra. Each panel is made as wide as they allow.

use std::f64::consts::{PI, TAU};

use nalgebra::Complex;

use super::mode::size;
use crate::{
    case::Case,
    dynamics::{ForcedModel, Poles},
};

/// Sum of the distances of a pole from the two ends of a panel, at least, over its width: half the
/// sum of the ellipse's axes is then 1.78 times half the panel. It leaves an error of 1e-7 or less.
const CLEARANCE: f64 = 1.17;
/// Ratio of the ends of a panel.
const RATIO: f64 = 4.0;
/// Phase between first and last wheelset over half a panel, rad.
const PHASE: f64 = 10.0;
/// A rest of the range that is this share of the last panel goes to it: it leaves the error as it is.
const REST: f64 = 1e-3;
/// Width of the narrowest panel over its frequency: some ten nodes apart are told apart there. Towards a
/// pole that lies straight ahead each panel leaves a twelfth of the distance, so that this takes fourteen.
/// A peak this narrow is one that rounding decides ([`super::rounding`]).
const NARROWEST: f64 = 1e-14;
/// Edges closer than this to the start of the band, as a share of it, are left out.
const START: f64 = 1e-3;

/// Edges of the panels in Hz, ascending, from one end of the case's band of frequencies to the
/// other.
pub fn panels(model: &ForcedModel, case: &Case, poles: &Poles) -> Vec<f64> {
    let [low, high] = case.model.frequency_band;
    let speed = case.service.speed;
    // In complex frequency: s = 2πi z.
    let own = poles.values.iter().filter(|s| s.im >= 0.0);
    let mut poles: Vec<Complex<f64>> = own.map(|s| Complex::new(s.im, s.re.abs()) / TAU).collect();
    let mut kinks = vec![high];
    for excitation in &model.excitations {
        let spectrum = case.service.track.spectrum(excitation.irregularity);
        let hertz = |wavenumber: f64| wavenumber * speed / TAU;
        poles.extend(spectrum.corners().map(|w| Complex::new(0.0, hertz(w))));
        kinks.extend(spectrum.kinks().map(hertz));
    }
    kinks.retain(|f| (low * (1.0 + START)..=high).contains(f));
    kinks.sort_by(f64::total_cmp);
    let lag = (model.lags[3] - model.lags[0]) / speed;
    let mut edges = vec![low];
    let mut at = low;
    for kink in kinks {
        while at < kink {
            let mut next = (at * RATIO).min(at + PHASE / (PI * lag));
            for z in &poles {
                let to = z - at;
                let width = 2.0 * (CLEARANCE * size(to) - to.re) / (CLEARANCE * CLEARANCE - 1.0);
                next = next.min(at + width);
            }
            // An undamped pole on the axis would stop the walk.
            next = next.max(at * (1.0 + NARROWEST));
            if kink - next < REST * (next - at) {
                next = kink;
            }
            edges.push(next);
            at = next;
        }
    }
    edges
}

/// Panels that end at further edges, Hz, too.
pub fn divided(mut panels: Vec<f64>, further: &[f64]) -> Vec<f64> {
    panels.extend(further);
    panels.sort_by(f64::total_cmp);
    panels.dedup();
    panels
}
