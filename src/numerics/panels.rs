//! Panels of quadrature around the known poles of an integrand.
//!
//! The error of a Gauss rule on a panel falls with the size of the largest ellipse around it, foci at
//! its ends, that holds no pole of the integrand (Davis, Rabinowitz: *Methods of Numerical Integration*,
//! 1984, section 4.6). Each panel is made as wide as the poles allow.

use nalgebra::Complex;

use super::size;

/// Sum of the distances of a pole from the two ends of a panel, at least, over its width: half the
/// sum of the ellipse's axes is then 1.78 times half the panel. It leaves an error of 1e-7 or less.
const CLEARANCE: f64 = 1.17;
/// Largest ratio of the ends of a panel.
const RATIO: f64 = 4.0;
/// Remainder of the range, as a share of the last panel, that is added to that panel: the error stays the
/// same.
const REMAINDER: f64 = 1e-3;
/// Width of the narrowest panel over its lower end: some ten doubles lie in it. Panels towards a pole
/// straight ahead shrink twelvefold each, so that fourteen reach this width.
const NARROWEST: f64 = 1e-14;
/// Distance of a kink from the start of the range, as a share of it, below which the kink is left out.
const START_GAP: f64 = 1e-3;

/// Edges of panels, ascending, from `low` to `high`. Every one of the integrand's `kinks` within the
/// range is an edge, no panel is wider than `widest`, and none comes closer to the `poles` than the
/// rule allows.
pub fn panels(
    [low, high]: [f64; 2],
    mut kinks: Vec<f64>,
    poles: &[Complex<f64>],
    widest: f64,
) -> Vec<f64> {
    kinks.push(high);
    kinks.retain(|kink| (low * (1.0 + START_GAP)..=high).contains(kink));
    kinks.sort_by(f64::total_cmp);
    let mut edges = vec![low];
    let mut at = low;
    for kink in kinks {
        while at < kink {
            let mut next = (at * RATIO).min(at + widest);
            for z in poles {
                let to = z - at;
                let width = 2.0 * (CLEARANCE * size(to) - to.re) / (CLEARANCE * CLEARANCE - 1.0);
                next = next.min(at + width);
            }
            // A pole on the axis would stop the progress.
            next = next.max(at * (1.0 + NARROWEST));
            if kink - next < REMAINDER * (next - at) {
                next = kink;
            }
            edges.push(next);
            at = next;
        }
    }
    edges
}

/// Panels divided at further edges.
pub fn divided(mut panels: Vec<f64>, further: &[f64]) -> Vec<f64> {
    panels.extend(further);
    panels.sort_by(f64::total_cmp);
    panels.dedup();
    panels
}
