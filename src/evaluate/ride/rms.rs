//! Ride on irregular track: RMS accelerations and strokes (3.2.1).

use super::{panels::response_panels, response::Response, rounding};
use crate::{
    case::Case,
    dynamics::{ForcedModel, ForcedTangent, LateralModel, VerticalModel, lateral, vertical},
    numerics::{
        EigenError, Poles,
        elimination::LANES,
        panels::divided,
        quadrature::{Integrals, integrate},
    },
};

/// Accuracy of mean squares, estimated error over value. Halving it changes RMS values by less than 1e-6.
const MEAN_SQUARE_TOLERANCE: f64 = 1e-6;

/// Reason why there is no stationary response.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NoRide {
    /// An oscillation grows without limit, or a coordinate drifts.
    #[error("unstable at the speed: there is no stationary response")]
    Unstable,
    /// A motion without oscillation grows.
    #[error("a motion without oscillation grows: there is no stationary response")]
    Diverges,
    /// An integral did not meet its tolerance, or rounding decides how high a resonance is.
    #[error("the random response did not converge")]
    NotConverged,
    /// The eigenvalues did not converge.
    #[error(transparent)]
    Poles(#[from] EigenError),
}

impl NoRide {
    /// Code in files.
    pub fn code(self) -> &'static str {
        match self {
            Self::Unstable => "unstable",
            Self::Diverges => "diverges",
            Self::NotConverged => "not-converged",
            Self::Poles(_) => "eigenvalues-not-converged",
        }
    }
}

/// Lateral ride of a stable vehicle.
#[derive(Debug, Clone, PartialEq)]
pub struct LateralRide {
    /// RMS acceleration at c.g., front, rear, m/s².
    pub acceleration: [f64; 3],
    /// RMS roll acceleration of the carbody, rad/s².
    pub roll_acceleration: f64,
    /// RMS secondary lateral stroke, leading and trailing truck, m.
    pub secondary_stroke: [f64; 2],
    /// RMS primary lateral stroke, wheelsets 1–4, m.
    pub primary_stroke: [f64; 4],
    /// RMS primary longitudinal stroke, wheelsets 1–4, m.
    pub longitudinal_stroke: [f64; 4],
    /// RMS wheelset excursion, wheelsets 1–4, m.
    pub excursion: [f64; 4],
}

/// Vertical ride.
#[derive(Debug, Clone, PartialEq)]
pub struct VerticalRide {
    /// RMS acceleration at c.g., front, rear, m/s².
    pub acceleration: [f64; 3],
    /// RMS roll acceleration of the carbody, rad/s².
    pub roll_acceleration: f64,
    /// RMS secondary vertical stroke, leading and trailing truck, m.
    pub secondary_stroke: [f64; 2],
    /// RMS primary vertical stroke, wheelsets 1–4, m.
    pub primary_stroke: [f64; 4],
    /// RMS change of wheel load, wheelsets 1–4, N.
    pub wheel_load: [f64; 4],
}

/// Average of RMS values, the report's: over c.g., front and rear, or over the two ends.
pub fn average(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Check for a stationary response.
///
/// # Errors
///
/// [`NoRide`] with the reason why there is none.
pub fn stationary(model: &ForcedModel, poles: &Poles) -> Result<(), NoRide> {
    if poles.stable() {
        Ok(())
    } else if poles.diverge() {
        Err(NoRide::Diverges)
    } else if rounding::makes_grow(model, poles) {
        Err(NoRide::NotConverged)
    } else {
        Err(NoRide::Unstable)
    }
}

/// Integrals over panels between `edges`, Hz, of the densities of a response, of `further` functions
/// that `more` computes from the densities, and of the densities' derivatives by design constants.
pub(super) fn mean_squares(
    mut response: Response<'_>,
    case: &Case,
    poles: &Poles,
    edges: &[f64],
    further: usize,
    more: impl Fn(&[f64; LANES], &mut [[f64; LANES]]),
) -> Result<Integrals, NoRide> {
    let outputs = response.outputs();
    let checked = outputs + further;
    let functions = [checked + outputs * response.constants(), checked];
    let integrals = integrate(edges, functions, MEAN_SQUARE_TOLERANCE, |f, values| {
        let (values, derivatives) = values.split_at_mut(checked);
        response.with_derivatives(f, &mut values[..outputs], derivatives);
        more(f, values);
    });
    let (model, range) = (response.model(), response.range());
    let total = |k: usize| integrals.total(k);
    if !integrals.converged || rounding::decides(model, case, poles, range, total) {
        return Err(NoRide::NotConverged);
    }
    Ok(integrals)
}

/// Mean squares of one output of a model between consecutive `edges`, Hz.
///
/// # Errors
///
/// [`NoRide`] where there are none.
pub(crate) fn mean_squares_between(
    model: &ForcedModel,
    case: &Case,
    output: usize,
    edges: &[f64],
) -> Result<Vec<f64>, NoRide> {
    let poles = Poles::at(model, case.service.speed)?;
    stationary(model, &poles)?;
    let outputs = output..output + 1;
    let response = Response::of(model, &case.service.track, case.service.speed, outputs);
    let panels = divided(response_panels(model, case, &poles), edges);
    let integrals = mean_squares(response, case, &poles, &panels, 0, |_, _| ())?;
    let between = edges
        .windows(2)
        .map(|ends| integrals.between(&panels, [ends[0], ends[1]], 0));
    Ok(between.collect())
}

/// Change of an RMS value with that of its square; zero at an RMS value of zero.
pub(super) fn rms_change(rms: f64, of_square: f64) -> f64 {
    of_square / (2.0 * rms).max(f64::MIN_POSITIVE)
}

/// RMS values of all outputs of a model and their derivatives by the constants of some tangents, each
/// arranged by `of`.
fn rms<T>(
    model: &ForcedModel,
    case: &Case,
    poles: &Poles,
    tangents: &[ForcedTangent],
    of: fn(&[f64]) -> T,
) -> Result<(T, Vec<T>), NoRide> {
    stationary(model, poles)?;
    let outputs = model.outputs.len();
    let response = Response::new(model, &case.service.track, case.service.speed);
    let response = response.with_tangents(tangents);
    let edges = response_panels(model, case, poles);
    let integrals = mean_squares(response, case, poles, &edges, 0, |_, _| ())?;
    let rms: Vec<f64> = (0..outputs).map(|k| integrals.total(k).sqrt()).collect();
    let derivatives = (1..=tangents.len()).map(|p| {
        let of_constant = rms.iter().enumerate();
        let change = |(k, rms): (usize, &f64)| rms_change(*rms, integrals.total(p * outputs + k));
        of(&of_constant.map(change).collect::<Vec<f64>>())
    });
    let derivatives = derivatives.collect();
    Ok((of(&rms), derivatives))
}

/// RMS values of a range of outputs.
fn array<const N: usize>(rms: &[f64], outputs: std::ops::Range<usize>) -> [f64; N] {
    std::array::from_fn(|i| rms[outputs.start + i])
}

/// Constructors and averages that the lateral and the vertical ride share.
macro_rules! ride {
    ($ride:ident of $model:ident) => {
        impl $ride {
            /// Ride of a case.
            ///
            /// # Errors
            ///
            /// [`NoRide`] where there is no stationary response.
            pub fn new(model: &$model, case: &Case) -> Result<Self, NoRide> {
                let poles = Poles::at(&model.forced, case.service.speed)?;
                Self::from_poles(model, case, &poles)
            }

            /// Ride of a case whose poles at the operating speed are known.
            ///
            /// # Errors
            ///
            /// [`NoRide`] where there is no stationary response.
            pub fn from_poles(model: &$model, case: &Case, poles: &Poles) -> Result<Self, NoRide> {
                Self::with_derivatives(model, case, poles, &[]).map(|(ride, _)| ride)
            }

            /// Ride, and the derivatives of all values by the constants of some tangents.
            ///
            /// # Errors
            ///
            /// [`NoRide`] where there is no stationary response.
            pub fn with_derivatives(
                model: &$model,
                case: &Case,
                poles: &Poles,
                tangents: &[ForcedTangent],
            ) -> Result<(Self, Vec<Self>), NoRide> {
                rms(&model.forced, case, poles, tangents, Self::of)
            }

            /// ACC: RMS acceleration averaged over the three points, m/s².
            pub fn average_acceleration(&self) -> f64 {
                average(&self.acceleration)
            }

            /// ST: RMS secondary stroke averaged over the two trucks, m.
            pub fn average_stroke(&self) -> f64 {
                average(&self.secondary_stroke)
            }
        }
    };
}

ride!(LateralRide of LateralModel);
ride!(VerticalRide of VerticalModel);

impl LateralRide {
    /// From RMS values in the order of the model's outputs.
    fn of(rms: &[f64]) -> Self {
        use lateral::output::{
            ACCELERATION, EXCURSION, LONGITUDINAL_STROKE, PRIMARY_STROKE, ROLL_ACCELERATION,
            SECONDARY_STROKE,
        };
        Self {
            acceleration: array(rms, ACCELERATION),
            roll_acceleration: rms[ROLL_ACCELERATION],
            secondary_stroke: array(rms, SECONDARY_STROKE),
            primary_stroke: array(rms, PRIMARY_STROKE),
            longitudinal_stroke: array(rms, LONGITUDINAL_STROKE),
            excursion: array(rms, EXCURSION),
        }
    }
}

impl VerticalRide {
    /// From RMS values in the order of the model's outputs.
    fn of(rms: &[f64]) -> Self {
        use vertical::output::{
            ACCELERATION, PRIMARY_STROKE, ROLL_ACCELERATION, SECONDARY_STROKE, WHEEL_LOAD,
        };
        Self {
            acceleration: array(rms, ACCELERATION),
            roll_acceleration: rms[ROLL_ACCELERATION],
            secondary_stroke: array(rms, SECONDARY_STROKE),
            primary_stroke: array(rms, PRIMARY_STROKE),
            wheel_load: array(rms, WHEEL_LOAD),
        }
    }
}
