//! Values that a quantity may take.

use super::Quantity;

/// Values that are physical, in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// Any finite value.
    Any,
    /// Above 0.
    Positive,
    /// 0 or more.
    NonNegative,
    /// Above 0, and not above the value.
    PositiveUpTo(f64),
    /// From the first to the second value.
    Between(f64, f64),
}

impl Range {
    /// Whether `si` is in the range.
    pub fn contains(self, si: f64) -> bool {
        match self {
            Self::Any => true,
            Self::Positive => si > 0.0,
            Self::NonNegative => si >= 0.0,
            Self::PositiveUpTo(upper) => si > 0.0 && si <= upper,
            Self::Between(lower, upper) => (lower..=upper).contains(&si),
        }
    }

    /// As in "expected a mass above 0".
    pub fn in_words(self, quantity: Quantity) -> String {
        let display = |si: f64| {
            let unit = quantity.si();
            // Rounded, lest 25° turn into 24.999999999999996°.
            let value = (unit.of(si) * 1e4).round() / 1e4;
            format!("{value} {}", unit.label).trim_end().to_owned()
        };
        match self {
            Self::Any => "of any size".into(),
            Self::Positive => "above 0".into(),
            Self::NonNegative => "of 0 or more".into(),
            Self::PositiveUpTo(upper) => format!("above 0, {} at the most", display(upper)),
            Self::Between(lower, upper) => format!("from {} to {}", display(lower), display(upper)),
        }
    }
}
