//! Everything that a spec may contain, as tables of keys.

mod key;
mod options;
mod suspension;
mod vehicle;
mod wheel_rail;

pub use crate::units::Range;
pub use key::{Key, Need};
pub use options::{Choice, OPTIONS, RANGES};

use crate::case::Case;
use crate::index::Index;
use crate::parameter::Parameter;

/// Paths of the entries that have their own form.
pub(super) const BASE: &str = "vehicle.base";
pub(super) const TRACK: &str = "service.track";
pub(super) const TRACKS: &str = "tracks";
pub(super) const CONDITIONS: &str = "conditions";
pub(super) const ORDER: &str = "design.order";
pub(super) const SEED: &str = "design.seed";
pub(super) const MAXIMIZE: &str = "objective.maximize";
pub(super) const MINIMIZE: &str = "objective.minimize";
pub(super) const FRONT_INDICES: &str = "pareto.indices";
pub(super) const FRONT_POINTS: &str = "pareto.points";
pub(super) const FRONT_BOUNDS: &str = "pareto.bounds";

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
pub(super) use wheel_rail::COEFFICIENTS;

/// Paths of all entries of a spec.
pub fn paths() -> Vec<&'static str> {
    let mut paths = vec![TRACK, BASE];
    paths.extend(case().map(|key| key.path));
    paths.extend(OPTIONS.iter().map(|option| option.path));
    paths.extend(RANGES.iter().map(|key| key.path));
    paths.push(TRACKS);
    paths.extend(Parameter::ALL.map(Parameter::path));
    paths.extend([ORDER, SEED, MAXIMIZE, MINIMIZE]);
    paths.extend(Index::ALL.map(Index::path));
    paths.extend([FRONT_INDICES, FRONT_POINTS, FRONT_BOUNDS, CONDITIONS]);
    paths
}

/// The values of a case by path, in SI base units; optional keys only where they are set.
pub fn inputs_si(inputs: &Case) -> Vec<(&'static str, f64)> {
    case()
        .filter_map(|key| Some((key.path, (key.get)(inputs)?)))
        .collect()
}
