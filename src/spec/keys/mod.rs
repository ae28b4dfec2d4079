//! Everything that a spec may contain, as tables of keys. Those of numbers stand with the [parameters](crate::parameter).

mod entries;
mod options;
mod tables;

pub use crate::parameter::CaseKey;
pub use crate::units::{Key, Need, Range};
pub use entries::{ENTRIES, Entry};
pub use options::{Choice, OPTIONS, RANGES};
pub use tables::{TABLES, Table};

use crate::case::Case;
use crate::index::Index;
use crate::parameter::{self, Parameter};
use crate::vehicle::AIR_SPRING;
use crate::wheel_rail;

pub(super) use crate::wheel_rail::CONICITY;
pub(super) use entries::{
    BASE, CONDITIONS, DELIVER_WITHIN, FREE_WITHIN, FRONT_BOUNDS, FRONT_INDICES, FRONT_POINTS,
    MAXIMIZE, MINIMIZE, ORDER, PREFER, SEED, TRACK, TRACKS, UNSEEN,
};

/// The numeric keys of a case: those of the leading end stand for both ends, those of the trailing end
/// come behind them.
pub fn case() -> impl Iterator<Item = &'static CaseKey> {
    parameter::keys().iter()
}

/// The numeric key at a path.
pub fn at(path: &str) -> Option<&'static CaseKey> {
    case().find(|key| key.path == path)
}

/// Keys of the air spring: all or none.
pub(super) fn air_spring() -> impl Iterator<Item = &'static CaseKey> {
    case().filter(|key| key.table() == AIR_SPRING.path)
}

/// Keys of explicit coefficients of the contact.
pub(super) fn coefficients() -> impl Iterator<Item = &'static CaseKey> {
    let is_coefficient =
        |key: &&CaseKey| wheel_rail::coefficients().any(|n| n.key.path == key.path);
    case().filter(is_coefficient)
}

/// Paths of all entries of a spec.
pub fn paths() -> Vec<&'static str> {
    let mut paths: Vec<&str> = ENTRIES.iter().map(|entry| entry.path).collect();
    paths.extend(case().map(|key| key.path));
    paths.extend(OPTIONS.iter().map(|option| option.path));
    paths.extend(RANGES.iter().map(|key| key.path));
    paths.extend(Parameter::all().map(Parameter::path));
    paths.extend(Index::ALL.map(Index::path));
    // As the tables follow each other in a spec: names known in a place are listed in this order.
    let place = |path: &&str| TABLES.iter().position(|table| table.holds(path));
    paths.sort_by_key(|path| place(path).unwrap_or(TABLES.len()));
    paths
}

/// Paths of what a condition may replace.
pub fn condition_paths() -> Vec<&'static str> {
    let mut paths = vec![TRACK];
    paths.extend(case().map(|key| key.path));
    paths.extend(Index::ALL.map(Index::path));
    paths
}

/// The values of a case by path, in SI base units; optional keys only where they are set.
pub fn inputs_si(inputs: &Case) -> Vec<(&'static str, f64)> {
    case()
        .filter_map(|key| Some((key.path, key.get(inputs)?)))
        .collect()
}
