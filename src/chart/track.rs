//! Spectral densities of the track (Figures 3.4.2, 3.4.3).

use super::{Entry, workbook::Workbook};
use crate::{
    plot::{Curve, Dash, Family, Figure, Ink, Panel, Scale, Stroke, Weight},
    track::{FRA_CLASSES, Spectrum, Track},
    units::{Quantity, us::FOOT},
};

/// Wavenumbers, rad/m: wave lengths from 1000 ft to 6 ft.
const RANGE: [f64; 2] = [0.005 / FOOT, 1.0 / FOOT];

fn points(spectrum: &Spectrum) -> Vec<[f64; 2]> {
    Scale::Log
        .spread(RANGE, 97)
        .into_iter()
        .map(|omega| [omega, spectrum.density(omega)])
        .collect()
}

/// Other tracks to compare with.
fn classes(of: impl Fn(&Track) -> &Spectrum, own: &str) -> Family {
    let stroke = Stroke::new(Ink::Grey, Dash::Solid).weight(Weight::Thin);
    let mut family = Family::new("classes", "FRA classes, to compare with", stroke);
    for class in 1..=FRA_CLASSES {
        if let Some(track) = Track::fra_class(class).filter(|track| track.name != own) {
            let line = Curve::line(format!("class {class}"), points(of(&track)));
            family = family.curve(line.at(class as f64));
        }
    }
    family
}

fn panel(book: &Workbook, families: Vec<Family>) -> Panel {
    let x = book.axis(
        "wavenumber",
        "Ω",
        "wavenumber_rad_per_m",
        Quantity::Wavenumber,
        Scale::Log,
        RANGE,
    );
    let values: Vec<f64> = families
        .iter()
        .flat_map(|f| &f.curves)
        .flat_map(Curve::points)
        .map(|p| p[1])
        .collect();
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let y = book
        .axis(
            "spectral density",
            "S",
            "spectral_density_m3_per_rad",
            Quantity::SpectralDensity,
            Scale::Log,
            [least, least * 2.0],
        )
        .holding(values);
    families.into_iter().fold(Panel::new("", x, y), Panel::with)
}

fn finished(book: &Workbook, figure: Figure) -> Figure {
    let track = &book.case().service.track;
    let mut figure = figure.note(format!("Track of the spec: {}.", track.source));
    figure.subtitle = format!("{}: track {}", book.name, track.name);
    figure
}

/// Vertical profile and alignment.
pub(super) fn profile_and_alignment(book: &Workbook, entry: &Entry) -> Figure {
    let track = &book.case().service.track;
    let own = Family::new("track", "", Stroke::default())
        .curve(
            Curve::line("vertical profile S_v", points(&track.vertical))
                .stroke(Stroke::new(Ink::Sky, Dash::Solid).weight(Weight::Bold)),
        )
        .curve(
            Curve::line("alignment S_a", points(&track.alignment))
                .stroke(Stroke::new(Ink::Black, Dash::Dashed)),
        );
    let mut other = classes(|t| &t.vertical, &track.name);
    other.title = "vertical profile of FRA classes, to compare with".into();
    let figure = entry
        .figure("Vertical profile and alignment spectral densities")
        .panel(panel(book, vec![other, own]))
        .described(
            "One-sided spectral density of vertical profile and alignment over wavenumber on \
             logarithmic axes.",
        );
    finished(book, figure)
}

/// Crosslevel.
pub(super) fn crosslevel(book: &Workbook, entry: &Entry) -> Figure {
    let track = &book.case().service.track;
    let own = Family::new("track", "", Stroke::default().weight(Weight::Bold))
        .curve(Curve::line("crosslevel S_c", points(&track.crosslevel)));
    let figure = entry
        .figure("Crosslevel spectral density")
        .panel(panel(
            book,
            vec![classes(|t| &t.crosslevel, &track.name), own],
        ))
        .described("One-sided spectral density of crosslevel over wavenumber on logarithmic axes.");
    finished(book, figure)
}
