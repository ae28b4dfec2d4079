//! The design parameters before and after.

use maud::{Markup, html};

use super::{
    Report,
    freedom::freedom,
    table::{Column, table},
    typeset::symbol,
};
use crate::{parameter::Parameter, units::number::both};

/// The section.
pub fn parameters(report: &Report) -> Markup {
    let designed = &report.spec.design;
    let shown = Parameter::all().filter(|p| p.is_of_table() || designed.freedom(*p).is_some());
    let rows: Vec<Vec<String>> = shown.map(|p| row(report, p)).collect();
    let mut columns = vec![("parameter", Column::Head), ("symbol", Column::Symbol)];
    columns.extend(if report.designed {
        [
            ("as given, SI", Column::Number),
            ("as given, US", Column::Number),
            ("designed, SI", Column::Number),
            ("designed, US", Column::Number),
            ("change", Column::Number),
        ]
        .to_vec()
    } else {
        vec![("SI", Column::Number), ("US", Column::Number)]
    });
    html! {
        section #parameters aria-labelledby="parameters-title" {
            h2 #parameters-title { "The parameters" }
            (table("Suspension and wheel profile (Table 4.1.1)", &columns, &rows))
            p.note {
                "Primary stiffnesses are per corner, four per truck; secondary ones per side, two "
                "per truck; yaw per truck. Frequencies and damping ratios are those of the carbody "
                "on its secondary springs (4.6-8, 9, 14, 15); "
                (symbol("K_b")) " = " (symbol("d_p^2")) " " (symbol("K_px")) "."
            }
            (freedom(report))
        }
    }
}

fn row(report: &Report, parameter: Parameter) -> Vec<String> {
    let [before, after] = [&report.spec.case, &report.result.case].map(|case| parameter.get(case));
    let mut row = vec![parameter.words().into(), parameter.symbol().into()];
    row.extend(both(parameter.quantity(), before));
    if report.designed {
        row.extend(both(parameter.quantity(), after));
        let change = 100.0 * (after / before - 1.0);
        row.push(
            if !change.is_finite() || before.to_bits() == after.to_bits() {
                "–".into()
            } else {
                format!("{change:+.1} %")
            },
        );
    }
    row
}
