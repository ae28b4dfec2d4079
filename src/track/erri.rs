//! Spectra of ERRI (ORE) B176, also known as the German low and high disturbance spectra.

use super::{Spectrum, Track};

/// Ω_c, Ω_r, Ω_s, rad/m.
const CORNERS: [f64; 3] = [0.8246, 0.0206, 0.4380];

impl Track {
    /// ERRI B176 low level: A_v = 4.032e-7, A_a = 2.119e-7 m rad.
    pub fn erri_low() -> Self {
        erri("erri-b176-low", 4.032e-7, 2.119e-7)
    }

    /// ERRI B176 high level: A_v = 1.080e-6, A_a = 6.125e-7 m rad.
    pub fn erri_high() -> Self {
        erri("erri-b176-high", 1.080e-6, 6.125e-7)
    }
}

/// ```math
/// S_v = A_v Ω_c² / ((Ω² + Ω_r²)(Ω² + Ω_c²)),  S_a likewise with A_a
/// S_φ = A_v b⁻² Ω_c² Ω² / ((Ω² + Ω_r²)(Ω² + Ω_c²)(Ω² + Ω_s²)),  b = 0.75 m
/// ```
///
/// The crosslevel spectrum is published as an angle; as a height difference over 2b it is 4b² S_φ.
/// One-sided: GENSYS, SIMPACK and OpenRailVehicleDynamics agree on the level.
fn erri(name: &str, a_v: f64, a_a: f64) -> Track {
    let [c, r, s] = CORNERS;
    let profile = |a: f64| Spectrum::Rational {
        gain: a * c * c,
        power: 0,
        corners: vec![r, c],
    };
    Track {
        name: name.into(),
        source: "ERRI B176 as published by SIMPACK and GENSYS".into(),
        vertical: profile(a_v),
        alignment: profile(a_a),
        crosslevel: Spectrum::Rational {
            gain: 4.0 * a_v * c * c,
            power: 1,
            corners: vec![r, c, s],
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// GENSYS tabulates "ORE B176 high level" against cyclic wavenumber n: 2π S(2πn), m²/(1/m).
    #[test]
    fn high_level_agrees_with_gensys() {
        let track = Track::erri_high();
        let cyclic = |s: &Spectrum, n: f64| {
            let tau = std::f64::consts::TAU;
            tau * s.density(tau * n)
        };
        for (n, lateral, vertical) in [
            (0.003_18, 4.6657e-3, 8.2268e-3),
            (0.02, 2.3194e-4, 4.0897e-4),
        ] {
            // Its first wavenumber is rounded to three figures: 0.1 %.
            assert!((cyclic(&track.alignment, n) / lateral - 1.0).abs() < 2e-3);
            assert!((cyclic(&track.vertical, n) / vertical - 1.0).abs() < 2e-3);
        }
    }
}
