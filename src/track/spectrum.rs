//! Spectral densities of track irregularities in wavenumber.

use serde::Serialize;

/// One-sided spectral density S(Ω) for Ω > 0, m²/(rad/m): the mean square is ∫₀^∞ S dΩ.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub enum Spectrum {
    /// ```math
    /// S(Ω) = gain · Ω^{2p} / ∏ (Ω² + Ω_i²)
    /// ```
    ///
    /// Every published form in use here is of this kind.
    Rational {
        /// m² (rad/m)^(2n − 2p − 1) for n corners.
        gain: f64,
        /// p.
        power: i32,
        /// Ω_i, rad/m.
        corners: Vec<f64>,
    },
    /// Points (Ω in rad/m, S in m²/(rad/m)) in ascending order, straight lines between them on
    /// log–log axes, the end segments produced beyond them.
    Points(Vec<[f64; 2]>),
}

impl Spectrum {
    /// Corners, rad/m.
    pub fn corners(&self) -> impl Iterator<Item = f64> + '_ {
        let corners: &[f64] = match self {
            Self::Rational { corners, .. } => corners,
            Self::Points(_) => &[],
        };
        corners.iter().copied().filter(|corner| *corner > 0.0)
    }

    /// Wavenumbers at which its slope changes at once, rad/m.
    pub fn kinks(&self) -> impl Iterator<Item = f64> + '_ {
        let points: &[[f64; 2]] = match self {
            Self::Rational { .. } => &[],
            Self::Points(points) => points,
        };
        points.iter().map(|[omega, _]| *omega)
    }

    /// S at wavenumber `omega` in rad/m, m²/(rad/m).
    pub fn density(&self, omega: f64) -> f64 {
        match self {
            Self::Rational {
                gain,
                power,
                corners,
            } => {
                let omega2 = omega * omega;
                corners
                    .iter()
                    .fold(gain * omega2.powi(*power), |s, corner| {
                        s / (omega2 + corner * corner)
                    })
            }
            Self::Points(points) => {
                let i = points
                    .partition_point(|p| p[0] < omega)
                    .clamp(1, points.len() - 1);
                let [[w0, s0], [w1, s1]] = [points[i - 1], points[i]];
                let slope = (s1 / s0).ln() / (w1 / w0).ln();
                s0 * (omega / w0).powf(slope)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_follow_a_power_law_and_its_extension() {
        let law = |omega: f64| 3e-6 * omega.powf(-2.5);
        let points = [0.1, 0.4, 2.0].map(|omega| [omega, law(omega)]).to_vec();
        let spectrum = Spectrum::Points(points);
        for omega in [0.01, 0.1, 0.2, 0.4, 1.9, 2.0, 30.0] {
            assert!((spectrum.density(omega) / law(omega) - 1.0).abs() < 1e-12);
        }
    }
}
