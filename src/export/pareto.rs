//! A front as text, JSON and a flat table.

use serde_json::{Value, json};

use super::{
    design_json::failures_of,
    origin::{PROGRAM, SCHEMA_VERSION},
    sheet::Sheet,
    status,
    table::Table,
};
use crate::{
    design::pareto::{Front, FrontPoint},
    index::Index,
    optimize::archive::Stop,
    spec::Spec,
    units::{DisplayUnit, Quantity, number::significant},
};

/// Price of a bound on an index: change of the objective, in the unit of its column, per unit of
/// the index's column; `None` if it held nothing back.
fn price(point: &FrontPoint, index: Index) -> Option<f64> {
    let explained = &point.explained;
    let objective = explained.objective?.index;
    let price = explained.prices.iter().find(|p| p.index == index)?;
    let si = explained.price(price);
    Some(objective.in_column(si) / index.in_column(1.0))
}

/// The front as a flat table: indices, parameters, multipliers and status, SI with units in the
/// names.
pub fn table(name: &str, front: &Front, digest: &str) -> Table {
    let mut table = Table::new();
    table.metadata("program", PROGRAM);
    table.metadata("name", name);
    table.metadata("spec_sha256", digest);
    let points = &front.points;
    for (k, index) in front.indices.iter().enumerate() {
        table.number(
            index.column(),
            points.iter().map(|p| index.in_column(p.values[k])),
        );
    }
    for parameter in &front.parameters {
        table.number(
            parameter.column(),
            points.iter().map(|p| parameter.get(&p.case)),
        );
    }
    table.text(
        "objective",
        points.iter().map(|p| match p.explained.objective {
            Some(objective) => objective.index.name(),
            None => "",
        }),
    );
    for index in &front.indices {
        table.number(
            format!("objective_change_per_{}", index.column()),
            points.iter().map(|p| price(p, *index)),
        );
    }
    let explained = || points.iter().map(|p| &p.explained);
    table.text("status", explained().map(|e| status::code(e.status)));
    table.number("kkt_residual", explained().map(|e| e.kkt_residual));
    table.text("held_back_by", explained().map(|e| e.active.join("; ")));
    table
}

/// Everything that `bogie pareto --format json` writes.
pub fn json(name: &str, front: &Front, spec: &Spec, digest: &str) -> Value {
    json!({
        "program": PROGRAM,
        "schema_version": SCHEMA_VERSION,
        "name": name,
        "spec_sha256": digest,
        "seed": spec.design.seed,
        "indices": front.indices.iter().map(|i| i.name()).collect::<Vec<_>>(),
        "status": status::of_front(front),
        "stopped": front.stopped.map(Stop::code),
        "stopped_text": front.stopped.map(|stop| stop.to_string()),
        "evaluations": front.evaluations,
        "failures": failures_of(&front.failures),
        "dominated": front.dominated,
        "points_asked": front.asked,
        "wide_gaps": front.sparse.map_or(0, |sparse| sparse.gaps),
        "why_sparse": sparse(front),
        "points": table(name, front, digest).json(),
    })
}

/// Everything that `bogie pareto` prints.
pub fn text(name: &str, front: &Front) -> String {
    let names: Vec<&str> = front.indices.iter().map(|i| i.words()).collect();
    let mut sheet = Sheet::new(&format!("{name}: front of {}", names.join(" and ")));
    if let Some(stop) = front.stopped {
        sheet.line(&format!("Ended early, {stop}: these points are done."));
    }
    for us in [true, false] {
        sheet.heading(if us { "US customary" } else { "SI" });
        let unit = |quantity: Quantity| if us { quantity.us() } else { quantity.si() };
        let mut header: Vec<String> = Vec::new();
        header.extend(
            front
                .indices
                .iter()
                .map(|i| heading(i.words(), unit(i.quantity()))),
        );
        header.extend(
            front
                .parameters
                .iter()
                .map(|p| heading(p.symbol(), unit(p.quantity()))),
        );
        header.push("held back by".into());
        header.push(String::new());
        let rows: Vec<Vec<String>> = front
            .points
            .iter()
            .map(|point| {
                let mut row: Vec<String> = Vec::new();
                for (index, value) in front.indices.iter().zip(&point.values) {
                    row.push(plain(unit(index.quantity()), *value));
                }
                for parameter in &front.parameters {
                    let value = parameter.get(&point.case);
                    row.push(plain(unit(parameter.quantity()), value));
                }
                row.push(point.explained.active.join("; "));
                row.push(status::words(point.explained.status));
                row
            })
            .collect();
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        let left = [header.len() - 2, header.len() - 1];
        sheet.table(&header, &left, &rows);
    }
    sheet.heading(&format!(
        "{} points, {} found and dominated; {} full-model evaluations",
        front.points.len(),
        front.dominated,
        front.evaluations
    ));
    if let Some(why) = sparse(front) {
        sheet.line(&why);
    }
    sheet.finish()
}

/// Why a front has fewer points than asked for, or wide gaps.
pub(crate) fn sparse(front: &Front) -> Option<String> {
    let sparse = front.sparse.filter(|_| front.stopped.is_none())?;
    let mut parts = Vec::new();
    if front.points.len() < front.asked {
        parts.push(format!("{} points were asked for", front.asked));
    }
    if sparse.gaps > 0 {
        parts.push(match sparse.gaps {
            1 => "one gap is wider than three times the mean".into(),
            n => format!("{n} gaps are wider than three times the mean"),
        });
    }
    parts.push(match sparse.jumps {
        0 => "the searches allowed for were not enough".into(),
        1 => "between two neighbouring points a search came to no other point: the front jumps there"
            .into(),
        n => format!(
            "at {n} places between neighbouring points a search came to no other point: the front jumps \
             there"
        ),
    });
    Some(parts.join("; "))
}

fn heading(name: &str, unit: DisplayUnit) -> String {
    match unit.label {
        "" => name.into(),
        label => format!("{name}, {label}"),
    }
}

fn plain(unit: DisplayUnit, si: f64) -> String {
    significant(unit.of(si), 4)
}
