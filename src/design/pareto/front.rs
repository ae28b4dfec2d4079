//! Points of a front: which of them count, and how they spread.

use super::tracer::Aim;
use crate::{
    case::Case,
    design::explain::Explained,
    index::{Index, Scale, Sense},
    optimize::local::Status,
};

/// A point of a front.
#[derive(Debug, Clone)]
pub struct FrontPoint {
    /// The design.
    pub case: Case,
    /// The indices traded off, SI, the worst over all conditions.
    pub values: Vec<f64>,
    /// The optimum explained, with the prices of the bounds on the other indices.
    pub explained: Explained,
    /// Number of its wheel profile.
    pub(super) profile: usize,
    /// The design in scaled coordinates.
    pub(super) x: Vec<f64>,
    /// The search that led to it.
    pub(super) aim: Aim,
    /// True if it was searched for everywhere.
    pub(super) is_verified: bool,
    /// True if its other indices were improved at no more than a negligible loss.
    pub(super) is_spared: bool,
}

/// Cost of a value: its logarithm for indices compared by ratios; smaller is better.
pub(super) fn badness(index: Index, value: f64) -> f64 {
    let size = match index.scale() {
        Scale::Logarithmic => value.max(f64::MIN_POSITIVE).ln(),
        Scale::Linear => value,
    };
    match index.sense() {
        Sense::AtLeast => -size,
        Sense::AtMost => size,
    }
}

/// The value that is so bad.
pub(super) fn of_badness(index: Index, badness: f64) -> f64 {
    let size = match index.sense() {
        Sense::AtLeast => -badness,
        Sense::AtMost => badness,
    };
    match index.scale() {
        Scale::Logarithmic => size.exp(),
        Scale::Linear => size,
    }
}

impl FrontPoint {
    /// Cost in every index.
    pub(super) fn badness(&self, indices: &[Index]) -> Vec<f64> {
        let pairs = indices.iter().zip(&self.values);
        pairs
            .map(|(index, value)| badness(*index, *value))
            .collect()
    }
}

/// Relative difference that counts as zero: the accuracy of convergence.
const EQUAL_VALUES: f64 = 1e-6;
/// Points that differ by no more than this in any index show the same twice: 0.1 %.
const REPEATED: f64 = 1e-3;

/// True if `a` is as good as `b` in every index, and better in some.
pub(super) fn dominates(a: &[f64], b: &[f64]) -> bool {
    let pairs = || a.iter().zip(b);
    pairs().all(|(a, b)| *a <= b + EQUAL_VALUES) && pairs().any(|(a, b)| *a < b - EQUAL_VALUES)
}

/// Removes points that others dominate or repeat. Returns how many were dominated.
pub(super) fn clean(points: &mut Vec<FrontPoint>, indices: &[Index]) -> usize {
    let badness: Vec<Vec<f64>> = points.iter().map(|p| p.badness(indices)).collect();
    let dominated = |i: usize| badness.iter().any(|b| dominates(b, &badness[i]));
    let repeats = |i: usize| {
        badness[..i].iter().enumerate().any(|(j, b)| {
            !dominated(j)
                && b.iter()
                    .zip(&badness[i])
                    .all(|(a, b)| (a - b).abs() <= REPEATED)
        })
    };
    let lost: Vec<bool> = (0..points.len()).map(dominated).collect();
    let keep: Vec<bool> = (0..points.len()).map(|i| !lost[i] && !repeats(i)).collect();
    let mut kept = keep.iter();
    points.retain(|_| *kept.next().unwrap_or(&false));
    lost.iter().filter(|lost| **lost).count()
}

/// Most of one index that a point may give for as much of another, in badness: of ratios, percent for
/// percent.
const DEAREST: f64 = 20.0;

/// Removes points that are not properly efficient (Geoffrion 1968): against some other point their loss
/// in one index is more than [`DEAREST`] times their gain in any. Returns how many. No chain of
/// such points closes, as gains add up along it, so the best of each chain stays.
pub(super) fn bargains(points: &mut Vec<FrontPoint>, indices: &[Index]) -> usize {
    let badness: Vec<Vec<f64>> = points.iter().map(|p| p.badness(indices)).collect();
    let better = |a: &[f64], b: &[f64]| {
        let pairs = a.iter().zip(b);
        pairs.map(|(a, b)| b - a).fold(0.0, f64::max)
    };
    let dear = |b: &[f64]| {
        badness
            .iter()
            .any(|a| better(a, b) > DEAREST * better(b, a))
    };
    let mut keep = badness.iter().map(|b| !dear(b));
    let count = points.len();
    points.retain(|_| keep.next().unwrap_or(true));
    count - points.len()
}

/// Removes points that did not converge to an optimum, but for the best in every index, which end
/// the front and say how they were found.
pub(super) fn converged(points: &mut Vec<FrontPoint>, indices: &[Index]) {
    let badness: Vec<Vec<f64>> = points.iter().map(|p| p.badness(indices)).collect();
    let mut ends = (0..points.len()).map(|i| is_end(&badness, i));
    let is_optimum =
        |p: &FrontPoint| matches!(p.explained.status, Status::Optimal | Status::BestFound);
    points.retain(|p| ends.next().unwrap_or(false) || is_optimum(p));
}

/// True if no point is better in some index.
fn is_end(badness: &[Vec<f64>], i: usize) -> bool {
    let indices = 0..badness[i].len();
    indices
        .into_iter()
        .any(|k| badness.iter().all(|b| b[k] >= badness[i][k]))
}

/// Extent of the front in every index; 1 where it has none.
pub(super) fn extents(badness: &[Vec<f64>]) -> Vec<f64> {
    let dimensions = badness.first().map_or(0, Vec::len);
    (0..dimensions)
        .map(|k| {
            let values = badness.iter().map(|b| b[k]);
            let low = values.clone().fold(f64::INFINITY, f64::min);
            let extent = values.fold(f64::NEG_INFINITY, f64::max) - low;
            if extent > 0.0 { extent } else { 1.0 }
        })
        .collect()
}

/// Distance of two points in shares of the front's extent.
pub(super) fn distance(a: &[f64], b: &[f64], extents: &[f64]) -> f64 {
    let squares = a.iter().zip(b).zip(extents);
    squares
        .map(|((a, b), e)| ((a - b) / e).powi(2))
        .sum::<f64>()
        .sqrt()
}

/// Thins a front to `wanted` points, always taking one of the closest two; the best in every index
/// stay.
pub(super) fn thin(points: &mut Vec<FrontPoint>, indices: &[Index], wanted: usize) {
    while points.len() > wanted.max(indices.len()) {
        let badness: Vec<Vec<f64>> = points.iter().map(|p| p.badness(indices)).collect();
        let extents = extents(&badness);
        let nearest = |i: usize| {
            let others = (0..points.len()).filter(|j| *j != i);
            others
                .map(|j| distance(&badness[i], &badness[j], &extents))
                .fold(f64::INFINITY, f64::min)
        };
        let closest = (0..points.len())
            .filter(|i| !is_end(&badness, *i))
            .map(|i| (nearest(i), i))
            .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let Some((_, i)) = closest else { break };
        points.remove(i);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn badness_and_back() {
        for (index, value) in [
            (Index::CriticalSpeed, 80.0),
            (Index::LateralAcceleration, 0.5),
            (Index::LeastDampingRatio, -0.03),
        ] {
            let back = of_badness(index, badness(index, value));
            assert!((back - value).abs() < 1e-12, "{index:?}");
        }
        assert!(badness(Index::CriticalSpeed, 90.0) < badness(Index::CriticalSpeed, 80.0));
    }

    #[test]
    fn dominance() {
        assert!(dominates(&[1.0, 2.0], &[1.0, 2.1]));
        assert!(!dominates(&[1.0, 2.0], &[1.0, 2.0]));
        assert!(!dominates(&[1.0, 2.0], &[0.9, 2.1]));
    }
}
