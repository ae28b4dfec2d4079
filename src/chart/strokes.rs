//! Influence of conicity, stiffness and speed on primary strokes, wheelset excursions, lateral ride and
//! secondary strokes (Figures 4.6.6–4.6.11, 4.6.14–4.6.17).

use super::{Entry, performance::lateral_ride, sweep::Sweep, workbook::Workbook};
use crate::{
    evaluate::{
        limits::{EXCURSION, PEAK, PRIMARY_STOP, SECONDARY_STOP},
        ride::LateralRide,
    },
    index::Index,
    parameter::Parameter,
    plot::{Axis, Curve, Direction, Family, Figure, Limit, Mark, Panel, Scale, Shade, Stroke},
    units::Quantity,
};

/// Quantity shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shown {
    /// RMS primary lateral strokes.
    PrimaryStroke,
    /// RMS wheelset excursions.
    Excursion,
    /// RMS lateral accelerations.
    Acceleration,
    /// RMS secondary lateral strokes.
    SecondaryStroke,
}

/// Over what.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Over {
    /// Wheel conicity.
    Conicity,
    /// K_b.
    Bending,
    /// K_py.
    Lateral,
    /// Speed, for several conicities.
    Speed,
}

const WHEELSETS: [&str; 4] = ["wheelset 1", "wheelset 2", "wheelset 3", "wheelset 4"];

impl Shown {
    fn axis(self, book: &Workbook) -> Axis {
        let (title, symbol, column, quantity) = match self {
            Self::PrimaryStroke => (
                "RMS primary lateral stroke",
                "PS",
                "primary_stroke_rms_m",
                Quantity::Stroke,
            ),
            Self::Excursion => (
                "RMS wheelset excursion",
                "WE",
                "wheelset_excursion_rms_m",
                Quantity::Stroke,
            ),
            Self::Acceleration => (
                "RMS lateral acceleration",
                "ACC",
                "acceleration_rms_m_per_s2",
                Quantity::Acceleration,
            ),
            Self::SecondaryStroke => (
                "RMS secondary lateral stroke",
                "ST",
                "secondary_stroke_rms_m",
                Quantity::Stroke,
            ),
        };
        book.axis(title, symbol, column, quantity, Scale::Linear, [0.0, 0.0])
    }

    /// Names and values of its curves.
    fn values(self, ride: &LateralRide) -> Vec<(&'static str, f64)> {
        let average = ("average", self.single(ride));
        match self {
            Self::PrimaryStroke => WHEELSETS.into_iter().zip(ride.primary_stroke).collect(),
            Self::Excursion => WHEELSETS.into_iter().zip(ride.excursion).collect(),
            Self::Acceleration => ["c.g.", "front", "rear"]
                .into_iter()
                .zip(ride.acceleration)
                .chain([average])
                .collect(),
            Self::SecondaryStroke => ["leading truck", "trailing truck"]
                .into_iter()
                .zip(ride.secondary_stroke)
                .chain([average])
                .collect(),
        }
    }

    /// The one value that the design procedure enters: wheelset 4's stroke, wheelset 1's
    /// excursion, averages (Tables 4.6.1, 4.7.1).
    fn single(self, ride: &LateralRide) -> f64 {
        match self {
            Self::PrimaryStroke => ride.primary_stroke[3],
            Self::Excursion => ride.excursion[0],
            Self::Acceleration => ride.average_acceleration(),
            Self::SecondaryStroke => ride.average_stroke(),
        }
    }

    /// Its index, and what 3.3 allows of it as a peak where the spec says nothing.
    fn limit(self) -> (Index, Option<f64>) {
        match self {
            Self::PrimaryStroke => (Index::PrimaryLateralStroke, Some(PRIMARY_STOP)),
            Self::Excursion => (Index::WheelsetExcursion, Some(EXCURSION)),
            Self::Acceleration => (Index::LateralAcceleration, None),
            Self::SecondaryStroke => (Index::SecondaryLateralStroke, Some(SECONDARY_STOP)),
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::PrimaryStroke => "primary lateral stroke",
            Self::Excursion => "wheelset excursion",
            Self::Acceleration => "carbody lateral acceleration",
            Self::SecondaryStroke => "secondary lateral stroke",
        }
    }
}

/// The largest RMS value whose peak is allowed, with its label: the spec's, or the nominal one.
pub(super) fn rms_limit(
    book: &Workbook,
    (index, nominal): (Index, Option<f64>),
) -> Option<(f64, String)> {
    let is_peak = index.quantity() == Quantity::Stroke;
    let share = if is_peak { PEAK } else { 1.0 };
    let prefix = if is_peak { "3σ = " } else { "" };
    match (book.spec.demands.get(index), nominal) {
        (Some(bound), _) => {
            let value = book.value(index.quantity(), bound, 3);
            Some((bound / share, format!("allowed {prefix}{value}")))
        }
        (None, Some(bound)) => {
            let value = book.value(index.quantity(), bound, 3);
            Some((bound / share, format!("nominal limit {prefix}{value}")))
        }
        _ => None,
    }
}

impl Over {
    /// Values that the chart holds fixed.
    fn fixed(self) -> Vec<Parameter> {
        [
            (Self::Conicity, Parameter::CONICITY),
            (Self::Bending, Parameter::PRIMARY_BENDING_STIFFNESS),
            (Self::Lateral, Parameter::PRIMARY_LATERAL_STIFFNESS),
        ]
        .into_iter()
        .filter(|(axis, p)| *axis != self && !(self == Self::Speed && *p == Parameter::CONICITY))
        .map(|(_, parameter)| parameter)
        .chain([Parameter::SECONDARY_YAW_STIFFNESS])
        .collect()
    }
}

/// Draws one of the charts.
pub(super) fn draw(book: &Workbook, entry: &Entry, shown: Shown, over: Over) -> Figure {
    let case = book.case();
    let speed = case.service.speed;
    let (x, at, words) = match over {
        Over::Conicity => (book.conicity_axis(), case.wheel_rail.conicity, "conicity"),
        Over::Bending => {
            let [axis, _] = book.stiffness_axes();
            let at = Parameter::PRIMARY_BENDING_STIFFNESS.get(case);
            (axis, at, "primary bending stiffness")
        }
        Over::Lateral => {
            let [_, axis] = book.stiffness_axes();
            let at = Parameter::PRIMARY_LATERAL_STIFFNESS.get(case);
            (axis, at, "primary lateral stiffness")
        }
        Over::Speed => (book.speed_axis(), speed, "speed"),
    };
    let curves = match over {
        Over::Conicity => by_name(book.over_conicity(), shown),
        Over::Bending => by_name(book.over_bending(), shown),
        Over::Lateral => by_name(book.over_lateral(), shown),
        Over::Speed => book
            .over_speed()
            .iter()
            .enumerate()
            .map(|(i, (conicity, sweep))| {
                Curve::line(
                    format!("λ = {conicity}"),
                    sweep.points(|ride| shown.single(ride)),
                )
                .at(*conicity)
                .stroke(Stroke::nth(i))
            })
            .collect(),
    };
    let design = lateral_ride(case).map(|ride| Mark::design([at, shown.single(&ride)]));
    let limit = rms_limit(book, shown.limit());
    let most = highest(&curves).max(design.iter().map(|mark| mark.at[1]).fold(0.0, f64::max));
    // A limit far off would press the curves to the bottom; then a note says where it is.
    let near = limit.as_ref().filter(|(value, _)| *value < 2.5 * most);
    let y = shown.axis(book).holding(
        [1.02 * most]
            .into_iter()
            .chain(near.map(|(value, _)| *value * 1.02)),
    );
    let shades = unstable(book, over, &x);
    let interrupted = curves.iter().any(|curve| curve.pieces.len() != 1)
        || curves.iter().any(|c| c.pieces.iter().flatten().count() < 2)
        || over_unstable(book, over);
    let family = Family::new(
        if over == Over::Speed {
            "conicity"
        } else {
            "place"
        },
        "",
        Stroke::default(),
    )
    .curves(curves);
    let mut panel = Panel::new("", x, y)
        .with(family)
        .mark(design.clone())
        .limit(near.map(|(value, label)| Limit {
            axis: Direction::Y,
            value: *value,
            at_least: false,
            label: label.clone(),
        }));
    panel.shades = shades;
    let what = match (over, shown) {
        (Over::Speed, Shown::PrimaryStroke) => "primary lateral stroke of wheelset 4",
        (Over::Speed, Shown::Excursion) => "excursion of wheelset 1",
        _ => shown.words(),
    };
    let mut figure = entry
        .figure(format!("Influence of {words} on {what}"))
        .panel(panel)
        .described(format!(
            "RMS {what} over the {words}; the design is marked."
        ));
    figure.subtitle = book.subtitle((over != Over::Speed).then_some(speed), &over.fixed());
    if over == Over::Speed {
        figure.subtitle = format!("{}, on {}", figure.subtitle, case.service.track.name);
    }
    if let Some((_, label)) = limit.as_ref().filter(|_| near.is_none()) {
        figure = figure.note(format!("Beyond the chart: {label}."));
    }
    if design.is_none() {
        figure = figure.note("The design is unstable at its speed: it has no ride to mark.");
    }
    if interrupted {
        figure =
            figure.note("No curve where the vehicle is unstable: there is no stationary response.");
    }
    figure
}

/// How far curves matter: towards instability they rise without end.
fn highest(curves: &[Curve]) -> f64 {
    let mut values: Vec<f64> = curves
        .iter()
        .flat_map(Curve::points)
        .map(|p| p[1])
        .collect();
    values.sort_by(f64::total_cmp);
    let median = values.get(values.len() / 2).copied().unwrap_or(0.0);
    values.last().map_or(0.0, |most| most.min(2.5 * median))
}

/// Share of the axis that a range without a ride must have to be named.
const NAMED: f64 = 0.15;

/// Where there is no ride, but over the speed, where every conicity ends at its own.
fn unstable(book: &Workbook, over: Over, x: &Axis) -> Vec<Shade> {
    let sweep = match over {
        Over::Conicity => book.over_conicity(),
        Over::Bending => book.over_bending(),
        Over::Lateral => book.over_lateral(),
        Over::Speed => return Vec::new(),
    };
    let speed = book.value(Quantity::Speed, book.case().service.speed, 3);
    let shade = |range: [f64; 2]| {
        let [from, to] = range.map(|v| x.fraction(v));
        let label = if (to - from).abs() > NAMED {
            format!("unstable at {speed}")
        } else {
            String::new()
        };
        Shade {
            axis: Direction::X,
            range,
            label,
        }
    };
    sweep.unstable().into_iter().map(shade).collect()
}

fn over_unstable(book: &Workbook, over: Over) -> bool {
    let unstable = |sweep: &Sweep| sweep.rides.iter().any(Option::is_none);
    match over {
        Over::Conicity => unstable(book.over_conicity()),
        Over::Bending => unstable(book.over_bending()),
        Over::Lateral => unstable(book.over_lateral()),
        Over::Speed => book.over_speed().iter().any(|(_, sweep)| unstable(sweep)),
    }
}

/// A curve for each wheelset, truck or passenger point.
fn by_name(sweep: &Sweep, shown: Shown) -> Vec<Curve> {
    let Some(first) = sweep.rides.iter().flatten().next() else {
        return Vec::new();
    };
    shown
        .values(first)
        .into_iter()
        .enumerate()
        .map(|(i, (name, _))| {
            Curve::line(name, sweep.points(|ride| shown.values(ride)[i].1)).stroke(Stroke::nth(i))
        })
        .collect()
}
