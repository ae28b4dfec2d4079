//! Entries that are no plain number, and have a form of their own.

/// An entry with its own form.
#[derive(Debug)]
pub struct Entry {
    /// Path in the spec.
    pub path: &'static str,
    /// Meaning in words.
    pub meaning: &'static str,
    /// The form, in words or as an example.
    pub form: &'static str,
    /// Default, in words.
    pub default: &'static str,
}

pub(in crate::spec) const BASE: &str = "vehicle.base";
pub(in crate::spec) const TRACK: &str = "service.track";
pub(in crate::spec) const TRACKS: &str = "tracks";
pub(in crate::spec) const CONDITIONS: &str = "conditions";
pub(in crate::spec) const ORDER: &str = "design.order";
pub(in crate::spec) const SEED: &str = "design.seed";
pub(in crate::spec) const UNSEEN: &str = "design.unseen";
pub(in crate::spec) const PREFER: &str = "design.prefer";
pub(in crate::spec) const DELIVER_WITHIN: &str = "design.deliver_within";
pub(in crate::spec) const FREE_WITHIN: &str = "design.free_within";
pub(in crate::spec) const MAXIMIZE: &str = "objective.maximize";
pub(in crate::spec) const MINIMIZE: &str = "objective.minimize";
pub(in crate::spec) const FRONT_INDICES: &str = "pareto.indices";
pub(in crate::spec) const FRONT_POINTS: &str = "pareto.points";
pub(in crate::spec) const FRONT_BOUNDS: &str = "pareto.bounds";

const GOALS: &str =
    "an index, a list of them, or a table of weights such as { degree_curve = 2.0 }";

/// All of them.
pub static ENTRIES: &[Entry] = &[
    Entry {
        path: TRACK,
        meaning: "irregularities of the tangent track",
        form: "a built-in track or the name of a [tracks.NAME] table",
        default: "\"fra-class-6\"",
    },
    Entry {
        path: BASE,
        meaning: "where everything that the spec does not give comes from: the vehicle of Table \
                  4.1.1 with its baseline suspension",
        form: "\"prototype\"",
        default: "nothing: every required key must be given",
    },
    Entry {
        path: ORDER,
        meaning: "whether the report's three trade-offs are taken in turn, or all parameters are \
                  chosen at once",
        form: "\"sequential\" or \"joint\"",
        default: "\"sequential\"",
    },
    Entry {
        path: SEED,
        meaning: "seed of the search: the same seed gives the same design",
        form: "a whole number from 0 up",
        default: "1",
    },
    Entry {
        path: UNSEEN,
        meaning: "share of the space that may lie in basins of optima not yet seen, by the estimate \
                  of Boender and Rinnooy Kan: the search goes on until it is smaller",
        form: "a number above 0, 0.5 at the most",
        default: "0.05",
    },
    Entry {
        path: PREFER,
        meaning: "which design is delivered within `deliver_within` of the optimum: the one nearest \
                  to the design as given, the one with the softest springs, or the optimum itself",
        form: "\"as-given\", \"softest\" or \"optimum\"",
        default: "\"as-given\"",
    },
    Entry {
        path: DELIVER_WITHIN,
        meaning: "what the design delivered may lose of each objective against the optimum, as a share",
        form: "a number above 0, 0.5 at the most",
        default: "0.001",
    },
    Entry {
        path: FREE_WITHIN,
        meaning: "what each objective may lose, as a share, over the ranges that `bogie optimize` gives \
                  for the variables",
        form: "a number above 0, 0.5 at the most",
        default: "0.01",
    },
    Entry {
        path: MAXIMIZE,
        meaning: "what is to be as large as can be; relative changes times weights add up",
        form: GOALS,
        default: "the report's own objectives",
    },
    Entry {
        path: MINIMIZE,
        meaning: "what is to be as small as can be; relative changes times weights add up",
        form: GOALS,
        default: "the report's own objectives",
    },
    Entry {
        path: FRONT_INDICES,
        meaning: "what `bogie pareto` trades off",
        form: "a list of two or three different indices",
        default: "[\"critical_speed\", \"degree_curve\"]",
    },
    Entry {
        path: FRONT_POINTS,
        meaning: "points of the front",
        form: "a whole number from 2 to 2000",
        default: "20",
    },
    Entry {
        path: FRONT_BOUNDS,
        meaning: "where the front ends: the worst value of an index on it",
        form: "a table such as { critical_speed = \"75 mph\" }",
        default: "the best designs in each index alone",
    },
    Entry {
        path: TRACKS,
        meaning: "tracks of one's own, [tracks.NAME]",
        form: "the constants of the FRA form, or points of three spectra",
        default: "the built-in tracks only",
    },
    Entry {
        path: CONDITIONS,
        meaning: "further operating conditions, [conditions.NAME], in which requirements and \
                  limits hold too",
        form: "any key of [service], [vehicle], [suspension], [wheel_rail], [passenger], \
               [requirements] and [limits] that is different",
        default: "the nominal condition only",
    },
];
