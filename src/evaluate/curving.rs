//! Limits of steady-state curving: flange contact and wheel slip (4.5.2, 3.3.3).

mod service;
mod state;
mod status;

pub use service::{ServiceCurve, level_curves};
pub use state::CurvingState;
pub use status::{AT_LIMIT, CurveStatus};

use crate::{
    case::Case,
    dynamics::curving::{CurvingError, CurvingModel, Segment, Side},
    track::{MAX_DEGREE, curvature_of_degree, degree_of_curvature},
};

/// Limit of the curves that a vehicle runs without flange contact or slip.
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
            Self::Slip(i, side) => write!(f, "slip, wheelset {} {side} wheel", i + 1),
        }
    }
}

/// A limit and the curve at which it is first met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitedCurve {
    /// D, degrees.
    pub degree: f64,
    /// Limit.
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
            (p, q, model.adhesion_limit(i, side))
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
