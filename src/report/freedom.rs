//! The optimum, the design delivered, and the ranges over which the variables are free, each with a bar
//! beside its bounds.

use maud::{Markup, html};

use super::{
    Report,
    typeset::{symbol, typeset},
};
use crate::{
    design::{explain::Chosen, freedom::Free},
    export::freedom::{bounds_met, delivered, ends, losses, meaning, variables},
    units::number::in_unit,
};

/// Length and height of a bar, in its own units.
const LENGTH: f64 = 200.0;
const HEIGHT: f64 = 14.0;

/// The table; none where nothing is known of the surroundings of the optimum.
pub fn freedom(report: &Report) -> Markup {
    let (result, space) = (report.result, &report.spec.design);
    if !report.designed || result.is_optimum() && result.free.is_empty() {
        return html! {};
    }
    html! {
        h3 { "How free the variables are" }
        p { (delivered(result, space)) "." }
        div.table {
            table aria-label="How free the variables are" {
                thead {
                    tr {
                        th scope="col" { "variable" }
                        th scope="col" { "symbol" }
                        @for head in ["optimum", "delivered", "free from", "to"] {
                            th.number scope="col" { (head) }
                        }
                        th scope="col" { "within its bounds" }
                    }
                }
                tbody {
                    @for (i, chosen) in variables(result).enumerate() { (row(report, i, chosen)) }
                }
            }
        }
        @if let Some(losses) = losses(result) { p.note { (typeset(&losses)) "." } }
        @if !result.free.is_empty() {
            p.note {
                (meaning(space)) ". A bar runs from bound to bound, as the variable is scaled; filled: free; "
                "line: optimum; circle: delivered. With ≤ or ≥ the range may reach further."
            }
        }
    }
}

fn row(report: &Report, i: usize, chosen: &Chosen) -> Markup {
    let result = report.result;
    let unit = chosen.variable.quantity.si();
    let free = result.free(chosen.parameter);
    let delivered = chosen.parameter.get(&result.case);
    let [from, to] = free.map_or(["–".into(), "–".into()], |free| ends(free, unit));
    html! {
        tr {
            th scope="row" { (chosen.variable.name) }
            td { (symbol(chosen.variable.symbol)) }
            td.number { (typeset(&in_unit(unit, chosen.value, 4))) }
            td.number { (typeset(&in_unit(unit, delivered, 4))) }
            td.number { (typeset(&from)) }
            td.number { (typeset(&to)) }
            td { @if let Some(free) = free { (bar(i, chosen, free, delivered)) } }
        }
    }
}

/// To a tenth of a bar's unit: finer than a screen.
fn rounded(length: f64) -> f64 {
    (10.0 * length).round() / 10.0
}

fn bar(i: usize, chosen: &Chosen, free: &Free, delivered: f64) -> Markup {
    let at = |value| rounded(LENGTH * chosen.variable.coordinate(value));
    let [from, to] = free.ends.map(|end| at(end.value));
    // A range of no length still shows.
    let length = rounded((to - from).max(1.0));
    let id = format!("free-{i}");
    let unit = chosen.variable.quantity.si();
    let [low, high] = chosen.variable.bounds.map(|bound| in_unit(unit, bound, 4));
    let [lower, upper] = ends(free, unit);
    let all = match bounds_met(free) {
        "" => String::new(),
        met => format!(", {met}"),
    };
    let middle = HEIGHT / 2.0;
    html! {
        svg.free role="img" aria-labelledby=(id) viewBox=(format!("-6 0 {} {HEIGHT}", LENGTH + 12.0)) {
            desc id=(id) { "bounds " (low) " to " (high) "; free from " (lower) " to " (upper) (all) }
            rect.bounds x="0" y=(middle - 2.0) width=(LENGTH) height="4" {}
            rect.range x=(from) y=(middle - 4.0) width=(length) height="8" {}
            line x1=(at(chosen.value)) x2=(at(chosen.value)) y1="0" y2=(HEIGHT) {}
            circle cx=(at(delivered)) cy=(middle) r="3" {}
        }
    }
}
