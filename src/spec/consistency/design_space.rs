//! Bounds and values in `[design]` that are hardly meant.

use std::ops::Range;

use super::situation::shown;
use crate::parameter::Parameter;
use crate::spec::diagnostic::Diagnostic;
use crate::spec::document::Document;
use crate::spec::{Freedom, Spec};

/// Widest ratio of bounds: four decades of stiffness reach from rubber to solid steel.
const WIDEST: f64 = 1e4;
/// Share by which the present value may miss its bounds: published constants are rounded.
const PUBLISHED_ROUNDING: f64 = 0.1;

/// Relative difference between a value and the same value in another unit.
const SAME_VALUE: f64 = 1e-6;

/// Doubts about bounds and values.
pub fn odd_freedoms(spec: &Spec, document: &Document, doubts: &mut Vec<Diagnostic>) {
    for (parameter, freedom) in &spec.design.parameters {
        let Some(value) = document.get(parameter.path()) else {
            continue;
        };
        let bounds = match freedom {
            Freedom::Between(bounds) => bounds,
            Freedom::Fixed(fixed) => {
                second_value(spec, document, (*parameter, *fixed), value.span(), doubts);
                continue;
            }
            Freedom::Choices(_) | Freedom::Tied { .. } => continue,
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
        let given = document.get(parameter.key_of_constant().path);
        let inside =
            bounds.lower * (1.0 - PUBLISHED_ROUNDING)..=bounds.upper * (1.0 + PUBLISHED_ROUNDING);
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

/// A constant set in `[design]` and given another value in the vehicle: the design takes the one,
/// the vehicle as given the other.
fn second_value(
    spec: &Spec,
    document: &Document,
    (parameter, fixed): (Parameter, f64),
    place: Range<usize>,
    doubts: &mut Vec<Diagnostic>,
) {
    let key = parameter.key_of_constant();
    let given = parameter.get(&spec.case);
    if document.get(key.path).is_some() && (given / fixed - 1.0).abs() > SAME_VALUE {
        let [fixed, given] = [fixed, given].map(|si| shown(si, parameter.quantity()));
        doubts.push(
            Diagnostic::at(
                place,
                format!(
                    "`{}` is {fixed} in the design, {given} by `{}`",
                    parameter.name(),
                    key.path
                ),
                "the design takes this value, the vehicle as given keeps its own",
            )
            .help("`bogie evaluate` shows the vehicle as given".to_owned()),
        );
    }
}
