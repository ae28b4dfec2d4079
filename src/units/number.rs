//! Numbers as an engineer writes them.

use crate::units::{DisplayUnit, Quantity};

/// `x` with `figures` significant figures; powers of ten only where plain digits get unreadable.
pub fn significant(x: f64, figures: u8) -> String {
    if x == 0.0 {
        return "0".into();
    }
    if !x.is_finite() {
        return "–".into();
    }
    // The exponent of the rounded number: 9.996 to three figures is 10.0.
    let scientific = format!("{x:.*e}", usize::from(figures.max(1)) - 1);
    let (rounded, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if !(-4..7).contains(&exponent) {
        return format!("{rounded}e{exponent}");
    }
    let decimals = usize::try_from(i32::from(figures) - 1 - exponent).unwrap_or(0);
    let rounded: f64 = scientific.parse().unwrap_or(x);
    format!("{rounded:.decimals$}")
}

/// A value in one unit, with its label.
pub fn in_unit(unit: DisplayUnit, si: f64, figures: u8) -> String {
    let number = significant(unit.of(si), figures);
    match unit.label {
        "" => number,
        "deg" => format!("{number}°"),
        label => format!("{number} {label}"),
    }
}

/// A value in SI and US customary units, four figures.
pub fn both(quantity: Quantity, si: f64) -> [String; 2] {
    let (si_unit, us_unit) = (quantity.si(), quantity.us());
    let us = if si_unit.label == us_unit.label {
        String::new()
    } else {
        in_unit(us_unit, si, 4)
    };
    [in_unit(si_unit, si, 4), us]
}

/// A change in percent with its sign, two decimals; none has no sign.
pub fn signed_percent(percent: f64) -> String {
    let text = format!("{percent:+.2} %");
    match text.as_str() {
        "+0.00 %" | "-0.00 %" => "0.00 %".into(),
        _ => text,
    }
}

/// A share in percent with a sign only where it is negative, two decimals.
pub fn unsigned_percent(percent: f64) -> String {
    signed_percent(percent).trim_start_matches('+').to_owned()
}

/// A value in both unit systems, as in "320 km/h (200 mph)".
pub(crate) fn value(quantity: Quantity, si: f64) -> String {
    let [si, us] = both(quantity, si);
    if us.is_empty() {
        si
    } else {
        format!("{si} ({us})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs() {
        for (x, text) in [(1.234, "+1.23 %"), (-0.006, "-0.01 %"), (-0.004, "0.00 %")] {
            assert_eq!(signed_percent(x), text);
            assert_eq!(unsigned_percent(x), text.trim_start_matches('+'));
        }
    }

    #[test]
    fn figures() {
        for (x, text) in [
            (9.9996, "10.00"),
            (0.051_23, "0.05123"),
            (205.04, "205.0"),
            (1_234_567.0, "1235000"),
            (28_239_202.0, "2.824e7"),
            (-0.000_012_34, "-1.234e-5"),
            (0.0, "0"),
            (f64::NAN, "–"),
        ] {
            assert_eq!(significant(x, 4), text);
        }
    }
}
