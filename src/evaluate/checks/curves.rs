//! L/V and quasi-static strokes in a curve against the limits of 3.3.3 and 3.3.4.
//!
//! L/V is that in the service curve: the one given, or the tightest run without flange contact or slip
//! at zero cant deficiency. Quasi-static strokes belong to the cant deficiency of the service; where
//! none is given, to the FRA's 3 in (3.2-2), in the curve given or the tightest run there.

use super::{Check, NotAssessed, at_most};
use crate::{
    case::Case,
    dynamics::curving::CurvingModel,
    evaluate::{
        Evaluation,
        curving::{CurveStatus, CurvingLimits, CurvingState, ServiceCurve},
        limits,
        stroke_in_curve::NoStroke,
    },
    track::SUPERELEVATION_BASE,
    units::Quantity,
};

/// A curve and the vehicle in it.
struct Judged {
    /// Name of the curve.
    place: String,
    /// The vehicle; its status where the model does not cover it.
    state: Result<CurvingState, CurveStatus>,
}

impl Judged {
    fn new(
        is_given: bool,
        degree: f64,
        cant_deficiency: &str,
        state: Result<CurvingState, CurveStatus>,
    ) -> Self {
        let which = if is_given { "service" } else { "tightest" };
        Self {
            place: format!("{which} curve, {degree:.2}° at {cant_deficiency} cant deficiency"),
            state,
        }
    }

    fn service(curve: &ServiceCurve) -> Self {
        let cant_deficiency = match curve.cant_deficiency {
            0.0 => "zero".to_owned(),
            angle => format!("{:.2}°", angle.to_degrees()),
        };
        Self::new(
            curve.is_given,
            curve.degree,
            &cant_deficiency,
            curve.covered().cloned(),
        )
    }

    /// At the FRA's cant deficiency. `None` if there is no steady-state solution.
    fn fra(case: &Case) -> Option<Self> {
        let angle = limits::CANT_DEFICIENCY / SUPERELEVATION_BASE;
        let clearance = case.wheel_rail.flange_clearance;
        let given = case.service.curve.map(f64::to_degrees);
        let model = CurveStatus::or_lifted(CurvingModel::new(case, angle)).ok()?;
        let (degree, state) = match model {
            Ok(model) => {
                let tightest = || CurvingLimits::of(&model, clearance, angle).degree();
                let degree = given.unwrap_or_else(tightest);
                let state = CurvingState::of(&model, clearance, degree, angle);
                let covered = match state.status {
                    CurveStatus::WithinModel => Ok(state),
                    status => Err(status),
                };
                (degree, covered)
            }
            Err(lifted) => (given.unwrap_or(0.0), Err(lifted)),
        };
        Some(Self::new(given.is_some(), degree, "3 in", state))
    }

    /// A check of a value in it.
    fn check(
        &self,
        name: &str,
        source: &'static str,
        quantity: Quantity,
        of: impl Fn(&CurvingState) -> f64,
        limit: f64,
    ) -> Check {
        let name = format!("{name}, {}", self.place);
        Check {
            value: self
                .state
                .as_ref()
                .map(of)
                .map_err(|s| NotAssessed::Curve(*s)),
            ..at_most(name, source, quantity, 0.0, limit)
        }
    }
}

/// L/V in the service curve.
pub(super) fn forces(list: &mut Vec<Check>, evaluation: &Evaluation) {
    let Ok(curve) = &evaluation.service_curve else {
        return;
    };
    let judged = Judged::service(curve);
    let mut force = |name, of: fn(&CurvingState) -> f64, limit| {
        list.push(judged.check(name, "3.3.3", Quantity::Dimensionless, of, limit));
    };
    force(
        "L/V leading outer wheel",
        |state| state.wheels[0][0].lateral_to_vertical(),
        limits::WHEEL_L_OVER_V,
    );
    force(
        "L/V truck side",
        CurvingState::truck_side_lateral_to_vertical,
        limits::TRUCK_SIDE_L_OVER_V,
    );
    force(
        "net axle L/V",
        CurvingState::net_axle_lateral_to_vertical,
        limits::NET_AXLE_L_OVER_V,
    );
}

/// Quasi-static strokes, and with them the random one of the secondary springs in a curve given.
pub(super) fn strokes(list: &mut Vec<Check>, case: &Case, evaluation: &Evaluation) {
    let Ok(curve) = &evaluation.service_curve else {
        return;
    };
    let judged = match case.service.cant_deficiency {
        Some(_) => Some(Judged::service(curve)),
        None => Judged::fra(case),
    };
    let mut stroke = |name, of: fn(&CurvingState) -> f64, limit| {
        let check = |judged: &Judged| judged.check(name, "3.3.4", Quantity::Stroke, of, limit);
        list.extend(judged.as_ref().map(check));
    };
    stroke(
        "primary lateral stroke",
        |state| largest(&state.primary_lateral_stroke),
        limits::PRIMARY_STOP,
    );
    stroke(
        "primary longitudinal stroke",
        |state| largest(&state.primary_longitudinal_stroke),
        limits::PRIMARY_STOP,
    );
    stroke(
        "secondary lateral stroke",
        |state| largest(&state.secondary_lateral_stroke),
        limits::SECONDARY_STOP,
    );
    let value = match evaluation.secondary_lateral_stroke_in_curve() {
        Ok(strokes) => Ok(largest(&strokes)),
        Err(NoStroke::NotCovered(status)) => Err(NotAssessed::Curve(status)),
        Err(NoStroke::NoRide(reason)) => Err(NotAssessed::Ride(reason)),
        Err(NoStroke::NotAsked | NoStroke::NoCurve(_)) => return,
    };
    let name = format!(
        "secondary lateral stroke with 3σ, {}",
        Judged::service(curve).place
    );
    let limit = limits::SECONDARY_STOP;
    list.push(Check {
        value,
        ..at_most(name, "3.3.4", Quantity::Stroke, 0.0, limit)
    });
}

fn largest(strokes: &[f64]) -> f64 {
    strokes.iter().fold(0.0, |m: f64, s| m.max(s.abs()))
}
