//! Modes of the lateral model followed over the speed.

use num_complex::Complex64;

use super::{
    performance::lateral_modes,
    workbook::{MPH, Workbook},
};
use crate::{
    dynamics::LateralModel,
    evaluate::modes::{KinematicMode, LateralShape, OVERDAMPED},
    units::Quantity,
};

/// Lowest speed shown.
const LOWEST: f64 = 20.0 * MPH;

/// Speeds at which the modes are computed: multiples of 2.5 mph or 5 km/h, with their numbers.
pub(super) fn speeds(book: &Workbook, highest: f64) -> (Vec<u32>, Vec<f64>) {
    let unit = book.unit(Quantity::Speed);
    let step = unit.factor * if unit.label == "mph" { 2.5 } else { 5.0 };
    (1..)
        .map(|n| (n, f64::from(n) * step))
        .skip_while(|(_, v)| *v < LOWEST)
        .take_while(|(_, v)| *v <= highest * (1.0 + 1e-9))
        .unzip()
}

/// A mode followed over the speed.
pub(super) struct Followed {
    /// At each speed; `None` where it was lost or does not oscillate.
    pub roots: Vec<Option<Complex64>>,
    /// Whether it is one of the kinematic modes at the service speed.
    pub kinematic: bool,
}

/// Follows every mode from the operating speed to both ends of the range: each goes to where it is
/// expected from its last two places, the nearest first.
pub(super) fn follow(book: &Workbook, speeds: &[f64]) -> Vec<Followed> {
    let case = book.case();
    let model = LateralModel::new(case);
    let modes = book.each(speeds, |speed| lateral_modes(case, &model, *speed));
    let start = speeds
        .iter()
        .position(|v| *v >= case.service.speed)
        .unwrap_or(speeds.len() - 1);
    let mut followed: Vec<Followed> = modes[start]
        .iter()
        .filter(|m| m.damping_ratio < OVERDAMPED)
        .map(|m| {
            let mut roots = vec![None; speeds.len()];
            roots[start] = Some(m.mode.eigenvalue);
            Followed {
                roots,
                kinematic: m.shape == LateralShape::Kinematic,
            }
        })
        .collect();
    let up = (start + 1..speeds.len()).map(|i| (i, i - 1, i.checked_sub(2)));
    let down = (0..start).rev().map(|i| (i, i + 1, Some(i + 2)));
    for (i, last, before) in up.chain(down) {
        let found: Vec<Complex64> = modes[i]
            .iter()
            .filter(|m| m.damping_ratio < OVERDAMPED)
            .map(|m| m.mode.eigenvalue)
            .collect();
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for (k, mode) in followed.iter().enumerate() {
            let Some(here) = mode.roots[last] else {
                continue;
            };
            let before = before.and_then(|b| mode.roots.get(b).copied().flatten());
            let expected = before.map_or(here, |before| here + (here - before));
            for (j, root) in found.iter().enumerate() {
                pairs.push(((root - expected).norm() / root.norm(), k, j));
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut taken = vec![false; found.len()];
        for (distance, k, j) in pairs {
            if distance < 0.2 && !taken[j] && followed[k].roots[i].is_none() {
                taken[j] = true;
                followed[k].roots[i] = Some(found[j]);
            }
        }
    }
    followed
}

/// Eigenvalue of the kinematic mode at a speed, with the damping ratio that is its index. `None` if the
/// truck diverges.
pub(super) fn kinematic_at(book: &Workbook, speed: f64) -> Option<Complex64> {
    let mode = KinematicMode::new(&LateralModel::new(book.case()), book.case(), speed);
    mode.ok().flatten().map(|mode| mode.eigenvalue())
}
