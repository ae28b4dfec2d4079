//! Wheel–rail forces of a wheelset in a steady curve.
//!
//! Per wheel, s = +1 outer and −1 inner, with y and ψ of its wheelset:
//!
//! ```math
//! F_x = −s f33 (λ y/r0 − a/R)
//! F_y = f11 ψ + f12 σ,   σ = 1/R + s δ0/r0 + Δ y/(a r0)
//! M_z = −f12 ψ + f22 σ
//! ```
//!
//! The normal forces N0 ± ΔN of the two wheels add, for the axle, −(W_A/a)(a11 + Δ) y − 2 ΔN δ0
//! laterally and +W_A a δ0 ψ in yaw.

use super::{CurvingModel, Segment};

/// Which wheel of a wheelset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// On the outer rail.
    Outer,
    /// On the inner rail.
    Inner,
}

impl std::fmt::Display for Side {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Outer => "outer",
            Self::Inner => "inner",
        })
    }
}

impl Side {
    /// Both sides, outer first.
    pub const BOTH: [Self; 2] = [Self::Outer, Self::Inner];

    pub(super) fn sign(self) -> f64 {
        match self {
            Self::Outer => 1.0,
            Self::Inner => -1.0,
        }
    }
}

/// Forces of the rail on one wheel, N.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelForces {
    /// F_x, longitudinal creep force.
    pub longitudinal_creep: f64,
    /// F_y, lateral creep force, outward positive.
    pub lateral_creep: f64,
    /// Lateral force in track plane: creep and the normal force's lateral part,
    /// −N (s δ0 + (Δ + a11) y/a); outward positive.
    pub lateral: f64,
    /// Vertical load.
    pub vertical: f64,
    /// Resultant creep force over μN.
    pub adhesion_used: f64,
}

impl WheelForces {
    /// L/V of the wheel.
    pub fn lateral_to_vertical(&self) -> f64 {
        self.lateral.abs() / self.vertical
    }
}

/// Where a wheelset is in the curve, or how its place changes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Place {
    /// y_w, m.
    pub y: f64,
    /// ψ_w, rad.
    pub psi: f64,
}

impl CurvingModel {
    /// Adds the forces of wheelset `i`, wheel by wheel, to stiffness and loads.
    pub(super) fn add_wheelset(&mut self, i: usize) {
        let w = self.vehicle.wheelset;
        let (a, r0) = (w.half_contact_distance, w.rolling_radius);
        let axle_load = self.vehicle.axle_load_of(i / 2);
        let [y, psi] = self.q.wheelset(i);
        for side in Side::BOTH {
            let (s, c) = (side.sign(), self.contact[i / 2][side as usize]);
            let spin_per_y = c.delta / (a * r0);
            let spin = s * c.delta_0 / r0;
            self.stiffness[(y, psi)] -= c.f11;
            self.stiffness[(y, y)] -= c.f12 * spin_per_y;
            self.load[y] += c.f12 * spin;
            self.load_per_curvature[y] += c.f12;

            self.stiffness[(psi, y)] += a * c.f33 * c.conicity / r0 - c.f22 * spin_per_y;
            self.stiffness[(psi, psi)] += c.f12;
            self.load[psi] += c.f22 * spin;
            self.load_per_curvature[psi] += a * a * c.f33 + c.f22;
        }
        let (c, [outer, inner]) = (self.contact[i / 2][0], self.wheel_load[i / 2]);
        self.stiffness[(y, y)] += axle_load / a * (c.a11 + c.delta);
        self.stiffness[(psi, psi)] -= axle_load * a * c.delta_0;
        // Equal loads lean on opposite contact angles and cancel; the transferred load 2 ΔN does not.
        self.load[y] -= (outer - inner) * c.delta_0;
    }

    /// Creep forces (F_x, F_y) of a wheel as affine functions of curvature on a segment:
    /// [at zero curvature, per unit curvature], N and N m.
    pub(crate) fn creep_forces(&self, segment: &Segment, i: usize, side: Side) -> [[f64; 2]; 2] {
        [
            self.creep(i, self.place(&segment.at_zero, i), 0.0, 1.0, side),
            self.creep(i, self.place(&segment.per_curvature, i), 1.0, 0.0, side),
        ]
    }

    /// Creep forces (F_x, F_y) of a wheel of wheelset `i`, linear in the place of the wheelset, the curvature,
    /// 1/m, and the share of the profile's own spin.
    pub(crate) fn creep(
        &self,
        i: usize,
        place: Place,
        curvature: f64,
        profile: f64,
        side: Side,
    ) -> [f64; 2] {
        let w = self.vehicle.wheelset;
        let (a, r0) = (w.half_contact_distance, w.rolling_radius);
        let (s, c) = (side.sign(), self.contact[i / 2][side as usize]);
        let Place { y, psi } = place;
        let spin = curvature + profile * s * c.delta_0 / r0 + c.delta * y / (a * r0);
        [
            -s * c.f33 * (c.conicity * y / r0 - a * curvature),
            c.f11 * psi + c.f12 * spin,
        ]
    }

    /// Lateral part of the normal force on a wheel, linear likewise, N.
    pub(crate) fn normal(&self, i: usize, place: Place, profile: f64, side: Side) -> f64 {
        let c = self.contact[i / 2][side as usize];
        let a = self.vehicle.wheelset.half_contact_distance;
        let angle = profile * side.sign() * c.delta_0 + (c.delta + c.a11) * place.y / a;
        -self.vertical(i, side) * angle
    }

    /// Vertical load of a wheel of wheelset `i`, N.
    pub fn vertical(&self, i: usize, side: Side) -> f64 {
        self.wheel_load[i / 2][side as usize]
    }

    /// μN of a wheel of wheelset `i`, N.
    pub fn adhesion_limit(&self, i: usize, side: Side) -> f64 {
        self.friction * self.vertical(i, side)
    }

    /// Forces on a wheel of wheelset `i` (0–3) at a curvature, 1/m.
    pub fn wheel_forces(&self, curvature: f64, i: usize, side: Side) -> WheelForces {
        let segment = self.segment_at(curvature);
        let [zero, slope] = self.creep_forces(segment, i, side);
        let [f_x, f_y] = [0, 1].map(|k| zero[k] + curvature * slope[k]);
        let displacement = |index| segment.displacement(index, curvature);
        let [y, psi] = self.q.wheelset(i).map(displacement);
        let place = Place { y, psi };
        WheelForces {
            longitudinal_creep: f_x,
            lateral_creep: f_y,
            lateral: f_y + self.normal(i, place, 1.0, side),
            vertical: self.vertical(i, side),
            adhesion_used: f_x.hypot(f_y) / self.adhesion_limit(i, side),
        }
    }
}
