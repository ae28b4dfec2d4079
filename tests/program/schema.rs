//! The schema of a spec says what the reader does.

use std::fs;

use bogie::spec::{Spec, keys, schema::schema};
use regex_lite::Regex;
use serde_json::Value;

use crate::support::problem_files;

/// Whether `value` is valid by `schema`, for the part of draft 2020-12 that ours uses. Any other
/// keyword ends the test.
fn is_valid(value: &Value, schema: &Value, root: &Value) -> bool {
    let Some(rules) = schema.as_object() else {
        panic!("no schema: {schema}");
    };
    let valid = |value: &Value, schema: &Value| is_valid(value, schema, root);
    let list = value.as_array();
    let object = value.as_object();
    let length = value.as_str().map(|s| s.chars().count() as u64);
    rules.iter().all(|(keyword, rule)| match keyword.as_str() {
        "$schema" | "$defs" | "title" | "description" | "examples" | "default" => true,
        "$ref" => {
            let pointer = rule.as_str().unwrap().trim_start_matches('#');
            valid(value, root.pointer(pointer).unwrap())
        }
        "type" => match rule.as_str().unwrap() {
            "object" => value.is_object(),
            "array" => value.is_array(),
            "string" => value.is_string(),
            "number" => value.is_number(),
            "integer" => value.is_i64() || value.is_u64(),
            other => panic!("type {other}"),
        },
        "enum" => rule.as_array().unwrap().contains(value),
        "anyOf" => rule.as_array().unwrap().iter().any(|s| valid(value, s)),
        "properties" => object.is_none_or(|o| {
            let known = rule.as_object().unwrap();
            o.iter()
                .all(|(k, v)| known.get(k).is_none_or(|s| valid(v, s)))
        }),
        "additionalProperties" => object.is_none_or(|o| {
            let known = rules.get("properties").and_then(Value::as_object);
            let mut rest = o
                .iter()
                .filter(|(k, _)| known.is_none_or(|p| !p.contains_key(*k)));
            rest.all(|(_, v)| rule != &Value::Bool(false) && valid(v, rule))
        }),
        "propertyNames" => {
            object.is_none_or(|o| o.keys().all(|k| valid(&Value::String(k.clone()), rule)))
        }
        "required" => object.is_none_or(|o| {
            let names = rule.as_array().unwrap();
            names
                .iter()
                .all(|name| o.contains_key(name.as_str().unwrap()))
        }),
        "items" => list.is_none_or(|l| l.iter().all(|v| valid(v, rule))),
        "minItems" => list.is_none_or(|l| l.len() as u64 >= rule.as_u64().unwrap()),
        "maxItems" => list.is_none_or(|l| l.len() as u64 <= rule.as_u64().unwrap()),
        "uniqueItems" => list.is_none_or(|l| (1..l.len()).all(|i| !l[..i].contains(&l[i]))),
        "minimum" => value.as_f64().is_none_or(|x| x >= rule.as_f64().unwrap()),
        "maximum" => value.as_f64().is_none_or(|x| x <= rule.as_f64().unwrap()),
        "exclusiveMinimum" => value.as_f64().is_none_or(|x| x > rule.as_f64().unwrap()),
        "minLength" => length.is_none_or(|n| n >= rule.as_u64().unwrap()),
        "maxLength" => length.is_none_or(|n| n <= rule.as_u64().unwrap()),
        "pattern" => value
            .as_str()
            .is_none_or(|s| Regex::new(rule.as_str().unwrap()).unwrap().is_match(s)),
        "if" => !valid(value, rule) || rules.get("then").is_none_or(|then| valid(value, then)),
        "else" => valid(value, &rules["if"]) || valid(value, rule),
        other => panic!("keyword {other}"),
    })
}

/// A TOML document as JSON; `None` if it is no TOML, or has numbers that JSON has not.
fn to_json(source: &str) -> Option<Value> {
    toml::from_str::<toml::Table>(source)
        .ok()
        .and_then(|table| serde_json::to_value(table).ok())
}

#[test]
fn every_right_spec_is_valid() {
    let schema = schema();
    let starter = ("starter".to_owned(), bogie::spec::STARTER.into());
    let files = ["", "doubtful"].map(problem_files).concat();
    for (name, bytes) in files.into_iter().chain([starter]) {
        let document = to_json(std::str::from_utf8(&bytes).unwrap()).unwrap();
        assert!(is_valid(&document, &schema, &schema), "{name}");
    }
}

/// What a schema cannot know: dimensions of units, relations between values, sizes beyond all
/// scale, names of tracks elsewhere in the file.
const BEYOND_A_SCHEMA: [&str; 18] = [
    "angle-on-torque",
    "condition-conicity-off-the-table",
    "conicity-off-the-table",
    "critical-speed-below-range",
    "critical-speed-out-of-range",
    "frame-frequency-too-low",
    "front-bound-out-of-range",
    "inertia-beyond-length",
    "out-of-scale",
    "same-variable-twice",
    "speed-above-range",
    "stroke-in-no-curve",
    "trucks-beyond-carbody",
    "trucks-overlap",
    "unknown-track",
    "wavenumber-in-cycles",
    "wheels-overlap",
    "wrong-dimension",
];

#[test]
fn every_structural_mistake_is_found() {
    let schema = schema();
    for (name, bytes) in problem_files("invalid") {
        // What is no TOML or no text has no structure.
        let Ok(source) = String::from_utf8(bytes) else {
            continue;
        };
        let Some(document) = to_json(&source) else {
            continue;
        };
        let beyond = BEYOND_A_SCHEMA.contains(&name.trim_end_matches(".toml"));
        let valid = is_valid(&document, &schema, &schema);
        assert!(valid == beyond, "{name}: {valid}");
    }
}

/// Paths of the entries of a schema's tables; `stop` are entries that are tables themselves.
fn leaves(schema: &Value, path: &str, stop: &[&str], found: &mut Vec<String>) {
    match schema.get("properties").and_then(Value::as_object) {
        Some(properties) if !stop.contains(&path) => {
            for (name, inner) in properties {
                let path = if path.is_empty() {
                    name.clone()
                } else {
                    format!("{path}.{name}")
                };
                leaves(inner, &path, stop, found);
            }
        }
        _ => found.push(path.to_owned()),
    }
}

#[test]
fn the_schema_has_the_keys_of_the_reader_and_no_others() {
    let schema = schema();
    let sorted = |mut paths: Vec<String>| {
        paths.sort();
        paths
    };
    let known = |paths: Vec<&str>| sorted(paths.into_iter().map(str::to_owned).collect());
    let mut found = Vec::new();
    leaves(&schema, "", &["pareto.bounds"], &mut found);
    assert_eq!(sorted(found), known(keys::paths()));

    let mut found = Vec::new();
    let conditions = &schema["properties"]["conditions"]["additionalProperties"];
    leaves(conditions, "", &[], &mut found);
    assert_eq!(sorted(found), known(keys::condition_paths()));
}

/// Every entry and table is described, for whoever hovers over it.
#[test]
fn everything_is_described() {
    fn look(schema: &Value, path: &str) {
        let text = schema["description"].as_str();
        assert!(
            text.is_some_and(|text| text.ends_with('.')),
            "{path}: {text:?}"
        );
        for (name, inner) in schema["properties"].as_object().into_iter().flatten() {
            if path != "pareto" || name != "bounds" {
                look(inner, &format!("{path}/{name}"));
            }
        }
    }
    look(&schema(), "");
}

/// What the reader takes a schema must not refuse: the defaults and examples.
#[test]
fn examples_and_defaults_are_right() {
    for entry in keys::case() {
        let lines = entry
            .quantity
            .examples()
            .map(|example| match entry.quantity.si().label {
                "" => format!("{} = {example}\n", entry.path),
                _ => format!("{} = \"{example}\"\n", entry.path),
            });
        for line in lines {
            let document = to_json(&line).unwrap();
            let schema = schema();
            let mut inner = (&schema, &document);
            for name in entry.path.split('.') {
                inner = (&inner.0["properties"][name], &inner.1[name]);
            }
            assert!(is_valid(inner.1, inner.0, &schema), "{line}");
        }
    }
    // `parse` is the judge of defaults that stand in the schema as values.
    let schema = schema();
    let default = &schema["properties"]["wheel_rail"]["properties"]["flange_clearance"]["default"];
    assert_eq!(default, "0.5 in");
    let source = "[vehicle]\nbase = \"prototype\"\n[wheel_rail]\nflange_clearance = \"0.5 in\"\n";
    let (given, without) = (
        Spec::parse(source),
        Spec::parse(&source[..source.find("[w").unwrap()]),
    );
    assert_eq!(given.unwrap().case, without.unwrap().case);
}

/// `docs/src/bogie.schema.json` is the schema. After a change of the tables
/// `BOGIE_UPDATE=1 cargo test --test program schema` writes it anew.
#[test]
fn the_copy_in_the_documentation_is_current() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/src/bogie.schema.json");
    let text = serde_json::to_string_pretty(&schema()).unwrap() + "\n";
    if std::env::var_os("BOGIE_UPDATE").is_some() {
        fs::write(path, &text).unwrap();
    }
    assert!(
        fs::read_to_string(path).unwrap() == text,
        "run with BOGIE_UPDATE=1"
    );
}
