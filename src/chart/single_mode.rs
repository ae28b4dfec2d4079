//! Transfer functions of a single rigid-body mode on its suspension (Figure 4.3.3).

use num_complex::Complex64;

use super::{Entry, comfort::frequency_axis, value::number, workbook::Workbook};
use crate::{
    parameter::Parameter,
    plot::{Axis, Curve, Family, Figure, Labels, Panel, Scale, Stroke, Unit},
};

/// |z̈/u| in 1/s² (4.3-1) and |z_r/u| (4.3-2) at frequency `f`, for f_n in Hz and ξ.
///
/// ```math
/// z̈/u = s² (2ξs/ω_n + 1) / (s²/ω_n² + 2ξs/ω_n + 1),   z_r/u = (s²/ω_n²) / (s²/ω_n² + 2ξs/ω_n + 1)
/// ```
pub(super) fn transfer(f: f64, f_n: f64, xi: f64) -> [f64; 2] {
    let s = Complex64::new(0.0, std::f64::consts::TAU * f);
    let r = Complex64::new(0.0, f / f_n);
    let damping = 2.0 * xi * r;
    let denominator = r * r + damping + 1.0;
    [
        (s * s * (damping + 1.0) / denominator).norm(),
        (r * r / denominator).norm(),
    ]
}

const FREQUENCIES: [f64; 4] = [0.5, 0.7, 1.0, 1.4];
const RATIOS: [f64; 5] = [0.05, 0.1, 0.25, 0.8, 1.5];

/// Acceleration and stroke for several natural frequencies and several damping ratios.
pub(super) fn draw(book: &Workbook, entry: &Entry) -> Figure {
    let case = book.case();
    let f_n = Parameter::SECONDARY_VERTICAL_FREQUENCY.get(case);
    let xi = Parameter::SECONDARY_VERTICAL_DAMPING_RATIO.get(case);
    let x = frequency_axis([0.1, 20.0]);
    let frequencies = Scale::Log.spread(x.range, 321);
    let outputs = [
        (
            "acceleration",
            "|z̈/u|",
            "acceleration_per_input_per_s2",
            "s^-2",
        ),
        ("stroke", "|z_r/u|", "stroke_per_input", ""),
    ];
    let mut figure = entry
        .figure("Transfer functions of a rigid-body mode")
        .columns(2)
        .height(0.85);
    for (row, by_frequency) in [true, false].into_iter().enumerate() {
        for (k, (word, symbol, column, unit)) in outputs.into_iter().enumerate() {
            let values: &[f64] = if by_frequency { &FREQUENCIES } else { &RATIOS };
            let curves = values.iter().enumerate().map(|(i, value)| {
                let points = frequencies.iter().map(|f| {
                    let found = if by_frequency {
                        transfer(*f, *value, xi)
                    } else {
                        transfer(*f, f_n, *value)
                    };
                    [*f, found[k]]
                });
                let label = if by_frequency {
                    format!("{value} Hz")
                } else {
                    format!("ξ = {value}")
                };
                Curve::line(label, points).at(*value).stroke(Stroke::nth(i))
            });
            let id = if by_frequency {
                "frequency"
            } else {
                "damping-ratio"
            };
            // Labels on the curves would hide the peaks of the damping ratios.
            let labels = if by_frequency {
                Labels::Inline
            } else {
                Labels::Legend
            };
            let family = Family::new(id, "", Stroke::default())
                .labelled(labels)
                .curves(curves);
            let least = [0.1, 1e-2][k];
            let y = Axis::new(
                word,
                symbol,
                column,
                Scale::Log,
                [least, 2.0 * least],
                [Unit::new(unit, 1.0)],
            )
            .holding(
                family
                    .curves
                    .iter()
                    .flat_map(Curve::points)
                    .map(|p| p[1])
                    .filter(|v| *v > least),
            );
            let what = if by_frequency {
                format!("ξ = {}", number(xi, 2))
            } else {
                format!("f_n = {} Hz", number(f_n, 3))
            };
            let letter = ["a", "b", "c", "d"][2 * row + k];
            figure = figure.panel(
                Panel::new(letter, x.clone(), y)
                    .with(family)
                    .titled(format!("({letter}) {word}, {what}")),
            );
        }
    }
    figure.subtitle = format!(
        "{}: secondary vertical f_n = {} Hz, ξ = {} of the design held while the other varies",
        book.name,
        number(f_n, 3),
        number(xi, 3)
    );
    figure.described(
        "Acceleration and stroke per unit input of a single rigid-body mode over frequency, all \
         logarithmic: for several natural frequencies above, for several damping ratios below.",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Far below resonance the body follows the track, far above it stands still.
    #[test]
    fn limits() {
        let [acceleration, stroke] = transfer(0.01, 1.0, 0.3);
        let omega = std::f64::consts::TAU * 0.01;
        assert!((acceleration / (omega * omega) - 1.0).abs() < 1e-3);
        assert!((stroke / 1e-4 - 1.0).abs() < 1e-3);
        let [_, stroke] = transfer(100.0, 1.0, 0.3);
        assert!((stroke - 1.0).abs() < 1e-3);
        // At resonance |z_r/u| = 1/(2ξ).
        assert!((transfer(1.0, 1.0, 0.2)[1] - 2.5).abs() < 1e-12);
    }
}
