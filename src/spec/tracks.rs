//! Tracks of one's own: `[tracks.NAME]`.

use std::collections::{BTreeMap, BTreeSet};

use toml::de::{DeTable, DeValue};

use super::diagnostic::{Collect, Diagnostic, word};
use super::document::{Document, Value, bad_name, nearest};
use super::keys::{self, Range};
use super::value::{choice, list, number};
use crate::track::{CORNER_WAVENUMBER, Spectrum, Track};
use crate::units::Quantity;

type Mistakes = Vec<Diagnostic>;

/// Keys of a track in the FRA form, and of one given by points.
pub(super) const FORM: [&str; 5] = [
    "form",
    "vertical_roughness",
    "alignment_roughness",
    "corner_wavenumber",
    "crosslevel_corner_wavenumber",
];
pub(super) const POINTS: [&str; 3] = ["vertical", "alignment", "crosslevel"];

/// The key of the form that may be left out.
pub(super) const OPTIONAL: &str = "corner_wavenumber";
/// Columns of a spectrum given by points.
pub(super) const COLUMNS: [(&str, Quantity); 2] = [
    ("wavenumber", Quantity::Wavenumber),
    ("density", Quantity::SpectralDensity),
];

/// Kind of quantity of a key in the FRA form.
pub(super) fn form_quantity(name: &str) -> Quantity {
    if name.ends_with("roughness") {
        Quantity::Roughness
    } else {
        Quantity::Wavenumber
    }
}

/// Reads `[tracks]`.
pub(super) fn read(document: &Document, mistakes: &mut Mistakes) -> BTreeMap<String, Track> {
    let Some(value) = document.get(keys::TRACKS) else {
        return BTreeMap::new();
    };
    let DeValue::Table(tracks) = value.get_ref() else {
        mistakes.push(Diagnostic::at(
            value.span(),
            "`tracks` is a table",
            "expected tables [tracks.NAME]",
        ));
        return BTreeMap::new();
    };
    let mut read = BTreeMap::new();
    for (name, value) in tracks {
        mistakes.extend(bad_name(name));
        let text = name.get_ref();
        if Track::named(text).is_some() {
            mistakes.push(Diagnostic::at(
                name.span(),
                format!("`{text}` is built in"),
                "expected another name",
            ));
        }
        let DeValue::Table(table) = value.get_ref() else {
            mistakes.push(Diagnostic::at(
                value.span(),
                format!("`tracks.{}` is a table", word(text)),
                format!("expected a table [tracks.{}]", word(text)),
            ));
            continue;
        };
        let reader = Reader {
            name: text,
            place: name.span(),
            table,
        };
        // A track with mistakes is still known by its name.
        let track = reader
            .track(mistakes)
            .unwrap_or_else(|| Track::fra_form(1.0, 1.0, 1.0, 1.0));
        let name = text.to_string();
        read.insert(name.clone(), Track { name, ..track });
    }
    read
}

struct Reader<'a> {
    name: &'a str,
    place: std::ops::Range<usize>,
    table: &'a DeTable<'a>,
}

impl Reader<'_> {
    fn track(&self, mistakes: &mut Mistakes) -> Option<Track> {
        let is_form = self.get("form").is_some();
        let allowed: &[&str] = if is_form { &FORM } else { &POINTS };
        self.only(allowed, mistakes);
        if is_form {
            self.fra(mistakes)
        } else {
            // All three are read, so that the mistakes of all are reported.
            let [vertical, alignment, crosslevel] =
                POINTS.map(|name| self.spectrum(name, mistakes));
            Some(Track {
                name: String::new(),
                source: "points of the spec".into(),
                vertical: vertical?,
                alignment: alignment?,
                crosslevel: crosslevel?,
            })
        }
    }

    fn fra(&self, mistakes: &mut Mistakes) -> Option<Track> {
        if let Some(value) = self.get("form") {
            mistakes.collect(choice(value, "form", &["fra"]));
        }
        let values = FORM[1..].iter().map(|&name| {
            let quantity = form_quantity(name);
            match self.get(name) {
                Some(value) => mistakes.collect(number(value, name, quantity, Range::Positive)),
                None if name == OPTIONAL => Some(CORNER_WAVENUMBER),
                None => {
                    mistakes.push(self.absent(name, quantity.expectation()));
                    None
                }
            }
        });
        let values: Vec<Option<f64>> = values.collect();
        let [a_v, a_a, omega_c, omega_s] = values[..] else {
            return None;
        };
        Some(Track::fra_form(a_v?, a_a?, omega_c?, omega_s?))
    }

    fn spectrum(&self, name: &str, mistakes: &mut Mistakes) -> Option<Spectrum> {
        let form =
            "expected { wavenumber = [\"0.1 rad/m\", …], density = [\"1e-6 m^2/(rad/m)\", …] }";
        let Some(value) = self.get(name) else {
            mistakes.push(self.absent(name, form.to_owned()));
            return None;
        };
        let DeValue::Table(table) = value.get_ref() else {
            let message = format!("`{name}` is a table");
            mistakes.push(Diagnostic::at(value.span(), message, form));
            return None;
        };
        let points = Reader {
            name,
            place: value.span(),
            table,
        };
        points.only(&COLUMNS.map(|(name, _)| name), mistakes);
        let mut column = |(name, quantity): (&str, Quantity)| {
            if let Some(value) = points.get(name) {
                mistakes.collect(list(value, name, quantity, Range::Positive, 2))
            } else {
                mistakes.push(points.absent(name, form.to_owned()));
                None
            }
        };
        let [wavenumber, density] = COLUMNS.map(&mut column);
        let (wavenumber, density) = (wavenumber?, density?);
        if wavenumber.len() != density.len() {
            mistakes.push(Diagnostic::at(
                points.place,
                format!(
                    "{} wavenumbers, {} densities",
                    wavenumber.len(),
                    density.len()
                ),
                "expected one density for each wavenumber",
            ));
            return None;
        }
        if !wavenumber.is_sorted_by(|a, b| a < b) {
            mistakes.push(Diagnostic::at(
                points.place,
                "the wavenumbers do not ascend",
                "expected each wavenumber above the one before it",
            ));
            return None;
        }
        let points = wavenumber.into_iter().zip(density);
        Some(Spectrum::Points(points.map(|(w, s)| [w, s]).collect()))
    }

    fn get(&self, name: &str) -> Option<&Value<'_>> {
        self.table
            .iter()
            .find(|(key, _)| key.get_ref() == name)
            .map(|(_, value)| value)
    }

    fn absent(&self, name: &str, expected: String) -> Diagnostic {
        let message = format!("`{}` has no `{name}`", word(self.name));
        Diagnostic::at(self.place.clone(), message, expected)
    }

    fn only(&self, allowed: &[&str], mistakes: &mut Mistakes) {
        let names: BTreeSet<&str> = allowed.iter().copied().collect();
        for (key, _) in self.table {
            let written = key.get_ref();
            if !names.contains(&**written) {
                let message = format!("unknown key `{}`", word(written));
                let expected = format!("expected {}", allowed.join(", "));
                let near = nearest(written, allowed.iter().copied());
                mistakes.push(
                    Diagnostic::at(key.span(), message, expected)
                        .help(near.map(|near| format!("did you mean `{near}`?"))),
                );
            }
        }
    }
}
