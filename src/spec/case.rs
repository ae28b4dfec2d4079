//! Reading the case: vehicle, service, wheel and rail, options.

use std::collections::BTreeMap;

use super::diagnostic::{Collect, Diagnostic};
use super::document::{Document, Value};
use super::keys::{self, CaseKey, Need, Range};
use super::value::{choice, number};
use crate::case::Case;
use crate::track::Track;
use crate::units::Quantity;
use crate::wheel_rail::CONICITY_MAX;

type Mistakes = Vec<Diagnostic>;

/// Reads the case. It starts from the prototype also where the spec has no base: then every
/// required key replaces it, and the rest of the prototype are the documented defaults.
pub(super) fn read(
    document: &Document,
    tracks: &BTreeMap<String, Track>,
    mistakes: &mut Mistakes,
) -> Case {
    let mut case = Case::prototype();
    let base = document.get(keys::BASE);
    if let Some(value) = base {
        mistakes.collect(choice(value, "base", &["prototype"]));
    } else {
        let all = keys::case().filter(|key| !key.path.contains(AIR_SPRING));
        missing(document, all, mistakes);
    }
    if keys::air_spring().any(|key| document.get(key.path).is_some()) {
        missing(document, keys::air_spring(), mistakes);
    }

    document.numbers(
        keys::case().filter(|key| key.path != keys::CONICITY),
        &mut case,
        mistakes,
    );
    if let Some(value) = document.get(keys::CONICITY)
        && let Some(conicity) = mistakes.collect(conicity(value, &[document]))
    {
        case.wheel_rail.conicity = conicity;
    }
    let vehicle = &mut case.vehicle;
    if document.get("vehicle.wheelset.roll_inertia").is_none() {
        vehicle.wheelset.roll_inertia = vehicle.wheelset.yaw_inertia;
    }
    if document.get("passenger.height_above_carbody_cg").is_none() {
        vehicle.passenger.height_above_carbody_cg = -vehicle.carbody.height_above_secondary;
    }
    if let Some(track) = track(document, tracks, mistakes) {
        case.service.track = track;
    }
    for option in keys::OPTIONS {
        if let Some(value) = document.get(option.path) {
            let name = option.path.trim_start_matches("model.");
            if let Some(i) = mistakes.collect(choice(value, name, option.names)) {
                (option.set)(&mut case.model, i);
            }
        }
    }
    document.intervals(keys::RANGES, &mut case, mistakes);
    case
}

/// The track that a document names.
pub(super) fn track(
    document: &Document,
    tracks: &BTreeMap<String, Track>,
    mistakes: &mut Mistakes,
) -> Option<Track> {
    let value = document.get(keys::TRACK)?;
    let builtin: Vec<String> = Track::names().collect();
    let names: Vec<&str> = builtin
        .iter()
        .chain(tracks.keys())
        .map(String::as_str)
        .collect();
    let i = mistakes.collect(choice(value, "track", &names))?;
    let own = tracks.get(names[i]).cloned();
    own.or_else(|| Track::named(names[i]))
}

const AIR_SPRING: &str = "suspension.secondary.air_spring.";

/// λ: the report's table ends at 0.25, but where `documents` together give all coefficients nothing is
/// read from it.
pub(super) fn conicity(value: &Value, documents: &[&Document]) -> Result<f64, Diagnostic> {
    let read = |range| number(value, "conicity", Quantity::Dimensionless, range);
    let conicity = read(Range::Positive)?;
    let absent: Vec<&str> = keys::coefficients()
        .filter(|key| documents.iter().all(|d| d.get(key.path).is_none()))
        .map(CaseKey::name)
        .collect();
    if absent.is_empty() {
        return Ok(conicity);
    }
    read(Range::PositiveUpTo(CONICITY_MAX)).map_err(|mistake| {
        mistake.help(format!(
            "the report's table ends there; beyond it give all coefficients: {}",
            absent.join(", ")
        ))
    })
}

/// Reports the required keys that the document lacks, one mistake per table.
fn missing(
    document: &Document,
    keys: impl Iterator<Item = &'static CaseKey>,
    mistakes: &mut Mistakes,
) {
    // With it `base` is lost, which may have been there.
    if document.is_no_table("vehicle") {
        return;
    }
    let mut tables: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for key in keys {
        if key.need == Need::Required && document.get(key.path).is_none() {
            let entry = format!("{} ({})", key.name(), key.quantity.with_article());
            tables.entry(key.table()).or_default().push(entry);
        }
    }
    let base = "write base = \"prototype\" in [vehicle] to take what is missing from Table 4.1.1";
    // Once is enough: the rest of the tables say what they lack.
    let mut help = document.get(keys::BASE).is_none().then(|| base.to_owned());
    for (table, absent) in tables {
        let span = document.table(table);
        let message = match span {
            Some(_) => format!("[{table}] is incomplete"),
            None => format!("there is no [{table}]"),
        };
        mistakes.push(Diagnostic {
            span,
            message,
            expected: format!("missing: {}", absent.join(", ")),
            help: help.take(),
        });
    }
}
