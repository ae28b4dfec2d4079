//! Stability against curving: lines of constant critical speed and degree curve over the primary
//! stiffnesses (Figures 4.5.6, 4.5.11, 4.5.12, 4.6.1–4.6.4), and the envelopes of the best designs
//! (Figure 4.5.13).

use super::{
    Entry,
    curving::degree_axis,
    performance::{critical_speed, degree_curve},
    value::number,
    workbook::{CONICITIES, MPH, Workbook},
};
use crate::{
    index::Index,
    parameter::Parameter,
    plot::{Axis, Curve, Dash, Direction, Family, Field, Figure, Ink, Mark, Panel, Stroke, Weight},
    units::Quantity,
};

/// Layers of the fields.
const DEGREE: usize = 0;
const SPEED: usize = 1;

/// Degrees of the lines of constant curving.
const DEGREES: [f64; 14] = [
    0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 6.0, 10.0,
];

/// Lines of constant critical speed and curving at one of [`CONICITIES`].
pub(super) fn contours(book: &Workbook, entry: &Entry, index: usize) -> Figure {
    let conicity = CONICITIES[index];
    let [x, y] = book.stiffness_axes();
    let field = book.stability_curving(index);
    let mut panel = Panel::new("", x.clone(), y.clone());
    let axes = [&x, &y];
    panel = panel
        .with(speed_lines(book, &field, axes))
        .with(curving_lines(
            &field,
            axes,
            Stroke::new(Ink::Blue, Dash::Dashed),
            &DEGREES,
        ));
    let demands = &book.spec.demands;
    let mut required = Family::new(
        "required",
        "",
        Stroke::new(Ink::Vermilion, Dash::Solid).weight(Weight::Bold),
    );
    if let Some(speed) = demands.get(Index::CriticalSpeed) {
        let label = format!("required {}", book.value(Quantity::Speed, speed, 3));
        required = required.curve(Curve::pieces(label, field.level(SPEED, speed, axes)).at(speed));
    }
    if let Some(degree) = demands.get(Index::DegreeCurve) {
        let degree = degree.to_degrees();
        let line = Curve::pieces(
            format!("required {}°", number(degree, 3)),
            field.level(DEGREE, degree, axes),
        );
        required = required.curve(
            line.at(degree.to_radians())
                .stroke(Stroke::new(Ink::Vermilion, Dash::Dashed).weight(Weight::Bold)),
        );
    }
    panel = panel.with(required);
    let own = book.case().wheel_rail.conicity;
    if (own - conicity).abs() < 1e-9 {
        panel = panel.mark(book.design(
            Parameter::PRIMARY_BENDING_STIFFNESS,
            Parameter::PRIMARY_LATERAL_STIFFNESS,
        ));
    }
    panel.field = Some(field);
    let kind = if conicity <= 0.05 {
        "conical"
    } else {
        "profiled"
    };
    let mut figure = entry
        .figure(format!(
            "Lines of constant critical speed and curving, λ\u{a0}=\u{a0}{conicity}"
        ))
        .panel(panel)
        .described(format!(
            "Lines of constant critical speed and of constant degree curve over the primary \
             bending stiffness and the primary lateral stiffness, for wheel conicity {conicity}."
        ));
    figure.subtitle = format!(
        "{}; {kind} wheels, zero cant deficiency",
        book.subtitle(
            None,
            &[
                Parameter::SECONDARY_YAW_STIFFNESS,
                Parameter::SECONDARY_YAW_BREAKAWAY_TORQUE,
            ],
        )
    );
    if (own - conicity).abs() >= 1e-9 {
        figure = figure.note(format!(
            "The design has conicity {own}: it is not on this chart."
        ));
    }
    figure
}

fn speed_lines(book: &Workbook, field: &Field, axes: [&Axis; 2]) -> Family {
    let unit = book.unit(Quantity::Speed);
    let step = if unit.label == "mph" { 25.0 } else { 40.0 };
    let mut family = Family::new(
        "critical-speed",
        format!("critical speed, {}", unit.label),
        Stroke::new(Ink::Black, Dash::Solid),
    );
    for n in 1..=16 {
        let speed = step * f64::from(n);
        let lines = field.level(SPEED, speed * unit.factor, axes);
        // The required speed has a line of its own.
        let required = book.spec.demands.get(Index::CriticalSpeed);
        let same = required.is_some_and(|r| (r / (speed * unit.factor) - 1.0).abs() < 1e-3);
        if !lines.is_empty() && !same {
            family = family.curve(Curve::pieces(format!("{speed}"), lines).at(speed * unit.factor));
        }
    }
    family
}

pub(super) fn curving_lines(
    field: &Field,
    axes: [&Axis; 2],
    stroke: Stroke,
    degrees: &[f64],
) -> Family {
    let mut family = Family::new("degree-curve", "degree curve", stroke);
    for degree in degrees {
        let lines = field.level(DEGREE, *degree, axes);
        if !lines.is_empty() {
            let line = Curve::pieces(format!("{degree}°"), lines);
            family = family.curve(line.at(degree.to_radians()));
        }
    }
    family
}

/// Critical speeds of the envelopes, mph: first, last and step.
const ENVELOPE: [f64; 3] = [50.0, 400.0, 2.5];

/// Where the edges of cliffs come down to a level.
fn on_cliffs(cliffs: &[[([f64; 2], f64); 2]], level: f64) -> impl Iterator<Item = [f64; 2]> + '_ {
    cliffs.iter().filter_map(move |[(p, at_p), (q, at_q)]| {
        let t = (level - at_p) / (at_q - at_p);
        let between = |k: usize| p[k] * (q[k] / p[k]).powf(t);
        (0.0..=1.0).contains(&t).then(|| [between(0), between(1)])
    })
}

/// The largest degree curve that a vehicle with at least a critical speed reaches, over the speed,
/// at one of [`CONICITIES`]: along every line of constant critical speed the best point, and no
/// worse than at any higher speed.
fn envelope(book: &Workbook, index: usize) -> Curve {
    let [x, y] = book.stiffness_axes();
    let axes = [&x, &y];
    let [first, last, step] = ENVELOPE;
    let field = book.stability_curving(index);
    let cliffs = field.cliffs(SPEED, axes);
    let mut best: f64 = f64::NAN;
    let mut points = Vec::new();
    let mut speed = last;
    while speed >= first {
        let at_level = field
            .level(SPEED, speed * MPH, axes)
            .into_iter()
            .flatten()
            .chain(on_cliffs(&cliffs, speed * MPH))
            .filter_map(|point| field.value(DEGREE, point, axes))
            .fold(f64::NAN, f64::max);
        best = best.max(at_level);
        if best.is_finite() {
            points.push([speed * MPH, best]);
        }
        speed -= step;
    }
    points.reverse();
    let conicity = CONICITIES[index];
    Curve::line(format!("λ = {conicity}"), points)
        .at(conicity)
        .stroke(Stroke::nth(index))
}

/// The envelopes of all conicities.
pub(super) fn envelopes(book: &Workbook, entry: &Entry) -> Figure {
    let curves = (0..CONICITIES.len()).map(|index| envelope(book, index));
    let family = Family::new("conicity", "", Stroke::default()).curves(curves);
    let case = book.case();
    let design = critical_speed(case)
        .ok()
        .flatten()
        .and_then(|speed| Some(Mark::design([speed, degree_curve(case)?])))
        .map(|mark| Mark {
            label: format!("design, λ = {}", number(case.wheel_rail.conicity, 3)),
            ..mark
        });
    let speed_axis = book
        .critical_speed_axis([ENVELOPE[0] * MPH, 300.0 * MPH])
        .holding(design.iter().map(|mark| mark.at[0]));
    let shown = family
        .curves
        .iter()
        .flat_map(Curve::points)
        .filter(|p| speed_axis.holds(p[0]))
        .map(|p| p[1])
        .fold(0.0, f64::max);
    let degree = degree_axis([0.0, shown.min(8.0)]).holding(design.iter().map(|mark| mark.at[1]));
    let panel = Panel::new("", speed_axis, degree)
        .with(family)
        .limit(book.required(Index::CriticalSpeed, Direction::X))
        .limit(book.required(Index::DegreeCurve, Direction::Y))
        .mark(design);
    let mut figure = entry
        .figure("Optimum stability–curving envelopes")
        .panel(panel)
        .described(
            "The largest degree curve without flange contact or slip over the critical speed, a \
             curve for each of five wheel conicities; the design is marked.",
        )
        .note(
            "Best over the primary bending and lateral stiffnesses of the charts of constant \
             critical speed and curving.",
        );
    figure.subtitle = format!(
        "{}, zero cant deficiency",
        book.subtitle(
            None,
            &[
                Parameter::SECONDARY_YAW_STIFFNESS,
                Parameter::SECONDARY_YAW_BREAKAWAY_TORQUE,
            ],
        )
    );
    figure
}
