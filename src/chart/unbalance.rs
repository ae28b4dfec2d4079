//! Limits of lateral unbalance (Figure 3.2.5): the region of acceptable steady-state curving in
//! cant deficiency against degree curve.

use super::{
    Entry,
    curving::{cant_units, degree_axis, height},
    workbook::{MPH, Workbook},
};
use crate::{
    evaluate::limits::CANT_DEFICIENCY,
    plot::{
        Axis, Curve, Dash, Direction, Family, Figure, Ink, Panel, Scale, Shade, Stroke, System,
        Weight,
    },
    track::{SUPERELEVATION_BASE, cant_deficiency, curvature_of_degree, fra_speed_limit},
    units::{Quantity, us::INCH},
};

/// Greatest superelevation of main line and of yard curves, m (3.2.3).
const MAIN: f64 = 6.0 * INCH;
const YARD: f64 = INCH;
/// Largest degree curve shown.
const LARGEST: f64 = 15.0;

/// Draws it.
pub(super) fn draw(book: &Workbook, entry: &Entry) -> Figure {
    let degrees: Vec<f64> = Scale::Linear.spread([0.05, LARGEST], 151);
    let angle = |height: f64| height / SUPERELEVATION_BASE;
    // (3.2-2) put into (3.2-1).
    let limit = |d: f64| {
        let speed = fra_speed_limit(MAIN, CANT_DEFICIENCY, d);
        [
            d,
            cant_deficiency(speed, curvature_of_degree(d), angle(MAIN)),
        ]
    };
    let at_limit = degrees.iter().map(|d| limit(*d));
    let main = height(book.system, MAIN);
    let bold = |dash| Stroke::new(Ink::Vermilion, dash).weight(Weight::Bold);
    let bounds = Family::new("boundary", "", bold(Dash::Solid))
        .curve(Curve::line(
            format!("FRA speed limit (3.2-2) on {main} superelevation"),
            at_limit,
        ))
        .curve(Curve::line(
            format!("at rest on {main} superelevation"),
            [[0.0, -angle(MAIN)], [LARGEST, -angle(MAIN)]],
        ))
        .curve(
            Curve::line(
                format!(
                    "at rest on {} superelevation (yards)",
                    height(book.system, YARD)
                ),
                [[0.0, -angle(YARD)], [LARGEST, -angle(YARD)]],
            )
            .stroke(bold(Dash::Long)),
        );
    let service = book.case().service.speed;
    let mut speeds: Vec<f64> = match book.system {
        System::Us => [20.0, 40.0, 60.0, 80.0, 110.0].map(|v| v * MPH).to_vec(),
        System::Si => [30.0, 60.0, 100.0, 130.0, 180.0].map(|v| v / 3.6).to_vec(),
    };
    speeds.retain(|v| (v / service - 1.0).abs() > 0.02);
    let line = |speed: f64| {
        let points = degrees.iter().map(|d| {
            [
                *d,
                cant_deficiency(speed, curvature_of_degree(*d), angle(MAIN)),
            ]
        });
        Curve::line(
            book.value(Quantity::Speed, speed, 3),
            points.collect::<Vec<_>>(),
        )
        .at(speed)
    };
    let lines = Family::new(
        "speed",
        format!("constant speed on {main} superelevation"),
        Stroke::new(Ink::Blue, Dash::Dashed),
    )
    .curves(speeds.into_iter().map(line))
    .curve(line(service).stroke(Stroke::new(Ink::Blue, Dash::Solid).weight(Weight::Bold)));
    let y = Axis::new(
        "cant deficiency",
        "φ_d",
        "cant_deficiency_rad",
        Scale::Linear,
        [-7.0, 4.0].map(f64::to_radians),
        cant_units(book.system),
    );
    let mut figure = entry
        .figure("Limits of lateral unbalance")
        .panel(
            Panel::new("", degree_axis([0.0, LARGEST]), y)
                .shade(Shade {
                    axis: Direction::Y,
                    range: [-angle(MAIN), limit(1.0)[1]],
                    label: String::new(),
                })
                .with(lines)
                .with(bounds),
        )
        .described(
            "Cant deficiency over degree curve: the FRA's limit of 3 in unbalance above, the \
             vehicle at rest on 6 in (main line) and 1 in (yards) of superelevation below, and \
             lines of constant speed.",
        )
        .note(
            "Acceptable where shaded, in yards down to the broken line; without track \
             irregularities. Superelevation is measured over 56 in. With the FRA's rounded 0.0007 \
             its 3 in of unbalance come out as 2.4 in by (3.2-1).",
        );
    figure.subtitle = format!(
        "service speed {} of {}",
        book.both(Quantity::Speed, service, 3),
        book.name
    );
    figure
}
