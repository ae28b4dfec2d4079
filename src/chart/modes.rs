//! Natural frequencies and damping ratios (Figures 4.3.1, 4.4.1).

use super::{
    Entry, comfort::frequency_axis, performance::lateral_modes, value::number, workbook::Workbook,
};
use crate::{
    dynamics::{LateralModel, VerticalModel},
    evaluate::modes::{LateralShape, OVERDAMPED, VerticalShape, vertical_modes},
    numerics::Poles,
    parameter::Parameter,
    plot::{Axis, Curve, Family, Figure, Ink, Labels, Mark, Panel, Scale, Stroke, Symbol, Unit},
};

/// A mode to be shown.
struct Shown {
    at: [f64; 2],
    kind: usize,
    name: String,
}

/// Looks of carbody, flexible, hunting and truck modes.
const LOOKS: [(Symbol, Ink, &str); 4] = [
    (Symbol::Disc, Ink::Black, "carbody"),
    (Symbol::Triangle, Ink::Blue, "flexible carbody"),
    (Symbol::Square, Ink::Vermilion, "hunting"),
    (Symbol::Ring, Ink::Green, "trucks and wheelsets"),
];

/// Modes nearer to each other than this share a mark: those of the two trucks.
const TWINS: f64 = 0.02;

fn chart(figure: Figure, mut modes: Vec<Shown>) -> Figure {
    modes.retain(|m| m.at[1] < OVERDAMPED);
    let mut marks: Vec<(Shown, usize)> = Vec::new();
    for mode in modes {
        let twin = marks.iter_mut().find(|(known, _)| {
            known.name == mode.name
                && (known.at[0] / mode.at[0] - 1.0).abs() < TWINS
                && (known.at[1] - mode.at[1]).abs() < TWINS
        });
        match twin {
            Some((_, count)) => *count += 1,
            None => marks.push((mode, 1)),
        }
    }
    let frequencies = marks.iter().map(|(m, _)| m.at[0]);
    let x = frequency_axis([0.3, 50.0]).holding(frequencies);
    let y = Axis::new(
        "damping ratio",
        "ζ",
        "damping_ratio",
        Scale::Linear,
        [0.0, 0.1],
        [Unit::new("", 1.0)],
    )
    .holding(marks.iter().map(|(m, _)| m.at[1] * 1.08));
    let mut panel = Panel::new("", x, y);
    // What the marks show, as a table.
    let mut family = Family::new("modes", "", Stroke::default()).labelled(Labels::None);
    for (kind, (symbol, ink, name)) in LOOKS.into_iter().enumerate() {
        if marks.iter().any(|(m, _)| m.kind == kind) {
            panel.keys.push(Mark::new([0.0; 2], symbol, ink, name));
        }
    }
    for (mode, count) in marks {
        let (symbol, ink, _) = LOOKS[mode.kind];
        let times = if count > 1 {
            format!(" (×{count})")
        } else {
            String::new()
        };
        let [frequency, ratio] = mode.at;
        family = family.curve(Curve::line(mode.name.clone(), [mode.at]));
        panel = panel.mark(Mark::new(
            [frequency, ratio],
            symbol,
            ink,
            format!("{}{times}, {} Hz", mode.name, number(frequency, 3)),
        ));
    }
    figure.panel(panel.with(family))
}

/// Modes of the vertical model.
pub(super) fn vertical(book: &Workbook, entry: &Entry) -> Figure {
    let model = VerticalModel::new(book.case());
    let found = Poles::at(&model.forced, book.case().service.speed)
        .and_then(|poles| vertical_modes(&model, &poles))
        .unwrap_or_default();
    let modes = found
        .iter()
        .map(|m| Shown {
            at: [m.frequency, m.damping_ratio],
            kind: match m.shape {
                VerticalShape::CarbodyHeave
                | VerticalShape::CarbodyPitch
                | VerticalShape::CarbodyRoll => 0,
                shape if shape.is_flexible() => 1,
                _ => 3,
            },
            name: m.shape.to_string(),
        })
        .collect();
    let figure = entry
        .figure("Natural frequencies and damping ratios, vertical model")
        .described(
            "Damping ratio over natural frequency of every mode of the vertical model, with its \
             name.",
        );
    let mut figure = chart(figure, modes);
    figure.subtitle = format!("{}, at any speed", book.name);
    figure
}

/// Modes of the lateral model at the operating speed.
pub(super) fn lateral(book: &Workbook, entry: &Entry) -> Figure {
    let case = book.case();
    let speed = case.service.speed;
    let modes = lateral_modes(case, &LateralModel::new(case), speed)
        .iter()
        .map(|m| Shown {
            at: [m.frequency, m.damping_ratio],
            kind: match m.shape {
                LateralShape::LowerSway | LateralShape::UpperSway | LateralShape::CarbodyYaw => 0,
                LateralShape::Kinematic => 2,
                _ => 3,
            },
            name: m.shape.to_string(),
        })
        .collect();
    let figure = entry
        .figure("Natural frequencies and damping ratios, lateral model")
        .described(
            "Damping ratio over natural frequency of every oscillatory mode of the lateral model \
             at the operating speed, with its name.",
        );
    let mut figure = chart(figure, modes);
    figure.subtitle = book.subtitle(Some(speed), &[Parameter::CONICITY]);
    figure.note("Modes with a damping ratio above 0.999 are left out.")
}
