//! Charts: what the report says of its figures, read off the drawn ones; how they are drawn; and
//! the command as a user calls it.

mod command;
mod drawing;
mod gallery;
mod lateral_ride;
mod modes;
mod stability_curving;
mod track;
mod vertical_ride;

use crate::support;
use bogie::{
    chart::{Workbook, find},
    plot::{Curve, Figure, System},
    spec::Spec,
};

/// The prototype of Table 4.1.1, with the secondary yaw stiffness of one of its columns.
fn prototype(yaw_stiffness: &str) -> Spec {
    let source = format!(
        "[service]\nspeed = \"110 mph\"\ntrack = \"fra-class-6\"\n[vehicle]\nbase = \
         \"prototype\"\n[suspension.secondary]\nyaw_stiffness = \"{yaw_stiffness}\""
    );
    Spec::parse(&source).unwrap_or_else(|m| panic!("{}", m.render("prototype", &source, false)))
}

/// Column "Stability/Curving" of Table 4.1.1.
fn stability_column() -> Spec {
    prototype("1e6 lbf ft/rad")
}

/// Column "Lateral Forced Response" of Table 4.1.1.
fn lateral_column() -> Spec {
    prototype("6e6 lbf ft/rad")
}

fn workbook(spec: &Spec) -> Workbook<'_> {
    Workbook::new(spec, "prototype", System::Us, &())
}

fn figure(book: &Workbook, number: &str) -> Figure {
    find(number).unwrap().draw(book)
}

/// The curve of a panel with that label.
fn curve<'a>(figure: &'a Figure, panel: usize, label: &str) -> &'a Curve {
    figure.panels[panel]
        .families
        .iter()
        .flat_map(|family| &family.curves)
        .find(|curve| curve.label == label)
        .unwrap_or_else(|| panic!("no curve {label} in {}", figure.number))
}

/// y of a curve at x, straight between its points.
fn at(curve: &Curve, x: f64) -> f64 {
    curve
        .pieces
        .iter()
        .flat_map(|piece| piece.windows(2))
        .find(|w| (w[0][0]..=w[1][0]).contains(&x))
        .map_or(f64::NAN, |w| {
            let t = (x - w[0][0]) / (w[1][0] - w[0][0]);
            w[0][1] + t * (w[1][1] - w[0][1])
        })
}
