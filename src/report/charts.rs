//! The charts of a report, and the data that let them answer to the reader.

use maud::{Markup, PreEscaped, html};
use serde_json::{Value, json};

use super::Report;
use crate::{
    case::Case,
    chart::{Entry, Progress, Workbook, find},
    parameter::Parameter,
    plot::{Axis, Drawing, Figure, Frame, Ink, Mark, Panel, Symbol, System, Text, Theme},
    spec::Spec,
};

/// Charts of the stability–curving trade-off, with their conicities.
const STABILITY_CURVING: [(f64, &str); 4] = [
    (0.05, "stability-curving-0.05"),
    (0.10, "stability-curving-0.10"),
    (0.15, "stability-curving-0.15"),
    (0.25, "stability-curving-0.25"),
];

/// The others, in the order of the page.
const OTHERS: [&str; 9] = [
    "speed-bending-stiffness",
    "speed-lateral-stiffness",
    "root-locus",
    "curving-boundary",
    "lateral-ride",
    "lateral-spectrum",
    "vertical-points",
    "vertical-spectra",
    "iso-boundary",
];

/// The charts for a design: that of the conicity nearest to its own comes first.
pub fn entries(case: &Case) -> Vec<&'static Entry> {
    let far = |conicity: f64| (conicity / case.wheel_rail.conicity).ln().abs();
    let nearest = STABILITY_CURVING
        .iter()
        .min_by(|a, b| far(a.0).total_cmp(&far(b.0)))
        .map(|(_, name)| *name);
    nearest.into_iter().chain(OTHERS).filter_map(find).collect()
}

/// Draws the charts of a design with its spec's limits. `shown` is told of each before it is drawn.
pub fn figures(
    spec: &Spec,
    name: &str,
    design: &Case,
    progress: &dyn Progress,
    shown: impl Fn(&Entry),
) -> Vec<Figure> {
    let designed = Spec {
        case: design.clone(),
        ..spec.clone()
    };
    let book = Workbook::new(&designed, name, System::Si, progress);
    entries(design)
        .into_iter()
        .map(|entry| {
            shown(entry);
            let mut figure = entry.draw(&book);
            for panel in &mut figure.panels {
                given(panel, &spec.case, design);
            }
            figure
        })
        .collect()
}

/// Marks the design as given on a panel over two parameters.
fn given(panel: &mut Panel, given: &Case, design: &Case) {
    let parameter = |axis: &Axis| Parameter::all().find(|p| p.column() == axis.column);
    let (Some(x), Some(y)) = (parameter(&panel.x), parameter(&panel.y)) else {
        return;
    };
    let at = [x.get(given), y.get(given)];
    let still = |axis: Parameter| axis.get(given).total_cmp(&axis.get(design)).is_eq();
    let moved = !(still(x) && still(y));
    let profile = (given.wheel_rail.conicity - design.wheel_rail.conicity).abs() < 1e-9;
    if moved && profile {
        panel
            .marks
            .push(Mark::new(at, Symbol::Ring, Ink::Vermilion, "as given"));
    }
}

/// The section.
pub fn charts(report: &Report) -> Markup {
    if report.figures.is_empty() {
        return html! {};
    }
    html! {
        section #charts aria-labelledby="charts-title" {
            h2 #charts-title { "The charts" }
            p {
                "The methodology's charts for this vehicle, with its design and limits. Numbers "
                "are those of the report's figures."
            }
            p.note.screen {
                "Point at a chart to read values, in both units. With a chart in focus, arrow keys "
                "walk along its points and curves (left and right) and from one to the next (up "
                "and down), + and − look closer and back, 0 shows the whole, Shift with arrow keys "
                "moves the view, Page Up and Page Down change the panel. The wheel zooms with Ctrl "
                "held or while the chart has the focus; drag to move."
            }
            @for drawn in report.figures { (figure(drawn)) }
        }
    }
}

/// A chart that answers: drawing, tools, what is read out, words, data.
pub fn figure(figure: &Figure) -> Markup {
    let drawing = Drawing::new(figure);
    let title = Text::new(&figure.title).plain();
    let tools = [
        ("in", "+", "Look closer"),
        ("out", "−", "Look from further away"),
        ("left", "←", "Move the view left"),
        ("right", "→", "Move the view right"),
        ("up", "↑", "Move the view up"),
        ("down", "↓", "Move the view down"),
        ("whole", "Whole", "Show the whole chart"),
    ];
    html! {
        figure.chart data-chart=(figure.name) {
            div.chart-tools hidden role="group" aria-label=(format!("View of: {title}")) {
                @for (action, face, words) in tools {
                    button type="button" data-action=(action) aria-label=(words) title=(words) { (face) }
                }
            }
            div.plot-scroll {
                div.plot tabindex="0" role="application" aria-roledescription="chart" aria-label=(title) {
                    (PreEscaped(drawing.svg(Theme::Bare)))
                }
            }
            output aria-live="polite" {}
            figcaption { (Text::new(&figure.description).plain()) }
            script type="application/json" { (PreEscaped(data(&drawing))) }
        }
    }
}

/// The numbers behind a chart, SI, as JSON that may stand in a script element.
fn data(drawing: &Drawing) -> String {
    let panels: Vec<Value> = drawing
        .figure
        .panels
        .iter()
        .zip(&drawing.frames)
        .map(|(panel, frame)| panel_data(panel, frame))
        .collect();
    // A `<` could end the element.
    json!({ "panels": panels })
        .to_string()
        .replace('<', "\\u003c")
}

fn panel_data(panel: &Panel, frame: &Frame) -> Value {
    let axis = |axis: &Axis| {
        let name = if axis.symbol.is_empty() {
            &axis.title
        } else {
            &axis.symbol
        };
        let units: Vec<Value> = axis
            .units
            .iter()
            .map(|unit| json!([Text::new(&unit.label).plain(), unit.factor]))
            .collect();
        json!({
            "name": Text::new(name).plain(),
            "log": axis.scale == crate::plot::Scale::Log,
            "range": axis.range,
            "units": units,
        })
    };
    let curves = panel.families.iter().flat_map(|family| {
        family.curves.iter().map(|curve| {
            let parts = [&family.title, &curve.label].map(|text| Text::new(text).plain());
            let label: Vec<String> = parts.into_iter().filter(|text| !text.is_empty()).collect();
            let pieces: Vec<Vec<[f64; 2]>> = curve
                .pieces
                .iter()
                .map(|piece| piece.iter().map(|point| point.map(rounded)).collect())
                .collect();
            json!({ "label": label.join(", "), "pieces": pieces })
        })
    });
    let curves: Vec<Value> = curves.collect();
    let marks: Vec<Value> = panel
        .marks
        .iter()
        .map(|mark| json!({ "label": Text::new(&mark.label).plain(), "at": mark.at }))
        .collect();
    let edges = [frame.x, frame.y, frame.width, frame.height];
    let edges = edges.map(|v| (10.0 * v).round() / 10.0);
    json!({
        "title": Text::new(&panel.title).plain(),
        "frame": edges,
        "x": axis(&panel.x),
        "y": axis(&panel.y),
        "curves": curves,
        "marks": marks,
    })
}

/// To six figures: more than a reading shows.
fn rounded(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}
