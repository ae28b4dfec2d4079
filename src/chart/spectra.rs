//! Acceleration spectra (Figures 4.3.2, 4.4.2).

use super::{
    Entry,
    comfort::{acceleration_axis, band_steps, boundary, frequency_axis},
    performance::lateral_passengers,
    value::number,
    workbook::Workbook,
};
use crate::{
    case::Case,
    comfort::iso_boundary,
    dynamics::{ForcedModel, LateralModel, VerticalModel, lateral, vertical},
    evaluate::ride::{mean_squares_between, response::Response},
    numerics::elimination::LANES,
    plot::{
        Axis, Curve, Dash, Direction, Family, Figure, Ink, Panel, Scale, Shade, Stroke, Unit,
        Weight,
    },
    vehicle::GRAVITY,
};

/// Frequencies of a spectrum.
const POINTS: usize = 321;
/// End of the band that the report singles out, Hz.
const LOW_BAND: f64 = 2.0;

/// Spectral density of one output of a model at frequencies in Hz.
fn spectrum(model: &ForcedModel, case: &Case, output: usize, frequencies: &[f64]) -> Vec<f64> {
    let outputs = output..output + 1;
    let mut response = Response::of(model, &case.service.track, case.service.speed, outputs);
    let mut densities = [[0.0; LANES]];
    let mut values = Vec::with_capacity(frequencies.len());
    for chunk in frequencies.chunks(LANES) {
        let mut f = [chunk[0]; LANES];
        f[..chunk.len()].copy_from_slice(chunk);
        response.densities(&f, &mut densities);
        values.extend(&densities[0][..chunk.len()]);
    }
    values
}

/// Share of the RMS value of an output that lies below 2 Hz: the RMS of the band over that of the
/// whole.
fn share(model: &ForcedModel, case: &Case, output: usize) -> Option<f64> {
    let [low, high] = case.model.frequency_band;
    let edges = [low, LOW_BAND.clamp(low, high), high];
    let squares = mean_squares_between(model, case, output, &edges).ok()?;
    Some((squares[0] / squares.iter().sum::<f64>()).sqrt())
}

/// A panel with the spectrum of an acceleration.
fn panel(book: &Workbook, id: &str, model: &ForcedModel, output: usize) -> Panel {
    let case = book.case();
    let x = frequency_axis([0.1, case.model.frequency_band[1].max(1.0)]);
    let frequencies = Scale::Log.spread(x.range, POINTS);
    let values = spectrum(model, case, output, &frequencies);
    let points: Vec<[f64; 2]> = frequencies
        .into_iter()
        .zip(values)
        .map(|(f, value)| [f, value])
        .collect();
    let most = points.iter().map(|p| p[1]).fold(0.0, f64::max);
    let y = Axis::new(
        "acceleration spectral density",
        "",
        "acceleration_psd_m2_per_s4_hz",
        Scale::Log,
        // Five decades below the peak nothing matters.
        [most * 1e-5, most],
        book.system.pair([
            Unit::new("(m/s^2)^2/Hz", 1.0),
            Unit::new("g^2/Hz", GRAVITY * GRAVITY),
        ]),
    )
    .rounded();
    let label = share(model, case, output).map_or_else(
        || "0–2 Hz".into(),
        |share| format!("0–2 Hz: {} % of RMS", number(100.0 * share, 3)),
    );
    let line = Curve::line("", points).stroke(Stroke::default());
    let [from, _] = x.range;
    Panel::new(id, x, y)
        .shade(Shade {
            axis: Direction::X,
            range: [from, LOW_BAND],
            label,
        })
        .with(Family::new("spectrum", "", Stroke::default()).curve(line))
}

/// Vertical spectra at the c.g. and the rear passenger point.
pub(super) fn vertical_spectra(book: &Workbook, entry: &Entry) -> Figure {
    let case = book.case();
    let model = VerticalModel::new(case);
    let outputs = vertical::output::ACCELERATION;
    let mut figure = entry
        .figure("Vertical acceleration spectral densities")
        .columns(2)
        .height(1.2)
        .panel(panel(book, "a", &model.forced, outputs.start).titled("(a) at the c.g."))
        .panel(
            panel(book, "b", &model.forced, outputs.start + 2)
                .titled("(b) at the rear passenger point"),
        )
        .described(
            "Power spectral density of the vertical acceleration over frequency on logarithmic \
             axes, at the c.g. and at the rear passenger point, with the share of the RMS value \
             below 2 Hz.",
        );
    figure.subtitle = book.subtitle(Some(case.service.speed), &[]);
    figure
}

/// Lateral spectrum and one-third-octave accelerations at the front passenger point.
pub(super) fn lateral_front(book: &Workbook, entry: &Entry) -> Figure {
    let case = book.case();
    let mut figure = entry
        .figure("Front passenger point: lateral acceleration by frequency")
        .columns(2)
        .height(1.2)
        .described(
            "Power spectral density of the lateral acceleration at the front passenger point, and \
             its one-third-octave RMS values against the ISO boundary, over frequency on \
             logarithmic axes.",
        );
    figure.subtitle = book.subtitle(Some(case.service.speed), &[]);
    let model = LateralModel::new(case);
    let Some([_, ride, _]) = lateral_passengers(case, &model) else {
        let empty = Axis::new("", "", "y", Scale::Linear, [0.0, 1.0], [Unit::new("", 1.0)]);
        return figure
            .panel(Panel::new("", frequency_axis([0.1, 50.0]), empty))
            .columns(1)
            .note("The design is unstable at its speed: there is no stationary response.");
    };
    let front = lateral::output::ACCELERATION.start + 1;
    let bands = &ride.bands;
    let values: Vec<f64> = bands.iter().map(|b| b.acceleration).collect();
    let most = values.iter().copied().fold(0.0, f64::max);
    let y = acceleration_axis(book, [most / 300.0, 2.0 * most]).holding([0.27 * 2.0]);
    let iso = Family::new(
        "boundary",
        "one-hour reduced comfort boundary",
        Stroke::new(Ink::Vermilion, Dash::Long).weight(Weight::Bold),
    )
    .curve(boundary("", iso_boundary::lateral));
    let own = Family::new("bands", "", Stroke::default()).curve(Curve::line("", band_steps(bands)));
    figure
        .panel(panel(book, "c", &model.forced, front).titled("(c) acceleration spectral density"))
        .panel(
            Panel::new("d", frequency_axis([0.4, 50.0]), y)
                .with(own)
                .with(iso)
                .titled("(d) one-third-octave RMS acceleration"),
        )
}
