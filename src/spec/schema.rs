//! The JSON schema of a spec (draft 2020-12), with which editors complete and check it.
//!
//! It is made from the tables that the reader uses. What it accepts is more than what is right:
//! dimensions of units and relations between values are for [`Spec::parse`](super::Spec::parse).

mod values;

use serde_json::{Map, Value, json};

use super::keys::{self, ENTRIES, Need, TABLES};
use super::{
    DesignSpace, FRONT_POINTS,
    design::{ORDERS, PREFERENCES, SHARES, may_be_tied},
    tracks,
};
use crate::index::{Index, Sense};
use crate::parameter::Parameter;
use crate::track::Track;
use crate::units::{Quantity, Range};
use values::{definitions, described, described_key, interval, number};

/// The schema.
pub fn schema() -> Value {
    let mut root = table("");
    for path in keys::paths() {
        insert(&mut root, path, entry(path));
    }
    for table in TABLES.iter() {
        describe(&mut root, table.path, table.meaning);
        for (before, what) in [
            ("trailing", "Of the trailing end, where it differs"),
            ("design", "What may vary of these numbers"),
            ("design.trailing", "What may vary of the trailing end"),
        ] {
            let path = format!("{before}.{}", table.path);
            describe(&mut root, &path, &format!("{what}. {}", table.meaning));
        }
    }
    let air_spring = keys::air_spring();
    let required = air_spring.filter(|key| key.need == Need::Required);
    let names: Vec<&str> = required.map(|key| key.name()).collect();
    if let Some(table) = at(&mut root, "suspension.secondary.air_spring") {
        table["required"] = json!(names);
    }
    let mut object = Map::new();
    object.insert(
        "$schema".into(),
        json!("https://json-schema.org/draft/2020-12/schema"),
    );
    object.insert("title".into(), json!("Spec for bogie"));
    object.insert(
        "description".into(),
        json!("A rail vehicle, what may vary in its suspension, and what it must reach."),
    );
    object.extend(root.as_object().cloned().unwrap_or_default());
    object.insert(
        "if".into(),
        json!({ "properties": { "vehicle": { "required": ["base"] } }, "required": ["vehicle"] }),
    );
    object.insert("else".into(), complete());
    object.insert("$defs".into(), definitions());
    Value::Object(object)
}

/// An empty table that knows no other keys than those put into it.
fn table(meaning: &str) -> Value {
    let mut table = json!({ "type": "object", "properties": {}, "additionalProperties": false });
    if !meaning.is_empty() {
        table["description"] = json!(meaning);
    }
    table
}

/// Puts `schema` at `path`, with the tables on the way.
fn insert(root: &mut Value, path: &str, schema: Value) {
    match path.split_once('.') {
        None => root["properties"][path] = schema,
        Some((parent, rest)) => {
            let inner = &mut root["properties"][parent];
            if inner.is_null() {
                *inner = table("");
            }
            insert(inner, rest, schema);
        }
    }
}

/// The schema of the table at `path`.
fn at<'s>(root: &'s mut Value, path: &str) -> Option<&'s mut Value> {
    path.split('.').try_fold(root, |table, name| {
        table.get_mut("properties")?.get_mut(name)
    })
}

fn describe(root: &mut Value, path: &str, meaning: &str) {
    if let Some(table) = at(root, path) {
        table["description"] = json!(meaning);
    }
}

/// The required keys of a spec without a base.
fn complete() -> Value {
    let mut root = json!({});
    for key in keys::case().filter(|key| key.need == Need::Required) {
        if keys::air_spring().any(|other| other.path == key.path) {
            continue;
        }
        let mut table = &mut root;
        let mut names = key.path.split('.').peekable();
        while let Some(name) = names.next() {
            if !table["required"].is_array() {
                table["required"] = json!([]);
            }
            if let Some(required) = table["required"].as_array_mut()
                && !required.contains(&json!(name))
            {
                required.push(json!(name));
            }
            if names.peek().is_some() {
                table = &mut table["properties"][name];
            }
        }
    }
    root
}

/// The schema of the entry at `path`.
fn entry(path: &str) -> Value {
    if let Some(key) = keys::at(path) {
        let range = match key.path {
            // The end of the report's table is none for coefficients of one's own.
            keys::CONICITY => Range::Positive,
            _ => key.range,
        };
        return described_key(number(key.quantity, range), &key.into());
    }
    if let Some(key) = keys::RANGES.iter().find(|key| key.path == path) {
        return described_key(interval(key.quantity, key.range), &key.into());
    }
    if let Some(option) = keys::OPTIONS.iter().find(|option| option.path == path) {
        return json!({
            "enum": option.names,
            "default": option.names[0],
            "description": format!("{}.", capital(option.meaning)),
        });
    }
    if let Some(parameter) = Parameter::all().find(|p| p.path() == path) {
        return freedom(parameter);
    }
    if let Some(index) = Index::ALL.into_iter().find(|index| index.path() == path) {
        return bound(index);
    }
    own_form(path)
}

/// Forms of a parameter in `[design]`.
fn freedom(parameter: Parameter) -> Value {
    let (quantity, range) = (parameter.quantity(), parameter.range());
    let ties: Vec<&str> = Parameter::of_table()
        .filter(|to| may_be_tied(parameter, *to))
        .map(Parameter::name)
        .collect();
    let mut forms = vec![
        described(interval(quantity, range), "Bounds, lowest first."),
        described(number(quantity, range), "This value."),
    ];
    if parameter == Parameter::CONICITY {
        let value = number(quantity, range);
        forms.push(json!({
            "description": "One of these wheel profiles.",
            "type": "object",
            "properties": { "choices": { "type": "array", "items": value, "minItems": 1, "uniqueItems": true } },
            "required": ["choices"],
            "additionalProperties": false,
        }));
    }
    if !ties.is_empty() {
        // Names of all parameters would make the schema many times as long.
        let ties = if parameter.is_of_table() {
            json!({ "enum": ties })
        } else {
            json!({ "type": "string" })
        };
        forms.push(json!({
            "description": "A multiple of another parameter.",
            "type": "object",
            "properties": {
                "tied_to": ties,
                "ratio": { "type": "number", "exclusiveMinimum": 0, "default": 1 },
            },
            "required": ["tied_to"],
            "additionalProperties": false,
        }));
    }
    let relation = parameter
        .relation()
        .map_or_else(String::new, |r| format!(" {r}."));
    let meaning = format!(
        "{}, {}.{relation}",
        capital(parameter.words()),
        parameter.symbol()
    );
    json!({ "description": meaning, "anyOf": forms })
}

/// A bound on an index.
fn bound(index: Index) -> Value {
    let which = match index.sense() {
        Sense::AtLeast => "Least value",
        Sense::AtMost => "Greatest value",
    };
    let meaning = format!("{which}: {}.", index.words());
    described(number(index.quantity(), index.range()), &meaning)
}

fn own_form(path: &str) -> Value {
    let meaning = ENTRIES.iter().find(|entry| entry.path == path);
    let text = meaning.map_or_else(String::new, |entry| {
        format!(
            "{}: {}. Default: {}.",
            capital(entry.meaning),
            entry.form,
            entry.default
        )
    });
    let form = match path {
        keys::BASE => json!({ "enum": ["prototype"] }),
        keys::TRACK => json!({ "anyOf": [
            { "enum": Track::names().collect::<Vec<_>>() },
            { "type": "string", "maxLength": NAME },
        ] }),
        keys::ORDER => json!({ "enum": ORDERS, "default": ORDERS[0] }),
        keys::UNSEEN => share(DesignSpace::default().unseen),
        keys::SEED => json!({ "type": "integer", "minimum": 0, "default": 1 }),
        keys::PREFER => json!({ "enum": PREFERENCES, "default": PREFERENCES[0] }),
        keys::DELIVER_WITHIN => share(DesignSpace::default().deliver_within),
        keys::FREE_WITHIN => share(DesignSpace::default().free_within),
        keys::MAXIMIZE => goals(Sense::AtLeast),
        keys::MINIMIZE => goals(Sense::AtMost),
        keys::FRONT_INDICES => json!({
            "type": "array",
            "items": { "enum": Index::ALL.map(Index::name) },
            "minItems": 2, "maxItems": 3, "uniqueItems": true,
        }),
        keys::FRONT_POINTS => json!({
            "type": "integer",
            "minimum": FRONT_POINTS.start(), "maximum": FRONT_POINTS.end(), "default": 20,
        }),
        keys::FRONT_BOUNDS => {
            let mut bounds = table("");
            for index in Index::ALL {
                insert(&mut bounds, index.name(), bound(index));
            }
            bounds
        }
        keys::TRACKS => named(&own_track()),
        keys::CONDITIONS => {
            let mut condition = table("What is different in this condition.");
            for path in keys::condition_paths() {
                insert(&mut condition, path, entry(path));
            }
            named(&condition)
        }
        _ => json!({}),
    };
    described(form, &text)
}

/// A relative loss, or a share of the space.
fn share(default: f64) -> Value {
    let mut schema = number(Quantity::Dimensionless, SHARES);
    schema["default"] = json!(default);
    schema
}

/// Longest name of a track or condition.
const NAME: usize = 60;

/// Tables by names of the author's.
fn named(table: &Value) -> Value {
    json!({
        "type": "object",
        "propertyNames": { "minLength": 1, "maxLength": NAME, "pattern": r"^[^\u0000-\u001f\u007f-\u009f]*$" },
        "additionalProperties": table,
    })
}

fn goals(sense: Sense) -> Value {
    let indices = Index::ALL
        .into_iter()
        .filter(|index| index.sense() == sense);
    let names: Vec<&str> = indices.map(Index::name).collect();
    let mut weights = table("");
    for name in &names {
        let weight = json!({ "type": "number", "exclusiveMinimum": 0 });
        insert(&mut weights, name, weight);
    }
    json!({ "anyOf": [
        { "enum": names },
        { "type": "array", "items": { "enum": names }, "uniqueItems": true },
        weights,
    ] })
}

/// The FRA form, or points.
fn own_track() -> Value {
    let mut form = table("The FRA form with constants of one's own.");
    for name in tracks::FORM {
        let schema = match name {
            "form" => json!({ "enum": ["fra"] }),
            _ => number(tracks::form_quantity(name), Range::Positive),
        };
        insert(&mut form, name, schema);
    }
    form["required"] = tracks::FORM
        .into_iter()
        .filter(|n| *n != tracks::OPTIONAL)
        .collect();
    let mut points =
        table("Points of one-sided spectral densities, lines between them on log–log axes.");
    for name in tracks::POINTS {
        let mut spectrum = table("");
        for (name, quantity) in tracks::COLUMNS {
            let values = json!({ "type": "array", "items": number(quantity, Range::Positive), "minItems": 2 });
            insert(&mut spectrum, name, values);
        }
        spectrum["required"] = tracks::COLUMNS.into_iter().map(|(name, _)| name).collect();
        insert(&mut points, name, spectrum);
    }
    points["required"] = json!(tracks::POINTS);
    json!({ "anyOf": [form, points] })
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars
        .next()
        .map_or_else(String::new, |c| c.to_uppercase().chain(chars).collect())
}
