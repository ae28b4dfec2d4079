//! The complete form of crosslevel: carried weight that follows the tilted truck plane.

use super::Builder;
use crate::{dynamics::LinearSystem, vehicle::GRAVITY};

impl Builder<'_> {
    /// Per truck, with stretch φ_t: row y_c ± l_sψ_c + h_csφ_c − y_t, M_c g/2; row y_t,
    /// M_c g/2 + M_t g; rows y_w of its wheelsets, −(M_c g/2 + M_t g)/2 each.
    pub(super) fn add_carried_weight(&self, system: &mut LinearSystem) {
        let carbody = self.vehicle.carbody.mass * GRAVITY / 2.0;
        for j in 0..2 {
            let truck = carbody + self.ends[j].truck.mass * GRAVITY;
            let phi_t = self.truck_roll(j);
            system.add_stiffness(&self.secondary_lateral_row(j), &phi_t, carbody);
            system.add_stiffness(&self.q.y_t(j), &phi_t, truck);
            for i in [2 * j, 2 * j + 1] {
                system.add_stiffness(&self.q.y_w(i), &phi_t, -truck / 2.0);
            }
        }
    }
}
