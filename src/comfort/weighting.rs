//! Frequency weightings of ISO 2631-1 (W_k, W_d) and EN 12299 (W_b).
//!
//! ```math
//! H(s) = s²/(s² + ω1 s/Q1 + ω1²) · ω2²/(s² + ω2 s/Q1 + ω2²)             band limits
//!      · (1 + s/ω3)/(1 + s/(Q4 ω4) + (s/ω4)²)                            acceleration to velocity
//!      · (1 + s/(Q5 ω5) + (s/ω5)²)/(1 + s/(Q6 ω6) + (s/ω6)²) · (ω5/ω6)²  upward step
//!      · K
//! ```
//!
//! Parameters: ISO 8041 as tabulated in the Larson Davis HVM200 manual, Table 3.1; the EN 12299
//! form of W_b as in two public codes (comfpy; SimulinkMatlab).

use num_complex::Complex64;

/// A weighting filter: frequencies in Hz.
struct Filter {
    /// Transition: f3, f4, Q4.
    transition: [f64; 3],
    /// Step: f5, Q5, f6, Q6.
    step: Option<[f64; 4]>,
    /// K.
    gain: f64,
}

/// Band limits f1, f2, Hz, and their Q.
const BAND: [f64; 2] = [0.4, 100.0];
const BAND_Q: f64 = std::f64::consts::FRAC_1_SQRT_2;

const W_K: Filter = Filter {
    transition: [12.5, 12.5, 0.63],
    step: Some([2.37, 0.91, 3.35, 0.91]),
    gain: 1.0,
};

const W_D: Filter = Filter {
    transition: [2.0, 2.0, 0.63],
    step: None,
    gain: 1.0,
};

/// EN 12299 writes the step without (f5/f6)² and K = 0.4.
const W_B: Filter = Filter {
    transition: [16.0, 16.0, 0.63],
    step: Some([2.5, 0.8, 4.0, 0.8]),
    gain: 0.4 * (4.0 / 2.5) * (4.0 / 2.5),
};

impl Filter {
    /// |H(i2πf)|; with all frequencies in Hz, s/ω is i f/f_k.
    fn magnitude(&self, f: f64) -> f64 {
        let s = |corner: f64| Complex64::new(0.0, f / corner);
        let second = |s: Complex64, q: f64| 1.0 + s / q + s * s;
        let high_pass = s(BAND[0]) * s(BAND[0]) / second(s(BAND[0]), BAND_Q);
        let low_pass = 1.0 / second(s(BAND[1]), BAND_Q);
        let [f3, f4, q4] = self.transition;
        let transition = (1.0 + s(f3)) / second(s(f4), q4);
        let step = self.step.map_or(Complex64::ONE, |[f5, q5, f6, q6]| {
            second(s(f5), q5) / second(s(f6), q6) * (f5 / f6).powi(2)
        });
        (high_pass * low_pass * transition * step).norm() * self.gain
    }
}

/// W_k, vertical, ISO 2631-1.
pub fn w_k(f: f64) -> f64 {
    W_K.magnitude(f)
}

/// W_d, horizontal, ISO 2631-1 and EN 12299.
pub fn w_d(f: f64) -> f64 {
    W_D.magnitude(f)
}

/// W_b, vertical, EN 12299 (not that of ISO 8041, from which it differs by up to 13 %).
pub fn w_b(f: f64) -> f64 {
    W_B.magnitude(f)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Magnitudes at exact one-third-octave centres, by nominal frequency: W_k, W_d, W_b; computed
    /// from the same tables with another program, so the last printed digit holds.
    const TABLE: [(f64, f64, f64, f64); 22] = [
        (-4., 0.3504, 0.7097, 0.2807),
        (-3., 0.4188, 0.8540, 0.3359),
        (-1., 0.4767, 0.9914, 0.3843),
        (0., 0.4825, 1.0110, 0.3911),
        (1., 0.4846, 1.0071, 0.3958),
        (2., 0.4935, 0.9707, 0.4063),
        (3., 0.5308, 0.8913, 0.4362),
        (4., 0.6335, 0.7733, 0.5094),
        (5., 0.8071, 0.6398, 0.6453),
        (6., 0.9648, 0.5143, 0.8183),
        (7., 1.0392, 0.4081, 0.9581),
        (8., 1.0544, 0.3226, 1.0312),
        (9., 1.0374, 0.2550, 1.0557),
        (10., 0.9884, 0.2017, 1.0484),
        (11., 0.8989, 0.1597, 1.0072),
        (12., 0.7743, 0.1266, 0.9227),
        (13., 0.6373, 0.1004, 0.7993),
        (14., 0.5103, 0.0796, 0.6602),
        (15., 0.4031, 0.0630, 0.5288),
        (16., 0.3160, 0.0496, 0.4163),
        (18., 0.1857, 0.0295, 0.2445),
        (19., 0.1339, 0.0213, 0.1760),
    ];

    #[test]
    fn magnitudes_agree_with_the_published_filters() {
        for (band, k, d, b) in TABLE {
            let f = 10_f64.powf(band / 10.0);
            for (value, tabulated) in [(w_k(f), k), (w_d(f), d), (w_b(f), b)] {
                assert!(
                    (value - tabulated).abs() < 6e-5,
                    "{f} Hz: {value} {tabulated}"
                );
            }
        }
    }
}
