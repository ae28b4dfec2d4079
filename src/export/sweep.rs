//! Designs of a sweep as a table.

use super::table::Table;
use crate::design::sweep::{Design, Meets, Sweep};

/// Design, parameters, indices, whether all is met, and a status: `ok`, or which index has no value
/// and why.
pub fn table(sweep: &Sweep, designs: &[Design]) -> Table {
    let mut table = Table::new();
    table.count("design", designs.iter().map(|d| d.number as u64));
    for parameter in sweep.parameters() {
        let values = designs.iter().map(|d| parameter.get(&d.case));
        table.number(parameter.column(), values);
    }
    for (i, index) in sweep.indices().iter().enumerate() {
        let value = |design: &Design| Some(index.in_column(*design.values[i].as_ref().ok()?));
        table.number(index.column(), designs.iter().map(value));
    }
    if sweep.asks() {
        let meets = |design: &Design| design.meets_all.map_or("", Meets::code);
        table.text("meets_all", designs.iter().map(meets));
    }
    table.text("status", designs.iter().map(|design| status(sweep, design)));
    table
}

fn status(sweep: &Sweep, design: &Design) -> String {
    let without: Vec<String> = sweep
        .indices()
        .iter()
        .zip(&design.values)
        .filter_map(|(index, value)| {
            let reason = value.as_ref().err()?;
            Some(format!("{}: {reason}", index.name()))
        })
        .collect();
    if without.is_empty() {
        "ok".into()
    } else {
        without.join("; ")
    }
}
