//! Linear forms that the elements of the lateral model are made of.

use super::Builder;
use crate::{case::Crosslevel, dynamics::Row};

impl Builder<'_> {
    /// y_t ± b ψ_t − y_w of wheelset `i`.
    pub(in crate::dynamics) fn primary_lateral_row(&self, i: usize) -> Row {
        let q = &self.q;
        let b = self.ends[i / 2].truck.half_wheelbase;
        let s = if i.is_multiple_of(2) { b } else { -b };
        q.y_t(i / 2) + s * q.psi_t(i / 2) - q.y_w(i)
    }

    /// Primary lateral stretch of wheelset `i`.
    pub(in crate::dynamics) fn primary_lateral_stretch(&self, i: usize) -> Row {
        let h_tp = self.ends[i / 2].truck.height_above_primary;
        self.primary_lateral_row(i) + h_tp * self.truck_roll(i / 2)
    }

    /// y_c ± l_s ψ_c + h_cs φ_c − y_t of truck `j`.
    pub(in crate::dynamics) fn secondary_lateral_row(&self, j: usize) -> Row {
        let (q, carbody) = (&self.q, &self.vehicle.carbody);
        let l_s = carbody.half_truck_spacing;
        let s = if j == 0 { l_s } else { -l_s };
        q.y_c() + s * q.psi_c() + carbody.height_above_secondary * q.phi_c() - q.y_t(j)
    }

    /// Secondary lateral stretch of truck `j`.
    pub(in crate::dynamics) fn secondary_lateral_stretch(&self, j: usize) -> Row {
        let h_ts = self.ends[j].truck.depth_below_secondary;
        self.secondary_lateral_row(j) + h_ts * self.truck_roll(j)
    }

    /// e, excursion of wheelset `i` from the track centre line at its contact points.
    pub(super) fn excursion(&self, i: usize) -> Row {
        let q = &self.q;
        let e = q.y_w(i) - q.y_a(i);
        match self.model.crosslevel {
            Crosslevel::Roll => e,
            Crosslevel::Contact => e + self.vehicle.wheelset.rolling_radius * q.phi_x(i),
        }
    }

    /// φ_w = φ_x + (a11/a) e, roll of wheelset `i` prescribed by the rails.
    pub(in crate::dynamics) fn wheelset_roll(&self, i: usize) -> Row {
        let a = self.vehicle.wheelset.half_contact_distance;
        self.q.phi_x(i) + self.contact[i / 2].a11 / a * self.excursion(i)
    }

    /// φ_t of truck `j`: its coordinate, or the mean of its wheelsets' roll (3.4.4.1).
    pub(in crate::dynamics) fn truck_roll(&self, j: usize) -> Row {
        self.q
            .phi_t(j)
            .unwrap_or_else(|| 0.5 * (self.wheelset_roll(2 * j) + self.wheelset_roll(2 * j + 1)))
    }
}
