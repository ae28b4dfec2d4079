//! A finished design as JSON: SI throughout, the unit in the key.

use serde_json::{Map, Value, json};

use super::{design_text::status, evaluation_json};
use crate::{
    design::{
        form::form,
        outcome::{Alternative, Bound, DesignResult, StageResult},
    },
    evaluate::checks::checks,
    spec::{DesignSpace, Limits, Requirements},
};

/// Everything that `bogie optimize --format json` writes.
pub fn design(
    name: &str,
    result: &DesignResult,
    space: &DesignSpace,
    requirements: &Requirements,
    limits: &Limits,
    warnings: &[String],
) -> Value {
    let mut object = Map::new();
    object.insert(
        "program".into(),
        json!(concat!("bogie ", env!("CARGO_PKG_VERSION"))),
    );
    object.insert("name".into(), json!(name));
    object.insert("seed".into(), json!(space.seed));
    object.insert("requirements_met".into(), json!(result.unmet.is_empty()));
    object.insert(
        "unmet".into(),
        json!(
            result
                .unmet
                .iter()
                .map(|u| json!({
                    "key": u.key,
                    "required_si": u.required,
                    "reached_si": u.reached,
                }))
                .collect::<Vec<_>>()
        ),
    );
    object.insert("coupling_rounds".into(), json!(result.rounds));
    object.insert("coupling_settled".into(), json!(result.settled));
    object.insert(
        "trade_offs".into(),
        json!(result.stages.iter().map(stage).collect::<Vec<_>>()),
    );
    object.insert("design_si".into(), evaluation_json::inputs(&result.case));
    object.insert("speed_m_per_s".into(), json!(result.case.service.speed));
    object.insert("track".into(), json!(result.case.service.track.name));
    object.extend(evaluation_json::indices(&result.case, &result.evaluation));
    object.insert(
        "checks".into(),
        json!(
            checks(&result.case, &result.evaluation)
                .iter()
                .map(evaluation_json::check)
                .collect::<Vec<_>>()
        ),
    );
    object.insert(
        "as_given".into(),
        Value::Object(evaluation_json::indices(&result.case, &result.before)),
    );
    object.insert(
        "half_kalker".into(),
        Value::Object(evaluation_json::indices(&result.case, &result.half_kalker)),
    );
    object.insert(
        "design_form".into(),
        json!(
            form(result, requirements, limits)
                .iter()
                .map(|line| json!({
                    "step": line.step,
                    "entry": line.text,
                    "symbol": line.symbol,
                    "value_si": line.value,
                }))
                .collect::<Vec<_>>()
        ),
    );
    object.insert("warnings".into(), json!(warnings));
    Value::Object(object)
}

fn stage(stage: &StageResult) -> Value {
    json!({
        "trade_off": stage.stage.to_string(),
        "goal": stage.goal,
        "status": status(stage.status),
        "kkt_residual": stage.kkt_residual,
        "evaluations": stage.evaluations,
        "failed_evaluations": stage.failed,
        "variables": stage.chosen.iter().map(|c| json!({
            "name": c.variable.name,
            "symbol": c.variable.symbol,
            "value_si": c.value,
            "bounds_si": c.variable.bounds,
            "at_bound": c.at_bound.map(|b| match b {
                Bound::Lower => "lower",
                Bound::Upper => "upper",
            }),
        })).collect::<Vec<_>>(),
        "active": stage.active,
        "profiles": stage.alternatives.iter().map(alternative).collect::<Vec<_>>(),
    })
}

fn alternative(a: &Alternative) -> Value {
    json!({
        "conicity": a.conicity,
        "status": status(a.status),
        "critical_speed_m_per_s": a.critical_speed,
        "degree_curve_deg": a.degree,
        "bending_stiffness_n_m_per_rad": a.bending_stiffness,
        "lateral_stiffness_n_per_m": a.lateral_stiffness,
    })
}
