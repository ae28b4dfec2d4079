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
mod suspension;
mod wheelset;

pub use coordinates::{Body, Coordinate, Coordinates};

use std::sync::OnceLock;

use super::{ForcedModel, LinearSystem, Output, Row, forced::Excitation, parts};
use crate::{
    case::{Case, Crosslevel, Model, TruckRoll},
    track::Irregularity,
    vehicle::Vehicle,
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

/// The suspension alone, with truck roll prescribed by the rails: what the curving model shares
/// with this one.
pub(super) fn suspension_on_rails(
    vehicle: &Vehicle,
    contact: Contact,
) -> (Coordinates, LinearSystem) {
    let builder = Builder::on_rails(vehicle, contact);
    let mut system = LinearSystem::new(builder.q.masses(vehicle), 8);
    builder.add_suspension(&mut system);
    (builder.q, system)
}

/// What the building of an element needs to see.
pub(super) struct Builder<'a> {
    vehicle: &'a Vehicle,
    contact: Contact,
    model: Model,
    q: Coordinates,
}

impl LateralModel {
    /// Builds the model of a case.
    pub fn new(case: &Case) -> Self {
        let builder = Builder {
            vehicle: &case.vehicle,
            contact: case.wheel_rail.contact(),
            model: case.model,
            q: Coordinates::new(case.model.truck_roll),
        };
        let mut system = LinearSystem::new(builder.q.masses(&case.vehicle), 8);
        builder.add_suspension(&mut system);
        builder.add_wheelsets(&mut system);
        if case.model.crosslevel == Crosslevel::Contact {
            builder.add_carried_weight(&mut system);
        }
        let q = builder.q;
        system.alike = q.trucks();
        let roll = 1.0 / (2.0 * case.vehicle.wheelset.half_contact_distance);
        let excitation = |irregularity, first: fn(Coordinates, usize) -> usize, scale| Excitation {
            irregularity,
            inputs: std::array::from_fn(|i| first(q, i)),
            scale,
        };
        let forced = ForcedModel {
            excitations: vec![
                excitation(Irregularity::Alignment, Coordinates::alignment_input, 1.0),
                excitation(Irregularity::Crosslevel, Coordinates::roll_input, roll),
            ],
            outputs: builder.outputs(),
            lags: std::array::from_fn(|i| case.vehicle.wheelset_lag(i)),
            elimination: OnceLock::new(),
            system,
        };
        Self {
            coordinates: q,
            forced,
        }
    }

    /// The leading truck under a carbody at rest, at `speed`, m/s: its coordinates' numbers in the model,
    /// and its equations of motion, whose damping is that at `speed`. The trailing truck has the same.
    pub fn one_truck(&self, speed: f64) -> (Vec<usize>, LinearSystem) {
        parts::one_alike(&self.forced.system, speed)
    }
}

impl<'a> Builder<'a> {
    /// In the report's form, truck roll prescribed.
    pub(super) fn on_rails(vehicle: &'a Vehicle, contact: Contact) -> Self {
        Self {
            vehicle,
            contact,
            model: Model::default(),
            q: Coordinates::new(TruckRoll::Prescribed),
        }
    }
}

impl Builder<'_> {
    fn outputs(&self) -> Vec<Output> {
        let q = &self.q;
        let passenger = &self.vehicle.passenger;
        let (x, h) = (
            passenger.longitudinal_offset,
            passenger.height_above_carbody_cg,
        );
        let d_p = self.vehicle.truck.half_primary_spacing;
        let acceleration =
            [0.0, x, -x].map(|x| Output::acceleration(q.y_c() + x * q.psi_c() - h * q.phi_c()));
        let roll = Output::acceleration(q.phi_c());
        let secondary = (0..2).map(|j| Output::displacement(self.secondary_lateral_stretch(j)));
        let primary = (0..4).map(|i| Output::displacement(self.primary_lateral_stretch(i)));
        let excursion = (0..4).map(|i| Output::displacement(self.excursion(i)));
        let longitudinal =
            (0..4).map(|i| Output::displacement(d_p * (q.psi_t(i / 2) - q.psi_w(i))));
        acceleration
            .into_iter()
            .chain([roll])
            .chain(secondary)
            .chain(primary)
            .chain(excursion)
            .chain(longitudinal)
            .collect()
    }

    /// e, excursion of wheelset `i` from the track centre line at its contact points.
    fn excursion(&self, i: usize) -> Row {
        let q = &self.q;
        let e = q.y_w(i) - q.y_a(i);
        match self.model.crosslevel {
            Crosslevel::Roll => e,
            Crosslevel::Contact => e + self.vehicle.wheelset.rolling_radius * q.phi_x(i),
        }
    }

    /// φ_w = φ_x + (a11/a) e, roll of wheelset `i` prescribed by the rails.
    fn wheelset_roll(&self, i: usize) -> Row {
        let a = self.vehicle.wheelset.half_contact_distance;
        self.q.phi_x(i) + self.contact.a11 / a * self.excursion(i)
    }

    /// φ_t of truck `j`: its coordinate, or the mean of its wheelsets' roll (3.4.4.1).
    fn truck_roll(&self, j: usize) -> Row {
        self.q
            .phi_t(j)
            .unwrap_or_else(|| 0.5 * (self.wheelset_roll(2 * j) + self.wheelset_roll(2 * j + 1)))
    }
}
