//! Spectra of the FRA track classes (3.4.2-2…4).

use super::{Spectrum, Track};
use crate::units::us::{FOOT, INCH};

/// Number of classes.
pub const FRA_CLASSES: usize = 6;

/// Ω_c = 2π/25 rad/ft, rad/m (3.4.2).
pub const CORNER_WAVENUMBER: f64 = std::f64::consts::TAU / (25.0 * FOOT);

/// A_v and A_a in in² rad/ft and Ω_s in rad/ft, by class 1…6.
///
/// Class 6 as the report prints it (0.00159, 0.1335). The others are the values in circulation
/// with these forms (A_v: D. Cantero, TTB-2D, quoting Berawi, Porto; A_a of classes 5 and 6:
/// also the OpenRailVehicleDynamics documentation), which all turn into four-decimal numbers in
/// inches and feet. Unconfirmed by a source at hand: A_a of classes 1–4 and Ω_s of classes 1–5.
const CLASSES: [[f64; 3]; FRA_CLASSES] = [
    [0.0572, 0.1589, 0.1843],
    [0.0481, 0.0572, 0.2837],
    [0.0322, 0.0195, 0.2597],
    [0.0254, 0.0143, 0.3448],
    [0.0099, 0.0036, 0.2502],
    [0.00159, 0.00159, 0.1335],
];

impl Track {
    /// Track of an FRA class, 1–6, in the report's form:
    ///
    /// ```math
    /// S_v = A_v Ω_c² / (Ω² (Ω² + Ω_c²))
    /// S_c = 4 A_v Ω_c² / ((Ω² + Ω_c²)(Ω² + Ω_s²))
    /// S_a = A_a Ω_c² / (Ω² (Ω² + Ω_c²))
    /// ```
    ///
    /// Later literature puts a factor k = 0.25 in front of all three; the report's published
    /// strokes agree with k = 1.
    pub fn fra_class(class: usize) -> Option<Self> {
        let [a_v, a_a, omega_s] = *CLASSES.get(class.checked_sub(1)?)?;
        let roughness = INCH * INCH / FOOT; // in² rad/ft → m² rad/m
        let mut track = Self::fra_form(
            a_v * roughness,
            a_a * roughness,
            CORNER_WAVENUMBER,
            omega_s / FOOT,
        );
        track.name = format!("fra-class-{class}");
        track.source = "FRA form without the factor 0.25 of later literature, as printed in the \
                        1981 FRA/MIT report (3.4.2-2…4)"
            .into();
        Some(track)
    }

    /// Track of the FRA form with parameters of one's own: A_v and A_a in m² rad/m, Ω_c and Ω_s
    /// in rad/m.
    pub fn fra_form(a_v: f64, a_a: f64, omega_c: f64, omega_s: f64) -> Self {
        let form = |gain: f64, corners: [f64; 2]| Spectrum::Rational {
            gain: gain * omega_c * omega_c,
            power: 0,
            corners: corners.to_vec(),
        };
        Self {
            name: String::new(),
            source: "FRA form (3.4.2-2…4) with parameters of the spec".into(),
            vertical: form(a_v, [0.0, omega_c]),
            alignment: form(a_a, [0.0, omega_c]),
            crosslevel: form(4.0 * a_v, [omega_c, omega_s]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The metric values of A_v, cm² rad/m, that public sources give (TTB-2D for all classes).
    #[test]
    fn roughness_agrees_with_its_metric_values() {
        let metric = [1.2107, 1.0181, 0.6816, 0.5376, 0.2095, 0.0339];
        for (class, a_v) in (1..).zip(metric) {
            let track = Track::fra_class(class).unwrap();
            // Far above the corner S_v → A_v Ω_c²/Ω⁴.
            let omega = 1e4;
            let a = track.vertical.density(omega) * omega.powi(4) / CORNER_WAVENUMBER.powi(2);
            // Class 6 is printed as 0.00159 by the report and as 0.0016 elsewhere: 0.7 %.
            let tolerance = if class == 6 { 0.01 } else { 1e-3 };
            assert!(
                (a * 1e4 / a_v - 1.0).abs() < tolerance,
                "class {class}: {a}"
            );
        }
    }

    #[test]
    fn only_six_classes() {
        assert!(Track::fra_class(0).is_none() && Track::fra_class(7).is_none());
        assert!(Track::names().all(|name| Track::named(&name).unwrap().name == name));
    }
}
