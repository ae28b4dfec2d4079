//! Values with their units, as titles and labels show them.

use crate::units::{DisplayUnit, number::significant};

/// A value with its unit, large and small ones as multiples of powers of ten.
pub fn written(unit: DisplayUnit, si: f64, figures: u8) -> String {
    let value = unit.of(si);
    let number = number(value, figures);
    match unit.label {
        "" => number,
        "deg" => format!("{number}°"),
        label => format!("{number} {label}"),
    }
}

/// A number with at most so many figures, without zeros at its end.
pub fn number(value: f64, figures: u8) -> String {
    let (mantissa, exponent) = if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        let scientific = format!("{value:.*e}", usize::from(figures) - 1);
        let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
        (mantissa.to_owned(), format!("×10^{exponent}"))
    } else {
        (significant(value, figures), String::new())
    };
    let mantissa = if mantissa.contains('.') {
        mantissa.trim_end_matches('0').trim_end_matches('.')
    } else {
        &mantissa
    };
    match (mantissa, exponent.strip_prefix('×')) {
        ("1", Some(power)) => power.into(),
        _ => format!("{mantissa}{exponent}"),
    }
}
