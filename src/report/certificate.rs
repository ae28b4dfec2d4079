//! Certificate of a design, in words.

use maud::{Markup, html};

use super::{Report, table::blocks};
use crate::export::{
    certificate::joint,
    design_text::{MATTERS, trade_off},
    sensitivity::summary,
    sheet::Sheet,
};

/// The section; none for a design as it stands.
pub fn certificate(report: &Report) -> Markup {
    if !report.designed {
        return html! {};
    }
    let result = report.result;
    let mut sheet = Sheet::new("");
    for stage in &result.stages {
        trade_off(&mut sheet, stage);
    }
    joint(&mut sheet, result);
    html! {
        section #certificate aria-labelledby="certificate-title" {
            h2 #certificate-title { "The certificate" }
            p {
                "At an optimum within limits no small change of the parameters gains anything that "
                "a limit would not forbid. The first-order residual says how nearly that holds "
                "(zero: exactly, in scaled variables). “Held back by” names the limits that are "
                "active; their prices say what a unit of each costs. Starts that agree are "
                "searches from different designs that ended at the same one."
            }
            (blocks(&sheet, "Trade-off"))
            p {
                (result.effort.evaluations) " evaluations of the full models in all"
                @if result.effort.failed() > 0 {
                    ", " (result.effort.failed()) " of them without a result"
                }
                "."
            }
        }
    }
}

/// Parameters to which the performance is sensitive; empty where this was not looked into.
pub fn matters(report: &Report) -> Markup {
    let Some(matters) = report.matters else {
        return html! {};
    };
    let mut sheet = Sheet::new("");
    sheet.table(&["index", "changes"], &[1], &summary(matters, MATTERS));
    html! {
        section #matters aria-labelledby="matters-title" {
            h2 #matters-title { "What matters" }
            p { "Change as an input goes from 10 % below the design to 10 % above." }
            (blocks(&sheet, "What matters"))
        }
    }
}
