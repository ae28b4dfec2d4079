//! Widths of text in DejaVu Sans Condensed, the font that pictures are drawn with.
//!
//! It has every letter that the charts need under a free licence, and it is wider than the
//! sans-serif fonts that browsers put in its place, so what fits here fits there. Only the advance
//! widths are kept, up to U+22FF (the mathematical operators): `advances.txt` has a row for sixteen
//! characters, the first one's code point ahead, with `.` for a character that the font lacks.

use std::{collections::HashMap, sync::LazyLock};

/// Families that the drawings ask for, best first.
pub(super) const FAMILIES: &str =
    "'DejaVu Sans Condensed','Helvetica Neue',Arial,'Liberation Sans',sans-serif";

/// Width of a character that the font lacks, in em.
const UNKNOWN: f64 = 0.6;

/// Units of the table per em.
const UNITS_PER_EM: f64 = 2048.0;

/// The table of advance widths.
const TABLE: &str = include_str!("advances.txt");

/// Advance widths in em.
static ADVANCES: LazyLock<HashMap<char, f64>> = LazyLock::new(|| {
    TABLE
        .lines()
        .filter_map(|row| row.split_once(' '))
        .filter_map(|(first, widths)| Some((u32::from_str_radix(first, 16).ok()?, widths)))
        .flat_map(|(first, widths)| (first..).zip(widths.split(' ')))
        .filter_map(|(code, width)| {
            let units: f64 = width.parse().ok()?;
            Some((char::from_u32(code)?, units / UNITS_PER_EM))
        })
        .collect()
});

/// Width of text on one level at a font size.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let advance = |c: char| ADVANCES.get(&c).copied().unwrap_or(UNKNOWN);
    size * text.chars().map(advance).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use std::fmt::Write;

    use skrifa::{FontRef, MetadataProvider, instance::LocationRef, instance::Size};

    use super::*;

    /// The table as it is to be, from the font.
    fn table() -> String {
        let font = FontRef::new(dejavu::sans_condensed::regular()).unwrap();
        let metrics = font.glyph_metrics(Size::unscaled(), LocationRef::default());
        let characters = font.charmap();
        let width = |code: u32| {
            let glyph = characters.map(char::from_u32(code)?)?;
            metrics.advance_width(glyph)
        };
        let mut table = String::new();
        for first in (0x20..0x2300).step_by(16) {
            let widths: Vec<String> = (first..first + 16)
                .map(|code| width(code).map_or(".".into(), |units| units.to_string()))
                .collect();
            if widths.iter().any(|width| width != ".") {
                writeln!(table, "{first:04x} {}", widths.join(" ")).unwrap();
            }
        }
        table
    }

    /// Written anew by `cargo test --lib advance_widths -- --ignored`.
    #[test]
    #[ignore = "writes the table of advance widths"]
    fn advance_widths() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/chart/advances.txt");
        std::fs::write(path, table()).unwrap();
    }

    #[test]
    fn the_table_is_that_of_the_font() {
        let font = FontRef::new(dejavu::sans_condensed::regular()).unwrap();
        let metrics = font.metrics(Size::unscaled(), LocationRef::default());
        assert!((f64::from(metrics.units_per_em) - UNITS_PER_EM).abs() < f64::EPSILON);
        assert!(
            TABLE == table(),
            "the table of advance widths is not the font's"
        );
    }

    /// All digits are equally wide, and every letter of the charts is in the font.
    #[test]
    fn the_font_has_what_is_needed() {
        assert!((width("0123", 10.0) - width("8888", 10.0)).abs() < 1e-6);
        assert!((4.0..8.0).contains(&width("0", 10.0)));
        for c in "ψφλξσμω°×−–√Δ²′″≥≤·πζ…θ".chars() {
            assert!(ADVANCES.contains_key(&c), "{c}");
        }
    }
}
