//! The vehicle: a carbody on two like trucks with two wheelsets each.
//!
//! Everything is in SI units. Spring and damper constants are per element, as in the report's
//! nomenclature: four primary corners and two secondary sides per truck, one secondary yaw
//! element per truck. Wheelsets are numbered 1–4 from the front, trucks 1 (leading) and 2.

mod carbody;
mod passenger;
mod prototype;
mod suspension;
mod truck;
mod wheelset;

pub use carbody::{Carbody, FlexibleMode};
pub use passenger::Passenger;
pub use suspension::{AirSpring, DAMPING_PER_STIFFNESS, Primary, Secondary, Suspension};
pub use truck::Truck;
pub use wheelset::Wheelset;

pub use crate::units::GRAVITY;

use serde::Serialize;

/// One vehicle with its suspension and the points where its passengers sit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Vehicle {
    /// One carbody.
    pub carbody: Carbody,
    /// Either of the two truck frames.
    pub truck: Truck,
    /// Any of the four wheelsets.
    pub wheelset: Wheelset,
    /// Springs and dampers between them.
    pub suspension: Suspension,
    /// Where the ride is computed.
    pub passenger: Passenger,
}

impl Vehicle {
    /// Static vertical load of one axle on the track, N, wheelset included.
    ///
    /// ```math
    /// W_A = g (M_c/4 + M_t/2 + M_w)
    /// ```
    pub fn axle_load(&self) -> f64 {
        GRAVITY * (self.carbody.mass / 4.0 + self.truck.mass / 2.0 + self.wheelset.mass)
    }

    /// Static load of one wheel, N: half the axle load.
    pub fn wheel_load(&self) -> f64 {
        self.axle_load() / 2.0
    }

    /// Static deflection of the secondary springs under the carbody, m; of air springs, which are
    /// levelled, the deflection that their static stiffness would give.
    ///
    /// ```math
    /// M_c g / (4 K_sz)
    /// ```
    pub fn secondary_static_deflection(&self) -> f64 {
        let stiffness = self.suspension.secondary.static_vertical_stiffness();
        self.carbody.mass * GRAVITY / (4.0 * stiffness)
    }

    /// Total mass, kg.
    pub fn mass(&self) -> f64 {
        self.carbody.mass + 2.0 * self.truck.mass + 4.0 * self.wheelset.mass
    }

    /// Primary bending stiffness K_b = d_p² K_px, N m/rad (4.5-7).
    pub fn bending_stiffness(&self) -> f64 {
        self.truck.half_primary_spacing.powi(2) * self.suspension.primary.longitudinal_stiffness
    }

    /// Sets K_px from the primary bending stiffness K_b, N m/rad (step 5 of Table 4.6.1).
    pub fn set_bending_stiffness(&mut self, bending_stiffness: f64) {
        self.suspension.primary.longitudinal_stiffness =
            bending_stiffness / self.truck.half_primary_spacing.powi(2);
    }

    /// Position of wheelset `i` (0–3 from the front) relative to mid-length, m, forward positive.
    pub fn wheelset_position(&self, i: usize) -> f64 {
        let (l_s, b) = (self.carbody.half_truck_spacing, self.truck.half_wheelbase);
        [l_s + b, l_s - b, -l_s + b, -l_s - b][i]
    }

    /// Distance of wheelset `i` behind wheelset 1, m: what delays its track input.
    pub fn wheelset_lag(&self, i: usize) -> f64 {
        self.wheelset_position(0) - self.wheelset_position(i)
    }
}
