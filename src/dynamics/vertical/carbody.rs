//! The flexible carbody: rigid motion, first bending and two torsion modes.
//!
//! ```math
//! w(x, y) = z_c − x θ_c + y φ_c + B(x) u_b + y [T1(x) u_1 + T2(x) u_2]
//! ```
//!
//! All shapes have unit mean square over the length, so the modal masses of a uniform body are
//! M_c, I_cx, I_cx. The report does not state its own.

use std::f64::consts::{PI, SQRT_2};

use super::Builder;
use crate::dynamics::{LinearSystem, Row};

/// βL of the first free–free bending mode: the first root of cos βL cosh βL = 1.
const BETA_L: f64 = 4.730_040_744_862_704;

/// First free–free bending mode of a uniform beam at ξ = x/l_c from mid-length.
///
/// ```math
/// B = cosh(βL ξ)/cosh(βL/2) + cos(βL ξ)/cos(βL/2)
/// ```
fn bending_shape(xi: f64) -> f64 {
    (BETA_L * xi).cosh() / (BETA_L / 2.0).cosh() + (BETA_L * xi).cos() / (BETA_L / 2.0).cos()
}

/// T1 = √2 sin(πξ), first torsion mode of a uniform shaft.
fn torsion_1_shape(xi: f64) -> f64 {
    SQRT_2 * (PI * xi).sin()
}

/// T2 = √2 cos(2πξ), second torsion mode.
fn torsion_2_shape(xi: f64) -> f64 {
    SQRT_2 * (2.0 * PI * xi).cos()
}

impl Builder<'_> {
    /// w(x, y), height of a carbody point.
    pub(super) fn carbody_point(&self, x: f64, y: f64) -> Row {
        let xi = x / self.vehicle.carbody.length;
        let shapes = [
            1.0,
            y,
            -x,
            bending_shape(xi),
            y * torsion_1_shape(xi),
            y * torsion_2_shape(xi),
        ];
        shapes
            .into_iter()
            .enumerate()
            .map(|(index, shape)| shape * Row::unit(index))
            .fold(Row::default(), |sum, term| sum + term)
    }

    /// ∂w/∂y, roll of the carbody with its torsion at a station.
    pub(in crate::dynamics) fn carbody_roll(&self, x: f64) -> Row {
        let xi = x / self.vehicle.carbody.length;
        Row::unit(1) + torsion_1_shape(xi) * Row::unit(4) + torsion_2_shape(xi) * Row::unit(5)
    }

    pub(super) fn add_flexible_modes(&self, system: &mut LinearSystem) {
        let carbody = &self.vehicle.carbody;
        let modes = [carbody.bending, carbody.torsion_1, carbody.torsion_2];
        for (index, mode) in (3..).zip(modes) {
            let (m, omega) = (system.mass[index], mode.angular_frequency());
            let u = Row::unit(index);
            system.add_element(
                &u,
                &u,
                m * omega * omega,
                2.0 * mode.damping_ratio * omega * m,
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mean(f: impl Fn(f64) -> f64) -> f64 {
        let n = 20_000;
        (0..n)
            .map(|i| f((f64::from(i) + 0.5) / f64::from(n) - 0.5))
            .sum::<f64>()
            / f64::from(n)
    }

    #[test]
    fn shapes_have_unit_mean_square_and_no_rigid_part() {
        for shape in [bending_shape, torsion_1_shape, torsion_2_shape] {
            // Midpoint rule with 20,000 steps: 1e-8.
            assert!((mean(|xi| shape(xi).powi(2)) - 1.0).abs() < 1e-7);
            assert!(mean(shape).abs() < 1e-7);
        }
        assert!(mean(|xi| xi * bending_shape(xi)).abs() < 1e-12);
        assert!((BETA_L.cos() * BETA_L.cosh() - 1.0).abs() < 1e-12);
    }
}
