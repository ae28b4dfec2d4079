//! The vehicle in one steady curve.

use super::{Limit, status::CurveStatus};
use crate::{
    case::Case,
    dynamics::{
        curving::{Breakaway, CurvingError, CurvingModel, Side, WheelForces},
        element::Name,
        suspension::{PRIMARY_LATERAL, SECONDARY_LATERAL},
    },
    track::curvature_of_degree,
};

/// The vehicle in one curve.
#[derive(Debug, Clone)]
pub struct CurvingState {
    /// D, degrees.
    pub degree: f64,
    /// φ_d, rad.
    pub cant_deficiency: f64,
    /// y_w of wheelsets 1–4, m, outward positive.
    pub wheelset_lateral: [f64; 4],
    /// ψ_w of wheelsets 1–4 from the radial line, rad.
    pub wheelset_yaw: [f64; 4],
    /// y_t of trucks 1, 2, m.
    pub truck_lateral: [f64; 2],
    /// ψ_t of trucks 1, 2, rad.
    pub truck_yaw: [f64; 2],
    /// y_c, m; ψ_c, φ_c, rad.
    pub carbody: [f64; 3],
    /// Primary lateral strokes, wheelsets 1–4, m.
    pub primary_lateral_stroke: [f64; 4],
    /// Primary longitudinal strokes, wheelsets 1–4, m.
    pub primary_longitudinal_stroke: [f64; 4],
    /// Secondary lateral strokes, trucks 1, 2, m.
    pub secondary_lateral_stroke: [f64; 2],
    /// Torque of the secondary yaw element on each truck, N m.
    pub secondary_yaw_torque: [f64; 2],
    /// True if it is stuck or slips.
    pub breakaway: [Breakaway; 2],
    /// Forces on the wheels, [outer, inner] of wheelsets 1–4.
    pub wheels: [[WheelForces; 2]; 4],
    /// Ratios to the limits, in the order of [`Limit::ALL`]: |y_w| over the flange clearance, and
    /// the share of μN that a wheel uses.
    pub limit_ratios: [f64; 12],
    /// True if the linear model covers this curve. Where it does not, forces and strokes are its
    /// extrapolation, of use to a search only.
    pub status: CurveStatus,
}

impl CurvingState {
    /// State of a case in a curve of `degree` degrees at cant deficiency φ_d, rad.
    ///
    /// # Errors
    ///
    /// [`CurvingError`] if there is no steady-state solution.
    pub fn new(case: &Case, degree: f64, cant_deficiency: f64) -> Result<Self, CurvingError> {
        let model = CurvingModel::new(case, cant_deficiency)?;
        let clearance = case.wheel_rail.flange_clearance;
        Ok(Self::of(&model, clearance, degree, cant_deficiency))
    }

    /// State of a model built before for a cant deficiency, rad.
    pub fn of(
        model: &CurvingModel,
        flange_clearance: f64,
        degree: f64,
        cant_deficiency: f64,
    ) -> Self {
        let curvature = curvature_of_degree(degree);
        let segment = model.segment_at(curvature);
        let x = |index: usize| segment.displacement(index, curvature);
        let torque = [0, 1].map(|j| model.secondary_yaw(curvature, j).0);
        let wheels: [[WheelForces; 2]; 4] =
            std::array::from_fn(|i| Side::BOTH.map(|side| model.wheel_forces(curvature, i, side)));
        let limit_ratios = Limit::ALL.map(|limit| match limit {
            Limit::Flange(i) => x(i).abs() / flange_clearance,
            Limit::Slip(i, side) => wheels[i][side as usize].adhesion_used,
        });
        Self {
            degree,
            cant_deficiency,
            wheelset_lateral: std::array::from_fn(&x),
            wheelset_yaw: std::array::from_fn(|i| x(4 + i)),
            truck_lateral: std::array::from_fn(|j| x(8 + j)),
            truck_yaw: std::array::from_fn(|j| x(10 + j)),
            carbody: std::array::from_fn(|k| x(12 + k)),
            primary_lateral_stroke: std::array::from_fn(|i| {
                model.stretch_at(Name::of_wheelset(PRIMARY_LATERAL, i), curvature)
            }),
            primary_longitudinal_stroke: std::array::from_fn(|i| {
                model.primary_longitudinal_stroke(curvature, i)
            }),
            secondary_lateral_stroke: std::array::from_fn(|j| {
                model.stretch_at(Name::of_truck(SECONDARY_LATERAL, j), curvature)
            }),
            secondary_yaw_torque: torque,
            breakaway: segment.breakaway,
            wheels,
            limit_ratios,
            status: CurveStatus::of(model, flange_clearance, &limit_ratios),
        }
    }

    /// Largest L/V of any wheel.
    pub fn wheel_lateral_to_vertical(&self) -> f64 {
        self.wheels
            .iter()
            .flatten()
            .map(WheelForces::lateral_to_vertical)
            .fold(0.0, f64::max)
    }

    /// Sums of lateral and of vertical forces on some wheels, (wheelset, side), N.
    pub fn sums(&self, wheels: &[(usize, usize)]) -> [f64; 2] {
        let forces = wheels.iter().map(|&(i, side)| &self.wheels[i][side]);
        [
            forces.clone().map(|wheel| wheel.lateral).sum(),
            forces.map(|wheel| wheel.vertical).sum(),
        ]
    }

    /// (L1 + L2)/(V1 + V2) of one side of a truck, signed outward.
    pub fn truck_side(&self, truck: usize, side: Side) -> f64 {
        let [lateral, vertical] =
            self.sums(&[2 * truck, 2 * truck + 1].map(|i| (i, side as usize)));
        lateral / vertical
    }

    /// L/V of all truck sides, signed outward: outer and inner of truck 1, then of truck 2.
    pub fn truck_sides(&self) -> [f64; 4] {
        [
            (0, Side::Outer),
            (0, Side::Inner),
            (1, Side::Outer),
            (1, Side::Inner),
        ]
        .map(|(j, side)| self.truck_side(j, side))
    }

    /// Largest L/V of any truck side.
    pub fn truck_side_lateral_to_vertical(&self) -> f64 {
        self.truck_sides()
            .map(f64::abs)
            .into_iter()
            .fold(0.0, f64::max)
    }

    /// Net lateral force over vertical load of axle `i`.
    pub fn net_axle(&self, i: usize) -> f64 {
        let [lateral, vertical] = self.sums(&[(i, 0), (i, 1)]);
        lateral.abs() / vertical
    }

    /// Largest net axle L/V.
    pub fn net_axle_lateral_to_vertical(&self) -> f64 {
        (0..4).map(|i| self.net_axle(i)).fold(0.0, f64::max)
    }
}
