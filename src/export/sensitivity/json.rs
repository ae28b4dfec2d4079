//! Sensitivity as JSON.

use serde_json::{Map, Value, json};

use crate::{
    design::sensitivity::{Effects, Factor, IndexSensitivity, Method, Sensitivity, morris},
    export::origin::sign,
    index::{Index, Scale},
    optimize::problem,
};

/// As JSON: bounds in SI, effects by index, the most important first.
pub fn json(name: &str, sensitivity: &Sensitivity) -> Value {
    let settings = &sensitivity.settings;
    let mut object = Map::new();
    sign(&mut object);
    let mut put = |key: &str, value: Value| object.insert(key.into(), value);
    put("name", json!(name));
    match settings.method {
        Method::Sobol { rows } => {
            put("method", json!("sobol"));
            put("rows_asked", json!(rows));
            put("rows", json!(sensitivity.groups));
        }
        Method::Morris { trajectories } => {
            put("method", json!("morris"));
            put("levels", json!(morris::LEVELS));
            put("trajectories_asked", json!(trajectories));
            put("trajectories", json!(sensitivity.groups));
        }
    }
    put("seed", json!(settings.seed));
    put("evaluations", json!(sensitivity.evaluations()));
    put("interrupted", json!(sensitivity.interrupted()));
    put("input_spread", json!(sensitivity.spread));
    let factors = &sensitivity.factors;
    put("factors", factors.iter().map(factor_json).collect());
    let indices = sensitivity.indices.iter();
    put(
        "indices",
        indices.map(|index| index_json(factors, index)).collect(),
    );
    put("matters_to_none", paths(factors, &sensitivity.negligible()));
    Value::Object(object)
}

fn factor_json(factor: &Factor) -> Value {
    let variable = &factor.variable;
    let [lower, upper] = variable.bounds;
    json!({
        "path": factor.path,
        "symbol": variable.symbol,
        "kind": if factor.open { "design" } else { "input" },
        "unit": variable.quantity.dimension().to_string(),
        "lower_si": lower,
        "upper_si": upper,
        "scale": match variable.scale {
            problem::Scale::Logarithmic => "logarithmic",
            problem::Scale::Linear => "linear",
        },
    })
}

fn index_json(factors: &[Factor], index: &IndexSensitivity) -> Value {
    let ranking = index.ranking();
    let ranked = ranking.matters.iter().chain(&ranking.negligible);
    let effects: Vec<Value> = ranked
        .map(|i| effect_json(factors[*i].path, &index.effects, *i))
        .collect();
    let failures: Map<String, Value> = index
        .failures
        .iter()
        .map(|(failure, count)| (kind(*failure), json!(count)))
        .collect();
    json!({
        "index": index.index.name(),
        "of": of(index.index),
        "mean": index.moments.map(|m| m[0]),
        "standard_deviation": index.moments.map(|m| m[1]),
        "failures": failures,
        "effects": effects,
        "negligible": paths(factors, &ranking.negligible),
        "too_few_evaluations": paths(factors, &ranking.unknown),
    })
}

fn effect_json(path: &str, effects: &Effects, factor: usize) -> Value {
    match effects {
        Effects::Sobol(effects) => {
            let e = effects[factor];
            json!({
                "path": path,
                "first_order": e.map(|e| e.first.value),
                "first_order_95": e.map(|e| e.first.interval),
                "total": e.map(|e| e.total.value),
                "total_95": e.map(|e| e.total.interval),
                "rows": e.map_or(0, |e| e.rows),
            })
        }
        Effects::Morris(effects) => {
            let e = effects[factor];
            json!({
                "path": path,
                "mu_star": e.map(|e| e.mu_star),
                "mu": e.map(|e| e.mu),
                "sigma": e.map(|e| e.sigma),
                "effects": e.map_or(0, |e| e.count),
            })
        }
    }
}

/// Kind of numbers.
fn of(index: Index) -> &'static str {
    match index.scale() {
        Scale::Logarithmic => "ln of the index in SI units",
        Scale::Linear => "the index",
    }
}

/// Name of a failure in files.
fn kind(failure: problem::Failure) -> String {
    match json!(failure) {
        Value::String(name) => name,
        _ => failure.to_string(),
    }
}

fn paths(factors: &[Factor], which: &[usize]) -> Value {
    which.iter().map(|i| json!(factors[*i].path)).collect()
}
