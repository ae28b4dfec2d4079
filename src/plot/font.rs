//! Widths of text, from the font that pictures are drawn with.
//!
//! DejaVu Sans Condensed is embedded: it has every letter that the charts need under a free
//! licence, and it is wider than the sans-serif fonts that browsers put in its place, so what fits
//! here fits there.

use std::{collections::HashMap, sync::LazyLock};

use skrifa::{FontRef, MetadataProvider, instance::LocationRef, instance::Size};

/// Families that the drawings ask for, best first.
pub(super) const FAMILIES: &str =
    "'DejaVu Sans Condensed','Helvetica Neue',Arial,'Liberation Sans',sans-serif";

/// Width of a character that the font lacks, in em.
const UNKNOWN: f64 = 0.6;

/// The embedded font.
pub(super) fn bytes() -> &'static [u8] {
    dejavu::sans_condensed::regular()
}

/// Advance widths in em.
static ADVANCES: LazyLock<HashMap<char, f64>> = LazyLock::new(|| {
    let Ok(font) = FontRef::new(bytes()) else {
        return HashMap::new();
    };
    let metrics = font.glyph_metrics(Size::new(1.0), LocationRef::default());
    let characters = font.charmap();
    (' '..'\u{2300}')
        .filter_map(|c| {
            let glyph = characters.map(c)?;
            Some((c, f64::from(metrics.advance_width(glyph)?)))
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
    use super::*;

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
