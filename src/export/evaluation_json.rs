//! An evaluation as JSON: SI throughout, the unit in the key.

use serde::Serialize;
use serde_json::{Map, Value, json};

use super::origin::sign;
use crate::{
    case::Case,
    evaluate::{
        Evaluation,
        checks::{Check, Verdict, checks},
        curving::{CurveStatus, LimitedCurve},
        modes::{KinematicMode, LateralMode, LateralModes, LateralShape, VerticalMode},
        ride::{NoRide, PassengerRide},
        stability::{Crossing, Stability},
    },
    spec,
};

/// Everything that `bogie evaluate --format json` writes.
pub fn evaluation(name: &str, case: &Case, evaluation: &Evaluation, warnings: &[String]) -> Value {
    let mut object = Map::new();
    sign(&mut object);
    object.insert("name".into(), json!(name));
    object.insert("speed_m_per_s".into(), json!(case.service.speed));
    object.insert("track".into(), json!(case.service.track.name));
    object.insert("track_source".into(), json!(case.service.track.source));
    object.insert("frequency_band_hz".into(), json!(case.model.frequency_band));
    object.extend(indices(case, evaluation));
    object.insert(
        "checks".into(),
        json!(
            checks(case, evaluation)
                .iter()
                .map(check)
                .collect::<Vec<_>>()
        ),
    );
    object.insert(
        "closed_forms".into(),
        super::cross_checks::json(case, evaluation),
    );
    object.insert("inputs_si".into(), inputs(case));
    object.insert("warnings".into(), json!(warnings));
    Value::Object(object)
}

/// The performance indices at the top level.
pub(super) fn indices(case: &Case, evaluation: &Evaluation) -> Map<String, Value> {
    let curving = evaluation.curving.as_ref().ok();
    let degree = |limited: Option<LimitedCurve>| limited.map(|l| l.degree);
    let modes = &evaluation.modes;
    let stroke_in_curve = evaluation.secondary_lateral_stroke_in_curve();
    let object = json!({
        "critical_speed_m_per_s": evaluation.stability.critical_speed(),
        "stability": stability(&evaluation.stability),
        "flange_limited_curve_deg": curving.and_then(|c| degree(c.flange)),
        "slip_limited_curve_deg": curving.and_then(|c| degree(c.slip)),
        "curving_status": match &evaluation.curving {
            Ok(_) => "solved".to_string(),
            Err(error) => error.to_string(),
        },
        "flange_limit": curving.and_then(|c| c.flange).map(|l| limited(&l)),
        "slip_limit": curving.and_then(|c| c.slip).map(|l| limited(&l)),
        "service_curve": service_curve(evaluation),
        "secondary_lateral_stroke_in_curve_m": stroke_in_curve.ok(),
        "secondary_lateral_stroke_in_curve_status": match stroke_in_curve {
            Ok(_) => CurveStatus::WithinModel.code(),
            Err(reason) => reason.code(),
        },
        "modes_at_speed": modes.oscillatory.iter().map(mode).collect::<Vec<_>>(),
        "real_eigenvalues_per_s": modes.real,
        "stable_at_speed": modes.stable(),
        "kinematic_mode": modes.kinematic.as_ref().map(kinematic_mode),
        "least_damped_mode": modes.least_damped().map(mode),
        "vertical_modes": evaluation.vertical_modes.iter().map(vertical_mode).collect::<Vec<_>>(),
        "lateral": lateral(evaluation),
        "lateral_status": ride_status(&evaluation.lateral),
        "lateral_status_text": ride_status_text(&evaluation.lateral),
        "vertical": vertical(evaluation),
        "vertical_status": ride_status(&evaluation.vertical),
        "vertical_status_text": ride_status_text(&evaluation.vertical),
        "axle_load_n": case.vehicle.axle_load(),
    });
    match object {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

/// Every numeric key of the spec with its value in force.
pub(super) fn inputs(case: &Case) -> Value {
    let pairs = spec::inputs_si(case);
    Value::Object(
        pairs
            .into_iter()
            .map(|(path, value)| (path.to_string(), json!(value)))
            .collect(),
    )
}

fn stability(found: &Stability) -> Value {
    let outcome = found.outcome();
    json!({
        "status": outcome.code(),
        "status_text": outcome.to_string(),
        "speeds_searched_m_per_s": found.range,
        "onsets": found.onsets.iter().map(onset).collect::<Vec<_>>(),
        "divergence_m_per_s": found.divergence,
    })
}

fn onset(onset: &Crossing) -> Value {
    json!({
        "speed_m_per_s": onset.speed,
        "frequency_hz": onset.frequency,
        "kind": onset.kind.to_string(),
    })
}

fn limited(l: &LimitedCurve) -> Value {
    json!({
        "degree_curve_deg": l.degree,
        "limit": l.limit.to_string(),
        "other_wheel_adhesion_left": l.other_wheel_reserve,
    })
}

pub(super) fn mode(m: &LateralMode) -> Value {
    json!({
        "frequency_hz": m.frequency,
        "damping_ratio": m.damping_ratio,
        "name": m.shape.to_string(),
        "carbody_energy_share": m.carbody_share,
    })
}

/// The carbody is at rest: it has no share in the energy.
pub(super) fn kinematic_mode(m: &KinematicMode) -> Value {
    json!({
        "frequency_hz": m.frequency,
        "damping_ratio": m.damping_ratio,
        "motion_damping_ratio": m.own_damping_ratio,
        "name": LateralShape::Kinematic.to_string(),
        "carbody_energy_share": 0.0,
    })
}

pub(super) fn vertical_mode(m: &VerticalMode) -> Value {
    json!({
        "frequency_hz": m.frequency,
        "damping_ratio": m.damping_ratio,
        "name": m.shape.to_string(),
    })
}

pub(super) fn modes(modes: &LateralModes) -> Vec<Value> {
    modes.oscillatory.iter().map(mode).collect()
}

fn points(points: &[PassengerRide; 3], of: impl Fn(&PassengerRide) -> f64) -> [f64; 3] {
    points.each_ref().map(of)
}

#[derive(Serialize)]
struct Bands {
    centre_hz: Vec<f64>,
    acceleration_rms_m_per_s2: [Vec<f64>; 3],
    reduced_comfort_1h_m_per_s2: Vec<Option<f64>>,
}

fn bands(points: &[PassengerRide; 3]) -> Bands {
    Bands {
        centre_hz: points[0].bands.iter().map(|b| b.centre).collect(),
        acceleration_rms_m_per_s2: points
            .each_ref()
            .map(|p| p.bands.iter().map(|b| b.acceleration).collect()),
        reduced_comfort_1h_m_per_s2: points[0].bands.iter().map(|b| b.boundary).collect(),
    }
}

/// Entries that both directions have; `weightings` are those of ISO 2631-1 and EN 12299.
fn passengers(
    ride: &[PassengerRide; 3],
    average: f64,
    weightings: [&str; 2],
) -> Map<String, Value> {
    let [iso, en] = weightings;
    let mut object = Map::new();
    let mut insert = |key: String, value: Value| object.insert(key, value);
    insert(
        "acceleration_rms_m_per_s2".into(),
        json!(points(ride, |p| p.acceleration)),
    );
    insert("acceleration_average_m_per_s2".into(), json!(average));
    insert(
        format!("iso_2631_1_{iso}_rms_m_per_s2"),
        json!(points(ride, |p| p.iso_weighted)),
    );
    insert(
        format!("en_12299_{en}_rms_m_per_s2"),
        json!(points(ride, |p| p.en_weighted)),
    );
    insert("sperling_wz".into(), json!(points(ride, |p| p.w_z)));
    insert("third_octave_bands".into(), json!(bands(ride)));
    object
}

/// Why a ride is null, where it is: a code.
pub(super) fn ride_status<T>(ride: &Result<T, NoRide>) -> &'static str {
    match ride {
        Ok(_) => SOLVED,
        Err(reason) => reason.code(),
    }
}

/// The same in words.
pub(super) fn ride_status_text<T>(ride: &Result<T, NoRide>) -> String {
    match ride {
        Ok(_) => SOLVED.into(),
        Err(reason) => reason.to_string(),
    }
}

/// Status of what there is.
const SOLVED: &str = "solved";

/// Null where there is no stationary response.
fn lateral(evaluation: &Evaluation) -> Value {
    let (Ok(ride), Some(points)) = (&evaluation.lateral, &evaluation.lateral_passengers) else {
        return Value::Null;
    };
    let mut object = passengers(points, ride.average_acceleration(), ["wd", "wd"]);
    let mut insert = |key: &str, value: Value| object.insert(key.into(), value);
    insert("secondary_stroke_rms_m", json!(ride.secondary_stroke));
    insert("secondary_stroke_average_m", json!(ride.average_stroke()));
    insert("primary_stroke_rms_m", json!(ride.primary_stroke));
    insert(
        "primary_longitudinal_stroke_rms_m",
        json!(ride.longitudinal_stroke),
    );
    insert("wheelset_excursion_rms_m", json!(ride.excursion));
    insert(
        "roll_acceleration_rms_rad_per_s2",
        json!(ride.roll_acceleration),
    );
    insert("converged", json!(true));
    Value::Object(object)
}

fn vertical(evaluation: &Evaluation) -> Value {
    let (Ok(ride), Some(points)) = (&evaluation.vertical, &evaluation.vertical_passengers) else {
        return Value::Null;
    };
    let mut object = passengers(points, ride.average_acceleration(), ["wk", "wb"]);
    let mut insert = |key: &str, value: Value| object.insert(key.into(), value);
    insert("secondary_stroke_rms_m", json!(ride.secondary_stroke));
    insert("secondary_stroke_average_m", json!(ride.average_stroke()));
    insert("primary_stroke_rms_m", json!(ride.primary_stroke));
    insert("wheel_load_rms_n", json!(ride.wheel_load));
    insert(
        "roll_acceleration_rms_rad_per_s2",
        json!(ride.roll_acceleration),
    );
    insert("converged", json!(true));
    Value::Object(object)
}

pub(super) fn check(check: &Check) -> Value {
    let verdict = check.verdict();
    let mut object = json!({
        "name": check.name,
        "source": check.source,
        "value_si": check.value.ok(),
        "limit_si": check.limit,
        "relation": if check.at_least { "at least" } else { "at most" },
        "satisfied": match verdict {
            Verdict::Ok => Some(true),
            Verdict::Exceeded => Some(false),
            Verdict::NotAssessed => None,
        },
        "status": verdict.code(),
    });
    if let Err(status) = check.value {
        object["value_status"] = json!(status.code());
    }
    object
}

/// Which curve the service has, and whether the model covers it.
fn service_curve(evaluation: &Evaluation) -> Value {
    match &evaluation.service_curve {
        Ok(curve) => {
            let mut object = json!({
                "degree_curve_deg": curve.degree,
                "cant_deficiency_rad": curve.cant_deficiency,
                "given": curve.is_given,
                "status": curve.status.code(),
            });
            if let Some((limit, ratio)) = curve.status.exceeded() {
                object["limit"] = json!(limit.to_string());
                object["ratio"] = json!(ratio);
            }
            object
        }
        Err(error) => json!({ "status": error.to_string() }),
    }
}
