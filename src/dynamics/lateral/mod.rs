//! Lateral model (3.4.4): 15 degrees of freedom, or 17 with truck roll free.
//!
//! ```math
//! q = [y_w1…4, ψ_w1…4, y_t1…2, ψ_t1…2, (φ_t1…2,) y_c, ψ_c, φ_c],   u = [y_a1…4, φ_x1…4]
//! ```
//!
//! x forward, y left, z up; small angles. Every element is a pair of rows over [q, u]: where its
//! force acts, and the stretch it feels. Roll of wheelsets, and of trucks in the report's form, is
//! prescribed by the rails, so it appears in stretches but never in rows: its reactions go into
//! the rails' vertical loads.

mod carried_weight;
mod coordinates;
mod rows;
mod wheelset;

pub use coordinates::{Body, Coordinate, Coordinates};

use std::sync::OnceLock;

use super::{
    ForcedModel, LinearSystem, Output,
    element::{self, Element, Name},
    forced::Excitation,
    parts,
    suspension::{self, PRIMARY_LATERAL, PRIMARY_YAW, SECONDARY_LATERAL},
};
use crate::{
    case::{Case, Crosslevel, Model},
    track::Irregularity,
    vehicle::{End, Vehicle},
    wheel_rail::Contact,
};

/// The lateral model of a case, for any speed.
#[derive(Debug, Clone)]
pub struct LateralModel {
    /// Numbering of the coordinates.
    pub coordinates: Coordinates,
    /// Equations of motion with track inputs and outputs.
    pub forced: ForcedModel,
}

/// Outputs of the lateral model, by position in [`ForcedModel::outputs`].
pub mod output {
    use std::ops::Range;

    /// Passenger acceleration at c.g., front, rear, m/s².
    pub const ACCELERATION: Range<usize> = 0..3;
    /// Carbody roll acceleration, rad/s².
    pub const ROLL_ACCELERATION: usize = 3;
    /// Secondary lateral stroke, leading and trailing truck, m.
    pub const SECONDARY_STROKE: Range<usize> = 4..6;
    /// Primary lateral stroke, wheelsets 1–4, m.
    pub const PRIMARY_STROKE: Range<usize> = 6..10;
    /// Wheelset excursion from the track centre line, wheelsets 1–4, m.
    pub const EXCURSION: Range<usize> = 10..14;
    /// Primary longitudinal stroke, wheelsets 1–4, m.
    pub const LONGITUDINAL_STROKE: Range<usize> = 14..18;
}

/// The suspension alone, with truck roll prescribed by the rails: the curving model shares it with this one.
pub(super) fn suspension_on_rails(
    vehicle: &Vehicle,
    contact: Contact,
) -> (Coordinates, Vec<Element>) {
    let builder = Builder::new(vehicle, contact, Model::default());
    let elements = suspension::lateral(&builder);
    (builder.q, elements)
}

/// A vehicle with the numbering of its lateral model.
pub(super) struct Builder<'a> {
    pub(super) vehicle: &'a Vehicle,
    /// Leading and trailing end.
    pub(super) ends: [End; 2],
    /// Contact of the wheels of either end.
    contact: [Contact; 2],
    model: Model,
    pub(super) q: Coordinates,
}

impl LateralModel {
    /// Builds the model of a case.
    pub fn new(case: &Case) -> Self {
        let vehicle = &case.vehicle;
        let mut builder = Builder::new(vehicle, case.wheel_rail.contact(), case.model);
        let mut elements = suspension::lateral(&builder);
        let inner = element::inner_coordinates(&elements);
        if !inner.is_empty() {
            // Inputs are numbered behind the inner coordinates.
            builder.q = Coordinates::new(case.model.truck_roll, &inner);
            elements = suspension::lateral(&builder);
        }
        let mut system = LinearSystem::new(builder.q.masses(vehicle), 8);
        element::assemble(&elements, &mut system, builder.q.massive());
        builder.add_wheelsets(&mut system);
        if case.model.crosslevel == Crosslevel::Contact {
            builder.add_carried_weight(&mut system);
        }
        let q = &builder.q;
        system.find_alike(q.ends());
        let roll = 1.0 / (2.0 * vehicle.wheelset.half_contact_distance);
        let excitation =
            |irregularity, first: fn(&Coordinates, usize) -> usize, scale| Excitation {
                irregularity,
                inputs: std::array::from_fn(|i| first(q, i)),
                scale,
            };
        let forced = ForcedModel {
            excitations: vec![
                excitation(Irregularity::Alignment, Coordinates::alignment_input, 1.0),
                excitation(Irregularity::Crosslevel, Coordinates::roll_input, roll),
            ],
            outputs: builder.outputs(&elements),
            lags: std::array::from_fn(|i| vehicle.wheelset_lag(i)),
            elimination: OnceLock::new(),
            system,
        };
        Self {
            coordinates: builder.q,
            forced,
        }
    }

    /// Each truck under a carbody at rest, at `speed`, m/s: its coordinates' numbers in the model, and its
    /// equations of motion, whose damping is that at `speed`. One truck where the ends are alike.
    pub fn trucks(&self, speed: f64) -> Vec<(Vec<usize>, LinearSystem)> {
        let ends = self.coordinates.ends();
        let count = if self.forced.system.alike.is_empty() {
            2
        } else {
            1
        };
        let truck = |j: usize| {
            let part: Vec<usize> = ends.iter().map(|pair| pair[j]).collect();
            let held = parts::part_at(&self.forced.system, speed, &part);
            (part, held)
        };
        (0..count).map(truck).collect()
    }
}

impl<'a> Builder<'a> {
    fn new(vehicle: &'a Vehicle, contact: Contact, model: Model) -> Self {
        // The coefficients belong to the mean axle load.
        let contact = match &vehicle.trailing {
            None => [contact; 2],
            Some(_) => {
                [0, 1].map(|j| contact.at_load(vehicle.axle_load_of(j) / vehicle.axle_load()))
            }
        };
        Self {
            vehicle,
            ends: [vehicle.end(0), vehicle.end(1)],
            contact,
            model,
            q: Coordinates::new(model.truck_roll, &[]),
        }
    }
}

impl Builder<'_> {
    fn outputs(&self, elements: &[Element]) -> Vec<Output> {
        let q = &self.q;
        let passenger = &self.vehicle.passenger;
        let (x, h) = (
            passenger.longitudinal_offset,
            passenger.height_above_carbody_cg,
        );
        let acceleration =
            [0.0, x, -x].map(|x| Output::acceleration(q.y_c() + x * q.psi_c() - h * q.phi_c()));
        let roll = Output::acceleration(q.phi_c());
        let stretch = |name| element::named(elements, name).stretch.clone();
        let secondary =
            (0..2).map(|j| Output::displacement(stretch(Name::of_truck(SECONDARY_LATERAL, j))));
        let primary =
            (0..4).map(|i| Output::displacement(stretch(Name::of_wheelset(PRIMARY_LATERAL, i))));
        let excursion = (0..4).map(|i| Output::displacement(self.excursion(i)));
        let longitudinal = (0..4).map(|i| {
            let d_p = self.ends[i / 2].truck.half_primary_spacing;
            Output::displacement(d_p * stretch(Name::of_wheelset(PRIMARY_YAW, i)))
        });
        acceleration
            .into_iter()
            .chain([roll])
            .chain(secondary)
            .chain(primary)
            .chain(excursion)
            .chain(longitudinal)
            .collect()
    }
}
