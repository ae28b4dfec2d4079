//! Where the report comes from: the spec, versions, and how to make it again.

use maud::{Markup, html};

use super::Report;

/// The section.
pub fn origin(report: &Report) -> Markup {
    html! {
        section #origin aria-labelledby="origin-title" {
            h2 #origin-title { "Inputs, and how to make this again" }
            dl {
                dt { "program" }
                dd { "bogie " (env!("CARGO_PKG_VERSION")) }
                dt { "command" }
                dd { code { (report.command) } }
                dt { "spec, SHA-256" }
                dd { code { (report.digest) } }
                dt { "seed" }
                dd { (report.spec.design.seed) }
            }
            p { "The same program makes the same report of the same spec, byte for byte." }
            h3 #spec-title { "The spec" }
            pre role="region" aria-labelledby="spec-title" { code { (report.source) } }
        }
    }
}
