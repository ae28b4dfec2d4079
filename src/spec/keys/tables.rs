//! The tables of a spec, in the order in which one writes them.

use std::sync::LazyLock;

use crate::{case::SERVICE, vehicle, wheel_rail::WHEEL_RAIL};

/// A table of a spec.
#[derive(Debug)]
pub struct Table {
    /// Path.
    pub path: &'static str,
    /// Contents in words.
    pub meaning: &'static str,
}

impl Table {
    /// Whether the entry at `path` stands in it, not in a table within it.
    pub fn holds(&self, path: &str) -> bool {
        let table = path.rsplit_once('.').map_or(path, |(table, _)| table);
        table == self.path
    }
}

/// All of them: those of numbers come from the parts of the case.
pub static TABLES: LazyLock<Vec<Table>> = LazyLock::new(|| {
    let of_vehicle = |prefix: &'static str| {
        let tables = vehicle::tables();
        tables
            .filter(move |t| t.path.starts_with(prefix))
            .map(|t| table(t.path, t.meaning))
    };
    let mut tables = vec![
        table(SERVICE.path, SERVICE.meaning),
        table("vehicle", VEHICLE),
    ];
    tables.extend(of_vehicle("vehicle."));
    tables.push(table("suspension", SUSPENSION));
    tables.extend(of_vehicle("suspension."));
    tables.push(table(WHEEL_RAIL.path, WHEEL_RAIL.meaning));
    tables.extend(of_vehicle("passenger"));
    tables.extend(OTHERS.iter().map(|(path, meaning)| table(path, meaning)));
    tables
});

const VEHICLE: &str = "The vehicle: a carbody on two trucks with two wheelsets each, which are alike unless [trailing] says otherwise.";
const SUSPENSION: &str = "Springs and dampers; constants are per element, not per truck.";

/// Tables without numbers of the case.
const OTHERS: [(&str, &str); 9] = [
    (
        "trailing",
        "The trailing end where it differs: the tables of truck, wheelset and suspension below it, such as [trailing.vehicle.truck]. What is not given is as at the leading end.",
    ),
    (
        "model",
        "What the models leave open, and the ranges that they look at.",
    ),
    ("tracks", "Tracks of one's own, each under its name."),
    (
        "design",
        "What may vary, and how. A parameter takes bounds, a value that it has in every design, or a tie to another; what is not listed stays as the vehicle has it.",
    ),
    (
        "objective",
        "What is to be best, in place of the report's three trade-offs.",
    ),
    ("requirements", "What the vehicle must reach."),
    (
        "limits",
        "What must not be exceeded; of random motion, three standard deviations.",
    ),
    ("pareto", "What `bogie pareto` traces."),
    (
        "conditions",
        "Further operating conditions, each under its name.",
    ),
];

const fn table(path: &'static str, meaning: &'static str) -> Table {
    Table { path, meaning }
}
