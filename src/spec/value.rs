//! Values of a spec: numbers with units, intervals, choices.

use toml::de::DeValue;

use super::diagnostic::{Collect, Diagnostic, word};
use super::document::{Document, Value, nearest};
use super::keys::{CaseKey, Key, Range};
use super::{Interval, scale};
use crate::case::Case;
use crate::units::Quantity;

type Read<T> = Result<T, Diagnostic>;

/// A value of `quantity` in SI within `range`; `name` is for messages.
pub(super) fn number(value: &Value, name: &str, quantity: Quantity, range: Range) -> Read<f64> {
    let mistake = |message: String| Diagnostic::at(value.span(), message, quantity.expectation());
    let si = match value.get_ref() {
        DeValue::String(text) => quantity
            .parse(text)
            .map_err(|error| mistake(format!("`{name}`: {error}")).help(error.help()))?,
        other => match plain(other) {
            Some(number) if matches!(quantity, Quantity::Dimensionless | Quantity::Angle) => number,
            Some(_) => return Err(mistake(format!("`{name}` needs a unit"))),
            None => {
                let found = other.type_str();
                return Err(mistake(format!("`{name}` cannot be of type {found}")));
            }
        },
    };
    if !si.is_finite() {
        return Err(mistake(format!("`{name}` is not a finite number")));
    }
    if range.contains(si) && !scale::is_in_scale(si, quantity) {
        let sizes = scale::in_words(quantity, range);
        return Err(Diagnostic::at(
            value.span(),
            format!("`{name}` is out of all scale"),
            format!("expected {} {sizes}", quantity.with_article()),
        ));
    }
    if !range.contains(si) {
        let bounds = range.in_words(quantity);
        return Err(Diagnostic::at(
            value.span(),
            format!("`{name}` is out of range"),
            format!("expected {} {bounds}", quantity.with_article()),
        ));
    }
    Ok(si)
}

fn plain(value: &DeValue) -> Option<f64> {
    match value {
        DeValue::Float(float) => float.as_str().parse().ok(),
        DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse().ok(),
        DeValue::Integer(integer) => i64::from_str_radix(integer.as_str(), integer.radix())
            .ok()
            .map(|i| i as f64),
        _ => None,
    }
}

/// Two values of `quantity` in ascending order.
pub(super) fn interval(
    value: &Value,
    name: &str,
    quantity: Quantity,
    range: Range,
) -> Read<Interval> {
    let example = match quantity {
        Quantity::Dimensionless => "0.05".to_owned(),
        _ => format!("\"{}\"", quantity.examples()[1]),
    };
    let mistake = |message: &str| {
        Diagnostic::at(
            value.span(),
            format!("`{name}` {message}"),
            format!("expected [lowest, highest], each such as {example}"),
        )
    };
    let DeValue::Array(array) = value.get_ref() else {
        return Err(mistake("is a pair of bounds"));
    };
    let [lower, upper] = &array[..] else {
        return Err(mistake("is a pair of bounds"));
    };
    let lower = number(lower, name, quantity, range)?;
    let upper = number(upper, name, quantity, range)?;
    if lower < upper {
        Ok(Interval { lower, upper })
    } else if lower > upper {
        Err(mistake("has its bounds reversed"))
    } else {
        Err(mistake("has two equal bounds")
            .help("leave the key out to keep the value as it stands".to_owned()))
    }
}

/// A list of at least `least` numbers.
pub(super) fn list(
    value: &Value,
    name: &str,
    quantity: Quantity,
    range: Range,
    least: usize,
) -> Read<Vec<f64>> {
    match value.get_ref() {
        DeValue::Array(array) if array.len() >= least => array
            .iter()
            .map(|item| number(item, name, quantity, range))
            .collect(),
        _ => Err(Diagnostic::at(
            value.span(),
            format!("`{name}` is a list of {least} values or more"),
            quantity.expectation() + " for each",
        )),
    }
}

/// Names that a message lists beside the one that is wrong.
const FEW: usize = 3;

/// The index of one of `choices`.
pub(super) fn choice(value: &Value, name: &str, choices: &[&str]) -> Read<usize> {
    let written = value.get_ref().as_str();
    written
        .and_then(|text| choices.iter().position(|choice| *choice == text))
        .ok_or_else(|| {
            let message = match written {
                Some(text) => format!("`{name}` cannot be \"{}\"", word(text)),
                None => format!("`{name}` is a name in quotes"),
            };
            let names: Vec<String> = choices.iter().map(|c| format!("\"{c}\"")).collect();
            let near = written.and_then(|text| nearest(text, choices.iter().copied()));
            let near = near.map(|near| format!("did you mean \"{near}\"?"));
            let known = format!("known: {}", names.join(", "));
            let (expected, help) = if choices.len() <= FEW {
                (format!("expected {}", names.join(" or ")), near)
            } else {
                ("not a known name".to_owned(), near.or(Some(known)))
            };
            Diagnostic::at(value.span(), message, expected).help(help)
        })
}

/// A whole number that is not negative.
pub(super) fn whole(value: &Value, name: &str) -> Read<u64> {
    match value.get_ref() {
        DeValue::Integer(i) => u64::from_str_radix(i.as_str(), i.radix()).ok(),
        _ => None,
    }
    .ok_or_else(|| {
        Diagnostic::at(
            value.span(),
            format!("`{name}` is a whole number"),
            "expected a whole number from 0 up",
        )
    })
}

impl Document<'_> {
    /// Reads the numbers of `keys` that the document has into `case`.
    pub fn numbers(
        &self,
        keys: impl Iterator<Item = &'static CaseKey>,
        case: &mut Case,
        mistakes: &mut Vec<Diagnostic>,
    ) {
        for key in keys {
            if let Some(value) = self.get(key.path) {
                let read = number(value, key.name(), key.quantity, key.range);
                if let Some(si) = mistakes.collect(read) {
                    key.set(case, si);
                }
            }
        }
    }

    /// Reads the intervals of `keys` that the document has into `owner`.
    pub fn intervals<T: 'static>(
        &self,
        keys: &'static [Key<T, Interval>],
        owner: &mut T,
        mistakes: &mut Vec<Diagnostic>,
    ) {
        for key in keys {
            if let Some(value) = self.get(key.path) {
                let read = interval(value, key.name(), key.quantity, key.range);
                if let Some(bounds) = mistakes.collect(read) {
                    (key.set)(owner, bounds);
                }
            }
        }
    }
}
