//! Keys of `[model]`.

use super::{Key, Need, Range};
use crate::case::{Case, Crosslevel, CurvingCreep, Model, TruckRoll};
use crate::spec::Interval;
use crate::units::Quantity;

/// A key whose value is one of a few names. The first is the default.
#[derive(Debug)]
pub struct Choice {
    /// Path in the spec.
    pub path: &'static str,
    /// Meaning in words.
    pub meaning: &'static str,
    /// The names.
    pub names: &'static [&'static str],
    /// Index of the name in force.
    pub get: fn(&Model) -> usize,
    /// Chooses the name with that index.
    pub set: fn(&mut Model, usize),
}

/// Names in `[model]`.
pub static OPTIONS: &[Choice] = &[
    Choice {
        path: "model.truck_roll",
        meaning: "truck roll in the lateral model: the mean of its wheelsets' roll, or a degree of \
                  freedom",
        names: &["prescribed", "dynamic"],
        get: |model| model.truck_roll as usize,
        set: |model, i| model.truck_roll = [TruckRoll::Prescribed, TruckRoll::Dynamic][i],
    },
    Choice {
        path: "model.crosslevel",
        meaning: "how crosslevel acts on the lateral model: by roll alone (the report's form), or \
                  at the contact at rail level too",
        names: &["roll", "contact"],
        get: |model| model.crosslevel as usize,
        set: |model, i| model.crosslevel = [Crosslevel::Roll, Crosslevel::Contact][i],
    },
    Choice {
        path: "model.curving_creep",
        meaning: "creep coefficients in curves: as on tangent track, or following the wheel loads",
        names: &["static", "load-dependent"],
        get: |model| model.curving_creep as usize,
        set: |model, i| {
            model.curving_creep = [CurvingCreep::Static, CurvingCreep::LoadDependent][i];
        },
    },
];

/// Ranges in `[model]`.
pub static RANGES: &[Key<Case, Interval>] = &[
    Key {
        path: "model.frequency_band",
        symbol: "",
        quantity: Quantity::Frequency,
        meaning: "band over which RMS values are defined",
        range: Range::Positive,
        need: Need::Optional("[\"0.02 Hz\", \"50 Hz\"]"),
        get: |case| Some(case.model.frequency_band.into()),
        set: |case, band| case.model.frequency_band = band.into(),
    },
    Key {
        path: "model.speed_range",
        symbol: "",
        quantity: Quantity::Speed,
        meaning: "speeds searched for the critical speed",
        range: Range::Positive,
        need: Need::Optional("[\"5 mph\", \"600 mph\"]"),
        get: |case| Some(case.model.speed_range.into()),
        set: |case, range| case.model.speed_range = range.into(),
    },
];
