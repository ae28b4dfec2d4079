//! The report's design charts for the vehicle of a spec.
//!
//! [`BOOK`] lists them by number and name. A [`Workbook`] holds the spec and what several charts
//! share; [`Entry::draw`] gives the figure.
//!
//! ```
//! use bogie::{chart::{Workbook, find}, plot::System, spec::Spec};
//!
//! let spec = Spec::parse("[service]\nspeed = \"110 mph\"\ntrack = \"fra-class-6\"\n[vehicle]\nbase = \"prototype\"")
//!     .unwrap_or_else(|_| unreachable!());
//! let book = Workbook::new(&spec, "prototype", System::Us, &());
//! let figure = find("3.4.3").unwrap().draw(&book);
//! assert_eq!(figure.name, "track-crosslevel");
//! ```

mod breakaway;
mod comfort;
mod critical_speed;
mod curving;
mod followed;
mod modes;
mod performance;
mod plane;
mod root_locus;
mod sampling;
mod single_mode;
mod spectra;
mod stability_curving;
mod stiffness_field;
mod strokes;
mod sweep;
mod track;
mod trade_off;
mod unbalance;
mod value;
mod workbook;

use plane::{AVERAGE, CG, Plane, REAR};
use strokes::{Over, Shown};
use workbook::MPH;
pub use workbook::{CONICITIES, Progress, Workbook};

use crate::{parameter::Parameter, plot::Figure};

/// A chart of the book.
pub struct Entry {
    /// Its numbers in the report: the report prints some charts twice.
    pub numbers: &'static [&'static str],
    /// Its name.
    pub name: &'static str,
    /// Title: the quantity shown.
    pub title: &'static str,
    draw: fn(&Workbook, &Entry) -> Figure,
}

const fn entry(
    numbers: &'static [&'static str],
    name: &'static str,
    title: &'static str,
    draw: fn(&Workbook, &Entry) -> Figure,
) -> Entry {
    Entry {
        numbers,
        name,
        title,
        draw,
    }
}

/// All charts, in the order of the report.
#[rustfmt::skip]
pub const BOOK: [Entry; 38] = [
    entry(&["3.2.1"], "iso-boundary", "ISO reduced comfort boundary with the design's accelerations", comfort::iso),
    entry(&["3.2.2"], "roll-acceleration", "roll acceleration by frequency (the discomfort curves are lost)", comfort::roll),
    entry(&["3.2.5"], "unbalance", "limits of lateral unbalance", unbalance::draw),
    entry(&["3.4.2"], "track-profile-alignment", "track: vertical profile and alignment", track::profile_and_alignment),
    entry(&["3.4.3"], "track-crosslevel", "track: crosslevel", track::crosslevel),
    entry(&["4.3.1"], "vertical-modes", "frequencies and damping ratios of the vertical model", modes::vertical),
    entry(&["4.3.2"], "vertical-spectra", "vertical acceleration spectra", spectra::vertical_spectra),
    entry(&["4.3.3"], "single-mode", "transfer functions of a rigid-body mode", single_mode::draw),
    entry(&["4.3.4"], "vertical-points", "vertical ride against stroke, c.g. and rear point, at the service speed",
        |b, e| trade_off::draw(b, e, Plane::Vertical, b.case().service.speed, &[CG, REAR])),
    entry(&["4.4.1"], "lateral-modes", "frequencies and damping ratios of the lateral model", modes::lateral),
    entry(&["4.4.2"], "lateral-spectrum", "lateral acceleration spectrum and one-third octaves", spectra::lateral_front),
    entry(&["4.4.3"], "lateral-ride", "lateral ride against stroke, at the service speed",
        |b, e| trade_off::draw(b, e, Plane::Lateral, b.case().service.speed, &[AVERAGE])),
    entry(&["4.5.5"], "curving-boundary", "flange and slip boundary in cant deficiency against degree curve", curving::boundary),
    entry(&["4.5.6"], "curving-lines", "lines of constant curving for two conicities", curving::lines),
    entry(&["4.5.7"], "root-locus", "kinematic modes against speed, and root locus", root_locus::draw),
    entry(&["4.5.8"], "speed-lateral-stiffness", "critical speed against primary lateral stiffness",
        |b, e| critical_speed::by_conicity(b, e, Parameter::PRIMARY_LATERAL_STIFFNESS)),
    entry(&["4.5.9"], "speed-bending-stiffness", "critical speed against primary bending stiffness",
        |b, e| critical_speed::by_conicity(b, e, Parameter::PRIMARY_BENDING_STIFFNESS)),
    entry(&["4.5.10", "4.6.5"], "speed-yaw-stiffness", "critical speed against secondary yaw stiffness", critical_speed::by_primary),
    entry(&["4.5.11", "4.6.1"], "stability-curving-0.05", "critical speed and curving, λ = 0.05", |b, e| stability_curving::contours(b, e, 1)),
    entry(&["4.6.2"], "stability-curving-0.10", "critical speed and curving, λ = 0.1", |b, e| stability_curving::contours(b, e, 2)),
    entry(&["4.5.12", "4.6.3"], "stability-curving-0.15", "critical speed and curving, λ = 0.15", |b, e| stability_curving::contours(b, e, 3)),
    entry(&["4.6.4"], "stability-curving-0.25", "critical speed and curving, λ = 0.25", |b, e| stability_curving::contours(b, e, 4)),
    entry(&["4.5.13"], "envelopes", "best degree curve against critical speed, by conicity", stability_curving::envelopes),
    entry(&["4.6.6"], "primary-stroke-conicity", "primary lateral strokes against conicity",
        |b, e| strokes::draw(b, e, Shown::PrimaryStroke, Over::Conicity)),
    entry(&["4.6.7"], "primary-stroke-lateral-stiffness", "primary lateral strokes against primary lateral stiffness",
        |b, e| strokes::draw(b, e, Shown::PrimaryStroke, Over::Lateral)),
    entry(&["4.6.8"], "primary-stroke-speed", "primary lateral stroke against speed",
        |b, e| strokes::draw(b, e, Shown::PrimaryStroke, Over::Speed)),
    entry(&["4.6.9"], "excursion-conicity", "wheelset excursions against conicity",
        |b, e| strokes::draw(b, e, Shown::Excursion, Over::Conicity)),
    entry(&["4.6.10"], "excursion-bending-stiffness", "wheelset excursions against primary bending stiffness",
        |b, e| strokes::draw(b, e, Shown::Excursion, Over::Bending)),
    entry(&["4.6.11"], "excursion-speed", "wheelset excursion against speed",
        |b, e| strokes::draw(b, e, Shown::Excursion, Over::Speed)),
    entry(&["4.6.12"], "lateral-ride-110", "lateral ride against stroke at 110 mph",
        |b, e| trade_off::draw(b, e, Plane::Lateral, 110.0 * MPH, &[AVERAGE])),
    entry(&["4.6.13"], "lateral-ride-60", "lateral ride against stroke at 60 mph",
        |b, e| trade_off::draw(b, e, Plane::Lateral, 60.0 * MPH, &[AVERAGE])),
    entry(&["4.6.14"], "acceleration-conicity", "lateral acceleration against conicity",
        |b, e| strokes::draw(b, e, Shown::Acceleration, Over::Conicity)),
    entry(&["4.6.15"], "acceleration-bending-stiffness", "lateral acceleration against primary bending stiffness",
        |b, e| strokes::draw(b, e, Shown::Acceleration, Over::Bending)),
    entry(&["4.6.16"], "secondary-stroke-conicity", "secondary lateral strokes against conicity",
        |b, e| strokes::draw(b, e, Shown::SecondaryStroke, Over::Conicity)),
    entry(&["4.6.17"], "secondary-stroke-bending-stiffness", "secondary lateral strokes against primary bending stiffness",
        |b, e| strokes::draw(b, e, Shown::SecondaryStroke, Over::Bending)),
    entry(&["4.6.18"], "vertical-ride-110", "vertical ride against stroke at 110 mph",
        |b, e| trade_off::draw(b, e, Plane::Vertical, 110.0 * MPH, &[AVERAGE])),
    entry(&["4.6.19"], "vertical-ride-60", "vertical ride against stroke at 60 mph",
        |b, e| trade_off::draw(b, e, Plane::Vertical, 60.0 * MPH, &[AVERAGE])),
    entry(&["A.2"], "breakaway-torque", "degree curve against yaw breakaway torque", breakaway::draw),
];

/// The chart of that number or name; a number may stand as in `Figure 4.6.1`.
pub fn find(wanted: &str) -> Option<&'static Entry> {
    let wanted = wanted.trim().to_lowercase();
    let number = ["figure", "fig."]
        .iter()
        .find_map(|word| wanted.strip_prefix(word))
        .unwrap_or(&wanted)
        .trim();
    BOOK.iter().find(|entry| {
        entry.name == wanted || entry.numbers.iter().any(|n| n.eq_ignore_ascii_case(number))
    })
}

/// The name or number that is most like what was asked for.
pub fn suggestion(wanted: &str) -> Option<&'static str> {
    let wanted = wanted.to_lowercase();
    BOOK.iter()
        .flat_map(|entry| entry.numbers.iter().copied().chain([entry.name]))
        .map(|known| (strsim::jaro_winkler(&wanted, known), known))
        .filter(|(likeness, _)| *likeness > 0.7)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, known)| known)
}

impl Entry {
    /// Draws the chart for the vehicle of a workbook.
    pub fn draw(&self, book: &Workbook) -> Figure {
        (self.draw)(book, self)
    }

    /// Its numbers as one text.
    pub fn number(&self) -> String {
        self.numbers.join(" and ")
    }

    fn figure(&self, title: impl Into<String>) -> Figure {
        Figure::new(self.number(), self.name, title)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    /// Every figure that the report's text names as a chart of the design procedure is there once.
    #[test]
    fn the_book_is_complete() {
        let numbers: Vec<&str> = BOOK.iter().flat_map(|e| e.numbers).copied().collect();
        let unique: HashSet<&str> = numbers.iter().copied().collect();
        assert_eq!(unique.len(), numbers.len());
        let ranges = [
            ("3.4", 2..4),
            ("4.3", 1..5),
            ("4.4", 1..4),
            ("4.5", 5..14),
            ("4.6", 1..20),
        ];
        for (section, figures) in ranges {
            for figure in figures {
                let number = format!("{section}.{figure}");
                assert!(unique.contains(number.as_str()), "{number}");
            }
        }
        for number in ["3.2.1", "3.2.2", "3.2.5", "A.2"] {
            assert!(unique.contains(number), "{number}");
        }
        assert_eq!(
            BOOK.iter().map(|e| e.name).collect::<HashSet<_>>().len(),
            BOOK.len()
        );
    }

    #[test]
    fn charts_are_found_by_number_and_name() {
        for wanted in [
            "4.6.1",
            "Figure 4.6.1",
            "fig. 4.5.11",
            "stability-curving-0.05",
        ] {
            assert_eq!(
                find(wanted).unwrap().name,
                "stability-curving-0.05",
                "{wanted}"
            );
        }
        assert_eq!(find("a.2").unwrap().name, "breakaway-torque");
        assert!(find("4.1.1").is_none());
        assert_eq!(suggestion("envelope"), Some("envelopes"));
    }
}
