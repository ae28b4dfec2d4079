//! A report of a design as one page that needs nothing else: HTML with its style, its charts and
//! the little program that makes them answer.
//!
//! [`Report`] gathers what is shown, [`page`](page()) writes it. What is written depends on the spec
//! and the way it was run alone: no times, nothing of the machine. All text goes through `maud`,
//! which escapes it; what is not escaped is this program's own (style, program, drawings) or is
//! escaped for its place ([`charts`]).

mod certificate;
pub mod charts;
mod checks;
mod form;
mod freedom;
mod front;
mod gain;
mod glance;
mod origin;
mod page;
mod parameters;
mod requirement;
mod table;
mod typeset;

pub use page::page;

use crate::{
    design::{outcome::DesignResult, pareto::Front, sensitivity::Sensitivity},
    plot::Figure,
    spec::Spec,
};

/// Contents of a report.
#[derive(Debug, Clone, Copy)]
pub struct Report<'a> {
    /// Name of the spec.
    pub name: &'a str,
    /// Text of the spec.
    pub source: &'a str,
    /// SHA-256 of that text.
    pub digest: &'a str,
    /// The command that makes this report again.
    pub command: &'a str,
    /// The spec.
    pub spec: &'a Spec,
    /// The design.
    pub result: &'a DesignResult,
    /// Whether the design was searched for; otherwise it is the spec's as it stands.
    pub designed: bool,
    /// Parameters to which the performance is sensitive.
    pub matters: Option<&'a Sensitivity>,
    /// The front that the spec asks for.
    pub front: Option<&'a Front>,
    /// Charts, drawn for the design.
    pub figures: &'a [Figure],
    /// Doubts about the result.
    pub warnings: &'a [String],
}
