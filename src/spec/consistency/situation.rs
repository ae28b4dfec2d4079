//! The case in one operating condition, with the places of the values that make it.

use std::ops::Range;

use crate::case::Case;
use crate::index::Demands;
use crate::spec::Condition;
use crate::spec::diagnostic::{Diagnostic, shortened, word};
use crate::spec::document::Document;
use crate::spec::keys::{self, Need};
use crate::units::Quantity;

/// The nominal case or that of a further condition.
pub struct Situation<'d> {
    /// The case.
    pub case: Case,
    /// Demands in it.
    pub demands: Demands,
    /// Entries of this condition itself.
    pub document: &'d Document<'d>,
    /// The condition; `None` for the nominal one.
    pub condition: Option<&'d Condition>,
    /// Places of values that could not be read: what they were meant to be is not known.
    wrong: Vec<Range<usize>>,
}

impl<'d> Situation<'d> {
    /// The nominal situation and those of the conditions.
    pub fn all(
        case: &Case,
        demands: &Demands,
        document: &'d Document<'d>,
        conditions: &'d [(Condition, Document<'d>)],
        mistakes: &[Diagnostic],
    ) -> Vec<Self> {
        let wrong: Vec<Range<usize>> = mistakes.iter().filter_map(|m| m.span.clone()).collect();
        let nominal = Self {
            case: case.clone(),
            demands: demands.clone(),
            document,
            condition: None,
            wrong: wrong.clone(),
        };
        let further = conditions.iter().map(|(condition, inner)| Self {
            case: condition.apply(case),
            demands: demands.overridden(&condition.demands),
            document: inner,
            condition: Some(condition),
            wrong: wrong.clone(),
        });
        std::iter::once(nominal).chain(further).collect()
    }

    /// Where the first of `paths` that this situation itself gives stands. `None` if it gives none
    /// of them, or if one could not be read or is missing: then nothing can be said of their
    /// relation.
    pub fn place(&self, paths: &[&str]) -> Option<Range<usize>> {
        let places = paths.iter().map(|path| self.document.get(path));
        let places: Vec<_> = places.map(|value| Some(value?.span())).collect();
        let is_wrong = |place: &Range<usize>| {
            let inside = |w: &Range<usize>| w.start < place.end && place.start < w.end;
            self.wrong.iter().any(inside)
        };
        let nominal = self.condition.is_none();
        let has_base = self.document.get(keys::BASE).is_some();
        for (path, place) in paths.iter().zip(&places) {
            let is_required = |path| {
                let key = keys::at(path);
                key.is_some_and(|key| key.need == Need::Required)
            };
            match place {
                Some(place) if is_wrong(place) => return None,
                None if nominal && !has_base && is_required(*path) => return None,
                _ => {}
            }
        }
        places.into_iter().flatten().next()
    }

    /// " in condition `worn`", or nothing.
    pub fn suffix(&self) -> String {
        self.condition
            .map(|c| format!(" in condition `{}`", word(&c.name)))
            .unwrap_or_default()
    }
}

/// A value with its SI unit, four digits.
pub fn shown(si: f64, quantity: Quantity) -> String {
    let unit = quantity.si();
    let value = unit.of(si);
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    let text = if (1e-3..1e7).contains(&rounded.abs()) || rounded == 0.0 {
        format!("{rounded} {}", unit.label)
    } else {
        format!("{rounded:e} {}", unit.label)
    };
    shortened(text.trim_end(), 40)
}
