//! Steady curving: the performance boundary (Figure 4.5.5) and lines of constant degree curve (4.5.6).

use super::{
    Entry,
    performance::degree_curve,
    stability_curving::curving_lines,
    value::number,
    workbook::{CONICITIES, Workbook},
};
use crate::{
    dynamics::curving::lifting_cant_deficiency,
    evaluate::{
        curving::{CurvingLimits, Limit as CurveLimit, LimitedCurve},
        limits::CANT_DEFICIENCY,
    },
    index::Index,
    parameter::Parameter,
    plot::{
        Curve, Dash, Direction, Family, Figure, Ink, Limit, Mark, Panel, Scale, Shade, Stroke,
        Symbol, System, Unit, Weight,
    },
    track::{MAX_DEGREE, SUPERELEVATION_BASE},
    units::us::INCH,
};

/// Units of cant deficiency: an angle, and the height of one rail over 56 in.
pub(super) fn cant_units(system: System) -> Vec<Unit> {
    let degree = Unit::new("°", std::f64::consts::PI / 180.0);
    let height = match system {
        System::Us => Unit::new("in", INCH / SUPERELEVATION_BASE),
        System::Si => Unit::new("mm", 1e-3 / SUPERELEVATION_BASE),
    };
    vec![degree, height]
}

/// A superelevation or an unbalance, m, as it is spoken of.
pub(super) fn height(system: System, height: f64) -> String {
    match system {
        System::Us => format!("{:.0} in", height / INCH),
        System::Si => format!("{:.0} mm", 1e3 * height),
    }
}

/// An axis of the degree curve, degrees of curve in the data as elsewhere.
pub(super) fn degree_axis(range: [f64; 2]) -> crate::plot::Axis {
    crate::plot::Axis::new(
        "degree curve",
        "D",
        "degree_curve_deg",
        Scale::Linear,
        range,
        [Unit::new("°", 1.0)],
    )
}

/// Cant deficiencies of the boundary, degrees.
const CANT: [f64; 2] = [-6.0, 6.0];
/// Their number: every tenth of a degree.
const STEPS: usize = 121;

/// Where the boundary ends short of the cant deficiency at which wheels lift.
const SHORT_OF_LIFT: f64 = 1.0 - 1e-9;

/// Boundary of flange contact and slip in cant deficiency against degree curve. It ends where the
/// wheels on one side lift.
pub(super) fn boundary(book: &Workbook, entry: &Entry) -> Figure {
    let case = book.case();
    let lift = lifting_cant_deficiency(&case.vehicle);
    let end = SHORT_OF_LIFT * lift;
    let mut cant = Scale::Linear.spread(CANT.map(f64::to_radians), STEPS);
    for angle in &mut cant {
        *angle = angle.clamp(-end, end);
    }
    cant.dedup();
    let limits: Vec<Option<CurvingLimits>> =
        book.each(&cant, |angle| CurvingLimits::new(case, *angle).ok());
    let flange = pieces(&limits, |l| l.flange);
    let slip = pieces(&limits, |l| l.slip);
    let largest = flange
        .iter()
        .chain(&slip)
        .flat_map(|(_, points)| points)
        .map(|p| p[0])
        .fold(0.5, f64::max);
    let x = degree_axis([0.0, (1.15 * largest).min(MAX_DEGREE)]).rounded();
    let y = crate::plot::Axis::new(
        "cant deficiency",
        "φ_d",
        "cant_deficiency_rad",
        Scale::Linear,
        CANT.map(f64::to_radians),
        cant_units(book.system),
    );
    let family = |id: &str, title: &str, stroke: Stroke, found: &[Piece]| {
        let curves = found
            .iter()
            .map(|(limit, points)| Curve::line(short(*limit), points.iter().copied()));
        Family::new(id, title, stroke).curves(curves)
    };
    let mut panel = Panel::new("", x, y)
        .with(family(
            "flange",
            "flange contact",
            Stroke::new(Ink::Blue, Dash::Dashed).weight(Weight::Bold),
            &flange,
        ))
        .with(family(
            "slip",
            "wheel slip",
            Stroke::new(Ink::Black, Dash::Solid).weight(Weight::Bold),
            &slip,
        ));
    panel.marks.extend(shares_left(&cant, &limits));
    panel.keys.push(Mark::new(
        [0.0; 2],
        Symbol::Dot,
        Ink::Black,
        "share of μN left at the other wheel of the slipping wheelset",
    ));
    panel.shades.extend(lifted(lift));
    let fra = CANT_DEFICIENCY / SUPERELEVATION_BASE;
    panel = panel.limit(Limit {
        axis: Direction::Y,
        value: fra,
        at_least: false,
        label: format!("FRA: {}", height(book.system, CANT_DEFICIENCY)),
    });
    panel = panel.limit(book.required(Index::DegreeCurve, Direction::X));
    if let Some(degree) = degree_curve(case) {
        panel = panel.mark(Mark {
            label: format!("design {}°", number(degree, 3)),
            ..Mark::design([degree, 0.0])
        });
    }
    let mut figure = entry
        .figure("Steady-state curving performance")
        .panel(panel)
        .height(1.1)
        .described(
            "Cant deficiency over degree curve: boundaries beyond which a wheelset touches a \
             flange or a wheel slips, with the wheel named along the boundary.",
        );
    if !figure.panels[0].shades.is_empty() {
        figure = figure.note(format!(
            "The boundary ends at {}° of cant deficiency: there the load transfer exceeds the static \
             load of the wheels on one side, and they lift.",
            number(lift.to_degrees(), 3)
        ));
    }
    figure.subtitle = book.subtitle(
        None,
        &[
            Parameter::CONICITY,
            Parameter::PRIMARY_BENDING_STIFFNESS,
            Parameter::PRIMARY_LATERAL_STIFFNESS,
            Parameter::SECONDARY_YAW_BREAKAWAY_TORQUE,
        ],
    );
    figure
}

/// Ranges of the chart in which the wheels on one side are lifted.
fn lifted(lift: f64) -> Vec<Shade> {
    let [low, high] = CANT.map(f64::to_radians);
    let ranges = [
        ([lift, high], "inner wheels lifted"),
        ([low, -lift], "outer wheels lifted"),
    ];
    let inside = ranges.into_iter().filter(|([from, to], _)| from < to);
    inside
        .map(|(range, label)| Shade {
            axis: Direction::Y,
            range,
            label: label.into(),
        })
        .collect()
}

/// The share of μN left at the other wheel on the slip boundary, every degree.
fn shares_left(cant: &[f64], limits: &[Option<CurvingLimits>]) -> Vec<Mark> {
    let mut marks = Vec::new();
    for (angle, limits) in cant.iter().zip(limits) {
        let degrees = angle.to_degrees();
        let shown = (degrees - degrees.round()).abs() < 1e-9 && degrees.abs() < 5.9;
        if let (true, Some(slip)) = (shown, limits.as_ref().and_then(|l| l.slip)) {
            let left = format!("{:.0} %", 100.0 * slip.other_wheel_reserve.max(0.0));
            marks.push(Mark::new(
                [slip.degree, *angle],
                Symbol::Dot,
                Ink::Black,
                left,
            ));
        }
    }
    marks
}

/// A part of a boundary at which one limit governs.
type Piece = (CurveLimit, Vec<[f64; 2]>);

/// The boundary in parts by what limits; each begins where the last one ends.
fn pieces(
    limits: &[Option<CurvingLimits>],
    of: impl Fn(&CurvingLimits) -> Option<LimitedCurve>,
) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    let mut last: Option<[f64; 2]> = None;
    for found in limits {
        let limited = found
            .as_ref()
            .and_then(|l| Some((of(l)?, l.cant_deficiency)));
        let Some((limited, angle)) = limited else {
            last = None;
            continue;
        };
        let point = [limited.degree, angle];
        match (pieces.last_mut(), last) {
            (Some((limit, points)), Some(_)) if *limit == limited.limit => points.push(point),
            (_, Some(previous)) => pieces.push((limited.limit, vec![previous, point])),
            _ => pieces.push((limited.limit, vec![point])),
        }
        last = Some(point);
    }
    pieces
}

/// A limit in few words.
fn short(limit: CurveLimit) -> String {
    match limit {
        CurveLimit::Flange(i) => format!("wheelset {}", i + 1),
        CurveLimit::Slip(i, side) => {
            let side = format!("{side:?}").to_lowercase();
            format!("wheelset {} {side}", i + 1)
        }
    }
}

/// Lines of constant degree curve for two conicities.
pub(super) fn lines(book: &Workbook, entry: &Entry) -> Figure {
    let [x, y] = book.stiffness_axes();
    let axes = [&x, &y];
    let mut panel = Panel::new("", x.clone(), y.clone());
    for (conicity, ink, dash) in [(1, Ink::Black, Dash::Solid), (3, Ink::Blue, Dash::Dashed)] {
        let field = book.curving(conicity);
        let degrees = [0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0];
        let mut family = curving_lines(&field, axes, Stroke::new(ink, dash), &degrees);
        family.id = format!("degree-curve-{}", CONICITIES[conicity]);
        family.title = format!("degree curve, λ = {}", CONICITIES[conicity]);
        panel = panel.with(family);
    }
    panel = panel.mark(book.design(
        Parameter::PRIMARY_BENDING_STIFFNESS,
        Parameter::PRIMARY_LATERAL_STIFFNESS,
    ));
    let mut figure = entry
        .figure("Lines of constant curving performance for two conicities")
        .panel(panel)
        .described(
            "Lines of constant degree curve over the primary bending and lateral stiffness, for \
             conicities 0.05 and 0.15; the design is marked.",
        );
    figure.subtitle = format!(
        "{}, zero cant deficiency; the design has λ = {}",
        book.subtitle(None, &[Parameter::SECONDARY_YAW_BREAKAWAY_TORQUE]),
        book.case().wheel_rail.conicity
    );
    figure
}
