//! Points in the gaps of a front.

use super::{
    front::{FrontPoint, clean, distance, extents, of_badness},
    tracer::{Aim, Tracer},
};
use crate::index::Index;

/// Gaps this many times wider than the mean are filled even if there are points enough.
const WIDE_GAP: f64 = 3.0;
/// Searches between points, per point asked for.
const TRIES: usize = 3;

/// Gaps between points that were searched.
#[derive(Debug, Default)]
pub(super) struct Filling {
    /// Pairs of points, by badness, between which a search came to no other.
    closed: Vec<[Vec<f64>; 2]>,
    tries: usize,
    is_at_end: bool,
}

impl Filling {
    /// True if there is no place left to search at.
    pub fn is_at_end(&self) -> bool {
        self.is_at_end
    }

    /// Places at which a search came to no other point.
    pub fn jumps(&self) -> usize {
        self.closed.len()
    }

    fn is_closed(&self, a: &[f64], b: &[f64]) -> bool {
        let pair = |[p, q]: &[Vec<f64>; 2]| p == a && q == b || p == b && q == a;
        self.closed.iter().any(pair)
    }
}

/// A pair of neighbouring points, by number, and their distance in shares of the front's extents.
type Gap = (f64, [usize; 2]);

/// Pairs of neighbouring points: consecutive points of two indices; of three, every point with the point
/// nearest to it.
fn gaps(badness: &[Vec<f64>]) -> Vec<Gap> {
    let extents = extents(badness);
    let far = |i: usize, j: usize| distance(&badness[i], &badness[j], &extents);
    if badness.first().is_some_and(|b| b.len() == 2) {
        let mut order: Vec<usize> = (0..badness.len()).collect();
        order.sort_by(|i, j| badness[*i][0].total_cmp(&badness[*j][0]));
        let pairs = order.windows(2);
        return pairs.map(|w| (far(w[0], w[1]), [w[0], w[1]])).collect();
    }
    let nearest = |i: usize| {
        let others = (0..badness.len()).filter(|j| *j != i);
        others
            .map(|j| (far(i, j), [i, j]))
            .min_by(|a, b| a.0.total_cmp(&b.0))
    };
    (0..badness.len()).filter_map(nearest).collect()
}

fn mean(gaps: &[Gap]) -> f64 {
    gaps.iter().map(|(width, _)| width).sum::<f64>() / gaps.len().max(1) as f64
}

/// Number of gaps wider than three times the mean.
pub(super) fn wide_gaps(points: &[FrontPoint], indices: &[Index]) -> usize {
    let badness: Vec<Vec<f64>> = points.iter().map(|p| p.badness(indices)).collect();
    let gaps = gaps(&badness);
    let widest = WIDE_GAP * mean(&gaps);
    gaps.iter().filter(|(width, _)| *width > widest).count()
}

/// Puts points into the widest gaps until the front has as many as wanted and no gap is three times as
/// wide as the mean.
pub(super) fn fill(
    tracers: &[Tracer],
    points: &mut Vec<FrontPoint>,
    wanted: usize,
    filling: &mut Filling,
) {
    let Some(Tracer {
        indices, archive, ..
    }) = tracers.first()
    else {
        return;
    };
    let mut tries = 0;
    while tries < TRIES * wanted && archive.stopped().is_none() {
        let badness: Vec<Vec<f64>> = points.iter().map(|p| p.badness(indices)).collect();
        let gaps = gaps(&badness);
        let widest = WIDE_GAP * mean(&gaps);
        let is_short = points.len() < wanted;
        let open = gaps
            .iter()
            .filter(|(width, [i, j])| {
                (is_short || *width > widest) && !filling.is_closed(&badness[*i], &badness[*j])
            })
            .max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, [i, j])) = open else {
            filling.is_at_end = true;
            return;
        };
        tries += 1;
        filling.tries += 1;
        let (a, b) = (badness[*i].clone(), badness[*j].clone());
        let ends = [points[*i].clone(), points[*j].clone()];
        let count = points.len();
        for aim in aims(indices, [&a, &b]) {
            points.extend(between(tracers, &ends, &aim, filling.tries));
            clean(points, indices);
            if points.len() > count {
                break;
            }
        }
        if points.len() <= count {
            filling.closed.push([a, b]);
        }
    }
    filling.is_at_end = false;
}

/// Searches half-way between two points: one index is made as good as can be within the means of the
/// others. First the index in which the points differ least; the critical speed last, which changes
/// smoothly as a bound.
fn aims(indices: &[Index], [a, b]: [&[f64]; 2]) -> Vec<Aim> {
    let difference = |k: usize| (a[k] - b[k]).abs();
    let mut objectives: Vec<usize> = (0..indices.len()).collect();
    objectives.sort_by(|i, j| {
        let is_speed = |k: usize| indices[k] == Index::CriticalSpeed;
        let by_speed = is_speed(*i).cmp(&is_speed(*j));
        by_speed.then(difference(*i).total_cmp(&difference(*j)))
    });
    let aim = |objective: usize| {
        let kept = (0..indices.len()).filter(|k| *k != objective);
        Aim {
            objective: indices[objective],
            bounds: kept
                .map(|k| {
                    (
                        indices[k],
                        of_badness(indices[k], f64::midpoint(a[k], b[k])),
                    )
                })
                .collect(),
        }
    };
    objectives.into_iter().map(aim).collect()
}

/// Points of an aim between two, for the profiles of both.
fn between(
    tracers: &[Tracer],
    ends: &[FrontPoint; 2],
    aim: &Aim,
    number: usize,
) -> Vec<FrontPoint> {
    let mut profiles = vec![ends[0].profile, ends[1].profile];
    profiles.dedup();
    profiles
        .into_iter()
        .filter_map(|profile| {
            let tracer = &tracers[profile];
            tracer.announce(&format!("gap {number}"));
            let own = ends.iter().filter(|point| point.profile == profile);
            tracer.beside(aim, own.map(|point| point.x.clone()).collect())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::gaps;

    #[test]
    fn neighbours_of_two_indices_lie_side_by_side() {
        let badness = [vec![0.0, 1.0], vec![1.0, 0.0], vec![0.25, 0.5]];
        let gaps = gaps(&badness);
        assert_eq!(
            gaps.iter().map(|g| g.1).collect::<Vec<_>>(),
            [[0, 2], [2, 1]]
        );
        assert!((gaps[0].0 - 0.3125_f64.sqrt()).abs() < 1e-12);
    }
}
