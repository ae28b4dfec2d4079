//! Everything that a spec may contain, as tables of keys.

mod entries;
mod key;
mod options;
mod suspension;
mod tables;
mod vehicle;
mod wheel_rail;

pub use crate::units::Range;
pub use entries::{ENTRIES, Entry};
pub use key::{Key, Need};
pub use options::{Choice, OPTIONS, RANGES};
pub use tables::{TABLES, Table};

use crate::case::Case;
use crate::index::Index;
use crate::parameter::Parameter;

pub(super) use entries::{
    BASE, CONDITIONS, DELIVER_WITHIN, FREE_WITHIN, FRONT_BOUNDS, FRONT_INDICES, FRONT_POINTS,
    MAXIMIZE, MINIMIZE, ORDER, PREFER, SEED, TRACK, TRACKS, UNSEEN,
};

/// The numeric keys of a case.
pub fn case() -> impl Iterator<Item = &'static Key<Case>> {
    [
        vehicle::SERVICE,
        vehicle::CARBODY,
        vehicle::TRUCK,
        vehicle::WHEELSET,
        suspension::PRIMARY,
        suspension::SECONDARY,
        suspension::AIR_SPRING,
        wheel_rail::WHEEL_RAIL,
        wheel_rail::COEFFICIENTS,
        vehicle::PASSENGER,
    ]
    .into_iter()
    .flatten()
}

pub(super) use suspension::AIR_SPRING;
pub(super) use wheel_rail::{COEFFICIENTS, CONICITY};

/// Paths of all entries of a spec.
pub fn paths() -> Vec<&'static str> {
    let mut paths: Vec<&str> = ENTRIES.iter().map(|entry| entry.path).collect();
    paths.extend(case().map(|key| key.path));
    paths.extend(OPTIONS.iter().map(|option| option.path));
    paths.extend(RANGES.iter().map(|key| key.path));
    paths.extend(Parameter::ALL.map(Parameter::path));
    paths.extend(Index::ALL.map(Index::path));
    // As the tables follow each other in a spec: names known in a place are listed in this order.
    paths.sort_by_key(|path| TABLES.iter().position(|table| table.holds(path)));
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
        .filter_map(|key| Some((key.path, (key.get)(inputs)?)))
        .collect()
}

/// The key of the case that a design parameter sets, in its own form or as the constant that
/// follows from it.
pub fn of_parameter(parameter: Parameter) -> Option<&'static Key<Case>> {
    let name = parameter.constant().name();
    let path = match name.split_once('_') {
        Some((stage, constant)) => format!("suspension.{stage}.{constant}"),
        None => format!("wheel_rail.{name}"),
    };
    case().find(|key| key.path == path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_parameter_sets_its_key() {
        for parameter in Parameter::ALL {
            let key = of_parameter(parameter).expect("a key for every parameter");
            let mut case = Case::prototype();
            let before = (key.get)(&case).unwrap();
            let value = 1.1 * parameter.get(&case);
            parameter.set(&mut case, value);
            assert!((key.get)(&case).unwrap() > before, "{parameter:?}");
            if parameter.constant() == parameter {
                assert_eq!((key.get)(&case), Some(value), "{parameter:?}");
            }
        }
    }
}
