//! Axes: quantity, units, scale and range.

use serde::Serialize;

use crate::units::{DisplayUnit, Quantity};

/// Unit in which an axis is labelled.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Unit {
    /// Its label; empty for plain numbers.
    pub label: String,
    /// Its size in SI base units.
    pub factor: f64,
}

impl Unit {
    /// A unit of `factor` SI base units.
    pub fn new(label: impl Into<String>, factor: f64) -> Self {
        Self {
            label: label.into(),
            factor,
        }
    }
}

impl From<DisplayUnit> for Unit {
    fn from(unit: DisplayUnit) -> Self {
        let label = match unit.label {
            "deg" => "°",
            label => label,
        };
        Self::new(label, unit.factor)
    }
}

/// System of units that comes first on a chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum System {
    /// US customary units.
    #[default]
    Us,
    /// SI units.
    Si,
}

impl System {
    /// The units of a quantity, that of this system first; one where both are the same.
    pub fn units(self, quantity: Quantity) -> Vec<Unit> {
        self.pair([quantity.si(), quantity.us()].map(Unit::from))
    }

    /// An SI and a US unit, that of this system first; one where both are the same.
    pub fn pair(self, [si, us]: [Unit; 2]) -> Vec<Unit> {
        if si == us {
            return vec![si];
        }
        match self {
            Self::Us => vec![us, si],
            Self::Si => vec![si, us],
        }
    }
}

/// How values are spread along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Scale {
    /// Equal differences.
    Linear,
    /// Equal ratios.
    Log,
}

impl Scale {
    /// The value itself, or its logarithm.
    pub fn forward(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Log => value.ln(),
        }
    }

    /// The value again.
    pub fn back(self, scaled: f64) -> f64 {
        match self {
            Self::Linear => scaled,
            Self::Log => scaled.exp(),
        }
    }

    /// `n` values from the first to the last of a range, evenly spread on the scale; the ends are
    /// exact.
    pub fn spread(self, range: [f64; 2], n: usize) -> Vec<f64> {
        let [low, high] = range.map(|x| self.forward(x));
        let last = n.saturating_sub(1);
        (0..n)
            .map(|i| match i {
                0 => range[0],
                _ if i == last => range[1],
                _ => self.back(low + (high - low) * i as f64 / last as f64),
            })
            .collect()
    }
}

/// An axis of a panel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Axis {
    /// Quantity along the axis.
    pub title: String,
    /// Its symbol, with subscripts as in `K_py`; may be empty.
    pub symbol: String,
    /// Name of its column in files, SI unit included.
    pub column: String,
    /// Spread of the values.
    pub scale: Scale,
    /// First and last value, SI.
    pub range: [f64; 2],
    /// Units: the first stands at the left and bottom, a second at the right and top.
    pub units: Vec<Unit>,
}

impl Axis {
    /// An axis over an SI range.
    pub fn new(
        title: impl Into<String>,
        symbol: impl Into<String>,
        column: impl Into<String>,
        scale: Scale,
        range: [f64; 2],
        units: impl Into<Vec<Unit>>,
    ) -> Self {
        Self {
            title: title.into(),
            symbol: symbol.into(),
            column: column.into(),
            scale,
            range,
            units: units.into(),
        }
    }

    /// Where a value stands: 0 at the first value of the range, 1 at the last.
    pub fn fraction(&self, value: f64) -> f64 {
        let [low, high] = self.range.map(|x| self.scale.forward(x));
        (self.scale.forward(value) - low) / (high - low)
    }

    /// The value that stands at a fraction: the inverse of [`Self::fraction`].
    pub fn value(&self, fraction: f64) -> f64 {
        let [low, high] = self.range.map(|x| self.scale.forward(x));
        self.scale.back(low + (high - low) * fraction)
    }

    /// Whether a value lies on the axis.
    pub fn holds(&self, value: f64) -> bool {
        let slack = 1e-9;
        (-slack..=1.0 + slack).contains(&self.fraction(value))
    }

    /// Title with symbol and unit, as in `primary lateral stiffness K_py, lbf/ft`.
    pub fn text(&self, unit: &Unit) -> String {
        let mut text = self.title.clone();
        if !self.symbol.is_empty() {
            text = format!("{text} {}", self.symbol);
        }
        if unit.label.is_empty() {
            text
        } else {
            format!("{text}, {}", unit.label)
        }
    }

    /// Widens the range to hold all `values`, and rounds it outward to ticks of the first unit.
    #[must_use]
    pub fn holding(mut self, values: impl IntoIterator<Item = f64>) -> Self {
        for value in values {
            if value.is_finite() && (self.scale == Scale::Linear || value > 0.0) {
                self.range = [self.range[0].min(value), self.range[1].max(value)];
            }
        }
        self.rounded()
    }

    /// The range rounded outward to ticks of the first unit.
    #[must_use]
    pub fn rounded(mut self) -> Self {
        let factor = self.units.first().map_or(1.0, |unit| unit.factor);
        let [low, high] = self.range.map(|x| x / factor);
        let rounded = match self.scale {
            Scale::Linear => {
                let step = super::tick::step((high - low) / 8.0);
                [(low / step + 1e-9).floor(), (high / step - 1e-9).ceil()].map(|n| n * step)
            }
            Scale::Log => [
                round_log(low * (1.0 + 1e-9), false),
                round_log(high * (1.0 - 1e-9), true),
            ],
        };
        self.range = rounded.map(|x| x * factor);
        self
    }
}

/// The next of 1, 2, 5 × 10^n below or above.
fn round_log(value: f64, up: bool) -> f64 {
    let decade = 10_f64.powf(value.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|m| m * decade);
    if up {
        steps.into_iter().find(|s| *s >= value)
    } else {
        steps.into_iter().rev().find(|s| *s <= value)
    }
    .unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(scale: Scale, range: [f64; 2]) -> Axis {
        Axis::new("x", "", "x", scale, range, [Unit::new("", 1.0)])
    }

    #[test]
    fn fraction_and_value_are_inverse() {
        for axis in [
            axis(Scale::Linear, [-3.0, 7.0]),
            axis(Scale::Log, [0.01, 300.0]),
        ] {
            for fraction in [0.0, 0.3, 1.0, 1.2] {
                assert!((axis.fraction(axis.value(fraction)) - fraction).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn ranges_are_rounded_to_ticks() {
        let linear = axis(Scale::Linear, [0.0, 9.1]).rounded().range;
        assert!(linear[0].abs() < 1e-12 && (linear[1] / 10.0 - 1.0).abs() < 1e-12);
        let log = axis(Scale::Log, [0.13, 7.0]).holding([0.03]).range;
        assert!((log[0] / 0.02 - 1.0).abs() < 1e-12 && (log[1] / 10.0 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn spread_is_exact_at_its_ends() {
        let values = Scale::Log.spread([0.02, 50.0], 7);
        assert_eq!((values[0], values[6]), (0.02, 50.0));
        assert!((values[3] - 1.0).abs() < 1e-12);
    }
}
