//! The plain response: a dense pivoted factorisation, one frequency at a time. The elimination is tested
//! against it, and steps aside for it at frequencies at which it loses digits.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix};

use crate::{
    dynamics::{ForcedModel, Row},
    track::Track,
};

/// Power spectral densities of all outputs at frequency `f` in Hz, one-sided, per Hz. NaN where
/// the dynamic stiffness is singular.
pub fn densities(model: &ForcedModel, track: &Track, speed: f64, f: f64, densities: &mut [f64]) {
    let system = &model.system;
    let (n, omega) = (system.order(), TAU * f);
    let damping = system.damping_at(speed);
    let stiffness = system.dynamic_stiffness(&damping, Complex::new(0.0, omega));
    let forced =
        |i: usize, j: usize| Complex::new(system.stiffness[(i, j)], omega * damping[(i, j)]);
    let lu = stiffness.lu();
    densities.fill(0.0);
    for excitation in &model.excitations {
        let mut u = vec![Complex::ZERO; system.inputs];
        for (&input, &lag) in excitation.inputs.iter().zip(&model.lags) {
            u[input - n] = Complex::from_polar(excitation.scale, -omega * lag / speed);
        }
        let force = DMatrix::from_fn(n, 1, |i, _| {
            let inputs = u.iter().enumerate();
            -inputs
                .map(|(j, u)| forced(i, n + j) * u)
                .sum::<Complex<f64>>()
        });
        let Some(q) = lu.solve(&force) else {
            densities.fill(f64::NAN);
            return;
        };
        let sum = |row: &Row| -> Complex<f64> {
            let terms = row.terms().iter();
            terms
                .map(|&(i, c)| if i < n { q[i] } else { u[i - n] } * c)
                .sum()
        };
        let irregularity = track.spectrum(excitation.irregularity);
        let input = irregularity.density(omega / speed) * TAU / speed;
        for (density, output) in densities.iter_mut().zip(&model.outputs) {
            let transfer = sum(&output.displacement)
                + sum(&output.velocity) * Complex::new(0.0, omega)
                - sum(&output.acceleration) * (omega * omega);
            *density += transfer.norm_sqr() * input;
        }
    }
}
