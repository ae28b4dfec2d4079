//! Further operating conditions: `[conditions.NAME]`.
//!
//! A condition is the case with some of its values replaced: another speed or track, worn wheels,
//! half the creep, a loaded carbody. Requirements and limits hold in every condition, unless it
//! has its own.

use std::collections::BTreeMap;

use toml::de::DeValue;

use super::case::conicity;
use super::demands::demands;
use super::diagnostic::{Collect, Diagnostic, word};
use super::document::{Document, bad_name};
use super::keys;
use super::value::number;
use crate::case::Case;
use crate::index::Demands;
use crate::track::Track;

/// An operating condition beside the nominal one.
#[derive(Debug, Clone, PartialEq)]
pub struct Condition {
    /// Its name.
    pub name: String,
    /// Values that it replaces, by path, SI.
    pub values: Vec<(&'static str, f64)>,
    /// Its track, if it has its own.
    pub track: Option<Track>,
    /// Demands in it, where they differ.
    pub demands: Demands,
}

impl Condition {
    /// The case in this condition.
    pub fn apply(&self, case: &Case) -> Case {
        let mut case = case.clone();
        for (path, value) in &self.values {
            if let Some(key) = keys::at(path) {
                key.set(&mut case, *value);
            }
        }
        if let Some(track) = &self.track {
            case.service.track = track.clone();
        }
        case
    }
}

/// Reads `[conditions]`; beside each condition what it says, by path.
pub(super) fn read<'a>(
    document: &Document<'a>,
    tracks: &BTreeMap<String, Track>,
    mistakes: &mut Vec<Diagnostic>,
) -> Vec<(Condition, Document<'a>)> {
    let Some(value) = document.get(keys::CONDITIONS) else {
        return Vec::new();
    };
    let table_expected = |span, name: &str| {
        Diagnostic::at(
            span,
            format!("`{name}` is a table"),
            format!("expected [{name}] with what differs below it"),
        )
    };
    let DeValue::Table(table) = value.get_ref() else {
        mistakes.push(table_expected(value.span(), "conditions.NAME"));
        return Vec::new();
    };
    let mut conditions = Vec::new();
    for (name, value) in table {
        mistakes.extend(bad_name(name));
        let DeValue::Table(inner) = value.get_ref() else {
            let path = format!("conditions.{}", word(name.get_ref()));
            mistakes.push(table_expected(value.span(), &path));
            continue;
        };
        let inner = Document::new(inner, &keys::condition_paths(), mistakes);
        let mut condition = Condition {
            name: name.get_ref().to_string(),
            values: Vec::new(),
            track: super::case::track(&inner, tracks, mistakes),
            demands: demands(&inner, mistakes),
        };
        for key in keys::case() {
            if let Some(value) = inner.get(key.path) {
                let read = match key.path {
                    // Coefficients that the condition does not give are those of the nominal case.
                    keys::CONICITY => conicity(value, &[&inner, document]),
                    _ => number(value, key.name(), key.quantity, key.range),
                };
                condition
                    .values
                    .extend(mistakes.collect(read).map(|si| (key.path, si)));
            }
        }
        conditions.push((condition, inner));
    }
    conditions
}
