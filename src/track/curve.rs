//! Curves of constant radius: degree of curve, cant deficiency, the FRA speed limit.

use crate::units::{
    GRAVITY,
    us::{FOOT, INCH, MILE},
};

/// Chord that subtends the degree of curve, m: 100 ft (A-8).
const CHORD: f64 = 100.0 * FOOT;

/// Tightest curve that is searched, degrees: beyond it no railway passenger vehicle runs.
pub const MAX_DEGREE: f64 = 25.0;

/// Rail spacing over which superelevation is measured, m: 56 in, which turns the report's 6 in into
/// its 6.14° (3.2.3) and 3 in into its 3.07° (4.5.2).
pub const SUPERELEVATION_BASE: f64 = 56.0 * INCH;

/// A curve of constant radius with constant superelevation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curve {
    /// D, degrees.
    pub degree: f64,
    /// Superelevation angle φ_se, rad.
    pub superelevation: f64,
}

impl Curve {
    /// Curvature 1/R, 1/m.
    pub fn curvature(&self) -> f64 {
        curvature_of_degree(self.degree)
    }

    /// Cant deficiency at `speed` (m/s), rad (3.2-1).
    pub fn cant_deficiency(&self, speed: f64) -> f64 {
        cant_deficiency(speed, self.curvature(), self.superelevation)
    }
}

/// Cant deficiency, rad (3.2-1): positive where the vehicle runs faster than balance.
///
/// ```math
/// φ_d = V²/(R g) − φ_se
/// ```
///
/// V in m/s, curvature 1/R in 1/m, superelevation in rad.
pub fn cant_deficiency(speed: f64, curvature: f64, superelevation: f64) -> f64 {
    speed * speed * curvature / GRAVITY - superelevation
}

/// 1/R in 1/m of a curve of D degrees (A-8): R = 50 ft / sin(D/2).
pub fn curvature_of_degree(degree: f64) -> f64 {
    2.0 * (degree.to_radians() / 2.0).sin() / CHORD
}

/// dκ/dD of a curve of D degrees, 1/m per degree.
pub fn curvature_per_degree(degree: f64) -> f64 {
    (degree.to_radians() / 2.0).cos().to_radians() / CHORD
}

/// D in degrees of a curvature 1/R in 1/m (A-8): D = 2 asin(50 ft / R).
pub fn degree_of_curvature(curvature: f64) -> f64 {
    2.0 * (curvature * CHORD / 2.0).asin().to_degrees()
}

/// FRA speed limit, m/s (3.2-2; 49 CFR 213.57 for 3 in of cant deficiency).
///
/// ```math
/// V_max = √((E_a + E_u) / (0.0007 D))   mph, inches, degrees
/// ```
///
/// `superelevation` E_a and `unbalance` E_u as heights in m, `degree` in degrees.
pub fn fra_speed_limit(superelevation: f64, unbalance: f64, degree: f64) -> f64 {
    let inches = (superelevation + unbalance) / INCH;
    (inches / (0.0007 * degree)).sqrt() * MILE / 3600.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 49 CFR 213 Appendix A, 3 in of unbalance: mph for E_a = 0…6 in.
    #[test]
    fn speed_limit_is_the_published_table() {
        let table: [(f64, [f64; 7]); 8] = [
            (0.5, [93., 107., 120., 131., 141., 151., 160.]),
            (1.0, [65., 76., 85., 93., 100., 107., 113.]),
            (1.5, [53., 62., 69., 76., 82., 87., 93.]),
            (2.0, [46., 53., 60., 65., 71., 76., 80.]),
            (3.0, [38., 44., 49., 53., 58., 62., 65.]),
            (5.0, [29., 34., 38., 41., 45., 48., 51.]),
            (10.0, [21., 24., 27., 29., 32., 34., 36.]),
            (12.0, [19., 22., 24., 27., 29., 31., 33.]),
        ];
        for (degree, speeds) in table {
            for (inches, published) in (0..).zip(speeds) {
                let v =
                    fra_speed_limit(f64::from(inches) * INCH, 3.0 * INCH, degree) * 3600.0 / MILE;
                // Whole mph; a few entries are truncated where others are rounded.
                assert!(
                    (v - published).abs() < 0.56,
                    "{degree}° {inches} in: {v} {published}"
                );
            }
        }
    }

    #[test]
    fn degree_and_curvature_are_inverse() {
        for degree in [1e-6, 0.5, 3.0, 12.0, MAX_DEGREE] {
            assert!((degree_of_curvature(curvature_of_degree(degree)) - degree).abs() < 1e-12);
        }
        // (A-9): R ≈ 5730 ft / D, good to 0.2 % below 10°.
        assert!((curvature_of_degree(1.0) * 5730.0 * FOOT - 1.0).abs() < 2e-4);
    }

    #[test]
    fn no_deficiency_at_balance() {
        let curve = Curve {
            degree: 2.0,
            superelevation: 0.1,
        };
        let balance = (0.1 * GRAVITY / curve.curvature()).sqrt();
        assert!(curve.cant_deficiency(balance).abs() < 1e-15);
        assert!(curve.cant_deficiency(balance * 1.1) > 0.0);
    }
}
