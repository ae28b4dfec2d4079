//! Panels of integration over frequency, laid around the poles of a response.
//!
//! The poles of the integrand are those of the vehicle and the corners of the track's spectra.

use std::f64::consts::{PI, TAU};

use nalgebra::Complex;

use crate::{
    case::Case,
    dynamics::ForcedModel,
    numerics::{Poles, panels::panels},
};

/// Phase between first and last wheelset over half a panel, rad.
const PHASE: f64 = 10.0;

/// Edges of the panels in Hz, ascending, from one end of the case's band of frequencies to the
/// other.
pub fn response_panels(model: &ForcedModel, case: &Case, poles: &Poles) -> Vec<f64> {
    let speed = case.service.speed;
    // In complex frequency: s = 2πi z.
    let own = poles.values.iter().filter(|s| s.im >= 0.0);
    let mut poles: Vec<Complex<f64>> = own.map(|s| Complex::new(s.im, s.re.abs()) / TAU).collect();
    let mut kinks = Vec::new();
    for excitation in &model.excitations {
        let spectrum = case.service.track.spectrum(excitation.irregularity);
        let hertz = |wavenumber: f64| wavenumber * speed / TAU;
        poles.extend(spectrum.corners().map(|w| Complex::new(0.0, hertz(w))));
        kinks.extend(spectrum.kinks().map(hertz));
    }
    let lag = (model.lags[3] - model.lags[0]) / speed;
    panels(case.model.frequency_band, kinks, &poles, PHASE / (PI * lag))
}
