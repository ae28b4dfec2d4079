//! Bounds in `[design]` that are hardly meant.

use super::situation::shown;
use crate::spec::diagnostic::Diagnostic;
use crate::spec::document::Document;
use crate::spec::{Freedom, Spec, keys};

/// Widest ratio of bounds: four decades of stiffness reach from rubber to solid steel.
const WIDEST: f64 = 1e4;
/// Share by which the present value may miss its bounds: published constants are rounded.
const ROUNDING: f64 = 0.1;

/// Doubts about bounds.
pub fn odd_bounds(spec: &Spec, document: &Document, doubts: &mut Vec<Diagnostic>) {
    for (parameter, freedom) in &spec.design.parameters {
        let Freedom::Between(bounds) = freedom else {
            continue;
        };
        let Some(value) = document.get(parameter.path()) else {
            continue;
        };
        let (name, quantity) = (parameter.name(), parameter.quantity());
        let ratio = bounds.upper / bounds.lower;
        if bounds.lower > 0.0 && ratio > WIDEST {
            doubts.push(
                Diagnostic::at(
                    value.span(),
                    format!("the bounds on `{name}` span {:.1} decades", ratio.log10()),
                    "more than four are rarely meant: check the units",
                )
                .help(
                    "the wider the bounds, the more of the search goes where nothing is".to_owned(),
                ),
            );
        }
        let now = parameter.get(&spec.case);
        let given = keys::of_parameter(*parameter).and_then(|key| document.get(key.path));
        let inside = bounds.lower * (1.0 - ROUNDING)..=bounds.upper * (1.0 + ROUNDING);
        if given.is_some() && !inside.contains(&now) {
            doubts.push(
                Diagnostic::at(
                    value.span(),
                    format!(
                        "the vehicle's own `{name}`, {}, lies outside its bounds",
                        shown(now, quantity)
                    ),
                    "a search cannot come back to it",
                )
                .help(parameter.relation().map(|r| format!("{r}: check both"))),
            );
        }
    }
}
