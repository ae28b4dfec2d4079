//! The first points of a front: its ends, and even steps between them.

use super::{
    front::{FrontPoint, clean, dominates, of_badness},
    tracer::{Aim, Bounds, END, Tracer},
};
use crate::{
    index::Index,
    optimize::{
        local::WIDE,
        solve::{NoDesign, Start},
    },
};

/// Share of the points that is laid evenly before gaps are looked at.
const EVEN: f64 = 0.6;

/// The index that is kept rather than pushed: the critical speed changes smoothly as a bound.
fn kept(indices: &[Index]) -> Index {
    let speed = indices.iter().find(|i| **i == Index::CriticalSpeed);
    *speed.unwrap_or(&indices[0])
}

impl Tracer<'_> {
    /// Front between `indices`, with `bounds` on others kept.
    ///
    /// # Errors
    ///
    /// [`NoDesign`] if no design could be evaluated.
    pub fn front(
        &self,
        indices: &[Index],
        bounds: &[(Index, f64)],
        wanted: usize,
    ) -> Result<Vec<FrontPoint>, NoDesign> {
        let kept = kept(indices);
        let rest: Vec<Index> = indices.iter().copied().filter(|i| *i != kept).collect();
        let mut points = self.ends(indices, bounds)?;
        let badness = points.iter().map(|p| self.badness_of(p, kept));
        let low = badness.clone().fold(f64::INFINITY, f64::min);
        let high = badness.fold(f64::NEG_INFINITY, f64::max);
        let wanted = wanted.saturating_sub(points.len());
        if wanted == 0 || low >= high {
            return Ok(points);
        }
        if let [objective] = rest[..] {
            let steps = (EVEN * wanted as f64).ceil();
            for k in 1..=wanted {
                let t = k as f64 / (steps + 1.0);
                if t >= 1.0 || self.archive.stopped().is_some() {
                    break;
                }
                self.announce(&format!("point {k} of {steps}"));
                let level = low + t * (high - low);
                points.extend(self.level(objective, (kept, level), bounds, &points));
            }
            self.mend(&mut points);
        } else {
            let slices = wanted.isqrt().max(2);
            for k in 0..slices {
                let t = (k as f64 + 0.5) / slices as f64;
                let level = of_badness(kept, low + t * (high - low));
                let mut bounds: Bounds = bounds.to_vec();
                bounds.push((kept, level));
                if self.archive.stopped().is_some() {
                    break;
                }
                // A slice without a design adds no points.
                if let Ok(slice) = self.front(&rest, &bounds, wanted.div_ceil(slices)) {
                    points.extend(slice);
                }
            }
        }
        Ok(points)
    }

    /// The best in every index alone, and among the designs that reach it the best in another.
    fn ends(
        &self,
        indices: &[Index],
        bounds: &[(Index, f64)],
    ) -> Result<Vec<FrontPoint>, NoDesign> {
        let mut points: Vec<FrontPoint> = Vec::new();
        for best in indices {
            self.announce(&format!("the best {}", best.words()));
            let aim = Aim {
                objective: *best,
                bounds: bounds.to_vec(),
            };
            let known = points.iter().map(|p| p.x.clone()).collect();
            // The ends of slices follow the basins seen, as all points between the ends do.
            let alone = if bounds.is_empty() {
                self.everywhere(&aim, known)
            } else {
                Ok(self.follow(&aim, known))
            };
            let alone = match alone {
                Ok(Some(alone)) => alone,
                Ok(None) => continue,
                // Finished points stay.
                Err(NoDesign::Stopped(_)) => break,
                Err(reason) => return Err(reason),
            };
            let mut found = false;
            let reached = of_badness(*best, self.badness_of(&alone, *best) + END);
            for other in indices.iter().filter(|i| *i != best) {
                let mut aim = Aim {
                    objective: *other,
                    bounds: bounds.to_vec(),
                };
                aim.bounds.push((*best, reached));
                let near = Start {
                    radius: WIDE,
                    ..Start::near(vec![alone.x.clone()])
                };
                if self.archive.stopped().is_none()
                    && let Ok(Some(end)) = self.solve(&aim, &near)
                {
                    points.push(end);
                    found = true;
                }
            }
            // Of the designs with the best value, the best in the other indices is taken.
            if !found {
                points.push(alone);
            }
        }
        Ok(points)
    }

    /// The best objective where an index is no worse than a level, in badness.
    fn level(
        &self,
        objective: Index,
        (kept, level): (Index, f64),
        bounds: &[(Index, f64)],
        known: &[FrontPoint],
    ) -> Option<FrontPoint> {
        let mut bounds: Bounds = bounds.to_vec();
        bounds.push((kept, of_badness(kept, level)));
        let near = [false, true]
            .into_iter()
            .filter_map(|above| self.nearest(known, kept, level, above));
        let near = near.map(|p| p.x.clone()).collect();
        self.follow(&Aim { objective, bounds }, near)
    }

    /// Searches again from another point's design where that is better.
    fn mend(&self, points: &mut [FrontPoint]) {
        for i in 0..points.len() {
            let badness = points[i].badness(self.indices);
            let better = points
                .iter()
                .find(|p| dominates(&p.badness(self.indices), &badness));
            let Some(better) = better.filter(|_| !points[i].aim.bounds.is_empty()) else {
                continue;
            };
            if self.archive.stopped().is_some() {
                return;
            }
            let start = Start::near(vec![better.x.clone()]);
            if let Ok(Some(point)) = self.solve(&points[i].aim.clone(), &start) {
                points[i] = point;
            }
        }
    }

    /// The point of this profile whose badness in an index is nearest to a level, above or below it.
    fn nearest<'p>(
        &self,
        points: &'p [FrontPoint],
        index: Index,
        level: f64,
        above: bool,
    ) -> Option<&'p FrontPoint> {
        let far = |p: &FrontPoint| (self.badness_of(p, index) - level).abs();
        let on_side = points
            .iter()
            .filter(|p| p.profile == self.profile && (self.badness_of(p, index) > level) == above);
        on_side.min_by(|a, b| far(a).total_cmp(&far(b)))
    }
}

/// Tries the other profiles where their own points, joined by lines, lie beyond the front between two
/// indices: points of one profile do not dominate what lies between those of another.
pub(super) fn rival(tracers: &[Tracer], points: &mut Vec<FrontPoint>) {
    let Some(first) = tracers.first().filter(|first| first.indices.len() == 2) else {
        return;
    };
    let kept = kept(first.indices);
    let Some(objective) = first.indices.iter().copied().find(|i| *i != kept) else {
        return;
    };
    let mut front = points.clone();
    clean(&mut front, first.indices);
    for point in &front {
        let level = first.badness_of(point, kept);
        let own = first.badness_of(point, objective);
        for tracer in tracers.iter().filter(|t| t.profile != point.profile) {
            let side = |above: bool| tracer.nearest(points, kept, level, above);
            let (Some(a), Some(b)) = (side(false), side(true)) else {
                continue;
            };
            let [xa, xb] = [a, b].map(|p| first.badness_of(p, kept));
            let [fa, fb] = [a, b].map(|p| first.badness_of(p, objective));
            let expected = fa + (fb - fa) * (level - xa) / (xb - xa).max(f64::MIN_POSITIVE);
            if expected >= own || first.archive.stopped().is_some() {
                continue;
            }
            tracer.announce("a rival of the front");
            points.extend(tracer.level(objective, (kept, level), &[], points));
        }
    }
}
