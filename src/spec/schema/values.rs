//! Schemas of numbers with and without units.

use serde_json::{Value, json};

use super::capital;
use crate::spec::keys::{CaseKey, Key, Need};
use crate::units::{LONGEST, Quantity, Range, pattern};

/// Names of the definitions of a value with its unit, of any sign and above zero.
const WITH_UNIT: [&str; 2] = ["value_with_unit", "positive_value_with_unit"];

/// The definitions that other schemas refer to.
pub fn definitions() -> Value {
    let [any, positive] = [true, false].map(|negative| {
        json!({
            "description": "A number and its unit, SI or US customary.",
            "type": "string",
            "pattern": pattern(negative),
            "maxLength": LONGEST,
        })
    });
    json!({ WITH_UNIT[0]: any, WITH_UNIT[1]: positive })
}

/// A value of `quantity` within `range`.
pub fn number(quantity: Quantity, range: Range) -> Value {
    let mut plain = json!({ "type": "number" });
    match range {
        Range::Any => {}
        Range::Positive => plain["exclusiveMinimum"] = json!(0),
        Range::NonNegative => plain["minimum"] = json!(0),
        Range::PositiveUpTo(upper) => {
            plain["exclusiveMinimum"] = json!(0);
            plain["maximum"] = json!(upper);
        }
        Range::Between(lower, upper) => {
            plain["minimum"] = json!(lower);
            plain["maximum"] = json!(upper);
        }
    }
    let is_positive = matches!(range, Range::Positive | Range::PositiveUpTo(_));
    let definition = WITH_UNIT[usize::from(is_positive)];
    let with_unit = json!({ "$ref": format!("#/$defs/{definition}") });
    let mut schema = match quantity {
        Quantity::Dimensionless => return plain,
        Quantity::Angle => json!({ "anyOf": [plain, with_unit] }),
        _ => with_unit,
    };
    let [si, us] = quantity.examples();
    schema["examples"] = if si == us {
        json!([si])
    } else {
        json!([si, us])
    };
    schema
}

/// Two values, the lower first.
pub fn interval(quantity: Quantity, range: Range) -> Value {
    json!({ "type": "array", "items": number(quantity, range), "minItems": 2, "maxItems": 2 })
}

/// `schema` with a description.
pub fn described(mut schema: Value, meaning: &str) -> Value {
    schema["description"] = json!(meaning);
    schema
}

/// The description of a key.
pub struct Described {
    pub symbol: &'static str,
    pub quantity: Quantity,
    pub meaning: &'static str,
    pub range: Range,
    pub need: Need,
}

impl From<&CaseKey> for Described {
    fn from(key: &CaseKey) -> Self {
        Self {
            symbol: key.symbol,
            quantity: key.quantity,
            meaning: key.meaning,
            range: key.range,
            need: key.need,
        }
    }
}

impl<T, V> From<&Key<T, V>> for Described {
    fn from(key: &Key<T, V>) -> Self {
        Self {
            symbol: key.symbol,
            quantity: key.quantity,
            meaning: key.meaning,
            range: key.range,
            need: key.need,
        }
    }
}

/// `schema` with the meaning of a key, its range and its default.
pub fn described_key(mut schema: Value, key: &Described) -> Value {
    let symbol = match key.symbol {
        "" => String::new(),
        symbol => format!(", {symbol}"),
    };
    let range = key.range.in_words(key.quantity);
    let kind = capital(key.quantity.with_article());
    let mut text = format!("{}{symbol}. {kind} {range}.", capital(key.meaning));
    match key.need {
        Need::Required => text += " Required unless the vehicle has a base.",
        Need::Optional(default) => {
            text = format!("{text} Default: {default}.");
            if let Some(value) = json_default(key.quantity, default) {
                schema["default"] = value;
            }
        }
    }
    described(schema, &text)
}

/// A default as a value of the spec, if it is one and not a rule in words.
fn json_default(quantity: Quantity, default: &str) -> Option<Value> {
    if quantity != Quantity::Dimensionless && quantity.parse(default).is_ok() {
        return Some(json!(default));
    }
    let value: Value = serde_json::from_str(default).ok()?;
    let fits = value.is_array() || matches!(quantity, Quantity::Dimensionless | Quantity::Angle);
    fits.then_some(value)
}
