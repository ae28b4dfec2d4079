//! The numbers behind a figure, as tables in SI units.

use crate::{
    export::table::Table,
    plot::{Axis, Figure, Panel, Text},
};

/// A table for every panel, with the panel's name.
pub fn tables(figure: &Figure) -> Vec<(String, Table)> {
    figure
        .panels
        .iter()
        .map(|panel| (panel.id.clone(), table(panel)))
        .collect()
}

/// The field of a panel where it has one, otherwise the points of its curves.
pub fn table(panel: &Panel) -> Table {
    match &panel.field {
        Some(field) => {
            let mut table = Table::new();
            let row = |y: &f64| field.x.iter().map(|x| (*x, *y)).collect::<Vec<_>>();
            let points: Vec<(f64, f64)> = field.y.iter().flat_map(row).collect();
            table.number(&panel.x.column, points.iter().map(|p| p.0));
            table.number(&panel.y.column, points.iter().map(|p| p.1));
            for layer in &field.layers {
                table.number(&layer.column, layer.values.iter().copied());
            }
            table
        }
        None => curves(panel),
    }
}

fn curves(panel: &Panel) -> Table {
    let mut rows: Vec<(&str, String, Option<f64>, [f64; 2])> = Vec::new();
    for family in &panel.families {
        for curve in &family.curves {
            let label = Text::new(&curve.label).plain();
            rows.extend(
                curve
                    .points()
                    .map(|point| (family.id.as_str(), label.clone(), curve.value, point)),
            );
        }
    }
    let mut table = Table::new();
    table.text("family", rows.iter().map(|row| row.0));
    table.text("curve", rows.iter().map(|row| row.1.clone()));
    table.number("value", rows.iter().map(|row| row.2));
    let [x, y] = names([&panel.x, &panel.y]);
    table.number(x, rows.iter().map(|row| row.3[0]));
    table.number(y, rows.iter().map(|row| row.3[1]));
    table
}

/// Names of the two columns, which must differ.
fn names([x, y]: [&Axis; 2]) -> [String; 2] {
    let (x, mut y) = (x.column.clone(), y.column.clone());
    if x == y {
        y.push_str("_y");
    }
    [x, y]
}
