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

use super::{
    ForcedModel, LinearSystem, Output, Row,
    element::{self, Element, Name},
    forced::Excitation,
    suspension::{self, PRIMARY_VERTICAL, SECONDARY_VERTICAL},
};
use crate::{
    case::Case,
    track::Irregularity,
    vehicle::{End, Vehicle},
};

/// Index of the first truck coordinate.
const TRUCKS: usize = 6;
/// Index of the first inner coordinate.
const INNER: usize = 12;

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
    /// Elongation of the damper in an element with a spring in series, by number.
    Inner(usize),
}

impl Coordinate {
    /// The coordinate at `index`.
    pub fn at(index: usize) -> Self {
        match index {
            0 => Self::CarbodyHeave,
            1 => Self::CarbodyRoll,
            2 => Self::CarbodyPitch,
            3 => Self::CarbodyBending,
            4 => Self::CarbodyTorsion1,
            5 => Self::CarbodyTorsion2,
            TRUCKS..INNER => {
                let truck = (index - TRUCKS) / 3;
                match (index - TRUCKS) % 3 {
                    0 => Self::TruckHeave(truck),
                    1 => Self::TruckRoll(truck),
                    _ => Self::TruckPitch(truck),
                }
            }
            _ => Self::Inner(index - INNER),
        }
    }
}

/// A vehicle with the numbering of its vertical model.
pub(super) struct Builder<'a> {
    vehicle: &'a Vehicle,
    /// Leading and trailing end.
    pub(super) ends: [End; 2],
    /// Elements with an inner coordinate, in the order of these.
    inner: Vec<Name>,
}

impl VerticalModel {
    /// Builds the model of a case.
    pub fn new(case: &Case) -> Self {
        let vehicle = &case.vehicle;
        let mut builder = Builder {
            vehicle,
            ends: [vehicle.end(0), vehicle.end(1)],
            inner: Vec::new(),
        };
        let mut elements = suspension::vertical(&builder);
        builder.inner = element::inner_coordinates(&elements);
        if !builder.inner.is_empty() {
            // Inputs are numbered behind the inner coordinates.
            elements = suspension::vertical(&builder);
        }
        let mut system = LinearSystem::new(builder.masses(), 8);
        builder.add_flexible_modes(&mut system);
        element::assemble(&elements, &mut system, INNER);
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
            outputs: builder.outputs(&elements),
            lags: std::array::from_fn(|i| vehicle.wheelset_lag(i)),
            elimination: OnceLock::new(),
            system,
        };
        Self { forced }
    }
}

impl Builder<'_> {
    fn order(&self) -> usize {
        INNER + self.inner.len()
    }

    /// Elements on the left with those on the right, then all of the leading truck with those of the trailing one.
    fn mirrored(&self) -> Vec<[usize; 2]> {
        let place = |name| self.inner.iter().position(|inner| *inner == name);
        let pair = |name, other| Some([INNER + place(name)?, INNER + place(other)?]);
        let inner = self.inner.iter().copied();
        let left = inner.clone().filter(|name| name.side == 0);
        let mut pairs: Vec<[usize; 2]> = left
            .filter_map(|name| pair(name, name.on_side(1)))
            .collect();
        pairs.extend(inner.filter_map(|name| pair(name, name.mirrored_behind()?)));
        pairs.extend((0..3).map(|k| [TRUCKS + k, TRUCKS + 3 + k]));
        pairs
    }

    fn masses(&self) -> Vec<f64> {
        let c = &self.vehicle.carbody;
        let truck = |j: usize| &self.ends[j].truck;
        (0..self.order())
            .map(|index| match Coordinate::at(index) {
                Coordinate::CarbodyHeave => c.mass,
                Coordinate::CarbodyRoll => c.roll_inertia,
                Coordinate::CarbodyPitch => c.pitch_inertia,
                Coordinate::CarbodyBending => c.mass * c.bending.modal_mass_ratio,
                Coordinate::CarbodyTorsion1 => c.roll_inertia * c.torsion_1.modal_mass_ratio,
                Coordinate::CarbodyTorsion2 => c.roll_inertia * c.torsion_2.modal_mass_ratio,
                Coordinate::TruckHeave(j) => truck(j).mass,
                Coordinate::TruckRoll(j) => truck(j).roll_inertia,
                Coordinate::TruckPitch(j) => truck(j).pitch_inertia,
                Coordinate::Inner(_) => 0.0,
            })
            .collect()
    }

    /// Height of the frame of truck `j` at (x, y) from its centre.
    fn truck_point(j: usize, x: f64, y: f64) -> Row {
        let first = TRUCKS + 3 * j;
        Row::unit(first) + y * Row::unit(first + 1) - x * Row::unit(first + 2)
    }

    /// φ_t of truck `j`.
    pub(in crate::dynamics) fn truck_roll(j: usize) -> Row {
        Row::unit(TRUCKS + 3 * j + 1)
    }

    /// Station of truck `j` ahead of the carbody's middle, m.
    pub(in crate::dynamics) fn truck_station(&self, j: usize) -> f64 {
        let l_s = self.vehicle.carbody.half_truck_spacing;
        if j == 0 { l_s } else { -l_s }
    }

    /// Height of the rail under the primary spring at ±d_p of wheelset `i`.
    fn rail(&self, i: usize, y: f64) -> Row {
        Row::unit(self.order() + i) + y * Row::unit(self.order() + 4 + i)
    }

    /// Stretch of the primary spring of wheelset `i` on a side, +1 left and −1 right.
    pub(super) fn primary_stretch(&self, i: usize, side: f64) -> Row {
        let truck = &self.ends[i / 2].truck;
        let b = truck.half_wheelbase;
        let x = if i.is_multiple_of(2) { b } else { -b };
        let y = side * truck.half_primary_spacing;
        Self::truck_point(i / 2, x, y) - self.rail(i, y)
    }

    /// Stretch of the secondary spring of truck `j` on a side, +1 left and −1 right.
    pub(super) fn secondary_stretch(&self, j: usize, side: f64) -> Row {
        let y = side * self.ends[j].truck.half_secondary_spacing;
        let x = self.truck_station(j);
        self.carbody_point(x, y) - Self::truck_point(j, 0.0, y)
    }

    fn outputs(&self, elements: &[Element]) -> Vec<Output> {
        let passenger = &self.vehicle.passenger;
        let (x, y) = (passenger.longitudinal_offset, passenger.lateral_offset);
        let acceleration = [(0.0, 0.0), (x, y), (-x, y)]
            .map(|(x, y)| Output::acceleration(self.carbody_point(x, y)));
        let roll = Output::acceleration(Row::unit(1));
        let left = |name| element::named(elements, name);
        let secondary = (0..2).map(|j| {
            Output::displacement(
                left(Name::of_truck(SECONDARY_VERTICAL, j).on_side(0))
                    .stretch
                    .clone(),
            )
        });
        let stroke = (0..4).map(|i| {
            Output::displacement(
                left(Name::of_wheelset(PRIMARY_VERTICAL, i).on_side(0))
                    .stretch
                    .clone(),
            )
        });
        let load = (0..4).map(|i| {
            let Element { stretch, law, .. } =
                left(Name::of_wheelset(PRIMARY_VERTICAL, i).on_side(0));
            Output::force(stretch, law.stiffness, law.damping)
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
