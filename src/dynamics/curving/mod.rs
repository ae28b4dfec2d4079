//! Steady-state curving, 15 degrees of freedom with Coulomb breakaway (3.4.5).
//!
//! Curve to the right, so outward is +y and the left wheel is the outer one. Coordinates are
//! relative to the local track centre line and radial line:
//!
//! ```math
//! q = [y_w1…4, ψ_w1…4, y_t1…2, ψ_t1…2, y_c, ψ_c, φ_c]
//! ```
//!
//! For a given state of the two secondary yaw elements (stuck or slipping) and a given cant
//! deficiency the equilibrium is affine in the curvature 1/R. So the whole response to curvature
//! is piecewise affine: one [`Segment`] per state that occurs.

mod equilibrium;
mod wheel;

pub use equilibrium::{Breakaway, CurvingError, Segment};
pub(crate) use wheel::Place;
pub use wheel::{Side, WheelForces};

use nalgebra::{DMatrix, DVector};

use super::lateral::{self, Coordinates};
use crate::{
    case::{Case, CurvingCreep},
    track::{MAX_DEGREE, curvature_of_degree},
    vehicle::{GRAVITY, Vehicle},
    wheel_rail::Contact,
};

/// The curving model of a case at one cant deficiency.
#[derive(Debug, Clone)]
pub struct CurvingModel {
    vehicle: Vehicle,
    friction: f64,
    /// Contact of outer and inner wheels.
    contact: [Contact; 2],
    /// Vertical load of outer and inner wheels, N.
    wheel_load: [f64; 2],
    q: Coordinates,
    /// Stiffness without the secondary yaw elements, N/m etc., 15 × 15.
    stiffness: DMatrix<f64>,
    /// Loads at zero curvature: cant deficiency and, with unequal wheels, their spin.
    load: DVector<f64>,
    /// Loads per unit curvature, without the secondary yaw elements.
    load_per_curvature: DVector<f64>,
    /// Response to curvature from tangent track to the tightest curve searched.
    segments: Vec<Segment>,
}

impl CurvingModel {
    /// Builds and solves the model of a case for cant deficiency φ_d, rad.
    ///
    /// # Errors
    ///
    /// [`CurvingError`] if the wheels on one side carry no load, the equations are singular or no
    /// state of the yaw elements is consistent.
    pub fn new(case: &Case, cant_deficiency: f64) -> Result<Self, CurvingError> {
        let mut model = Self::unsolved(case, cant_deficiency);
        let unloaded = |side: &Side| model.wheel_load[*side as usize] <= 0.0;
        if let Some(side) = Side::BOTH.into_iter().find(unloaded) {
            return Err(CurvingError::WheelLifted(side));
        }
        model.segments = model.solve(curvature_of_degree(MAX_DEGREE))?;
        Ok(model)
    }

    /// The equations alone.
    pub(crate) fn unsolved(case: &Case, cant_deficiency: f64) -> Self {
        // The yaw elements between trucks and carbody are added state by state.
        let mut vehicle = case.vehicle;
        vehicle.suspension.secondary.yaw_stiffness = 0.0;
        let contact = case.wheel_rail.contact();
        let (q, system) = lateral::suspension_on_rails(&vehicle, contact);
        let n = q.len();
        let transfer = load_transfer(&case.vehicle, cant_deficiency);
        let wheel_load = [1.0, -1.0].map(|s| case.vehicle.wheel_load() + s * transfer);
        let mut model = Self {
            vehicle: case.vehicle,
            friction: case.wheel_rail.friction,
            contact: wheel_load.map(|load| match case.model.curving_creep {
                CurvingCreep::Static => contact,
                CurvingCreep::LoadDependent => at_load(contact, load / case.vehicle.wheel_load()),
            }),
            wheel_load,
            q,
            stiffness: system.stiffness.columns(0, n).into_owned(),
            load: DVector::zeros(n),
            load_per_curvature: DVector::zeros(n),
            segments: Vec::new(),
        };
        model.add_weights(cant_deficiency);
        model.add_curved_track();
        for i in 0..4 {
            model.add_wheelset(i);
        }
        model
    }

    /// The piecewise affine response, in ascending curvature from zero without gaps.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// The segment that holds a curvature, 1/m.
    pub fn segment_at(&self, curvature: f64) -> &Segment {
        let i = self
            .segments
            .partition_point(|segment| segment.curvature[1] < curvature);
        &self.segments[i.min(self.segments.len() - 1)]
    }

    /// Body weights × cant deficiency, outward at each c.g.
    fn add_weights(&mut self, cant_deficiency: f64) {
        let vehicle = &self.vehicle;
        let mut add = |row: crate::dynamics::Row, mass: f64| {
            for &(i, c) in row.terms() {
                self.load[i] += c * mass * GRAVITY * cant_deficiency;
            }
        };
        for i in 0..4 {
            add(self.q.y_w(i), vehicle.wheelset.mass);
        }
        for j in 0..2 {
            add(self.q.y_t(j), vehicle.truck.mass);
        }
        add(self.q.y_c(), vehicle.carbody.mass);
    }

    /// Stretches that the curved centre line puts into the springs: primary lateral b²/(2R),
    /// primary yaw ±b/R, secondary lateral l_s²/(2R); upper sign for the leading one.
    fn add_curved_track(&mut self) {
        let vehicle = self.vehicle;
        let (primary, secondary) = (vehicle.suspension.primary, vehicle.suspension.secondary);
        let (b, l_s) = (
            vehicle.truck.half_wheelbase,
            vehicle.carbody.half_truck_spacing,
        );
        let d_p2 = vehicle.truck.half_primary_spacing.powi(2);
        let rows = lateral::Builder::on_rails(&vehicle, self.contact[0]);
        let mut add = |row: crate::dynamics::Row, force: f64| {
            for &(i, c) in row.terms() {
                self.load_per_curvature[i] -= c * force;
            }
        };
        for i in 0..4_usize {
            let sign = if i.is_multiple_of(2) { 1.0 } else { -1.0 };
            add(
                rows.primary_lateral_row(i),
                2.0 * primary.lateral_stiffness * b * b / 2.0,
            );
            add(
                self.q.psi_t(i / 2) - self.q.psi_w(i),
                2.0 * d_p2 * primary.longitudinal_stiffness * sign * b,
            );
        }
        for j in 0..2 {
            add(
                rows.secondary_lateral_row(j),
                2.0 * secondary.lateral_stiffness * l_s * l_s / 2.0,
            );
        }
    }
}

/// Load that every axle's outer wheel gains and its inner wheel loses, N.
///
/// ```math
/// ΔN = φ_d g [M_c (r0 + h_tp + h_ts + h_cs)/4 + M_t (r0 + h_tp)/2 + M_w r0] / (2a)
/// ```
fn load_transfer(vehicle: &Vehicle, cant_deficiency: f64) -> f64 {
    let (c, t, w) = (&vehicle.carbody, &vehicle.truck, &vehicle.wheelset);
    let truck_height = w.rolling_radius + t.height_above_primary;
    let carbody_height = truck_height + t.depth_below_secondary + c.height_above_secondary;
    let moment =
        c.mass * carbody_height / 4.0 + t.mass * truck_height / 2.0 + w.mass * w.rolling_radius;
    cant_deficiency * GRAVITY * moment / (2.0 * w.half_contact_distance)
}

/// Cant deficiency of either sign at which the load transfer takes a wheel's static load away,
/// ΔN = N, rad; infinite where no load is transferred.
pub fn lifting_cant_deficiency(vehicle: &Vehicle) -> f64 {
    vehicle.wheel_load() / load_transfer(vehicle, 1.0).abs()
}

/// Creep coefficients of a wheel whose load is `ratio` times its static one (3.4.5):
/// f11, f33 ∝ N^⅔, f12 ∝ N, f22 ∝ N^(4/3).
fn at_load(contact: Contact, ratio: f64) -> Contact {
    // A wheel without load has no creep forces; the model of such a vehicle is not solved.
    let ratio = ratio.max(0.0);
    Contact {
        f11: contact.f11 * ratio.powf(2.0 / 3.0),
        f12: contact.f12 * ratio,
        f22: contact.f22 * ratio.powf(4.0 / 3.0),
        f33: contact.f33 * ratio.powf(2.0 / 3.0),
        ..contact
    }
}
