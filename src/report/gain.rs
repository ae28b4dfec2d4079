//! Values that a design reaches in the indices that are traded off, beside what was given.

use maud::{Markup, html};

use super::{
    Report,
    table::{Column, table},
};
use crate::{
    design::margin::{margins, value},
    export::certificate::reached as in_words,
    index::{Index, Sense},
    optimize::problem::Failure,
    units::number::value as written,
};

/// The indices that the methodology trades off, and others that the objective names.
fn headline(report: &Report) -> Vec<Index> {
    let mut indices = vec![
        Index::CriticalSpeed,
        Index::DegreeCurve,
        Index::LateralAcceleration,
        Index::VerticalAcceleration,
    ];
    for goal in &report.spec.objective {
        if !indices.contains(&goal.index) {
            indices.push(goal.index);
        }
    }
    indices
}

/// Values that the design reaches, with their gain or loss against the design as given.
pub fn gain(report: &Report) -> Markup {
    html! {
        (reached(report))
        @if report.designed { (given(report)) }
    }
}

fn reached(report: &Report) -> Markup {
    let range = report.result.case.model.speed_range;
    let cell = |index: Index, value: &Result<f64, Failure>| in_words(index, value, range);
    let rows: Vec<Vec<String>> = headline(report)
        .into_iter()
        .map(|index| {
            let designed = value(&report.result.case, index);
            let mut row = vec![index.words().to_owned()];
            if report.designed {
                let given = value(&report.spec.case, index);
                row.extend(cell(index, &given));
                row.extend(cell(index, &designed));
                row.push(change(index, given.ok(), designed.ok()));
            } else {
                row.extend(cell(index, &designed));
            }
            row
        })
        .collect();
    let caption = if report.spec.conditions.is_empty() {
        "What the design reaches"
    } else {
        "What the design reaches in the nominal condition"
    };
    if report.designed {
        let columns = [
            ("index", Column::Head),
            ("as given, SI", Column::Number),
            ("as given, US", Column::Number),
            ("designed, SI", Column::Number),
            ("designed, US", Column::Number),
            ("change", Column::Number),
        ];
        table(caption, &columns, &rows)
    } else {
        let columns = [
            ("index", Column::Head),
            ("SI", Column::Number),
            ("US", Column::Number),
        ];
        table(caption, &columns, &rows)
    }
}

/// Demands that the design as given does not meet: a loss against it may have that reason.
fn given(report: &Report) -> Markup {
    let spec = report.spec;
    let margins = margins(&spec.case, &spec.demands, &spec.conditions);
    let unmet: Vec<String> = margins
        .iter()
        .filter(|margin| !margin.met())
        .map(|margin| {
            let reached = match &margin.reached {
                Ok(si) => written(margin.index.quantity(), *si),
                Err(failure) => failure.to_string(),
            };
            let condition = margin.condition.iter().map(|name| format!(" in “{name}”"));
            let words = margin.index.words();
            format!("{words}{}, {reached}", condition.collect::<String>())
        })
        .collect();
    html! {
        @if !unmet.is_empty() {
            p.note { "The design as given does not meet: " (unmet.join("; ")) "." }
        }
    }
}

/// As in "12.3 % better".
fn change(index: Index, given: Option<f64>, designed: Option<f64>) -> String {
    let (Some(given), Some(designed)) = (given, designed) else {
        return String::new();
    };
    let more = 100.0 * (designed / given - 1.0);
    let better = match index.sense() {
        Sense::AtLeast => more,
        Sense::AtMost => -more,
    };
    if !better.is_finite() || better.abs() < 0.05 {
        return "–".into();
    }
    let word = if better > 0.0 { "better" } else { "worse" };
    format!("{:.1} % {word}", more.abs())
}
