//! The page: head, contents, sections.

use base64::{Engine, engine::general_purpose::STANDARD};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use sha2::{Digest, Sha256};

use super::{
    Report,
    certificate::{certificate, matters},
    charts::charts,
    checks::checks,
    form::form,
    front::front,
    glance::{glance, performance},
    origin::origin,
    parameters::parameters,
    requirement::requirement,
};
use crate::{
    export::evaluation_text::title,
    plot::{Theme, stylesheet},
};

const STYLE: &str = include_str!("assets/report.css");
const PROGRAM: &str = concat!(
    include_str!("assets/number.js"),
    include_str!("assets/axis.js"),
    include_str!("assets/view.js"),
    include_str!("assets/panel.js"),
    include_str!("assets/pointer.js"),
    include_str!("assets/keyboard.js"),
    include_str!("assets/chart.js"),
    include_str!("assets/front.js"),
    include_str!("assets/scroll.js"),
);

/// The report as HTML.
pub fn page(report: &Report) -> String {
    let style = format!("{}{STYLE}", stylesheet(Theme::Page));
    // Names of the programs stay their own; the page gets none.
    let program = format!("(() => {{\n\"use strict\";\n{PROGRAM}}})();\n");
    let title = title(report.name, &report.result.case);
    let kind = if report.designed {
        "Suspension design"
    } else {
        "Design as it stands"
    };
    let page: Markup = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(policy(&style, &program));
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta name="generator" content=(concat!("bogie ", env!("CARGO_PKG_VERSION")));
                title { (report.name) " – " (kind) }
                style { (PreEscaped(&style)) }
            }
            body {
                a.skip href="#glance" { "Skip to the result" }
                div.page {
                    header {
                        h1 { (kind) ": " (report.name) }
                        p.lead { (title) }
                        (contents(report))
                    }
                    main {
                        (glance(report))
                        (requirement(report))
                        (parameters(report))
                        (performance(report))
                        (charts(report))
                        (front(report))
                        (certificate(report))
                        (matters(report))
                        (form(report))
                        (checks(report))
                        (origin(report))
                    }
                    footer {
                        p.note {
                            "Equations, tables and figures by number are those of "
                            em { "Rail Passenger Vehicle Truck Design Methodology" }
                            ", FRA/MIT, 1981."
                        }
                    }
                }
                script { (PreEscaped(&program)) }
            }
        }
    };
    page.into_string()
}

/// Nothing from anywhere; this style and this program alone.
fn policy(style: &str, program: &str) -> String {
    let hash = |text: &str| STANDARD.encode(Sha256::digest(text.as_bytes()));
    format!(
        "default-src 'none'; style-src 'sha256-{}'; script-src 'sha256-{}'; base-uri 'none'; \
         form-action 'none'",
        hash(style),
        hash(program)
    )
}

fn contents(report: &Report) -> Markup {
    let sections = [
        ("glance", "The result at a glance", true),
        ("requirement", "The requirement", true),
        ("parameters", "The parameters", true),
        ("performance", "Performance", true),
        ("charts", "The charts", !report.figures.is_empty()),
        ("front", "The front", report.front.is_some()),
        ("certificate", "The certificate", report.designed),
        ("matters", "What matters", report.matters.is_some()),
        ("form", "The design form", true),
        ("checks", "The checks", true),
        ("origin", "Inputs, and how to make this again", true),
    ];
    html! {
        nav aria-label="Contents" {
            ol {
                @for (id, title, _) in sections.iter().filter(|(_, _, shown)| *shown) {
                    li { a href={ "#" (id) } { (title) } }
                }
            }
        }
    }
}
