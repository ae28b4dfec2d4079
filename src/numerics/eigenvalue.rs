//! Eigenvalues s of a second-order system: frequency, damping ratio, and slope over the speed.

use std::f64::consts::TAU;

use nalgebra::Complex;

/// Modulus |s|, without the scaling that numbers near the ends of the range would need.
#[inline]
pub fn size(s: Complex<f64>) -> f64 {
    s.norm_sqr().sqrt()
}

/// Frequency |s|/2π in Hz of an eigenvalue.
#[inline]
pub fn frequency(s: Complex<f64>) -> f64 {
    size(s) / TAU
}

/// Damping ratio −Re s/|s| of an eigenvalue.
#[inline]
pub fn damping_ratio(s: Complex<f64>) -> f64 {
    -s.re / size(s)
}

/// Change of the damping ratio with that of the eigenvalue.
#[inline]
pub fn damping_ratio_change(s: Complex<f64>, change: Complex<f64>) -> f64 {
    let size = size(s);
    let growth = (s.re * change.re + s.im * change.im) / size;
    (s.re * growth / size - change.re) / size
}

/// An eigenvalue and its slope at a speed.
#[derive(Debug, Clone, Copy)]
pub struct Eigenvalue {
    /// V, m/s.
    pub speed: f64,
    /// s, rad/s.
    pub s: Complex<f64>,
    /// ds/d ln V, rad/s.
    pub slope: Complex<f64>,
}

impl Eigenvalue {
    /// Extrapolation of s by `h` in ln V: to first order, or to second order with the slope at a speed
    /// `before`. Of ln s rather than s, because an eigenvalue proportional to V is then exact.
    pub fn expected(&self, h: f64, before: Option<&Self>) -> Complex<f64> {
        let rate = self.slope / self.s;
        let bend = before.map_or(Complex::ZERO, |before| {
            (rate - before.slope / before.s) / (self.speed / before.speed).ln()
        });
        self.s * (rate * h + bend * (h * h / 2.0)).exp()
    }
}
