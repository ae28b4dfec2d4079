//! Springs, dampers and the carbody's weight in the lateral model.
//!
//! | element | row | stretch | constant |
//! |---|---|---|---|
//! | primary lateral, wheelset at s = ±b | y_t + sψ_t − y_w | row + h_tp φ_t | 2K_py, 2C_py |
//! | primary yaw (longitudinal springs at ±d_p) | ψ_t − ψ_w | row | 2d_p²K_px, 2d_p²C_px |
//! | secondary lateral, truck at ±l_s | y_c ± l_s ψ_c + h_cs φ_c − y_t | row + h_ts φ_t | 2K_sy, 2C_sy |
//! | secondary roll | φ_c | φ_c − φ_t | 2d_s²K_sz, 2d_s²C_sz |
//! | secondary yaw | ψ_c − ψ_t | row | K_sψ, C_sψ |
//! | carbody weight on its springs | φ_c | φ_c | −M_c g h_cs |
//! | primary roll, truck roll free | φ_t | φ_t − φ_w | 2d_p²K_pz, 2d_p²C_pz |
//! | weight on the truck, truck roll free | φ_t | φ_t | −(M_c g/2) h_ts − (M_c g/2 + M_t g) h_tp |
//!
//! With truck roll free, φ_t is part of the rows just as of the stretches.

use super::Builder;
use crate::{
    dynamics::{LinearSystem, Row},
    vehicle::GRAVITY,
};

impl Builder<'_> {
    pub(super) fn add_suspension(&self, system: &mut LinearSystem) {
        let (q, vehicle) = (&self.q, self.vehicle);
        let (primary, secondary) = (&vehicle.suspension.primary, &vehicle.suspension.secondary);
        let d_p2 = vehicle.truck.half_primary_spacing.powi(2);
        let d_s2 = vehicle.truck.half_secondary_spacing.powi(2);
        for i in 0..4 {
            let j = i / 2;
            let stretch = self.primary_lateral_stretch(i);
            let row = if q.phi_t(j).is_some() {
                stretch.clone()
            } else {
                self.primary_lateral_row(i)
            };
            let (k, c) = (primary.lateral_stiffness, primary.c_py());
            system.add_element(&row, &stretch, 2.0 * k, 2.0 * c);

            let yaw = q.psi_t(j) - q.psi_w(i);
            let (k, c) = (primary.longitudinal_stiffness, primary.c_px());
            system.add_element(&yaw, &yaw, 2.0 * d_p2 * k, 2.0 * d_p2 * c);

            if let Some(phi_t) = q.phi_t(j) {
                let stretch = phi_t.clone() - self.wheelset_roll(i);
                let (k, c) = (primary.vertical_stiffness, primary.c_pz());
                system.add_element(&phi_t, &stretch, 2.0 * d_p2 * k, 2.0 * d_p2 * c);
            }
        }
        let half_carbody_weight = vehicle.carbody.mass * GRAVITY / 2.0;
        let truck_weight = vehicle.truck.mass * GRAVITY;
        for j in 0..2 {
            let stretch = self.secondary_lateral_stretch(j);
            let row = if q.phi_t(j).is_some() {
                stretch.clone()
            } else {
                self.secondary_lateral_row(j)
            };
            let (k, c) = (secondary.lateral_stiffness, secondary.lateral_damping);
            system.add_element(&row, &stretch, 2.0 * k, 2.0 * c);

            let stretch = q.phi_c() - self.truck_roll(j);
            let row = if q.phi_t(j).is_some() {
                stretch.clone()
            } else {
                q.phi_c()
            };
            let (k, c) = (secondary.vertical_stiffness, secondary.vertical_damping);
            system.add_element(&row, &stretch, 2.0 * d_s2 * k, 2.0 * d_s2 * c);

            let yaw = q.psi_c() - q.psi_t(j);
            system.add_element(&yaw, &yaw, secondary.yaw_stiffness, secondary.c_spsi());

            if let Some(phi_t) = q.phi_t(j) {
                let truck = &vehicle.truck;
                let weight = half_carbody_weight * truck.depth_below_secondary
                    + (half_carbody_weight + truck_weight) * truck.height_above_primary;
                system.add_stiffness(&phi_t, &phi_t, -weight);
            }
        }
        let overturning = 2.0 * half_carbody_weight * vehicle.carbody.height_above_secondary;
        system.add_stiffness(&q.phi_c(), &q.phi_c(), -overturning);
    }

    /// y_t ± b ψ_t − y_w of wheelset `i`.
    pub(in crate::dynamics) fn primary_lateral_row(&self, i: usize) -> Row {
        let q = &self.q;
        let b = self.vehicle.truck.half_wheelbase;
        let s = if i.is_multiple_of(2) { b } else { -b };
        q.y_t(i / 2) + s * q.psi_t(i / 2) - q.y_w(i)
    }

    /// Primary lateral stroke of wheelset `i`.
    pub(in crate::dynamics) fn primary_lateral_stretch(&self, i: usize) -> Row {
        let h_tp = self.vehicle.truck.height_above_primary;
        self.primary_lateral_row(i) + h_tp * self.truck_roll(i / 2)
    }

    /// y_c ± l_s ψ_c + h_cs φ_c − y_t of truck `j`.
    pub(in crate::dynamics) fn secondary_lateral_row(&self, j: usize) -> Row {
        let (q, carbody) = (&self.q, &self.vehicle.carbody);
        let l_s = carbody.half_truck_spacing;
        let s = if j == 0 { l_s } else { -l_s };
        q.y_c() + s * q.psi_c() + carbody.height_above_secondary * q.phi_c() - q.y_t(j)
    }

    /// Secondary lateral stroke of truck `j`.
    pub(in crate::dynamics) fn secondary_lateral_stretch(&self, j: usize) -> Row {
        let h_ts = self.vehicle.truck.depth_below_secondary;
        self.secondary_lateral_row(j) + h_ts * self.truck_roll(j)
    }
}
