//! Frequencies and damping ratios of the kinematic modes against speed, with their root locus
//! (Figure 4.5.7).

use num_complex::Complex64;

use super::{
    Entry,
    performance::{critical_speed, lateral_modes},
    value::number,
    workbook::{MPH, Workbook},
};
use crate::{
    chart::{
        Axis, Curve, Dash, Direction, Family, Figure, Ink, Labels, Limit, Mark, Panel, Scale,
        Stroke, Symbol, Unit, Weight,
    },
    dynamics::LateralModel,
    evaluate::{
        lateral_modes::{LateralShape, OVERDAMPED},
        mode::{damping_ratio, frequency},
    },
    index::Index,
    units::Quantity,
};

/// Lowest speed shown.
const LOWEST: f64 = 20.0 * MPH;
/// Highest frequency shown of modes other than the kinematic ones, Hz.
const HIGHEST: f64 = 10.0;
/// Every how many speeds one is written at the root locus.
const WRITTEN: u32 = 20;

/// Speeds at which the modes are computed: multiples of 2.5 mph or 5 km/h, with their numbers.
fn speeds(book: &Workbook, highest: f64) -> (Vec<u32>, Vec<f64>) {
    let unit = book.unit(Quantity::Speed);
    let step = unit.factor * if unit.label == "mph" { 2.5 } else { 5.0 };
    (1..)
        .map(|n| (n, f64::from(n) * step))
        .skip_while(|(_, v)| *v < LOWEST)
        .take_while(|(_, v)| *v <= highest * (1.0 + 1e-9))
        .unzip()
}

/// A mode followed over the speed.
struct Followed {
    /// At each speed; `None` where it was lost or does not oscillate.
    roots: Vec<Option<Complex64>>,
    kinematic: bool,
}

/// Follows every mode from the operating speed to both ends of the range: each goes to where it is
/// expected from its last two places, the nearest first.
fn follow(book: &Workbook, speeds: &[f64]) -> Vec<Followed> {
    let case = book.case();
    let model = LateralModel::new(case);
    let modes = book.each(speeds, |speed| lateral_modes(case, &model, *speed));
    let start = speeds
        .iter()
        .position(|v| *v >= case.service.speed)
        .unwrap_or(speeds.len() - 1);
    let mut followed: Vec<Followed> = modes[start]
        .iter()
        .filter(|m| m.damping_ratio < OVERDAMPED)
        .map(|m| {
            let mut roots = vec![None; speeds.len()];
            roots[start] = Some(m.mode.eigenvalue);
            Followed {
                roots,
                kinematic: m.shape == LateralShape::Kinematic,
            }
        })
        .collect();
    let up = (start + 1..speeds.len()).map(|i| (i, i - 1, i.checked_sub(2)));
    let down = (0..start).rev().map(|i| (i, i + 1, Some(i + 2)));
    for (i, last, before) in up.chain(down) {
        let found: Vec<Complex64> = modes[i]
            .iter()
            .filter(|m| m.damping_ratio < OVERDAMPED)
            .map(|m| m.mode.eigenvalue)
            .collect();
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (k, mode) in followed.iter().enumerate() {
            let Some(here) = mode.roots[last] else {
                continue;
            };
            let before = before.and_then(|b| mode.roots.get(b).copied().flatten());
            let expected = before.map_or(here, |before| here + (here - before));
            for (j, root) in found.iter().enumerate() {
                pairs.push(((root - expected).norm() / root.norm(), k, j));
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut taken = vec![false; found.len()];
        for (distance, k, j) in pairs {
            if distance < 0.2 && !taken[j] && followed[k].roots[i].is_none() {
                taken[j] = true;
                followed[k].roots[i] = Some(found[j]);
            }
        }
    }
    followed
}

/// Draws it.
#[expect(clippy::too_many_lines, reason = "four panels, each said once")]
pub(super) fn draw(book: &Workbook, entry: &Entry) -> Figure {
    let case = book.case();
    let critical = critical_speed(case).ok().flatten();
    let top = critical
        .map_or(300.0 * MPH, |v| 1.1 * v)
        .max(1.1 * case.service.speed)
        .min(600.0 * MPH);
    let speed_axis = book
        .axis(
            "speed",
            "V",
            "speed_m_per_s",
            Quantity::Speed,
            Scale::Linear,
            [0.0, top],
        )
        .rounded();
    let (numbers, speeds) = speeds(book, speed_axis.range[1]);
    let modes = follow(book, &speeds);
    let family = |kinematic: bool, highest: f64, point: &dyn Fn(usize, Complex64) -> [f64; 2]| {
        let (id, title, stroke) = if kinematic {
            (
                "kinematic",
                "kinematic modes",
                Stroke::new(Ink::Black, Dash::Solid).weight(Weight::Bold),
            )
        } else {
            ("other", "other modes", Stroke::new(Ink::Grey, Dash::Dashed))
        };
        let curves = modes
            .iter()
            .filter(|m| m.kinematic == kinematic)
            .map(|mode| {
                let points = mode.roots.iter().enumerate().map(|(i, root)| {
                    root.filter(|s| kinematic || frequency(*s) < highest)
                        .map_or([f64::NAN; 2], |s| point(i, s))
                });
                Curve::line("", points.collect::<Vec<_>>())
            });
        Family::new(id, title, stroke)
            .labelled(Labels::None)
            .curves(curves)
    };
    let roots = |kinematic: bool| {
        let of = modes.iter().filter(move |m| m.kinematic || !kinematic);
        of.flat_map(|m| m.roots.iter().flatten().copied())
    };
    let ratio = |i: usize, s: Complex64| [speeds[i], damping_ratio(s)];
    let hertz = |i: usize, s: Complex64| [speeds[i], frequency(s)];
    let root = |_: usize, s: Complex64| [s.re, s.im];
    let plain = |title: &str, symbol: &str, column: &str, range: [f64; 2], unit: &str| {
        Axis::new(
            title,
            symbol,
            column,
            Scale::Linear,
            range,
            [Unit::new(unit, 1.0)],
        )
    };
    let own: Vec<Complex64> = kinematic_at(book, case.service.speed);
    let mark = |at: [f64; 2]| Mark::design(at);
    let worst = own
        .iter()
        .copied()
        .min_by(|a, b| damping_ratio(*a).total_cmp(&damping_ratio(*b)));
    let onset = critical.map(|v| {
        let text = format!("V_cr = {}", book.value(Quantity::Speed, v, 3));
        Mark::new([v, 0.0], Symbol::Disc, Ink::Vermilion, text)
    });
    let required = book.spec.demands.get(Index::CriticalSpeed);
    let limit = required.map(|value| Limit {
        axis: Direction::X,
        value,
        at_least: true,
        label: format!("required {}", book.value(Quantity::Speed, value, 3)),
    });
    let damping = Panel::new(
        "a",
        speed_axis.clone(),
        plain("damping ratio", "ζ", "damping_ratio", [-0.1, 1.0], ""),
    )
    .titled("(a) damping ratio")
    .with(family(false, HIGHEST, &ratio))
    .with(family(true, HIGHEST, &ratio))
    .limit(limit)
    .mark(onset)
    .mark(worst.map(|s| mark([case.service.speed, damping_ratio(s)])));
    let natural = Panel::new(
        "b",
        speed_axis,
        plain("frequency", "f", "frequency_hz", [0.0, HIGHEST], "Hz")
            .holding(roots(true).map(frequency)),
    )
    .titled("(b) natural frequency")
    .with(family(false, HIGHEST, &hertz))
    .with(family(true, HIGHEST, &hertz))
    .mark(worst.map(|s| mark([case.service.speed, frequency(s)])));
    let mut locus = Panel::new(
        "c",
        plain("Re s", "", "re_s_per_s", [-10.0, 2.0], "1/s").holding(roots(true).map(|s| s.re)),
        plain("Im s", "", "im_s_rad_per_s", [0.0, 10.0], "rad/s")
            .holding(roots(true).map(|s| 1.05 * s.im)),
    )
    .titled("(c) root locus, the speed along the curves")
    .with(family(false, HIGHEST, &root))
    .with(family(true, HIGHEST, &root));
    // The trucks' modes nearly coincide: numbers on one are enough.
    if let Some(mode) = modes.iter().find(|m| m.kinematic) {
        for (i, s) in mode.roots.iter().enumerate() {
            if let Some(s) = s.filter(|_| numbers[i].is_multiple_of(WRITTEN)) {
                let text = number(speeds[i] / book.unit(Quantity::Speed).factor, 3);
                locus = locus.mark(Mark::new([s.re, s.im], Symbol::Dot, Ink::Black, text));
            }
        }
    }
    locus = locus.mark(worst.map(|s| mark([s.re, s.im])));
    let all = Panel::new(
        "d",
        plain("Re s", "", "re_s_per_s", [-10.0, 2.0], "1/s").holding(roots(false).map(|s| s.re)),
        plain("Im s", "", "im_s_rad_per_s", [0.0, 10.0], "rad/s")
            .holding(roots(false).map(|s| s.im)),
    )
    .titled("(d) root locus, all modes")
    .with(family(false, f64::INFINITY, &root))
    .with(family(true, f64::INFINITY, &root))
    .mark(worst.map(|s| mark([s.re, s.im])));
    let mut figure = entry
        .figure("Frequencies and damping ratios of the kinematic modes")
        .columns(2)
        .panel(damping)
        .panel(natural)
        .panel(locus)
        .panel(all)
        .described(
            "Damping ratio and natural frequency of the lateral modes over speed, and their root \
             locus; the kinematic modes are emphasised, the critical speed and the design are \
             marked.",
        );
    figure.subtitle = book.subtitle(
        None,
        &[
            crate::parameter::Parameter::Conicity,
            crate::parameter::Parameter::PrimaryBendingStiffness,
            crate::parameter::Parameter::PrimaryLateralStiffness,
        ],
    );
    figure.note(format!(
        "Modes that oscillate at the service speed, followed from there; those above {HIGHEST} Hz \
         are in (d) only. Numbers along the locus are speeds in {}.",
        book.unit(Quantity::Speed).label
    ))
}

/// Eigenvalues of the kinematic modes at a speed.
fn kinematic_at(book: &Workbook, speed: f64) -> Vec<Complex64> {
    let case = book.case();
    lateral_modes(case, &LateralModel::new(case), speed)
        .iter()
        .filter(|m| m.shape == LateralShape::Kinematic)
        .map(|m| m.mode.eigenvalue)
        .collect()
}
