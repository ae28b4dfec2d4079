//! Everything that a spec may contain, as tables of keys.

mod design;
mod key;
mod options;
mod suspension;
mod vehicle;
mod wheel_rail;

pub use design::{BOUNDS, LIMITS, REQUIREMENTS, RULES};
pub use key::{Key, Need, Range};
pub use options::{Choice, OPTIONS, RANGES};

use crate::case::Case;

/// Paths of the entries that have their own form.
pub(super) const BASE: &str = "vehicle.base";
pub(super) const TRACK: &str = "service.track";
pub(super) const TRACKS: &str = "tracks";
pub(super) const CONICITY_SPACE: &str = "design.conicity";
pub(super) const LONGITUDINAL_BOUNDS: &str = "design.primary_longitudinal_stiffness";
pub(super) const SEED: &str = "design.seed";

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
    paths.extend(BOUNDS.iter().map(|key| key.path));
    paths.extend(RULES.iter().map(|key| key.path));
    paths.extend([LONGITUDINAL_BOUNDS, CONICITY_SPACE, SEED]);
    paths.extend(REQUIREMENTS.iter().map(|key| key.path));
    paths.extend(LIMITS.iter().map(|key| key.path));
    paths
}

/// The values of a case by path, in SI base units; optional keys only where they are set.
pub fn inputs_si(inputs: &Case) -> Vec<(&'static str, f64)> {
    case()
        .filter_map(|key| Some((key.path, (key.get)(inputs)?)))
        .collect()
}
