//! Wheel–rail forces on the wheelsets: linear creep (Kalker) and gravitation.
//!
//! With e the excursion from the track centre line, per axle:
//!
//! ```math
//! ξ_y = v_c/V − ψ_w,   v_c = d/dt[y_w + r0 (a11/a) e]                       lateral creepage
//! ξ_s = ψ̇_w/V − Δ e/(a r0)                                                  spin creepage
//! Y = −2 f11 ξ_y − 2 f12 ξ_s − (W_A/a)(a11 + Δ) e                           lateral force, N
//! N = −2 a f33 (λ e/r0 + a ψ̇_w/V) + 2 f12 ξ_y − 2 f22 ξ_s + W_A a δ0 ψ_w − (I_wy V/r0) φ̇_w
//! ```
//!
//! N, the yaw moment in N m, holds the longitudinal creep couple, spin–lateral coupling, spin,
//! gravitational yaw (destabilising) and the gyroscopic moment. Here both stand on the left, with
//! their signs turned.

use super::Builder;
use crate::{
    case::Crosslevel,
    dynamics::{LinearSystem, Speed},
};

impl Builder<'_> {
    pub(super) fn add_wheelsets(&self, system: &mut LinearSystem) {
        let w = &self.vehicle.wheelset;
        let (a, r0) = (w.half_contact_distance, w.rolling_radius);
        for i in 0..4 {
            let c = &self.contact[i / 2];
            let axle_load = self.vehicle.axle_load_of(i / 2);
            let w = &self.ends[i / 2].wheelset;
            let (y, psi) = (self.q.y_w(i), self.q.psi_w(i));
            let e = self.excursion(i);
            let phi_w = self.wheelset_roll(i);
            // v_c is the rate of this; in the report's form only through the profile.
            let contact_point = y.clone()
                + match self.model.crosslevel {
                    Crosslevel::Roll => r0 * c.a11 / a * e.clone(),
                    Crosslevel::Contact => r0 * phi_w.clone(),
                };
            // Per unit of V: ξ_y = lateral_rate/V + lateral_angle, likewise for spin.
            let spin_angle = -c.delta / (a * r0) * e.clone();
            let lateral_angle = -psi.clone();

            system.add_damping(Speed::Inverse, &y, &contact_point, 2.0 * c.f11);
            system.add_stiffness(&y, &lateral_angle, 2.0 * c.f11);
            system.add_damping(Speed::Inverse, &y, &psi, 2.0 * c.f12);
            system.add_stiffness(&y, &spin_angle, 2.0 * c.f12);
            match self.model.crosslevel {
                Crosslevel::Roll => {
                    system.add_stiffness(&y, &e, axle_load / a * (c.a11 + c.delta));
                }
                Crosslevel::Contact => {
                    system.add_stiffness(&y, &(phi_w.clone() + c.delta / a * e.clone()), axle_load);
                }
            }

            system.add_stiffness(&psi, &e, 2.0 * a * c.f33 * c.conicity / r0);
            system.add_damping(Speed::Inverse, &psi, &psi, 2.0 * a * a * c.f33);
            system.add_damping(Speed::Inverse, &psi, &contact_point, -2.0 * c.f12);
            system.add_stiffness(&psi, &lateral_angle, -2.0 * c.f12);
            system.add_damping(Speed::Inverse, &psi, &psi, 2.0 * c.f22);
            system.add_stiffness(&psi, &spin_angle, 2.0 * c.f22);
            system.add_stiffness(&psi, &psi, -axle_load * a * c.delta_0);
            system.add_damping(Speed::Proportional, &psi, &phi_w, w.spin_inertia / r0);
        }
    }
}
