//! Limits of steady-state curving: flange contact and wheel slip (4.5.2, 3.3.3).

use crate::{
    case::Case,
    dynamics::curving::{Breakaway, CurvingError, CurvingModel, Segment, Side, WheelForces},
    track::{MAX_DEGREE, curvature_of_degree, degree_of_curvature},
};

/// What ends the range of curves that a vehicle runs without flange contact or slip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    /// |y_w| of a wheelset (0–3) reaches the flange clearance.
    Flange(usize),
    /// The resultant creep force of a wheel reaches μN.
    Slip(usize, Side),
}

impl std::fmt::Display for Limit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Flange(i) => write!(f, "flange contact, wheelset {}", i + 1),
            Self::Slip(i, Side::Outer) => write!(f, "slip, wheelset {} outer wheel", i + 1),
            Self::Slip(i, Side::Inner) => write!(f, "slip, wheelset {} inner wheel", i + 1),
        }
    }
}

/// A limit and the curve at which it is first met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitedCurve {
    /// D, degrees.
    pub degree: f64,
    /// What limits.
    pub limit: Limit,
    /// Share of μN that the other wheel of the limiting wheelset has left.
    pub other_wheel_reserve: f64,
}

/// The tightest curves at one cant deficiency.
#[derive(Debug, Clone)]
pub struct CurvingLimits {
    /// φ_d, rad.
    pub cant_deficiency: f64,
    /// First curve of each of the four flange and eight slip limits, degrees; `None`: not met up
    /// to [`MAX_DEGREE`]. In the order of [`Limit::ALL`].
    pub pieces: [Option<f64>; 12],
    /// Smallest flange-limited curve; `None`: no flange contact up to [`MAX_DEGREE`].
    pub flange: Option<LimitedCurve>,
    /// Smallest slip-limited curve; `None`: no slip up to [`MAX_DEGREE`].
    pub slip: Option<LimitedCurve>,
}

impl Limit {
    /// All limits: flange of wheelsets 1–4, then slip of outer and inner wheel of each.
    pub const ALL: [Self; 12] = [
        Self::Flange(0),
        Self::Flange(1),
        Self::Flange(2),
        Self::Flange(3),
        Self::Slip(0, Side::Outer),
        Self::Slip(0, Side::Inner),
        Self::Slip(1, Side::Outer),
        Self::Slip(1, Side::Inner),
        Self::Slip(2, Side::Outer),
        Self::Slip(2, Side::Inner),
        Self::Slip(3, Side::Outer),
        Self::Slip(3, Side::Inner),
    ];
}

impl CurvingLimits {
    /// Limits of a case at cant deficiency φ_d, rad.
    ///
    /// # Errors
    ///
    /// [`CurvingError`] if there is no steady-state solution.
    pub fn new(case: &Case, cant_deficiency: f64) -> Result<Self, CurvingError> {
        let model = CurvingModel::new(case, cant_deficiency)?;
        Ok(Self::of(
            &model,
            case.wheel_rail.flange_clearance,
            cant_deficiency,
        ))
    }

    /// Limits of a model built before.
    pub fn of(model: &CurvingModel, flange_clearance: f64, cant_deficiency: f64) -> Self {
        let pieces = Limit::ALL.map(|limit| {
            let curvature = first_exceedance(model, limit, flange_clearance)?;
            Some(degree_of_curvature(curvature))
        });
        let least = |flange: bool| {
            Limit::ALL
                .iter()
                .zip(pieces)
                .filter(|(limit, _)| matches!(limit, Limit::Flange(_)) == flange)
                .filter_map(|(&limit, degree)| Some((limit, degree?)))
                .min_by(|a, b| a.1.total_cmp(&b.1))
                .map(|(limit, degree)| LimitedCurve {
                    degree,
                    limit,
                    other_wheel_reserve: reserve(model, limit, curvature_of_degree(degree)),
                })
        };
        Self {
            cant_deficiency,
            pieces,
            flange: least(true),
            slip: least(false),
        }
    }

    /// The smaller of the two; `None`: no limit up to [`MAX_DEGREE`].
    pub fn governing(&self) -> Option<LimitedCurve> {
        [self.flange, self.slip]
            .into_iter()
            .flatten()
            .min_by(|a, b| a.degree.total_cmp(&b.degree))
    }

    /// Degree curve D: that of the governing limit, or [`MAX_DEGREE`] where there is none.
    pub fn degree(&self) -> f64 {
        self.governing()
            .map_or(MAX_DEGREE, |limited| limited.degree)
    }
}

/// Smallest curvature at which a limit is exceeded, 1/m.
///
/// On a segment a limit reads |P + κQ| ≤ c, a quadratic in κ: the curvatures within it are an
/// interval.
fn first_exceedance(model: &CurvingModel, limit: Limit, flange_clearance: f64) -> Option<f64> {
    for segment in model.segments() {
        let [low, high] = segment.curvature;
        let (p, q, c) = affine(model, segment, limit, flange_clearance);
        let square = q[0] * q[0] + q[1] * q[1];
        let cross = p[0] * q[0] + p[1] * q[1];
        let constant = p[0] * p[0] + p[1] * p[1] - c * c;
        let excess = |kappa: f64| constant + kappa * (2.0 * cross + kappa * square);
        if excess(low) > 0.0 {
            return Some(low);
        }
        if excess(high) > 0.0 {
            // The larger root, in the form without cancellation.
            let root = (cross * cross - square * constant).max(0.0).sqrt();
            let kappa = if cross > 0.0 {
                -constant / (cross + root)
            } else {
                (root - cross) / square
            };
            return Some(kappa.clamp(low, high));
        }
    }
    None
}

/// P, Q and c of a limit |P + κQ| ≤ c on a segment.
fn affine(
    model: &CurvingModel,
    segment: &Segment,
    limit: Limit,
    flange_clearance: f64,
) -> ([f64; 2], [f64; 2], f64) {
    match limit {
        Limit::Flange(i) => (
            [segment.at_zero[i], 0.0],
            [segment.per_curvature[i], 0.0],
            flange_clearance,
        ),
        Limit::Slip(i, side) => {
            let [p, q] = model.creep_forces(segment, i, side);
            (p, q, model.adhesion_limit(side))
        }
    }
}

/// Share of μN left at the other wheel of a slipping wheel's wheelset, or at the more loaded
/// wheel of a flanging wheelset.
fn reserve(model: &CurvingModel, limit: Limit, curvature: f64) -> f64 {
    let used = |i, side| model.wheel_forces(curvature, i, side).adhesion_used;
    match limit {
        Limit::Flange(i) => 1.0 - used(i, Side::Outer).max(used(i, Side::Inner)),
        Limit::Slip(i, Side::Outer) => 1.0 - used(i, Side::Inner),
        Limit::Slip(i, Side::Inner) => 1.0 - used(i, Side::Outer),
    }
}

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
    /// Whether it is stuck or slips.
    pub breakaway: [Breakaway; 2],
    /// Forces on the wheels, [outer, inner] of wheelsets 1–4.
    pub wheels: [[WheelForces; 2]; 4],
}

impl CurvingState {
    /// State of a case in a curve of `degree` degrees at cant deficiency φ_d, rad.
    ///
    /// # Errors
    ///
    /// [`CurvingError`] if there is no steady-state solution.
    pub fn new(case: &Case, degree: f64, cant_deficiency: f64) -> Result<Self, CurvingError> {
        let model = CurvingModel::new(case, cant_deficiency)?;
        let curvature = curvature_of_degree(degree);
        let segment = model.segment_at(curvature);
        let x = |index: usize| segment.displacement(index, curvature);
        let torque = [0, 1].map(|j| model.secondary_yaw(curvature, j).0);
        Ok(Self {
            degree,
            cant_deficiency,
            wheelset_lateral: std::array::from_fn(&x),
            wheelset_yaw: std::array::from_fn(|i| x(4 + i)),
            truck_lateral: std::array::from_fn(|j| x(8 + j)),
            truck_yaw: std::array::from_fn(|j| x(10 + j)),
            carbody: std::array::from_fn(|k| x(12 + k)),
            primary_lateral_stroke: std::array::from_fn(|i| {
                model.primary_lateral_stroke(curvature, i)
            }),
            primary_longitudinal_stroke: std::array::from_fn(|i| {
                model.primary_longitudinal_stroke(curvature, i)
            }),
            secondary_lateral_stroke: std::array::from_fn(|j| {
                model.secondary_lateral_stroke(curvature, j)
            }),
            secondary_yaw_torque: torque,
            breakaway: segment.breakaway,
            wheels: std::array::from_fn(|i| {
                Side::BOTH.map(|side| model.wheel_forces(curvature, i, side))
            }),
        })
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
