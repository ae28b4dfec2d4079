//! Ride against stroke: nets of natural frequency and damping ratio of the secondary suspension
//! (Figures 4.3.4, 4.4.3, 4.6.12, 4.6.13, 4.6.18, 4.6.19).

use super::{
    Entry,
    plane::{AVERAGE, Plane},
    strokes::rms_limit,
    value::number,
    workbook::Workbook,
};
use crate::{
    evaluate::limits::SECONDARY_STOP,
    index::Index,
    parameter::Parameter,
    plot::{Axis, Curve, Dash, Direction, Family, Figure, Ink, Limit, Mark, Panel, Scale, Stroke},
    units::Quantity,
};

/// Points on each line of a net.
const POINTS: usize = 65;

/// Rides on a line of the net: natural frequency, damping ratio, and the ride.
type Line = Vec<Option<([f64; 4], f64)>>;

/// The lines of the net of a plane at a speed: those of constant natural frequency, then those of
/// constant damping ratio, at evenly spread logarithms of the other.
fn net(book: &Workbook, plane: Plane, speed: f64) -> Vec<Line> {
    let [frequency, ratio] = plane.parameters();
    let [frequencies, ratios] = plane.lines();
    let ends = |values: &[f64]| [values[0], values[values.len() - 1]];
    let along_frequency = Scale::Log.spread(ends(frequencies), POINTS);
    let along_ratio = Scale::Log.spread(ends(ratios), POINTS);
    let mut wanted: Vec<[f64; 2]> = Vec::new();
    for f in frequencies {
        wanted.extend(along_ratio.iter().map(|xi| [*f, *xi]));
    }
    for xi in ratios {
        wanted.extend(along_frequency.iter().map(|f| [*f, *xi]));
    }
    let rides = book.each(&wanted, |[f, xi]| {
        let mut case = book.case().clone();
        case.service.speed = speed;
        case.vehicle.suspension.secondary.air_spring = None;
        frequency.set(&mut case, *f);
        ratio.set(&mut case, *xi);
        plane.ride(&case)
    });
    rides.chunks(POINTS).map(<[_]>::to_vec).collect()
}

/// Draws a net at a speed, a panel for each passenger point wanted.
pub(super) fn draw(
    book: &Workbook,
    entry: &Entry,
    plane: Plane,
    speed: f64,
    points: &[usize],
) -> Figure {
    let [frequency, ratio] = plane.parameters();
    let [frequencies, ratios] = plane.lines();
    let lines = net(book, plane, speed);
    let (of_frequency, of_ratio) = lines.split_at(frequencies.len());
    let mut case = book.case().clone();
    case.service.speed = speed;
    let design = plane.ride(&case);
    let mut figure = entry
        .figure(format!(
            "Carbody {} acceleration against secondary stroke",
            plane.word()
        ))
        .height(if points.len() > 1 { 0.85 } else { 1.0 });
    for point in points {
        let curve = |label: String, value: f64, line: &Line| {
            let points = line.iter().map(|ride| {
                ride.as_ref()
                    .map_or([f64::NAN; 2], |(a, stroke)| [*stroke, a[*point]])
            });
            Curve::line(label, points).at(value)
        };
        let net_f = Family::new(
            "frequency",
            format!("natural frequency {}", frequency.symbol()),
            Stroke::new(Ink::Blue, Dash::Dashed),
        )
        .curves(
            frequencies
                .iter()
                .zip(of_frequency)
                .map(|(f, line)| curve(format!("{f} Hz"), *f, line)),
        );
        let net_xi = Family::new(
            "damping-ratio",
            format!("damping ratio {}", ratio.symbol()),
            Stroke::new(Ink::Black, Dash::Solid),
        )
        .curves(
            ratios
                .iter()
                .zip(of_ratio)
                .map(|(xi, line)| curve(format!("{xi}"), *xi, line)),
        );
        let mark = design
            .as_ref()
            .map(|(a, stroke)| Mark::design([*stroke, a[*point]]));
        let panel = panel(book, plane, *point, points.len() > 1, [net_f, net_xi], mark);
        figure = figure.panel(panel);
    }
    if design.is_none() {
        figure = figure.note(format!(
            "The design is unstable at {}: it is not marked.",
            book.value(Quantity::Speed, speed, 3)
        ));
    }
    if book
        .case()
        .vehicle
        .suspension
        .secondary
        .air_spring
        .is_some()
        && plane == Plane::Vertical
    {
        figure = figure.note(
            "The net is that of springs and dampers; the design, on air springs, lies off it.",
        );
    }
    let own = [frequency, ratio].map(|p| {
        let value = number(p.get(book.case()), 3);
        let unit = if p == frequency { " Hz" } else { "" };
        format!("{} = {value}{unit}", p.symbol()).replace(' ', "\u{a0}")
    });
    figure.subtitle = format!(
        "{}; design {}",
        book.subtitle(Some(speed), fixed(plane)),
        own.join(", ")
    );
    figure.description = format!(
        "A net of lines of constant natural frequency and of constant damping ratio of the \
         secondary {} suspension, RMS acceleration over RMS secondary stroke; the design is \
         marked.",
        plane.word()
    );
    figure
}

/// Values that the charts of a plane hold fixed.
fn fixed(plane: Plane) -> &'static [Parameter] {
    match plane {
        Plane::Lateral => &[
            Parameter::CONICITY,
            Parameter::PRIMARY_BENDING_STIFFNESS,
            Parameter::SECONDARY_YAW_STIFFNESS,
        ],
        Plane::Vertical => &[],
    }
}

fn panel(
    book: &Workbook,
    plane: Plane,
    point: usize,
    titled: bool,
    net: [Family; 2],
    design: Option<Mark>,
) -> Panel {
    let place = [
        "at the c.g.",
        "at the front point",
        "at the rear point",
        "average",
    ][point];
    let (index, acceleration) = match plane {
        Plane::Lateral => (Index::SecondaryLateralStroke, Index::LateralAcceleration),
        Plane::Vertical => (Index::SecondaryVerticalStroke, Index::VerticalAcceleration),
    };
    let word = plane.word();
    let axis = |title: String, symbol: &str, column: &str, quantity: Quantity| -> Axis {
        book.axis(&title, symbol, column, quantity, Scale::Linear, [0.0, 0.0])
    };
    let values = |k: usize| -> Vec<f64> {
        net.iter()
            .flat_map(|family| &family.curves)
            .flat_map(Curve::points)
            .chain(design.iter().map(|mark| mark.at))
            .map(|p| p[k])
            .collect()
    };
    let x = axis(
        format!("RMS secondary {word} stroke"),
        "ST",
        "secondary_stroke_rms_m",
        Quantity::Stroke,
    )
    .holding(values(0));
    let y = axis(
        if titled {
            format!("RMS {word} acceleration")
        } else {
            format!("RMS {word} acceleration, {place}")
        },
        "ACC",
        "acceleration_rms_m_per_s2",
        Quantity::Acceleration,
    )
    .holding(values(1));
    let limit = |axis: Direction, of: (Index, Option<f64>)| {
        rms_limit(book, of).map(|(value, label)| Limit {
            axis,
            value,
            at_least: false,
            label,
        })
    };
    let on = |limit: &Limit, axis: &Axis| axis.holds(limit.value);
    let stroke = limit(Direction::X, (index, Some(SECONDARY_STOP))).filter(|l| on(l, &x));
    // The required acceleration is one of the average.
    let required =
        limit(Direction::Y, (acceleration, None)).filter(|l| on(l, &y) && point == AVERAGE);
    let [f, xi] = net;
    let mut panel = Panel::new(
        if titled {
            ["cg", "front", "rear", "average"][point]
        } else {
            ""
        },
        x,
        y,
    )
    .with(f)
    .with(xi)
    .limit(stroke)
    .limit(required)
    .mark(design);
    if titled {
        panel = panel.titled(place);
    }
    panel
}
