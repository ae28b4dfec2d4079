//! Ride comfort by frequency: the ISO boundary (Figure 3.2.1) and roll acceleration (3.2.2).

use super::{
    Entry,
    performance::{lateral_passengers, vertical_passengers},
    workbook::Workbook,
};
use crate::{
    comfort::{iso_boundary, third_octave},
    dynamics::{ForcedModel, LateralModel, VerticalModel, lateral, vertical},
    evaluate::ride::{BandRide, PassengerRide, mean_squares_between},
    numerics::Poles,
    plot::{Axis, Curve, Dash, Family, Figure, Ink, Labels, Panel, Scale, Stroke, Unit, Weight},
    units::Quantity,
};

/// Axis of frequency.
pub(super) fn frequency_axis(range: [f64; 2]) -> Axis {
    Axis::new(
        "frequency",
        "f",
        "frequency_hz",
        Scale::Log,
        range,
        [Unit::new("Hz", 1.0)],
    )
}

/// A one-third-octave band is half a decade's tenth wide to either side of its centre.
fn band_edges(centre: f64) -> [f64; 2] {
    [10_f64.powf(-0.05), 10_f64.powf(0.05)].map(|factor| centre * factor)
}

/// Band values as steps.
fn steps(bands: impl IntoIterator<Item = (f64, f64)>) -> Vec<[f64; 2]> {
    bands
        .into_iter()
        .flat_map(|(centre, value)| band_edges(centre).map(|f| [f, value]))
        .collect()
}

/// One-third-octave accelerations of the worst passenger point, as steps.
fn worst_point(passengers: &[PassengerRide; 3]) -> Vec<[f64; 2]> {
    let ratio = |p: &PassengerRide| p.boundary_ratio().map_or(0.0, |(ratio, _)| ratio);
    let worst = passengers
        .iter()
        .max_by(|a, b| ratio(a).total_cmp(&ratio(b)));
    worst.map_or_else(Vec::new, |passenger| band_steps(&passenger.bands))
}

/// Steps of some bands, for a plot of one-third-octave bands.
pub(super) fn band_steps(bands: &[BandRide]) -> Vec<[f64; 2]> {
    steps(bands.iter().map(|b| (b.centre, b.acceleration)))
}

/// The lateral or vertical boundary as a curve.
pub(super) fn boundary(label: &str, of: fn(f64) -> Option<f64>) -> Curve {
    let points = Scale::Log
        .spread([1.0, 80.0], 96)
        .into_iter()
        .map(|f| [f, of(f).unwrap_or(f64::NAN)]);
    Curve::line(label, points)
}

/// An axis of RMS acceleration in bands.
pub(super) fn acceleration_axis(book: &Workbook, range: [f64; 2]) -> Axis {
    book.axis(
        "RMS acceleration per one-third octave",
        "",
        "acceleration_rms_m_per_s2",
        Quantity::Acceleration,
        Scale::Log,
        range,
    )
}

/// The boundary for both directions, with the design's accelerations.
pub(super) fn iso(book: &Workbook, entry: &Entry) -> Figure {
    let case = book.case();
    let boundaries = Family::new(
        "boundary",
        "one-hour reduced comfort boundary",
        Stroke::new(Ink::Black, Dash::Solid).weight(Weight::Bold),
    )
    .curve(boundary("vertical", iso_boundary::vertical))
    .curve(
        boundary("lateral", iso_boundary::lateral)
            .stroke(Stroke::new(Ink::Blue, Dash::Dashed).weight(Weight::Bold)),
    );
    let mut design =
        Family::new("design", "", Stroke::new(Ink::Black, Dash::Solid)).labelled(Labels::Legend);
    let vertical = vertical_passengers(case);
    let lateral = lateral_passengers(case, &LateralModel::new(case));
    if let Some(passengers) = &vertical {
        design = design.curve(
            Curve::line("design, vertical, worst point", worst_point(passengers))
                .stroke(Stroke::new(Ink::Black, Dash::Solid)),
        );
    }
    if let Some(passengers) = &lateral {
        design = design.curve(
            Curve::line("design, lateral, worst point", worst_point(passengers))
                .stroke(Stroke::new(Ink::Blue, Dash::Dotted)),
        );
    }
    let least = design.curves.iter().flat_map(Curve::points).map(|p| p[1]);
    let y = acceleration_axis(book, [0.02, 10.0]).holding(least.filter(|a| *a > 0.01));
    let panel = Panel::new("", frequency_axis([0.5, 80.0]), y)
        .with(design)
        .with(boundaries);
    let mut figure = entry
        .figure("Lateral and vertical acceleration limits, one hour, reduced comfort")
        .panel(panel)
        .described(
            "RMS acceleration over frequency on logarithmic axes: the vertical and lateral ISO \
             boundaries from 1 to 80 Hz, and the design's one-third-octave accelerations.",
        )
        .note(
            "Boundaries of ISO 2631:1974 as in general circulation, not confirmed from the \
             standard itself.",
        );
    figure.subtitle = book.subtitle(Some(case.service.speed), &[]);
    if lateral.is_none() {
        figure = figure.note("The design is unstable at its speed: it has no lateral ride.");
    }
    figure
}

/// RMS roll acceleration in one-third-octave bands of one output of a model; none where it did not
/// converge.
fn roll_bands(book: &Workbook, model: &ForcedModel, output: usize) -> Vec<[f64; 2]> {
    let case = book.case();
    let [low, high] = case.model.frequency_band;
    let edges = third_octave::edges_between(low, high);
    let Ok(squares) = mean_squares_between(model, case, output, &edges) else {
        return Vec::new();
    };
    steps(edges.windows(2).enumerate().filter_map(|(b, edges)| {
        let centre = third_octave::centre_of(edges[0], edges[1])?;
        Some((centre, squares[b].sqrt()))
    }))
}

/// RMS roll acceleration of the carbody.
pub(super) fn roll(book: &Workbook, entry: &Entry) -> Figure {
    let case = book.case();
    let mut family = Family::new("roll", "", Stroke::default()).labelled(Labels::Legend);
    let lateral = LateralModel::new(case);
    let poles = Poles::at(&lateral.forced, case.service.speed);
    let stable = poles.is_ok_and(|poles| poles.stable());
    if stable {
        let bands = roll_bands(book, &lateral.forced, lateral::output::ROLL_ACCELERATION);
        family = family.curve(
            Curve::line("lateral model: alignment and crosslevel", bands)
                .stroke(Stroke::new(Ink::Blue, Dash::Dashed)),
        );
    }
    let model = VerticalModel::new(case);
    let bands = roll_bands(book, &model.forced, vertical::output::ROLL_ACCELERATION);
    family = family.curve(
        Curve::line("vertical model: crosslevel", bands)
            .stroke(Stroke::new(Ink::Black, Dash::Solid)),
    );
    let values: Vec<f64> = family
        .curves
        .iter()
        .flat_map(Curve::points)
        .map(|p| p[1])
        .collect();
    let y = Axis::new(
        "RMS roll acceleration per one-third octave",
        "",
        "roll_acceleration_rms_rad_per_s2",
        Scale::Log,
        [0.01, 0.1],
        [Unit::new("rad/s^2", 1.0)],
    )
    .holding(values);
    let mut figure = entry
        .figure("Roll acceleration of the carbody by frequency")
        .panel(Panel::new("", frequency_axis([0.4, 50.0]), y).with(family))
        .described(
            "RMS roll acceleration of the carbody in one-third-octave bands over frequency, on \
             logarithmic axes.",
        )
        .note(
            "The roll equal-discomfort curves of the report's figure (its reference 29) are lost, \
             and none are made up here: this is what would be held against them.",
        );
    figure.subtitle = book.subtitle(Some(case.service.speed), &[]);
    if !stable {
        figure =
            figure.note("The design is unstable at its speed: the lateral model has no response.");
    }
    figure
}
