//! The result at a glance: whether every requirement is met, by how much, and how the search ended.

use maud::{Markup, html};

use super::{
    Report,
    gain::gain,
    table::{Column, blocks, table},
};
use crate::{
    design::{
        margin::{self, Margin},
        outcome::Delivered,
    },
    evaluate::checks::{Verdict, checks},
    export::{
        certificate::{conflict, margin_row},
        design_text::{performance_rows, stage_name},
        sheet::Sheet,
        status,
        verdict::verdict,
    },
};

/// The section.
pub fn glance(report: &Report) -> Markup {
    html! {
        section #glance aria-labelledby="glance-title" {
            h2 #glance-title { "The result at a glance" }
            (said(report))
            (gain(report))
            (margins(report))
            @if report.designed { (ended(report)) }
            (exceeded(report))
            @for warning in report.warnings { p.warning { strong { "Warning: " } (warning) } }
            (conflicts(report))
        }
    }
}

/// The verdict in one sentence.
fn said(report: &Report) -> Markup {
    let result = report.result;
    if result.margins.is_empty() {
        return html! { p.verdict.open { "The spec sets no requirement and no limit." } };
    }
    let unmet = result.unmet().count();
    let is_missed = |margin: &&Margin| margin.verdict() == margin::Verdict::NotMet;
    let missed = result.unmet().filter(is_missed).count();
    if unmet == 0 {
        return html! {
            p.verdict.met { "All " (result.margins.len()) " requirements and limits are met." }
            @if let Some(stop) = result.stopped {
                p { "The search ended early, " (stop) ": this is the best found so far." }
            }
        };
    }
    let mut sheet = Sheet::new("");
    if report.designed {
        verdict(&mut sheet, result);
    }
    html! {
        p.verdict.unmet {
            (missed) " of " (result.margins.len()) " requirements and limits "
            (if missed == 1 { "is" } else { "are" }) " not met"
            @if unmet > missed { ", " (unmet - missed) " not assessed" }
            "."
        }
        (blocks(&sheet, "Not met"))
    }
}

fn margins(report: &Report) -> Markup {
    let margins = &report.result.margins;
    if margins.is_empty() {
        return html! {};
    }
    let rows: Vec<Vec<String>> = margins
        .iter()
        .map(|margin| {
            let mut row = margin_row(margin, report.result.case.model.speed_range);
            if margin.condition.is_none() {
                row[1] = "nominal".into();
            }
            // The verdict beside the name: it is in sight on a narrow page too.
            let verdict = row.pop().unwrap_or_default();
            row.insert(2, verdict);
            row
        })
        .collect();
    let conditions = margins.iter().any(|m| m.condition.is_some());
    let mut columns = vec![
        ("index", Column::Head),
        ("condition", Column::Text),
        ("verdict", Column::Verdict),
        ("asked, SI", Column::Number),
        ("asked, US", Column::Number),
        ("reached, SI", Column::Number),
        ("reached, US", Column::Number),
        ("margin", Column::Number),
    ];
    let rows = if conditions {
        rows
    } else {
        columns.remove(1);
        let without = |mut row: Vec<String>| {
            row.remove(1);
            row
        };
        rows.into_iter().map(without).collect()
    };
    table("Requirements and limits", &columns, &rows)
}

/// How each search ended.
fn ended(report: &Report) -> Markup {
    let result = report.result;
    let stages = result
        .stages
        .iter()
        .chain(result.joint.iter().map(|j| &j.stage));
    let rows: Vec<Vec<String>> = stages
        .map(|stage| {
            let explained = &stage.explained;
            vec![
                stage_name(stage.trade_off),
                explained.goal.clone(),
                status::words(explained.status),
                explained
                    .kkt_residual
                    .map_or_else(|| "–".into(), |r| format!("{r:.0e}")),
                explained.active.join("; "),
            ]
        })
        .collect();
    let columns = [
        ("trade-off", Column::Head),
        ("what was sought", Column::Wide),
        ("status", Column::Text),
        ("first-order residual", Column::Number),
        ("held back by", Column::Wide),
    ];
    html! {
        (table("How the searches ended", &columns, &rows))
        @if result.delivered == Delivered::AsGiven {
            p.note {
                "The design of this report is the one as given: it stands better to the demands than "
                "those that the searches came to."
            }
        } @else if result.joint_in_place_of_sequence() {
            p.note {
                "The design of this report is that of “all at once”: it meets or comes closer to "
                "demands that the trade-offs taken in turn miss."
            }
        } @else if result.joint.is_some() {
            p.note {
                "The design of this report is that of the trade-offs taken in turn. “All at once” "
                "is what weighing them together would give: see the certificate."
            }
        }
        @if !result.settled && result.stopped.is_none() {
            p { "The coupling loop still changed the design after " (result.rounds) " rounds." }
        }
    }
}

/// Nominal constraints of the report that the design exceeds, whether or not the spec limits them.
fn exceeded(report: &Report) -> Markup {
    let checks = checks(&report.result.case, &report.result.evaluation);
    let named = |verdict: Verdict| -> Vec<&str> {
        let these = checks.iter().filter(|check| check.verdict() == verdict);
        these.map(|check| check.name.as_str()).collect()
    };
    let [exceeded, open] = [Verdict::Exceeded, Verdict::NotAssessed].map(named);
    html! {
        p {
            (checks.len() - exceeded.len() - open.len()) " of the " (checks.len())
            " nominal " a href="#checks" { "checks" } " of the methodology are passed."
            @if !exceeded.is_empty() { " Not passed: " (exceeded.join("; ")) "." }
            @if !open.is_empty() {
                " Not assessed, as the linear model does not cover the curve: " (open.join("; ")) "."
            }
        }
    }
}

fn conflicts(report: &Report) -> Markup {
    let mut sheet = Sheet::new("");
    conflict(&mut sheet, report.result);
    blocks(&sheet, "Requirements in conflict")
}

/// Performance before and after (Table 4.7.1).
pub fn performance(report: &Report) -> Markup {
    let result = report.result;
    let mut rows = performance_rows(result);
    let mut columns = vec![
        ("index", Column::Head),
        ("unit", Column::Text),
        ("as given", Column::Number),
        ("designed", Column::Number),
        ("at half the creep coefficients", Column::Number),
    ];
    columns.extend(
        result
            .conditions
            .iter()
            .map(|c| (c.name.as_str(), Column::Number)),
    );
    if !report.designed {
        columns.remove(3);
        for row in &mut rows {
            row.remove(3);
        }
    }
    html! {
        section #performance aria-labelledby="performance-title" {
            h2 #performance-title { "Performance" }
            (table("As Table 4.7.1", &columns, &rows))
            p.note {
                "Half the creep coefficients of Kalker's theory stand for contaminated rail (4.5.4)."
            }
        }
    }
}
