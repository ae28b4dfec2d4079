//! Designs of a sweep as a table.

use super::{status::failure_code, table::Table};
use crate::design::sweep::{Design, Meets, NoValue, Sweep};

/// Design, parameters, indices, whether all is met, and a status in words and in codes: `ok`, or which
/// index has no value and why.
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
    let words = |design| status(sweep, design, ToString::to_string);
    table.text("status", designs.iter().map(words));
    let codes = |design| status(sweep, design, |reason| code(*reason));
    table.text("status_codes", designs.iter().map(codes));
    table
}

/// Code of why a design has no value of an index.
fn code(reason: NoValue) -> String {
    match reason {
        NoValue::Failure(failure) => failure_code(failure),
        NoValue::Stable(_) => "stable-over-range".into(),
        NoValue::Hunts(_) => "unstable".into(),
        NoValue::Unlimited => "not-limited".into(),
    }
}

fn status(sweep: &Sweep, design: &Design, of: impl Fn(&NoValue) -> String) -> String {
    let without: Vec<String> = sweep
        .indices()
        .iter()
        .zip(&design.values)
        .filter_map(|(index, value)| {
            let reason = value.as_ref().err()?;
            Some(format!("{}: {}", index.name(), of(reason)))
        })
        .collect();
    if without.is_empty() {
        "ok".into()
    } else {
        without.join("; ")
    }
}
