//! The checks of a finished design: nominal limits, stability, curving, ride, closed forms.

use maud::{Markup, html};

use super::{
    Report,
    table::{Column, blocks, table},
};
use crate::{
    evaluate::checks::checks as nominal,
    export::{
        cross_checks,
        evaluation_text::{check_row, curving, ride, stability},
        sheet::Sheet,
    },
};

/// The section.
pub fn checks(report: &Report) -> Markup {
    let (case, evaluation) = (&report.result.case, &report.result.evaluation);
    let rows: Vec<Vec<String>> = nominal(case, evaluation)
        .iter()
        .map(|check| {
            // The name first: it is the head of the row.
            let mut row = check_row(check);
            row.swap(0, 1);
            row
        })
        .collect();
    let columns = [
        ("what", Column::Head),
        ("verdict", Column::Verdict),
        ("value, SI", Column::Number),
        ("limit, SI", Column::Number),
        ("value, US", Column::Number),
        ("limit, US", Column::Number),
        ("section", Column::Text),
    ];
    let mut sheet = Sheet::new("");
    stability(&mut sheet, evaluation);
    curving(&mut sheet, evaluation);
    ride(&mut sheet, evaluation);
    cross_checks::table(&mut sheet, case, evaluation);
    html! {
        section #checks aria-labelledby="checks-title" {
            h2 #checks-title { "The checks" }
            p {
                "Nominal limits of the methodology (3.3), separation of natural frequencies "
                "(3.5.3, 4.3). They are looked at whether or not the spec limits them. The "
                "performance at half the creep coefficients stands in the "
                a href="#performance" { "performance table" } "."
            }
            (table("Nominal constraints", &columns, &rows))
            (blocks(&sheet, "Checks"))
        }
    }
}
