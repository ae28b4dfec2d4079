//! Vertical model (3.4.3): 12 degrees of freedom, 16 with an orifice-damped air suspension.
//!
//! ```math
//! q = [z_c, φ_c, θ_c, u_b, u_1, u_2, (z_t, φ_t, θ_t)×2 (, p×4)],   u = [z_v1…4, φ_x1…4]
//! ```
//!
//! Massless wheels follow the rails. Suspension elements act along what they feel (row =
//! stretch): secondary at (±l_s, ±d_s), primary at (±l_s ± b, ±d_p), where the wheel sees
//! z_v ± d_p φ_x.

mod carbody;

use std::sync::OnceLock;

use super::{ForcedModel, LinearSystem, Output, Row, forced::Excitation};
use crate::{
    case::Case,
    track::Irregularity,
    vehicle::{AirSpring, Vehicle},
};

/// Index of the first truck coordinate.
const TRUCKS: usize = 6;
/// Index of the first inner point of the air springs.
const AIR_SPRINGS: usize = 12;

/// The vertical model of a case; its equations do not depend on the speed.
#[derive(Debug, Clone)]
pub struct VerticalModel {
    /// Equations of motion with track inputs and outputs.
    pub forced: ForcedModel,
}

/// Outputs of the vertical model, by position in [`ForcedModel::outputs`].
pub mod output {
    use std::ops::Range;

    /// Passenger acceleration at c.g., front, rear, flexible modes included, m/s².
    pub const ACCELERATION: Range<usize> = 0..3;
    /// Roll acceleration of the rigid carbody, rad/s².
    pub const ROLL_ACCELERATION: usize = 3;
    /// Secondary vertical stroke on the left, leading and trailing truck, m.
    pub const SECONDARY_STROKE: Range<usize> = 4..6;
    /// Primary vertical stroke on the left, wheelsets 1–4, m.
    pub const PRIMARY_STROKE: Range<usize> = 6..10;
    /// Change of wheel load, wheelsets 1–4, N: the force in the wheel's primary element (3.4.3).
    pub const WHEEL_LOAD: Range<usize> = 10..14;
}

/// Names of the coordinates, for mode shapes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coordinate {
    /// z_c.
    CarbodyHeave,
    /// φ_c.
    CarbodyRoll,
    /// θ_c.
    CarbodyPitch,
    /// u_b.
    CarbodyBending,
    /// u_1.
    CarbodyTorsion1,
    /// u_2.
    CarbodyTorsion2,
    /// z_t of truck 0 or 1.
    TruckHeave(usize),
    /// φ_t.
    TruckRoll(usize),
    /// θ_t.
    TruckPitch(usize),
    /// p of air spring 0–3: leading left, leading right, trailing left, trailing right.
    AirSpring(usize),
}

impl Coordinate {
    /// What the coordinate at `index` is.
    pub fn at(index: usize) -> Self {
        match index {
            0 => Self::CarbodyHeave,
            1 => Self::CarbodyRoll,
            2 => Self::CarbodyPitch,
            3 => Self::CarbodyBending,
            4 => Self::CarbodyTorsion1,
            5 => Self::CarbodyTorsion2,
            TRUCKS..AIR_SPRINGS => {
                let truck = (index - TRUCKS) / 3;
                match (index - TRUCKS) % 3 {
                    0 => Self::TruckHeave(truck),
                    1 => Self::TruckRoll(truck),
                    _ => Self::TruckPitch(truck),
                }
            }
            _ => Self::AirSpring(index - AIR_SPRINGS),
        }
    }
}

struct Builder<'a> {
    vehicle: &'a Vehicle,
    air_spring: Option<AirSpring>,
}

impl VerticalModel {
    /// Builds the model of a case.
    pub fn new(case: &Case) -> Self {
        let vehicle = &case.vehicle;
        let builder = Builder {
            vehicle,
            air_spring: vehicle.suspension.secondary.air_spring,
        };
        let mut system = LinearSystem::new(builder.masses(), 8);
        builder.add_flexible_modes(&mut system);
        builder.add_secondary(&mut system);
        builder.add_primary(&mut system);
        let order = builder.order();
        system.mirrored = builder.mirrored();
        let excitation = |irregularity, first: usize, scale| Excitation {
            irregularity,
            inputs: std::array::from_fn(|i| order + first + i),
            scale,
        };
        let roll = 1.0 / (2.0 * vehicle.wheelset.half_contact_distance);
        let forced = ForcedModel {
            excitations: vec![
                excitation(Irregularity::Vertical, 0, 1.0),
                excitation(Irregularity::Crosslevel, 4, roll),
            ],
            outputs: builder.outputs(),
            lags: std::array::from_fn(|i| vehicle.wheelset_lag(i)),
            elimination: OnceLock::new(),
            system,
        };
        Self { forced }
    }
}

impl Builder<'_> {
    fn order(&self) -> usize {
        AIR_SPRINGS + if self.air_spring.is_some() { 4 } else { 0 }
    }

    /// Air springs left and right, then all of the trucks in front and behind.
    fn mirrored(&self) -> Vec<[usize; 2]> {
        let trucks = (0..3).map(|k| [TRUCKS + k, TRUCKS + 3 + k]);
        let springs = self
            .air_spring
            .map_or(&[][..], |_| &[[0, 1], [2, 3], [0, 2], [1, 3]]);
        let springs = springs
            .iter()
            .map(|pair| pair.map(|corner| AIR_SPRINGS + corner));
        springs.chain(trucks).collect()
    }

    fn masses(&self) -> Vec<f64> {
        let (c, t) = (&self.vehicle.carbody, &self.vehicle.truck);
        (0..self.order())
            .map(|index| match Coordinate::at(index) {
                Coordinate::CarbodyHeave => c.mass,
                Coordinate::CarbodyRoll => c.roll_inertia,
                Coordinate::CarbodyPitch => c.pitch_inertia,
                Coordinate::CarbodyBending => c.mass * c.bending.modal_mass_ratio,
                Coordinate::CarbodyTorsion1 => c.roll_inertia * c.torsion_1.modal_mass_ratio,
                Coordinate::CarbodyTorsion2 => c.roll_inertia * c.torsion_2.modal_mass_ratio,
                Coordinate::TruckHeave(_) => t.mass,
                Coordinate::TruckRoll(_) => t.roll_inertia,
                Coordinate::TruckPitch(_) => t.pitch_inertia,
                Coordinate::AirSpring(_) => 0.0,
            })
            .collect()
    }

    /// Height of the frame of truck `j` at (x, y) from its centre.
    fn truck_point(j: usize, x: f64, y: f64) -> Row {
        let first = TRUCKS + 3 * j;
        Row::unit(first) + y * Row::unit(first + 1) - x * Row::unit(first + 2)
    }

    /// Height of the rail under the primary spring at ±d_p of wheelset `i`.
    fn rail(&self, i: usize, y: f64) -> Row {
        Row::unit(self.order() + i) + y * Row::unit(self.order() + 4 + i)
    }

    fn primary_stretch(&self, i: usize, side: f64) -> Row {
        let truck = &self.vehicle.truck;
        let b = truck.half_wheelbase;
        let x = if i.is_multiple_of(2) { b } else { -b };
        let y = side * truck.half_primary_spacing;
        Self::truck_point(i / 2, x, y) - self.rail(i, y)
    }

    /// Where the secondary spring of truck `j` on a side meets carbody and truck.
    fn secondary_ends(&self, j: usize, side: f64) -> [Row; 2] {
        let l_s = self.vehicle.carbody.half_truck_spacing;
        let y = side * self.vehicle.truck.half_secondary_spacing;
        let x = if j == 0 { l_s } else { -l_s };
        [self.carbody_point(x, y), Self::truck_point(j, 0.0, y)]
    }

    fn add_primary(&self, system: &mut LinearSystem) {
        let primary = &self.vehicle.suspension.primary;
        for i in 0..4 {
            for side in [1.0, -1.0] {
                let stretch = self.primary_stretch(i, side);
                system.add_element(
                    &stretch,
                    &stretch,
                    primary.vertical_stiffness,
                    primary.c_pz(),
                );
            }
        }
    }

    fn add_secondary(&self, system: &mut LinearSystem) {
        let secondary = &self.vehicle.suspension.secondary;
        let corners = [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)];
        for (corner, (j, side)) in corners.into_iter().enumerate() {
            let [carbody, truck] = self.secondary_ends(j, side);
            let stretch = carbody.clone() - truck.clone();
            if let Some(air) = self.air_spring {
                let p = Row::unit(AIR_SPRINGS + corner);
                let bellows = carbody - p.clone();
                let reservoir = p - truck;
                system.add_stiffness(&stretch, &stretch, air.direct_stiffness);
                system.add_stiffness(&bellows, &bellows, air.series_stiffness);
                system.add_element(
                    &reservoir,
                    &reservoir,
                    air.reservoir_stiffness,
                    air.orifice_damping,
                );
            } else {
                let (k, c) = (secondary.vertical_stiffness, secondary.vertical_damping);
                system.add_element(&stretch, &stretch, k, c);
            }
        }
    }

    fn outputs(&self) -> Vec<Output> {
        let passenger = &self.vehicle.passenger;
        let primary = &self.vehicle.suspension.primary;
        let (x, y) = (passenger.longitudinal_offset, passenger.lateral_offset);
        let acceleration = [(0.0, 0.0), (x, y), (-x, y)]
            .map(|(x, y)| Output::acceleration(self.carbody_point(x, y)));
        let roll = Output::acceleration(Row::unit(1));
        let secondary = (0..2).map(|j| {
            let [carbody, truck] = self.secondary_ends(j, 1.0);
            Output::displacement(carbody - truck)
        });
        let stroke = (0..4).map(|i| Output::displacement(self.primary_stretch(i, 1.0)));
        let load = (0..4).map(|i| {
            let stretch = self.primary_stretch(i, 1.0);
            Output::force(&stretch, primary.vertical_stiffness, primary.c_pz())
        });
        acceleration
            .into_iter()
            .chain([roll])
            .chain(secondary)
            .chain(stroke)
            .chain(load)
            .collect()
    }
}
