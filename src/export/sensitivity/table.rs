//! Sensitivity as a flat table.

use crate::{
    design::sensitivity::{Effects, IndexSensitivity, Method, Sensitivity},
    export::table::Table,
};

/// As a flat table: a row for every index and factor, by rank.
pub fn table(sensitivity: &Sensitivity) -> Table {
    let mut rows: Vec<(&IndexSensitivity, usize, &str)> = Vec::new();
    for index in &sensitivity.indices {
        let ranking = index.ranking();
        for (part, verdict) in [
            (ranking.matters, "matters"),
            (ranking.negligible, "does not matter"),
            (ranking.unknown, "unknown"),
        ] {
            rows.extend(part.into_iter().map(|factor| (index, factor, verdict)));
        }
    }
    let mut table = Table::new();
    table.text("index", rows.iter().map(|(index, ..)| index.index.name()));
    let factor = |i: &usize| &sensitivity.factors[*i];
    table.text("factor", rows.iter().map(|(_, i, _)| factor(i).label()));
    table.text("path", rows.iter().map(|(_, i, _)| factor(i).path));
    table.text("verdict", rows.iter().map(|(.., verdict)| *verdict));
    let mut number = |name: &str, of: &dyn Fn(&Effects, usize) -> Option<f64>| {
        table.number(
            name,
            rows.iter().map(|(index, i, _)| of(&index.effects, *i)),
        );
    };
    match sensitivity.settings.method {
        Method::Sobol { .. } => {
            let of = |effects: &Effects, i: usize| match effects {
                Effects::Sobol(effects) => effects[i],
                Effects::Morris(_) => None,
            };
            number("first_order", &|e, i| Some(of(e, i)?.first.value));
            number("first_order_low", &|e, i| Some(of(e, i)?.first.interval[0]));
            number("first_order_high", &|e, i| {
                Some(of(e, i)?.first.interval[1])
            });
            number("total", &|e, i| Some(of(e, i)?.total.value));
            number("total_low", &|e, i| Some(of(e, i)?.total.interval[0]));
            number("total_high", &|e, i| Some(of(e, i)?.total.interval[1]));
            let rows_left = |e: &Effects, i: usize| of(e, i).map_or(0, |e| e.rows as u64);
            let counts = rows
                .iter()
                .map(|(index, i, _)| rows_left(&index.effects, *i));
            table.count("rows", counts);
        }
        Method::Morris { .. } => {
            let of = |effects: &Effects, i: usize| match effects {
                Effects::Morris(effects) => effects[i],
                Effects::Sobol(_) => None,
            };
            number("mu_star", &|e, i| Some(of(e, i)?.mu_star));
            number("mu", &|e, i| Some(of(e, i)?.mu));
            number("sigma", &|e, i| Some(of(e, i)?.sigma));
            let effects_left = |e: &Effects, i: usize| of(e, i).map_or(0, |e| e.count as u64);
            let counts = rows
                .iter()
                .map(|(index, i, _)| effects_left(&index.effects, *i));
            table.count("effects", counts);
        }
    }
    table
}
