//! The design form of Table 4.6.1.

use maud::{Markup, html};

use super::{
    Report,
    table::{Column, table},
};
use crate::{design::form, export::design_text::form_row};

/// The section.
pub fn form(report: &Report) -> Markup {
    let lines = form::form(report.result, &report.spec.demands);
    let rows: Vec<Vec<String>> = lines
        .iter()
        .map(|line| {
            // The entry names its row; the step stands before it.
            let mut row = form_row(line);
            row.swap(0, 1);
            row
        })
        .collect();
    let columns = [
        ("entry", Column::Head),
        ("step", Column::Text),
        ("symbol", Column::Symbol),
        ("SI", Column::Number),
        ("US", Column::Number),
    ];
    html! {
        section #form aria-labelledby="form-title" {
            h2 #form-title { "The design form" }
            p {
                "The steps of the procedure (Table 4.6.1), filled from the full models: where the "
                "procedure adds up chart readings (steps 6, 7, 14, 15, 22, 23), these are sums of "
                "the full response. Desired strokes are RMS values, a third of the limits."
            }
            (table("Design form", &columns, &rows))
        }
    }
}
