//! One-hour reduced comfort boundaries of ISO 2631:1974, for one-third-octave band RMS values.
//!
//! The fatigue-decreased proficiency boundary for one hour, divided by 3.15, m/s²:
//!
//! ```math
//! vertical:  1.18 √(4/f) for 1–4 Hz, 1.18 for 4–8 Hz, 1.18 f/8 above
//! lateral:   0.85 for 1–2 Hz, 0.85 f/2 above
//! ```
//!
//! These values are in general circulation and reproduce the standard's slopes, but were **not
//! confirmed from the standard itself**. They are shown for comparison; no requirement rests on
//! them.

/// Fatigue-decreased proficiency over reduced comfort.
const REDUCED_COMFORT: f64 = 3.15;
/// Range of the standard, Hz, wide enough for exact band centres of its nominal 1 and 80 Hz.
const RANGE: std::ops::RangeInclusive<f64> = 0.99..=81.0;

/// Vertical boundary at a band centre, m/s² RMS; `None` outside 1–80 Hz.
pub fn vertical(f: f64) -> Option<f64> {
    let proficiency = 1.18
        * if f < 4.0 {
            (4.0 / f).sqrt()
        } else {
            (f / 8.0).max(1.0)
        };
    RANGE.contains(&f).then_some(proficiency / REDUCED_COMFORT)
}

/// Lateral boundary at a band centre, m/s² RMS; `None` outside 1–80 Hz.
pub fn lateral(f: f64) -> Option<f64> {
    let proficiency = 0.85 * (f / 2.0).max(1.0);
    RANGE.contains(&f).then_some(proficiency / REDUCED_COMFORT)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tabulated boundaries, m/s²: nominal Hz, vertical, lateral.
    #[test]
    fn closed_forms_reproduce_the_table() {
        for (f, a_z, a_xy) in [
            (1.0, 0.749, 0.270),
            (1.25, 0.673, 0.270),
            (2.0, 0.540, 0.270),
            (2.5, 0.476, 0.337),
            (3.15, 0.419, 0.419),
            (4.0, 0.375, 0.540),
            (8.0, 0.375, 1.063),
            (10.0, 0.476, 1.349),
            (16.0, 0.749, 2.127),
            (31.5, 1.508, 4.190),
            (80.0, 3.746, 10.63),
        ] {
            // The table rounds to preferred numbers: 2.5 %.
            assert!((vertical(f).unwrap() / a_z - 1.0).abs() < 0.025, "{f}");
            assert!((lateral(f).unwrap() / a_xy - 1.0).abs() < 0.025, "{f}");
        }
        assert!(vertical(0.5).is_none() && lateral(100.0).is_none());
    }
}
