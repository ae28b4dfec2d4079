//! Sperling's ride comfort index W_z.
//!
//! ```math
//! B_s = 0.588 √[(1.911 f² + (0.25 f²)²) / ((1 − 0.277 f²)² + (1.563 f − 0.0368 f³)²)]   vertical
//! B_w = 1.25 B_s                                                                       horizontal
//! W_z = (∫ 2 G(f) B² df)^{1/6.67},   G one-sided in (cm/s²)²/Hz
//! ```
//!
//! The 2 turns mean squares into squared amplitudes, in which the index was first defined. Forms
//! as in two public codes (comfpy; SimulinkMatlab). Here the integral runs over the band of the
//! random response.

/// B_s, vertical comfort.
pub fn vertical(f: f64) -> f64 {
    let f2 = f * f;
    let numerator = 1.911 * f2 + (0.25 * f2).powi(2);
    let denominator = (1.0 - 0.277 * f2).powi(2) + (1.563 * f - 0.0368 * f2 * f).powi(2);
    0.588 * (numerator / denominator).sqrt()
}

/// B_w, horizontal comfort.
pub fn horizontal(f: f64) -> f64 {
    0.737 / 0.588 * vertical(f)
}

/// W_z from the mean square of the weighted acceleration, ∫ G B² df with G in (m/s²)²/Hz.
pub fn w_z(weighted_mean_square: f64) -> f64 {
    /// (cm/s²)² in (m/s²)².
    const CM2: f64 = 1e4;
    (2.0 * weighted_mean_square * CM2).powf(1.0 / 6.67)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// For a sinusoid of amplitude a in cm/s² the index is Sperling's original (a² B²)^{1/6.67}.
    #[test]
    fn a_sinusoid_gives_the_original_index() {
        let (amplitude, f) = (20.0_f64, 1.2);
        let mean_square = (amplitude / 100.0).powi(2) / 2.0;
        let expected = (amplitude * amplitude * horizontal(f).powi(2)).powf(1.0 / 6.67);
        assert!((w_z(mean_square * horizontal(f).powi(2)) - expected).abs() < 1e-12);
    }

    /// People are most sensitive at 4–6 Hz; horizontal counts 1.25 times vertical.
    #[test]
    fn most_sensitive_near_five_hertz() {
        let peak = (1..300)
            .map(|i| f64::from(i) / 10.0)
            .max_by(|a, b| vertical(*a).total_cmp(&vertical(*b)));
        assert!((4.0..7.0).contains(&peak.unwrap()), "{peak:?}");
        assert!((horizontal(3.0) / vertical(3.0) - 1.25).abs() < 5e-3);
    }
}
