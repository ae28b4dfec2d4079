//! The registry itself, composed once from the tables of numbers.

use std::sync::OnceLock;

use crate::{
    units::{Quantity, Range},
    wheel_rail::CONICITY,
};

use super::{
    case_key::{CaseKey, keys},
    natural::{NATURAL, Natural},
};

/// One parameter.
pub(super) struct Entry {
    pub path: &'static str,
    pub words: &'static str,
    pub symbol: &'static str,
    pub quantity: Quantity,
    pub range: Range,
    pub access: Access,
}

/// Access to a parameter's value.
#[derive(Clone, Copy)]
pub(super) enum Access {
    /// A number of the case.
    Key(&'static CaseKey),
    /// Another form of a number.
    Natural(&'static Natural),
}

/// Names of the parameters of Table 4.1.1, in the order of [`super::Parameter`]'s constants.
const TABLE: [&str; 16] = [
    "conicity",
    "primary_longitudinal_stiffness",
    "primary_bending_stiffness",
    "primary_lateral_stiffness",
    "secondary_yaw_stiffness",
    "secondary_yaw_breakaway_torque",
    "secondary_lateral_stiffness",
    "secondary_lateral_frequency",
    "secondary_lateral_damping",
    "secondary_lateral_damping_ratio",
    "secondary_vertical_stiffness",
    "secondary_vertical_frequency",
    "secondary_vertical_damping",
    "secondary_vertical_damping_ratio",
    "primary_vertical_stiffness",
    "primary_vertical_frequency",
];

/// Their number.
pub(super) const OF_TABLE: u16 = 16;

/// A position in the registry as the number of a parameter.
pub(super) fn number(position: usize) -> u16 {
    u16::try_from(position).unwrap_or(u16::MAX)
}

/// All parameters.
pub(super) fn entries() -> &'static [Entry] {
    static ENTRIES: OnceLock<Vec<Entry>> = OnceLock::new();
    ENTRIES.get_or_init(|| {
        let natural = NATURAL.iter().map(of_natural);
        // The service is asked for, not designed.
        let designed = keys().iter().filter(|key| key.table() != "service");
        let mut entries: Vec<Entry> = natural.chain(designed.map(of_key)).collect();
        let place = |entry: &Entry| {
            let name = entry.path.strip_prefix("design.");
            TABLE.iter().position(|of_table| Some(*of_table) == name)
        };
        entries.sort_by_key(|entry| place(entry).unwrap_or(TABLE.len()));
        entries
    })
}

fn of_natural(natural: &'static Natural) -> Entry {
    Entry {
        path: kept(format!("design.{}", natural.name)),
        words: natural.words,
        symbol: natural.symbol,
        quantity: natural.quantity,
        range: natural.range,
        access: Access::Natural(natural),
    }
}

fn of_key(key: &'static CaseKey) -> Entry {
    let words = key.meaning.split([',', ';', '(']).next();
    let words = words.unwrap_or_default().trim_end();
    let (words, symbol) = if key.is_trailing {
        (
            kept(format!("trailing {words}")),
            kept(format!("{}2", symbol(key))),
        )
    } else {
        (words, symbol(key))
    };
    Entry {
        path: kept(format!("design.{}", short_name(key.path))),
        words,
        symbol,
        quantity: key.quantity,
        range: key.range,
        access: Access::Key(key),
    }
}

/// Name of a number in `[design]`: `primary_lateral_stiffness` for `suspension.primary.lateral_stiffness`,
/// `conicity`, and else the path.
fn short_name(path: &'static str) -> String {
    let constant = path
        .strip_prefix("suspension.")
        .filter(|rest| rest.starts_with("primary.") || rest.starts_with("secondary."));
    match constant {
        Some(rest) if rest.matches('.').count() == 1 => rest.replace('.', "_"),
        _ if path == CONICITY => "conicity".to_owned(),
        _ => path.to_owned(),
    }
}

/// Symbol of a number; the end of its path where it has none.
fn symbol(key: &CaseKey) -> &'static str {
    if !key.symbol.is_empty() {
        return key.symbol;
    }
    let mut dots = key.path.rmatch_indices('.').skip(1);
    dots.next().map_or(key.path, |(at, _)| &key.path[at + 1..])
}

/// Text that is kept as long as the program runs: the registry is composed once.
fn kept(text: String) -> &'static str {
    Box::leak(text.into_boxed_str())
}

/// End of an exported column's name with the SI unit of a quantity.
pub(super) fn unit_suffix(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Mass => "_kg",
        Quantity::Length | Quantity::Stroke => "_m",
        Quantity::Inertia => "_kg_m2",
        Quantity::Stiffness => "_n_per_m",
        Quantity::Damping => "_n_s_per_m",
        Quantity::RotationalStiffness => "_n_m_per_rad",
        Quantity::RotationalDamping => "_n_m_s_per_rad",
        Quantity::Torque | Quantity::LateralSpinCreep => "_n_m",
        Quantity::SpinCreep => "_n_m2",
        Quantity::Force => "_n",
        Quantity::Frequency => "_hz",
        Quantity::Angle => "_rad",
        _ => "",
    }
}
