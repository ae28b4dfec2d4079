//! The front with the design behind every point.

use maud::{Markup, html};

use super::{
    Report,
    charts::figure,
    table::{Column, blocks, cells, class, table},
    typeset::typeset,
};
use crate::{
    design::{
        margin::worst_value,
        pareto::{Front, FrontPoint},
    },
    export::{certificate::certificate, pareto::sparse, sheet::Sheet, status},
    index::Index,
    parameter::Parameter,
    plot::{Axis, Curve, Family, Figure, Ink, Mark, Panel, Scale, Stroke, Symbol, System},
    units::number::{both, significant, value},
};

/// The section; none without a front.
pub fn front(report: &Report) -> Markup {
    let Some(front) = report.front else {
        return html! {};
    };
    let names: Vec<&str> = front.indices.iter().map(|i| i.words()).collect();
    html! {
        section.front #front aria-labelledby="front-title" {
            h2 #front-title { "The front of " (names.join(" and ")) }
            @if let Some(stop) = front.stopped {
                p { "The search ended early, " (stop) ": these points are done." }
            }
            @if front.points.is_empty() {
                p { "No design keeps the remaining requirements and limits: there is no front." }
            } @else {
                p {
                    "Each point is a converged optimum: the best in one index that the others allow. "
                    (front.points.len()) " points, " (front.dominated) " found and dominated; "
                    (front.evaluations) " evaluations of the full models."
                    @if let Some(why) = sparse(front) { " " (why) "." }
                }
                p.note.screen {
                    "Pick a point on the chart, or with its button in the table, to see the design "
                    "behind it; with the chart or a button in focus arrow keys go from point to point."
                }
                (figure(&chart(report, front)))
                (points(front))
                div.designs.screen aria-live="polite" {
                    @for (i, point) in front.points.iter().enumerate() { (design(front, i, point)) }
                }
            }
        }
    }
}

/// The front as a chart; of three indices, the second and third against the first.
fn chart(report: &Report, front: &Front) -> Figure {
    let mut drawn = Figure::new("", "front", "Front");
    let own: Vec<Option<f64>> = front
        .indices
        .iter()
        .map(|i| worst_value(&report.result.case, &report.spec.conditions, *i).ok())
        .collect();
    let conicities = conicities(front);
    for k in 1..front.indices.len() {
        let at = |point: &FrontPoint| [point.values[0], point.values[k]];
        let design = match (own[0], own[k]) {
            (Some(x), Some(y)) => Some([x, y]),
            _ => None,
        };
        let shown = || front.points.iter().map(at).chain(design);
        let x = axis(front.indices[0], shown().map(|p| p[0]));
        let y = axis(front.indices[k], shown().map(|p| p[1]));
        let mut panel = Panel::new(if k == 1 { "" } else { "second" }, x, y);
        if front.indices.len() == 2 {
            let line = Curve::line("front", front.points.iter().map(at));
            panel = panel.with(
                Family::new(
                    "front",
                    "",
                    Stroke::new(Ink::Grey, crate::plot::Dash::Solid),
                )
                .labelled(crate::plot::Labels::None)
                .curve(line),
            );
        }
        for (i, point) in front.points.iter().enumerate() {
            let ink = ink(&conicities, point);
            panel = panel.mark(Mark::new(at(point), Symbol::Disc, ink, (i + 1).to_string()));
        }
        panel = panel.mark(design.map(Mark::design));
        if conicities.len() > 1 {
            for (i, conicity) in conicities.iter().enumerate() {
                let label = format!("λ = {}", significant(*conicity, 3));
                panel
                    .keys
                    .push(Mark::new([0.0, 0.0], Symbol::Disc, Ink::nth(i), label));
            }
        }
        drawn = drawn.panel(panel);
    }
    let columns = drawn.panels.len();
    let others: Vec<&str> = front.indices[1..].iter().map(|i| i.words()).collect();
    drawn.title = format!(
        "Front of {} against {}",
        others.join(" and "),
        front.indices[0].words()
    );
    drawn.subtitle = report.name.into();
    drawn.columns(columns).described(
        "Points of the front, numbered as in the table below, and the design of this report.",
    )
}

/// Conicities of the front's wheel profiles, in order.
fn conicities(front: &Front) -> Vec<f64> {
    let mut list: Vec<f64> = front
        .points
        .iter()
        .map(|p| p.case.wheel_rail.conicity)
        .collect();
    list.sort_by(f64::total_cmp);
    list.dedup();
    list
}

fn ink(conicities: &[f64], point: &FrontPoint) -> Ink {
    let own = point.case.wheel_rail.conicity;
    let place = conicities.iter().position(|c| c.total_cmp(&own).is_eq());
    Ink::nth(place.unwrap_or(0))
}

fn axis(index: Index, values: impl Iterator<Item = f64>) -> Axis {
    let values: Vec<f64> = values.filter(|v| v.is_finite()).collect();
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let room = 0.06 * (high - low).max(1e-6 * high.abs()).max(f64::MIN_POSITIVE);
    let range = [low - room, high + room];
    let units = System::Si.units(index.quantity());
    Axis::new(
        index.words(),
        "",
        index.column(),
        Scale::Linear,
        range,
        units,
    )
    .rounded()
}

/// All points with their designs.
fn points(front: &Front) -> Markup {
    let mut columns: Vec<(&str, Column)> = front
        .indices
        .iter()
        .map(|i| (i.words(), Column::Number))
        .collect();
    columns.extend(
        front
            .parameters
            .iter()
            .map(|p| (p.symbol(), Column::Number)),
    );
    columns.push(("status", Column::Text));
    html! {
        div.table {
            table {
                caption { "Points of the front" }
                thead {
                    tr {
                        th scope="col" { "point" }
                        @for (head, column) in &columns {
                            th scope="col" class=[class(*column)] { (typeset(head)) }
                        }
                    }
                }
                tbody {
                    @for (i, point) in front.points.iter().enumerate() {
                        tr {
                            th scope="row" {
                                button type="button" data-point=(i) aria-pressed="false"
                                    aria-label=(format!("Show the design of point {}", i + 1)) { (i + 1) }
                            }
                            (cells(&columns, &row(front, point)))
                        }
                    }
                }
            }
        }
    }
}

fn row(front: &Front, point: &FrontPoint) -> Vec<String> {
    let pairs = front.indices.iter().zip(&point.values);
    let mut row: Vec<String> = pairs.map(|(i, v)| value(i.quantity(), *v)).collect();
    row.extend(
        front
            .parameters
            .iter()
            .map(|p| value(p.quantity(), p.get(&point.case))),
    );
    row.push(status::words(point.explained.status));
    row
}

/// The design behind a point.
fn design(front: &Front, i: usize, point: &FrontPoint) -> Markup {
    let mut rows: Vec<Vec<String>> = front
        .indices
        .iter()
        .zip(&point.values)
        .map(|(index, v)| {
            let [si, us] = both(index.quantity(), *v);
            vec![index.words().into(), String::new(), si, us]
        })
        .collect();
    rows.extend(Parameter::plain_of_table().map(|p| {
        let [si, us] = both(p.quantity(), p.get(&point.case));
        vec![p.words().into(), p.symbol().into(), si, us]
    }));
    let columns = [
        ("what", Column::Head),
        ("symbol", Column::Symbol),
        ("SI", Column::Number),
        ("US", Column::Number),
    ];
    let mut sheet = Sheet::new("");
    sheet.line(&format!("{}.", point.explained.goal));
    if !point.explained.active.is_empty() {
        sheet.line(&format!(
            "held back by: {}",
            point.explained.active.join("; ")
        ));
    }
    certificate(&mut sheet, &point.explained);
    let title = format!("Point {}", i + 1);
    html! {
        article data-design=(i) aria-label=(title) hidden[i > 0] {
            h3 { (title) }
            (table(&format!("Design of point {}", i + 1), &columns, &rows))
            (blocks(&sheet, &title))
        }
    }
}
