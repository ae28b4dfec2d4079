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

use super::{
    Row,
    element::{Element, Name},
    lateral::{self, Coordinates},
};
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
    /// Contact of outer and inner wheels, of the leading and the trailing truck.
    contact: [[Contact; 2]; 2],
    /// Vertical load of outer and inner wheels, N, of the leading and the trailing truck.
    wheel_load: [[f64; 2]; 2],
    q: Coordinates,
    /// Elements of the suspension with their stretch per unit of curvature, m² or rad m.
    elements: Vec<(Element, f64)>,
    /// Stiffness without the elements that may slip, N/m etc., 15 × 15.
    stiffness: DMatrix<f64>,
    /// Loads at zero curvature: cant deficiency and, with unequal wheels, their spin.
    load: DVector<f64>,
    /// Loads per unit curvature, without the elements that may slip.
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
        let loads = model.wheel_load;
        let unloaded = |side: &Side| loads.iter().any(|load| load[*side as usize] <= 0.0);
        if let Some(side) = Side::BOTH.into_iter().find(unloaded) {
            return Err(CurvingError::WheelLifted(side));
        }
        model.segments = model.solve(curvature_of_degree(MAX_DEGREE))?;
        Ok(model)
    }

    /// The equations alone.
    pub(crate) fn unsolved(case: &Case, cant_deficiency: f64) -> Self {
        let vehicle = &case.vehicle;
        let contact = case.wheel_rail.contact();
        let (q, elements) = lateral::suspension_on_rails(vehicle, contact);
        let n = q.massive();
        let with_offset = |element: Element| {
            let offset = q.offset_in_curve(&element.row, vehicle);
            (element, offset)
        };
        let mean = vehicle.wheel_load();
        let wheel_load = [0, 1].map(|j| {
            let (own, transfer) = (
                vehicle.axle_load_of(j) / 2.0,
                load_transfer(vehicle, j, cant_deficiency),
            );
            [1.0, -1.0].map(|s| own + s * transfer)
        });
        let contact = [0, 1].map(|j| {
            wheel_load[j].map(|load| match case.model.curving_creep {
                CurvingCreep::Static if vehicle.trailing.is_none() => contact,
                CurvingCreep::Static => contact.at_load(vehicle.axle_load_of(j) / 2.0 / mean),
                CurvingCreep::LoadDependent => contact.at_load(load / mean),
            })
        });
        let mut model = Self {
            vehicle: vehicle.clone(),
            friction: case.wheel_rail.friction,
            contact,
            wheel_load,
            elements: elements.into_iter().map(with_offset).collect(),
            q,
            stiffness: DMatrix::zeros(n, n),
            load: DVector::zeros(n),
            load_per_curvature: DVector::zeros(n),
            segments: Vec::new(),
        };
        model.add_suspension();
        model.add_weights(cant_deficiency);
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

    /// Place of wheelset `i` in displacements of the model, or in their change.
    pub(crate) fn place(&self, x: &DVector<f64>, i: usize) -> Place {
        let [y, psi] = self.q.wheelset(i).map(|index| x[index]);
        Place { y, psi }
    }

    /// Body weights × cant deficiency, outward at each c.g.
    fn add_weights(&mut self, cant_deficiency: f64) {
        let masses = self.q.masses(&self.vehicle);
        for (index, mass) in masses.into_iter().enumerate().take(self.load.len()) {
            if self.q.coordinate(index).is_lateral() {
                self.load[index] += mass * GRAVITY * cant_deficiency;
            }
        }
    }

    /// Elements that never slip: their stiffness, and the stretch that the curved centre line puts into them.
    /// Dampers carry no steady load.
    fn add_suspension(&mut self) {
        let n = self.load.len();
        let fixed = self.elements.iter().filter(|(e, _)| e.breakaway.is_none());
        for (element, offset) in fixed {
            let k = element.law.steady_stiffness();
            for &(i, row) in element.row.terms() {
                for &(j, stretch) in element.stretch.terms().iter().filter(|(j, _)| *j < n) {
                    self.stiffness[(i, j)] += k * row * stretch;
                }
                self.load_per_curvature[i] -= row * k * offset;
            }
        }
    }

    /// The element with a name and its stretch per unit of curvature.
    fn element(&self, name: Name) -> (&Element, f64) {
        let found = self
            .elements
            .iter()
            .find(|(element, _)| element.name == name);
        let (element, offset) = found.expect("an element of the lateral model");
        (element, *offset)
    }

    /// Stretch of an element for displacements of the model, m or rad, on smooth track at a curvature, 1/m.
    pub(crate) fn stretch(&self, name: Name, x: &DVector<f64>, curvature: f64) -> f64 {
        let (element, offset) = self.element(name);
        form(&element.stretch, x.len(), |i| x[i]) + curvature * offset
    }
}

/// Value of a linear form in the displacements of `n` coordinates, without inputs.
fn form(row: &Row, n: usize, displacement: impl Fn(usize) -> f64) -> f64 {
    let terms = row.terms().iter().filter(|(i, _)| *i < n);
    terms.map(|&(i, c)| c * displacement(i)).sum()
}

/// Load that the outer wheel of every axle of truck `j` gains and the inner wheel loses, N.
///
/// ```math
/// ΔN = φ_d g [M_c (r0 + h_tp + h_ts + h_cs)/4 + M_t (r0 + h_tp)/2 + M_w r0] / (2a)
/// ```
fn load_transfer(vehicle: &Vehicle, j: usize, cant_deficiency: f64) -> f64 {
    let wheelset = vehicle.wheelset_at(j);
    let (c, t, w) = (&vehicle.carbody, vehicle.truck_at(j), &wheelset);
    let truck_height = w.rolling_radius + t.height_above_primary;
    let carbody_height = truck_height + t.depth_below_secondary + c.height_above_secondary;
    let moment =
        c.mass * carbody_height / 4.0 + t.mass * truck_height / 2.0 + w.mass * w.rolling_radius;
    cant_deficiency * GRAVITY * moment / (2.0 * w.half_contact_distance)
}

/// Cant deficiency of either sign at which the load transfer takes a wheel's static load away,
/// ΔN = N, rad; infinite where no load is transferred.
pub fn lifting_cant_deficiency(vehicle: &Vehicle) -> f64 {
    let of = |j| vehicle.axle_load_of(j) / 2.0 / load_transfer(vehicle, j, 1.0).abs();
    f64::min(of(0), of(1))
}
