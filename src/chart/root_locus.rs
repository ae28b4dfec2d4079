//! Frequencies and damping ratios of the kinematic modes against speed, with their root locus
//! (Figure 4.5.7).

use num_complex::Complex64;

use super::{
    Entry,
    followed::{Followed, follow, kinematic_at, speeds},
    performance::critical_speed,
    value::number,
    workbook::{MPH, Workbook},
};
use crate::{
    index::Index,
    numerics::{damping_ratio, frequency},
    parameter::Parameter,
    plot::{
        Axis, Curve, Dash, Direction, Family, Figure, Ink, Labels, Mark, Panel, Scale, Stroke,
        Symbol, Unit, Weight,
    },
    units::Quantity,
};

/// Highest frequency shown of modes other than the kinematic ones, Hz.
const HIGHEST: f64 = 10.0;
/// Every how many speeds one is written at the root locus.
const WRITTEN: u32 = 20;

/// Contents of the panels.
struct Shown<'a> {
    book: &'a Workbook<'a>,
    /// Numbers of the speeds, of which some are written at the locus.
    numbers: Vec<u32>,
    speeds: Vec<f64>,
    modes: Vec<Followed>,
    /// The kinematic mode at the service speed: hunting of a truck under a carbody at rest.
    design: Option<Complex64>,
}

/// An axis of a panel in one unit.
fn axis(title: &str, symbol: &str, column: &str, range: [f64; 2], unit: &str) -> Axis {
    let units = [Unit::new(unit, 1.0)];
    Axis::new(title, symbol, column, Scale::Linear, range, units)
}

impl Shown<'_> {
    /// Curves of the kinematic or the other modes below a frequency, through a point for each
    /// speed and root.
    fn family(
        &self,
        kinematic: bool,
        highest: f64,
        point: impl Fn(f64, Complex64) -> [f64; 2],
    ) -> Family {
        let (id, title, stroke) = if kinematic {
            let bold = Stroke::new(Ink::Black, Dash::Solid).weight(Weight::Bold);
            ("kinematic", "kinematic modes", bold)
        } else {
            let grey = Stroke::new(Ink::Grey, Dash::Dashed);
            ("other", "other modes", grey)
        };
        let of = self.modes.iter().filter(|m| m.kinematic == kinematic);
        let curves = of.map(|mode| {
            let points = mode.roots.iter().zip(&self.speeds).map(|(root, speed)| {
                root.filter(|s| kinematic || frequency(*s) < highest)
                    .map_or([f64::NAN; 2], |s| point(*speed, s))
            });
            Curve::line("", points)
        });
        Family::new(id, title, stroke)
            .labelled(Labels::None)
            .curves(curves)
    }

    /// All roots, or those of the kinematic modes.
    fn roots(&self, kinematic: bool) -> impl Iterator<Item = Complex64> + '_ {
        let of = self.modes.iter().filter(move |m| m.kinematic || !kinematic);
        of.flat_map(|m| m.roots.iter().flatten().copied())
    }

    /// A panel with all curves and the design.
    fn panel(
        &self,
        id: &str,
        axes: [Axis; 2],
        highest: f64,
        point: impl Fn(f64, Complex64) -> [f64; 2],
    ) -> Panel {
        let speed = self.book.case().service.speed;
        let [x, y] = axes;
        Panel::new(id, x, y)
            .with(self.family(false, highest, &point))
            .with(self.family(true, highest, &point))
            .mark(self.design.map(|s| Mark::design(point(speed, s))))
    }

    fn damping(&self, speed: Axis, critical: Option<f64>) -> Panel {
        let ratio = axis("damping ratio", "ζ", "damping_ratio", [-0.1, 1.0], "");
        let onset = critical.map(|v| {
            let text = format!("V_cr = {}", self.book.value(Quantity::Speed, v, 3));
            Mark::new([v, 0.0], Symbol::Disc, Ink::Vermilion, text)
        });
        self.panel("a", [speed, ratio], HIGHEST, |v, s| [v, damping_ratio(s)])
            .titled("(a) damping ratio")
            .limit(self.book.required(Index::CriticalSpeed, Direction::X))
            .mark(onset)
    }

    fn natural(&self, speed: Axis) -> Panel {
        let hertz = axis("frequency", "f", "frequency_hz", [0.0, HIGHEST], "Hz")
            .holding(self.roots(true).map(frequency));
        self.panel("b", [speed, hertz], HIGHEST, |v, s| [v, frequency(s)])
            .titled("(b) natural frequency")
    }

    /// The locus of the kinematic modes or of all.
    fn locus(&self, id: &str, kinematic: bool) -> Panel {
        let axes = [
            axis("Re s", "", "re_s_per_s", [-10.0, 2.0], "1/s")
                .holding(self.roots(kinematic).map(|s| s.re)),
            axis("Im s", "", "im_s_rad_per_s", [0.0, 10.0], "rad/s")
                .holding(self.roots(kinematic).map(|s| 1.05 * s.im)),
        ];
        let highest = if kinematic { HIGHEST } else { f64::INFINITY };
        self.panel(id, axes, highest, |_, s| [s.re, s.im])
    }

    /// With speeds written at the locus. The trucks' modes nearly coincide: at one is enough.
    fn numbered(&self, mut locus: Panel) -> Panel {
        let unit = self.book.unit(Quantity::Speed);
        let Some(mode) = self.modes.iter().find(|m| m.kinematic) else {
            return locus;
        };
        for (i, root) in mode.roots.iter().enumerate() {
            if let Some(s) = root.filter(|_| self.numbers[i].is_multiple_of(WRITTEN)) {
                let text = number(self.speeds[i] / unit.factor, 3);
                locus = locus.mark(Mark::new([s.re, s.im], Symbol::Dot, Ink::Black, text));
            }
        }
        locus
    }
}

/// Draws it.
pub(super) fn draw(book: &Workbook, entry: &Entry) -> Figure {
    let case = book.case();
    let critical = critical_speed(case).ok().flatten();
    let top = critical
        .map_or(300.0 * MPH, |v| 1.1 * v)
        .max(1.1 * case.service.speed)
        .min(600.0 * MPH);
    let speed = book
        .axis(
            "speed",
            "V",
            "speed_m_per_s",
            Quantity::Speed,
            Scale::Linear,
            [0.0, top],
        )
        .rounded();
    let (numbers, speeds) = speeds(book, speed.range[1]);
    let shown = Shown {
        book,
        modes: follow(book, &speeds),
        numbers,
        speeds,
        design: kinematic_at(book, case.service.speed),
    };
    let locus = shown
        .numbered(shown.locus("c", true))
        .titled("(c) root locus, the speed along the curves");
    let mut figure = entry
        .figure("Frequencies and damping ratios of the kinematic modes")
        .columns(2)
        .panel(shown.damping(speed.clone(), critical))
        .panel(shown.natural(speed))
        .panel(locus)
        .panel(shown.locus("d", false).titled("(d) root locus, all modes"))
        .described(
            "Damping ratio and natural frequency of the lateral modes over speed, and their root \
             locus; the kinematic modes are emphasised, the critical speed and the design are \
             marked.",
        );
    figure.subtitle = book.subtitle(
        None,
        &[
            Parameter::CONICITY,
            Parameter::PRIMARY_BENDING_STIFFNESS,
            Parameter::PRIMARY_LATERAL_STIFFNESS,
        ],
    );
    figure.note(format!(
        "Modes that oscillate at the service speed, followed from there; those above {HIGHEST} Hz \
         are in (d) only. The design is a truck under a carbody at rest. Numbers along the locus are \
         speeds in {}.",
        book.unit(Quantity::Speed).label
    ))
}
