//! The vehicle: a carbody on two trucks with two wheelsets each.
//!
//! Everything is in SI units. Spring and damper constants are per element, as in the report's
//! nomenclature: four primary corners and two secondary sides per truck, one secondary yaw
//! element per truck. Wheelsets are numbered 1–4 from the front, trucks 1 (leading) and 2.

mod carbody;
mod end;
mod passenger;
mod prototype;
mod suspension;
mod truck;
mod wheelset;

pub use carbody::{Carbody, FlexibleMode};
pub use end::{End, Trailing};
pub use passenger::Passenger;
pub use suspension::{
    AIR_SPRING, AirSpring, DAMPING_PER_STIFFNESS, Primary, Secondary, Suspension,
};
pub use truck::Truck;
pub use wheelset::Wheelset;

pub use crate::units::GRAVITY;

use serde::Serialize;

use crate::units::Table;

/// The numbers of a vehicle, table by table.
pub fn tables() -> impl Iterator<Item = &'static Table<Vehicle>> + Clone {
    let running_gear = [&truck::TRUCK, &wheelset::WHEELSET];
    carbody::TABLES
        .into_iter()
        .chain(running_gear)
        .chain(suspension::TABLES)
        .chain([&passenger::PASSENGER])
}

/// One vehicle with its suspension and the points where its passengers sit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Vehicle {
    /// One carbody.
    pub carbody: Carbody,
    /// Truck frame of the leading end, and of the trailing end unless that has its own.
    pub truck: Truck,
    /// Either wheelset of the leading end, and of the trailing end unless that has its own.
    pub wheelset: Wheelset,
    /// Springs and dampers of the leading end, and of the trailing end unless that has its own.
    pub suspension: Suspension,
    /// Points where the ride is computed.
    pub passenger: Passenger,
    /// The trailing end where it differs; `None`: both ends are the same.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trailing: Option<Box<Trailing>>,
}

impl Vehicle {
    /// Truck j (0 leading, 1 trailing) with its wheelsets and suspension.
    pub fn end(&self, j: usize) -> End {
        let leading = End {
            truck: self.truck,
            wheelset: self.wheelset,
            suspension: self.suspension,
        };
        match &self.trailing {
            Some(trailing) if j == 1 => trailing.beside(&leading),
            _ => leading,
        }
    }

    /// Frame of truck j (0 leading, 1 trailing).
    pub fn truck_at(&self, j: usize) -> &Truck {
        match &self.trailing {
            Some(trailing) if j == 1 => &trailing.end.truck,
            _ => &self.truck,
        }
    }

    /// Either wheelset of truck j (0 leading, 1 trailing).
    pub fn wheelset_at(&self, j: usize) -> Wheelset {
        match &self.trailing {
            Some(_) if j == 1 => self.end(1).wheelset,
            _ => self.wheelset,
        }
    }

    /// Static vertical load of one axle on the track, N, wheelset included; the mean of both ends where
    /// they differ.
    ///
    /// ```math
    /// W_A = g (M_c/4 + M_t/2 + M_w)
    /// ```
    pub fn axle_load(&self) -> f64 {
        match self.trailing {
            None => self.axle_load_of(0),
            Some(_) => f64::midpoint(self.axle_load_of(0), self.axle_load_of(1)),
        }
    }

    /// Static vertical load of an axle of truck j (0 leading, 1 trailing), N.
    pub fn axle_load_of(&self, j: usize) -> f64 {
        let (carbody, truck) = (self.carbody.mass, self.truck_at(j).mass);
        GRAVITY * (carbody / 4.0 + truck / 2.0 + self.wheelset_at(j).mass)
    }

    /// Static load of one wheel, N: half the axle load.
    pub fn wheel_load(&self) -> f64 {
        self.axle_load() / 2.0
    }

    /// Static deflection of the secondary springs under the carbody, m; of air springs, which are
    /// levelled, the deflection that their static stiffness would give. The larger one where the ends
    /// differ.
    ///
    /// ```math
    /// M_c g / (4 K_sz)
    /// ```
    pub fn secondary_static_deflection(&self) -> f64 {
        let of = |j| {
            let stiffness = self.end(j).suspension.secondary.static_vertical_stiffness();
            self.carbody.mass * GRAVITY / (4.0 * stiffness)
        };
        of(0).max(of(1))
    }

    /// Total mass, kg.
    pub fn mass(&self) -> f64 {
        let end = |j| self.truck_at(j).mass + 2.0 * self.wheelset_at(j).mass;
        self.carbody.mass + (end(0) + end(1))
    }

    /// Primary bending stiffness K_b = d_p² K_px, N m/rad (4.5-7).
    pub fn bending_stiffness(&self) -> f64 {
        self.truck.half_primary_spacing.powi(2) * self.suspension.primary.longitudinal_stiffness
    }

    /// Position of wheelset `i` (0–3 from the front) relative to mid-length, m, forward positive.
    pub fn wheelset_position(&self, i: usize) -> f64 {
        let b = self.truck_at(i / 2).half_wheelbase;
        let l_s = self.carbody.half_truck_spacing;
        let truck = if i < 2 { l_s } else { -l_s };
        truck + if i.is_multiple_of(2) { b } else { -b }
    }

    /// Distance of wheelset `i` behind wheelset 1, m: its track input is delayed by the time for that way.
    pub fn wheelset_lag(&self, i: usize) -> f64 {
        self.wheelset_position(0) - self.wheelset_position(i)
    }
}
