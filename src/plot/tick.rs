//! Ticks of an axis: where they stand and what is written at them.

use super::Scale;

/// A tick.
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    /// Value in the unit of the axis.
    pub value: f64,
    /// Label, with powers of ten as in `2×10^5`; `None` for a minor tick.
    pub label: Option<String>,
    /// Whether a stronger grid line belongs to it.
    pub major: bool,
}

/// The smallest of 1, 2, 2.5, 5 × 10^n that is not less than `least`.
pub(super) fn step(least: f64) -> f64 {
    let decade = 10_f64.powf(least.log10().floor());
    [1.0, 2.0, 2.5, 5.0]
        .map(|m| m * decade)
        .into_iter()
        .find(|s| *s >= least * (1.0 - 1e-9))
        .unwrap_or(10.0 * decade)
}

/// Ticks from `low` to `high` with about `labels` labels.
pub fn ticks(scale: Scale, low: f64, high: f64, labels: usize) -> Vec<Tick> {
    match scale {
        Scale::Log if high / low > 2.5 => log_ticks(low, high, labels),
        _ => linear_ticks(low, high, labels),
    }
}

fn linear_ticks(low: f64, high: f64, labels: usize) -> Vec<Tick> {
    let major = step((high - low) / labels.max(1) as f64);
    // Minor steps at round numbers too: 5 of a step of 1 or 5, 4 of a step of 2.
    let leading = major / 10_f64.powf(major.log10().floor() + 1e-9);
    let parts = if (1.5..2.2).contains(&leading) { 4 } else { 5 };
    let minor = major / f64::from(parts);
    let decimals = decimals(major);
    let first = (low / minor - 1e-6).ceil();
    let count = (high / minor + 1e-6).floor() - first;
    whole(count)
        .map(|i| first + i)
        .map(|n| {
            let is_major = (n / f64::from(parts)).fract().abs() < 1e-9;
            let value = n * minor;
            // No −0.
            let shown = if n == 0.0 { 0.0 } else { value };
            Tick {
                value: shown,
                label: is_major.then(|| number(shown, decimals)),
                major: is_major,
            }
        })
        .collect()
}

/// Whole numbers from 0 to `last`.
fn whole(last: f64) -> impl Iterator<Item = f64> {
    (0..).map(f64::from).take_while(move |i| *i <= last)
}

/// Decimals that tell multiples of a step apart.
fn decimals(step: f64) -> usize {
    (0..12_usize)
        .find(|d| {
            let scaled = step * 10_f64.powi(i32::try_from(*d).unwrap_or(0));
            (scaled - scaled.round()).abs() < 1e-6 * scaled
        })
        .unwrap_or(12)
}

fn number(value: f64, decimals: usize) -> String {
    let plain = format!("{value:.decimals$}");
    let plain = match plain.strip_prefix('-') {
        Some(positive) => format!("−{positive}"),
        None => plain,
    };
    if value.abs() >= 1e5 || (value != 0.0 && value.abs() < 1e-4) {
        power(value)
    } else {
        plain
    }
}

/// As a multiple of a power of ten.
fn power(value: f64) -> String {
    let scientific = format!("{value:e}");
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    // What rounding left at the end.
    let mantissa = format!("{:.3}", mantissa.parse::<f64>().unwrap_or(1.0));
    let mantissa = mantissa.trim_end_matches('0').trim_end_matches('.');
    let exponent = exponent.replace('-', "−");
    match mantissa {
        "1" => format!("10^{exponent}"),
        mantissa => format!("{}×10^{exponent}", mantissa.replace('-', "−")),
    }
}

fn log_ticks(low: f64, high: f64, labels: usize) -> Vec<Tick> {
    let decades = (high / low).log10();
    let first = whole_exponent(low);
    let last = whole_exponent(high) + 1;
    // Every how many decades there is a label, or which multiples have one within a decade.
    let labels = labels.max(2) as f64;
    let every = (1..1000)
        .find(|n| decades / f64::from(*n) <= labels)
        .unwrap_or(1);
    let plain = low >= 0.99e-3 && high < 1.0e5;
    // Powers of ten beside multiples of them read badly over many decades.
    let many = !plain && decades > 2.5;
    let multiples: &[u32] = if many {
        &[1]
    } else if decades * 3.0 <= labels {
        &[1, 2, 5]
    } else if decades * 2.0 <= labels && decades < 3.0 {
        &[1, 3]
    } else {
        &[1]
    };
    let mut ticks = Vec::new();
    for exponent in first..=last {
        for multiple in 1..10_u32 {
            let value = f64::from(multiple) * 10_f64.powi(exponent);
            let slack = 1e-6;
            if value < low * (1.0 - slack) || value > high * (1.0 + slack) {
                continue;
            }
            let major = multiple == 1;
            let labelled = multiples.contains(&multiple) && exponent.rem_euclid(every) == 0;
            let label = labelled.then(|| {
                if plain {
                    number(value, usize::try_from(-exponent).unwrap_or(0))
                } else {
                    power(value)
                }
            });
            ticks.push(Tick {
                value,
                label,
                major,
            });
        }
    }
    ticks
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "exponents of finite numbers"
)]
fn whole_exponent(value: f64) -> i32 {
    (value.log10() + 1e-9).floor() as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().filter_map(|t| t.label.as_deref()).collect()
    }

    #[test]
    fn linear_labels_are_round() {
        let found = ticks(Scale::Linear, 0.0, 300.0, 6);
        assert_eq!(
            labels(&found),
            ["0", "50", "100", "150", "200", "250", "300"]
        );
        let found = ticks(Scale::Linear, -0.5, 1.0, 6);
        assert_eq!(
            labels(&found),
            ["−0.50", "−0.25", "0.00", "0.25", "0.50", "0.75", "1.00"]
        );
        assert!(found.iter().filter(|t| !t.major).count() > 10);
    }

    #[test]
    fn logarithmic_labels_follow_the_room() {
        let wide = ticks(Scale::Log, 1e5, 1e7, 9);
        assert_eq!(
            labels(&wide),
            [
                "10^5", "2×10^5", "5×10^5", "10^6", "2×10^6", "5×10^6", "10^7"
            ]
        );
        assert_eq!(
            labels(&ticks(Scale::Log, 1e-9, 1e3, 5)),
            ["10^−9", "10^−6", "10^−3", "10^0", "10^3"]
        );
        assert_eq!(labels(&ticks(Scale::Log, 0.1, 50.0, 5)), ["0.1", "1", "10"]);
        // Grid lines at every whole multiple.
        assert_eq!(ticks(Scale::Log, 1.0, 100.0, 5).len(), 19);
    }

    #[test]
    fn steps() {
        for (least, expected) in [(0.9, 1.0), (1.0, 1.0), (1.1, 2.0), (2.1, 2.5), (0.06, 0.1)] {
            assert!((step(least) / expected - 1.0).abs() < 1e-12, "{least}");
        }
    }
}
