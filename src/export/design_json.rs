//! A finished design as JSON: SI throughout, the unit in the key. What is here depends on the spec
//! alone: no times, nothing of the machine.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};

use super::{evaluation_json, origin::sign, status};
use crate::{
    design::{
        explain::{Bound, Chosen, Explained, LocalOptimum},
        form::form,
        freedom::{End, EndKind, Loss},
        margin::{Margin, Verdict},
        outcome::{Delivered, DesignResult, Profile, StageResult},
        price::Price,
        sensitivity::Sensitivity,
    },
    evaluate::{checks::checks, curving::CurveStatus},
    index::Index,
    optimize::{archive::Stop, certificate::Curvature, problem::Failure},
    spec::Spec,
};

/// Everything that `bogie optimize --format json` writes.
pub fn design(
    name: &str,
    result: &DesignResult,
    spec: &Spec,
    digest: &str,
    matters: Option<&Sensitivity>,
    warnings: &[String],
) -> Value {
    let mut object = Map::new();
    sign(&mut object);
    let mut insert = |key: &str, value: Value| object.insert(key.into(), value);
    insert("name", json!(name));
    insert("spec_sha256", json!(digest));
    insert("seed", json!(spec.design.seed));
    insert("status", json!(status::of_run(result)));
    insert("requirements_met", json!(result.met()));
    insert(
        "delivered",
        json!(match result.delivered {
            Delivered::InTurn => "in-turn",
            Delivered::AllAtOnce => "all-at-once",
            Delivered::AsGiven => "as-given",
        }),
    );
    insert("prefer", json!(spec.design.prefer.name()));
    insert("deliver_within", json!(spec.design.deliver_within));
    insert("is_optimum", json!(result.is_optimum()));
    insert("loss", json!(result.loss()));
    insert("losses", result.losses.iter().map(loss).collect());
    insert("stopped", json!(result.stopped.map(Stop::code)));
    insert(
        "stopped_text",
        json!(result.stopped.map(|stop| stop.to_string())),
    );
    let unmet: Vec<Value> = result.unmet().map(margin).collect();
    insert("unmet", json!(unmet));
    insert("margins", result.margins.iter().map(margin).collect());
    insert("conflict", conflict(result));
    insert("coupling_rounds", json!(result.rounds));
    insert("coupling_settled", json!(result.settled));
    let stages = result.stages.iter().map(|stage| {
        let delivered = result
            .delivered_stages()
            .any(|own| std::ptr::eq(own, stage));
        solution(stage, delivered.then_some((result, spec)))
    });
    insert("trade_offs", stages.collect());
    insert("joint", joint(result, spec));
    insert("evaluations", json!(result.effort.evaluations));
    insert("failed_evaluations", failures_of(&result.effort.failures));
    insert("design_si", evaluation_json::inputs(&result.case));
    insert("optimum_si", evaluation_json::inputs(&result.optimum));
    insert("speed_m_per_s", json!(result.case.service.speed));
    insert("track", json!(result.case.service.track.name));
    object.extend(evaluation_json::indices(&result.case, &result.evaluation));
    let mut insert = |key: &str, value: Value| object.insert(key.into(), value);
    let checks = checks(&result.case, &result.evaluation);
    insert(
        "checks",
        checks.iter().map(evaluation_json::check).collect(),
    );
    insert(
        "as_given",
        Value::Object(evaluation_json::indices(&result.case, &result.before)),
    );
    insert(
        "half_kalker",
        Value::Object(evaluation_json::indices(&result.case, &result.half_kalker)),
    );
    let conditions = result.conditions.iter().map(|c| {
        let mut indices = evaluation_json::indices(&c.case, &c.evaluation);
        indices.insert("condition".into(), json!(c.name));
        Value::Object(indices)
    });
    insert("conditions", conditions.collect());
    let lines = form(result, &spec.demands);
    let lines = lines.iter().map(|line| {
        json!({
            "step": line.step,
            "entry": line.text,
            "symbol": line.symbol,
            "value_si": line.value,
        })
    });
    insert("design_form", lines.collect());
    insert(
        "sensitivity",
        matters.map_or(Value::Null, |m| super::sensitivity::json(name, m)),
    );
    insert("warnings", json!(warnings));
    Value::Object(object)
}

fn margin(margin: &Margin) -> Value {
    let exceeded = margin.curve.and_then(CurveStatus::exceeded);
    json!({
        "key": margin.key(),
        "condition": margin.condition,
        "required_si": margin.required,
        "reached_si": margin.reached.as_ref().ok(),
        "failure": margin.reached.as_ref().err(),
        "exceeded_limit": exceeded.map(|(limit, _)| limit.to_string()),
        "exceeded_limit_ratio": exceeded.map(|(_, ratio)| ratio),
        "largest_limit_ratio": margin.curve_ratio,
        "met": margin.met(),
        "verdict": match margin.verdict() {
            Verdict::Met => "met",
            Verdict::NotMet => "not-met",
            Verdict::NotAssessed => "not-assessed",
        },
    })
}

pub(super) fn failures_of(failures: &BTreeMap<Failure, usize>) -> Value {
    let failures = failures.iter();
    failures
        .map(|(failure, count)| {
            let name = serde_json::to_value(failure).unwrap_or_default();
            json!({ "reason": name, "count": count })
        })
        .collect()
}

fn loss(loss: &Loss) -> Value {
    json!({
        "goal": loss.goal,
        "index": loss.index.map(Index::name),
        "share": loss.share,
    })
}

/// A solved stage, with what is delivered of it where it led to the design delivered.
fn solution(stage: &StageResult, delivered: Option<(&DesignResult, &Spec)>) -> Value {
    let Explained {
        goal,
        objective,
        merit,
        chosen,
        active,
        prices,
        effort,
        coverage,
        ..
    } = &stage.explained;
    json!({
        "trade_off": stage.trade_off.map_or_else(|| "all at once".into(), |t| t.to_string()),
        "goal": goal,
        "objective": objective.map(|objective| json!({
            "index": objective.index.name(),
            "value_si": objective.value,
        })),
        "merit": merit,
        "status": status::code(stage.explained.status),
        "status_text": status::words(stage.explained.status),
        "kkt_residual": stage.explained.kkt_residual,
        "largest_violation": stage.explained.violation,
        "second_order": stage.explained.curvature.map(curvature),
        "starts": effort.starts,
        "starts_agreed": effort.agreed,
        "optima": stage.explained.optima.iter().map(|o| optimum(&stage.explained, o)).collect::<Vec<_>>(),
        "uniform_starts": coverage.map(|coverage| coverage.uniform),
        "unseen_share": coverage.map(|coverage| coverage.unseen),
        "unseen_bound": coverage.map(|coverage| coverage.bound),
        "evaluations": effort.evaluations,
        "failed_evaluations": effort.failed(),
        "failures": failures_of(&effort.failures),
        "variables": chosen.iter().map(|c| variable(&stage.explained, c, delivered)).collect::<Vec<_>>(),
        "without_influence": stage.unused.iter().map(|p| p.name()).collect::<Vec<_>>(),
        "active": active,
        "prices": prices.iter().map(|p| price(&stage.explained, p)).collect::<Vec<_>>(),
        "profiles_not_pursued": [],
        "profiles": stage.profiles.iter().map(profile).collect::<Vec<_>>(),
    })
}

fn optimum(explained: &Explained, optimum: &LocalOptimum) -> Value {
    let names = explained.chosen.iter().map(|c| c.parameter.name());
    let at: serde_json::Map<String, Value> = names
        .zip(&optimum.at)
        .map(|(name, si)| (name.to_owned(), json!(si)))
        .collect();
    json!({
        "merit": optimum.merit,
        "objective_si": optimum.value,
        "variables_si": at,
        "searches": optimum.searches,
    })
}

fn curvature(curvature: Curvature) -> Value {
    let (kind, least) = match curvature {
        Curvature::Vertex => ("vertex", None),
        Curvature::Minimum(least) => ("minimum", Some(least)),
        Curvature::Flat(least) => ("flat", Some(least)),
        Curvature::Saddle(least) => ("saddle", Some(least)),
    };
    json!({ "kind": kind, "least_curvature": least })
}

fn variable(explained: &Explained, c: &Chosen, delivered: Option<(&DesignResult, &Spec)>) -> Value {
    let free = delivered.and_then(|(result, _)| result.free(c.parameter));
    let [from, to] = [0, 1].map(|k| free.map(|free| free.ends[k]));
    let within = delivered.filter(|_| free.is_some());
    json!({
        "key": c.parameter.name(),
        "name": c.variable.name,
        "symbol": c.variable.symbol,
        "value_si": c.value,
        "bounds_si": c.variable.bounds,
        "at_bound": c.at_bound.map(|b| match b {
            Bound::Lower => "lower",
            Bound::Upper => "upper",
        }),
        "bound_price": c.bound_price,
        "objective_elasticity": c.elasticity,
        "relative_gain_per_relative_increase": explained.gain_per_share(c),
        "delivered_si": delivered.map(|(result, _)| c.parameter.get(&result.case)),
        "free_from_si": from.map(|end| end.value),
        "free_from_end": from.map(end),
        "free_to_si": to.map(|end| end.value),
        "free_to_end": to.map(end),
        "free_within": within.map(|(_, spec)| spec.design.free_within),
    })
}

fn end(end: End) -> &'static str {
    match end.kind {
        EndKind::Bound => "bound",
        EndKind::Verified => "verified",
        EndKind::AtLeast => "at-least",
    }
}

fn price(explained: &Explained, price: &Price) -> Value {
    json!({
        "key": price.index.path(),
        "condition": price.conditions.first(),
        "conditions": price.conditions,
        "bound_si": price.bound,
        "multiplier": price.multiplier,
        "objective_change_per_si_unit": explained.price(price),
        "elasticities": price.elasticities,
    })
}

fn profile(p: &Profile) -> Value {
    json!({
        "conicity": p.conicity,
        "status": status::code(p.status),
        "status_text": status::words(p.status),
        "unseen_share": p.coverage.map(|coverage| coverage.unseen),
        "critical_speed_m_per_s": p.critical_speed,
        "degree_curve_deg": p.degree,
        "bending_stiffness_n_m_per_rad": p.bending_stiffness,
        "lateral_stiffness_n_per_m": p.lateral_stiffness,
    })
}

fn conflict(result: &DesignResult) -> Value {
    let Some(conflict) = &result.conflict else {
        return Value::Null;
    };
    let groups = conflict.demands.iter().map(|opposed| opposed.group).max();
    let demands = conflict.demands.iter().map(|opposed| {
        json!({
            "key": opposed.index.path(),
            "condition": opposed.condition,
            "required_si": opposed.required,
            "group": opposed.group,
            "share": opposed.share,
            "influenced": opposed.influenced,
            "feasible_alone_at_si": opposed.alone.filter(|_| groups == Some(0)),
            "feasible_alone_in_group_at_si": opposed.alone,
        })
    });
    demands.collect()
}

fn joint(result: &DesignResult, spec: &Spec) -> Value {
    let Some(joint) = &result.joint else {
        return Value::Null;
    };
    let indices = joint.indices.iter().map(|compared| {
        json!({
            "index": compared.index.name(),
            "sequential_si": compared.sequential.as_ref().ok(),
            "joint_si": compared.joint.as_ref().ok(),
        })
    });
    let delivered = result.joint_in_place_of_sequence();
    json!({
        "gain": joint.gain,
        "indices": indices.collect::<Vec<_>>(),
        "solution": solution(&joint.stage, delivered.then_some((result, spec))),
        "design_si": evaluation_json::inputs(&joint.case),
    })
}
