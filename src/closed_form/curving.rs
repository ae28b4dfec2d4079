//! Simplified steady curving (4.5.2, Appendix A): conical wheels, no secondary yaw torque, no spin
//! creep, one creep coefficient f.
//!
//! A truck is then two wheelsets joined by a shear stiffness K_s and a bending stiffness K_b. With
//! y measured from the pure rolling line y_0 and ψ from the radial line, under a flanging force
//! F_f on the leading wheelset and a centre-pin load F_c (both outward on their body):
//!
//! ```math
//! [ −K_s           bK_s + 2f     K_s            bK_s       ] [y_1]   [F_f − F_c/2]
//! [ bK_s − 2fλa/r0 −b²K_s − K_b  −bK_s          −b²K_s + K_b] [ψ_1] = [−2bK_b/R   ]
//! [ K_s            −bK_s         −K_s           −bK_s + 2f ] [y_2]   [−F_c/2     ]
//! [ bK_s           −b²K_s + K_b  −bK_s − 2fλa/r0 −b²K_s − K_b] [ψ_2]   [2bK_b/R    ]
//! ```

use crate::{track::degree_of_curvature, vehicle::Vehicle, wheel_rail::Contact};

/// Distance of the pure rolling line outside the track centre line, m (4.5-1), for curvature 1/R.
///
/// ```math
/// y_0 = a r0/(λ R)
/// ```
pub fn pure_rolling_line(vehicle: &Vehicle, conicity: f64, curvature: f64) -> f64 {
    let w = &vehicle.wheelset;
    w.half_contact_distance * w.rolling_radius / conicity * curvature
}

/// Excursion of a rigid truck's wheelsets from the track centre line, m (4.5-4).
///
/// ```math
/// y = (a r0/(λR)) (1 + b²/a²)
/// ```
pub fn rigid_truck_excursion(vehicle: &Vehicle, conicity: f64, curvature: f64) -> f64 {
    let ratio = vehicle.truck.half_wheelbase / vehicle.wheelset.half_contact_distance;
    pure_rolling_line(vehicle, conicity, curvature) * (1.0 + ratio * ratio)
}

/// The simplified truck.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SimpleTruck {
    /// a, m.
    pub a: f64,
    /// b, m.
    pub b: f64,
    /// r0, m.
    pub r0: f64,
    /// λ.
    pub conicity: f64,
    /// f, N: the mean of f11 and f33, which the simplification takes as equal (A-3).
    pub f: f64,
    /// K_b, N m/rad (A-2, 4.5-7).
    pub bending_stiffness: f64,
    /// K_s, N/m (A-1, 4.5-8).
    pub shear_stiffness: f64,
}

/// Where the wheelsets of the simplified truck stand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wheelsets {
    /// y_1, y_2 from the pure rolling line, m, outward positive.
    pub lateral: [f64; 2],
    /// ψ_1, ψ_2 from the radial line, rad.
    pub yaw: [f64; 2],
}

impl SimpleTruck {
    /// The simplified truck of a vehicle.
    pub fn new(vehicle: &Vehicle, contact: &Contact) -> Self {
        let b = vehicle.truck.half_wheelbase;
        let k_b = vehicle.bending_stiffness();
        let k_py = vehicle.suspension.primary.lateral_stiffness;
        Self {
            a: vehicle.wheelset.half_contact_distance,
            b,
            r0: vehicle.wheelset.rolling_radius,
            conicity: contact.conicity,
            f: f64::midpoint(contact.f11, contact.f33),
            bending_stiffness: k_b,
            shear_stiffness: k_b * k_py / (b * b * k_py + k_b),
        }
    }

    /// λa/r0, the steering of a wheelset out of the rolling line.
    fn steering(&self) -> f64 {
        self.conicity * self.a / self.r0
    }

    /// Wheelsets in a curve 1/R under F_f and F_c, N (A-5…7, with forces A-15…17).
    pub fn wheelsets(
        &self,
        curvature: f64,
        flanging_force: f64,
        centre_pin_load: f64,
    ) -> Wheelsets {
        let Self {
            b,
            f,
            bending_stiffness: k_b,
            shear_stiffness: k_s,
            ..
        } = *self;
        let (s, f_f, f_c) = (self.steering(), flanging_force, centre_pin_load);
        let y_1 = (b * curvature * (b * k_s * k_b / s + k_b * f)
            - f_f / (4.0 * f) * self.flange_coefficient()
            + f_c / (4.0 * f) * self.pin_coefficient())
            / (k_s * k_b + f * f * s);
        let denominator = k_s * b + f * s;
        let psi_1 = (k_s * s * y_1 - f_f / (4.0 * f) * (k_s * b * s - 2.0 * f * s - 2.0 * k_s * b)
            + f_c / (4.0 * f) * (k_s * b * s - f * s - k_s * b))
            / denominator;
        let y_2 =
            ((k_s * b - f * s) * y_1 - (f_f - f_c) / (4.0 * f) * 2.0 * k_s * b * b) / denominator;
        Wheelsets {
            lateral: [y_1, y_2],
            yaw: [psi_1, -psi_1 + (f_f - f_c) / (2.0 * f)],
        }
    }

    /// b²fK_s + K_b f + bK_sK_b (r0/(λa) − 1).
    fn flange_coefficient(&self) -> f64 {
        let Self {
            b,
            f,
            bending_stiffness: k_b,
            shear_stiffness: k_s,
            ..
        } = *self;
        b * b * f * k_s + k_b * f + b * k_s * k_b * (1.0 / self.steering() - 1.0)
    }

    /// b²fK_s − bK_sK_b.
    fn pin_coefficient(&self) -> f64 {
        let Self {
            b,
            f,
            bending_stiffness: k_b,
            shear_stiffness: k_s,
            ..
        } = *self;
        b * b * f * k_s - b * k_s * k_b
    }

    /// b²K_sK_b r0/(λa) + bK_bf + (a r0/λ)K_bK_s + f²a²: excursion per curvature, over
    /// K_bK_s + f²λa/r0.
    fn excursion_coefficient(&self) -> f64 {
        let Self {
            a,
            b,
            f,
            bending_stiffness: k_b,
            shear_stiffness: k_s,
            ..
        } = *self;
        b * b * k_s * k_b / self.steering()
            + b * k_b * f
            + a * self.r0 / self.conicity * k_b * k_s
            + f * f * a * a
    }

    /// Flange-limited curve in degrees for clearance y_fc, m, under F_f and F_c, N (A-11 = 4.5-5,
    /// with forces A-18). The exact (A-8) turns curvature into degrees, where the report has 5730/R.
    pub fn flange_limit(&self, clearance: f64, flanging_force: f64, centre_pin_load: f64) -> f64 {
        let Self {
            f,
            bending_stiffness: k_b,
            shear_stiffness: k_s,
            ..
        } = *self;
        let available = clearance * (k_b * k_s + f * f * self.steering())
            + flanging_force / (4.0 * f) * self.flange_coefficient()
            - centre_pin_load / (4.0 * f) * self.pin_coefficient();
        degree_of_curvature(available / self.excursion_coefficient())
    }

    /// Slip-limited curve in degrees for μN at a wheel, N (A-14 = 4.5-6).
    pub fn slip_limit(&self, adhesion: f64) -> f64 {
        let Self {
            a,
            b,
            f,
            bending_stiffness: k_b,
            shear_stiffness: k_s,
            ..
        } = *self;
        let stiffening = 1.0 + f * f * self.steering() / (k_b * k_s);
        let resultant = (b / a + f * self.conicity / (k_s * self.r0)).hypot(1.0);
        degree_of_curvature(adhesion / (b * f) * stiffening / resultant)
    }

    /// Flanging force that keeps the leading wheelset at clearance y_fc in a curve 1/R, N (A-19 =
    /// 4.5-9); negative where the flange is not reached.
    pub fn flanging_force(&self, curvature: f64, clearance: f64, centre_pin_load: f64) -> f64 {
        let Self {
            f,
            bending_stiffness: k_b,
            shear_stiffness: k_s,
            ..
        } = *self;
        4.0 * f
            * (curvature * self.excursion_coefficient()
                + centre_pin_load / (4.0 * f) * self.pin_coefficient()
                - clearance * (k_b * k_s + f * f * self.steering()))
            / self.flange_coefficient()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix4, Vector4};
    use proptest::prelude::*;

    use super::*;
    use crate::track::curvature_of_degree;

    fn truck() -> impl Strategy<Value = SimpleTruck> {
        (
            0.5..0.9,
            0.9..1.6,
            0.35..0.55,
            0.02..0.3,
            5.0..7.5,
            5.0..7.5,
            6.5..7.5,
        )
            .prop_map(
                |(a, b, r0, conicity, k_b, k_s, f): (f64, f64, f64, f64, f64, f64, f64)| {
                    SimpleTruck {
                        a,
                        b,
                        r0,
                        conicity,
                        f: 10_f64.powf(f),
                        bending_stiffness: 10_f64.powf(k_b),
                        shear_stiffness: 10_f64.powf(k_s),
                    }
                },
            )
    }

    /// The printed 4 × 4 system, solved numerically.
    fn solved(t: &SimpleTruck, curvature: f64, f_f: f64, f_c: f64) -> Wheelsets {
        let (b, f, k_b, k_s) = (t.b, t.f, t.bending_stiffness, t.shear_stiffness);
        let s = 2.0 * f * t.steering();
        #[rustfmt::skip]
        let m = Matrix4::new(
            -k_s, b * k_s + 2.0 * f, k_s, b * k_s,
            b * k_s - s, -b * b * k_s - k_b, -b * k_s, -b * b * k_s + k_b,
            k_s, -b * k_s, -k_s, -b * k_s + 2.0 * f,
            b * k_s, -b * b * k_s + k_b, -b * k_s - s, -b * b * k_s - k_b,
        );
        let bend = 2.0 * b * curvature * k_b;
        let x = m
            .lu()
            .solve(&Vector4::new(f_f - f_c / 2.0, -bend, -f_c / 2.0, bend))
            .unwrap();
        Wheelsets {
            lateral: [x[0], x[2]],
            yaw: [x[1], x[3]],
        }
    }

    proptest! {
        /// Every printed solution solves the printed system. 1e-7: conditioning of the system.
        #[test]
        fn closed_forms_solve_the_system(t in truck(), d in 0.1..10.0, f_f in 0.0..3e4, f_c in -3e4..3e4) {
            let curvature = curvature_of_degree(d);
            for (f_f, f_c) in [(0.0, 0.0), (f_f, f_c)] {
                let (ours, exact) = (t.wheelsets(curvature, f_f, f_c), solved(&t, curvature, f_f, f_c));
                let scale = exact.lateral.iter().chain(&exact.yaw).fold(1e-6, |m: f64, x| m.max(x.abs()));
                for k in 0..2 {
                    prop_assert!((ours.lateral[k] - exact.lateral[k]).abs() < 1e-7 * scale);
                    prop_assert!((ours.yaw[k] - exact.yaw[k]).abs() < 1e-7 * scale);
                }
            }
        }

        /// At the flange limit the leading wheelset is at the clearance; the flanging force there is
        /// the one applied. At the slip limit its creep force is μN (A-13).
        #[test]
        fn limits_are_where_they_say(t in truck(), f_f in 0.0..1e4, f_c in 0.0..1e4) {
            let clearance = 0.0127;
            let limit = t.flange_limit(clearance, f_f, f_c);
            prop_assume!(limit > 0.0 && limit < 25.0);
            let curvature = curvature_of_degree(limit);
            let y_0 = t.a * t.r0 / t.conicity * curvature;
            let y = t.wheelsets(curvature, f_f, f_c).lateral[0] + y_0;
            prop_assert!((y / clearance - 1.0).abs() < 1e-9);
            let force = t.flanging_force(curvature, clearance, f_c);
            prop_assert!((force - f_f).abs() < 1e-6 * t.f * clearance);

            let adhesion = 1.2e4;
            let curvature = curvature_of_degree(t.slip_limit(adhesion));
            prop_assume!(curvature.is_finite());
            let w = t.wheelsets(curvature, 0.0, 0.0);
            let creep = (t.f * t.conicity / t.r0 * w.lateral[0]).hypot(t.f * w.yaw[0]);
            prop_assert!((creep / adhesion - 1.0).abs() < 1e-9);
        }

        /// Excursions of a free truck lie between the pure rolling line and the rigid truck (4.5.2).
        #[test]
        fn between_free_and_rigid(t in truck(), d in 0.1..5.0) {
            let curvature = curvature_of_degree(d);
            let y_0 = t.a * t.r0 / t.conicity * curvature;
            let rigid = y_0 * (1.0 + (t.b / t.a).powi(2));
            let leading = t.wheelsets(curvature, 0.0, 0.0).lateral[0] + y_0;
            prop_assert!(leading >= y_0 * (1.0 - 1e-12));
            // The bound is exact for stiffnesses far above the creep forces; on the way there the
            // leading wheelset may pass it, the mean of both does not.
            let both = t.wheelsets(curvature, 0.0, 0.0).lateral;
            prop_assert!(f64::midpoint(both[0], both[1]) + y_0 <= rigid * (1.0 + 1e-9));
        }
    }
}
