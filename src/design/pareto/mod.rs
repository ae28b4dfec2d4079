//! Pareto fronts between two or three indices by the ε-constraint method (Haimes, Lasdon, Wismer
//! 1971): one index is made as good as can be while the others keep a bound, and the bounds sweep
//! the front.
//!
//! Every point is a converged constrained optimum, started from its neighbours' designs. The ends
//! are the designs best in each index alone, and of those the best in the others. Where
//! neighbouring points are far apart, a point is put between them. Three indices are swept in
//! slices of the first, every point's other indices are made as good as they can be for next to
//! nothing, and points that give much of one index for little of another are left out.
//!
//! Requirements and limits on the indices traded off are left out: the front shows them, and ends
//! where `[pareto.bounds]` says.

mod front;

use std::collections::BTreeMap;

pub use front::FrontPoint;

use super::{
    explain::Explained,
    margin::worst_value,
    search::{Searched, search_feasible},
    study::Study,
    tasks::Tasks,
};
use crate::{
    index::Index,
    optimize::{
        archive::{Archive, Stop},
        local::{Status, WIDE},
        problem::Failure,
        solve::{NoDesign, Start},
    },
    parameter::Parameter,
    spec::{Condition, Spec},
};
use front::{badness, bargains, clean, converged, distance, dominates, extents, of_badness, thin};

/// A front.
#[derive(Debug, Clone)]
pub struct Front {
    /// What is traded off, in the order asked for.
    pub indices: Vec<Index>,
    /// The parameters that vary, the conicity among them where it is chosen from profiles.
    pub parameters: Vec<Parameter>,
    /// Points, none of which another dominates, in the order of the first index.
    pub points: Vec<FrontPoint>,
    /// Points found but dominated by others.
    pub dominated: usize,
    /// Why there is no point, where no design could be evaluated.
    pub failure: Option<Failure>,
    /// Why the run ended early, if it did.
    pub stopped: Option<Stop>,
    /// Full-model evaluations.
    pub evaluations: usize,
    /// Of which without a result, by reason.
    pub failures: BTreeMap<Failure, usize>,
}

/// By how much a bound that is an end of the front is loosened to choose among the designs that
/// reach it, in badness.
const END: f64 = 1e-3;
/// Share of the points that is laid evenly before gaps are looked at.
const EVEN: f64 = 0.6;
/// One in so many of these is searched for everywhere, the others from their neighbours' designs.
const EVERYWHERE: usize = 4;
/// Fewest points that show the shape of one profile's front.
const SHAPE: usize = 6;

/// Traces the front of a spec. A run that is stopped before its first point, and one in which no
/// design could be evaluated, give a front without points.
pub fn pareto(spec: &Spec, archive: &Archive) -> Front {
    let (count, before) = (archive.count(), archive.failures());
    let indices = &spec.front.indices;
    let tasks = Tasks::new(spec);
    let profiles = tasks.profiles(&spec.case);
    // Gaps are filled where a profile turns out to be the best.
    let wanted = match profiles.len() {
        1 => spec.front.points,
        n => spec.front.points.div_ceil(n).max(SHAPE),
    };
    let tracers: Vec<Tracer> = profiles
        .iter()
        .enumerate()
        .map(|(profile, conicity)| {
            let mut case = spec.case.clone();
            case.wheel_rail.conicity = *conicity;
            Tracer {
                profile,
                study: bounded(tasks.bare(&case, indices), spec),
                conditions: &spec.conditions,
                indices,
                seed: spec.design.seed,
                archive,
                name: match profiles.len() {
                    1 => "front".into(),
                    _ => format!("front of conicity {conicity}"),
                },
            }
        })
        .collect();
    let mut points = Vec::new();
    let mut failure = None;
    for tracer in &tracers {
        match tracer.front(indices, &[], wanted) {
            Ok(found) => points.extend(found),
            Err(NoDesign::Failed(reason)) => failure = Some(reason),
            Err(NoDesign::Stopped(_)) => {}
        }
        if archive.stopped().is_some() {
            break;
        }
    }
    let failure = failure.filter(|_| points.is_empty());
    if indices.len() == 2 {
        refine(&tracers, &mut points, spec.front.points);
        rival(&tracers, &mut points);
    }
    let mut parameters = tracers
        .first()
        .map_or_else(Vec::new, |t| t.study.parameters().to_vec());
    if profiles.len() > 1 {
        parameters.push(Parameter::Conicity);
    }
    let mut dominated = clean(&mut points, indices);
    converged(&mut points, indices);
    if indices.len() > 2 {
        for point in &mut points {
            tracers[point.profile].spare(point);
        }
        dominated += clean(&mut points, indices);
        dominated += bargains(&mut points, indices);
    }
    thin(&mut points, indices, spec.front.points);
    points.sort_by(|a, b| a.values[0].total_cmp(&b.values[0]));
    Front {
        indices: indices.clone(),
        parameters,
        points,
        dominated,
        failure,
        stopped: archive.stopped(),
        evaluations: archive.count() - count,
        failures: archive.failures_since(&before),
    }
}

/// The study with the ends that the spec gives the front.
fn bounded(mut study: Study, spec: &Spec) -> Study {
    for condition in 0..study.conditions() {
        for demand in spec.front.bounds.iter() {
            study = study.demand(condition, demand.index, demand.bound);
        }
    }
    study
}

/// Puts points into the widest gaps until the front has `wanted`, of the profiles on either side.
fn refine(tracers: &[Tracer], points: &mut Vec<FrontPoint>, wanted: usize) {
    let Some(Tracer {
        indices, archive, ..
    }) = tracers.first()
    else {
        return;
    };
    let kept = kept(indices);
    let Some(objective) = indices.iter().copied().find(|i| *i != kept) else {
        return;
    };
    let between = Between {
        objective,
        kept,
        bounds: &[],
    };
    let at = |index: Index| indices.iter().position(|i| *i == index).unwrap_or(0);
    let order = [at(kept), at(objective)];
    let mut tried: Vec<f64> = Vec::new();
    let mut front = points.clone();
    clean(&mut front, indices);
    while front.len() < wanted && tried.len() < 2 * wanted && archive.stopped().is_none() {
        let mut along: Vec<(Vec<f64>, usize)> = front
            .iter()
            .map(|p| {
                let badness = p.badness(indices);
                (order.map(|k| badness[k]).to_vec(), p.profile)
            })
            .collect();
        along.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
        let badness: Vec<Vec<f64>> = along.iter().map(|(b, _)| b.clone()).collect();
        let extents = extents(&badness);
        let widest = along
            .windows(2)
            .map(|w| {
                let middle = f64::midpoint(w[0].0[0], w[1].0[0]);
                (
                    distance(&w[0].0, &w[1].0, &extents),
                    middle,
                    [w[0].1, w[1].1],
                )
            })
            .filter(|(_, middle, _)| !tried.iter().any(|t| (t - middle).abs() < 1e-9))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, middle, [left, right])) = widest else {
            break;
        };
        tried.push(middle);
        let profiles = if left == right {
            vec![left]
        } else {
            vec![left, right]
        };
        for profile in profiles {
            let tracer = &tracers[profile];
            tracer.announce(&format!("gap {}", tried.len()));
            if let Some(point) = tracer.level(&between, middle, points, false) {
                points.push(point.clone());
                front.push(point);
            }
        }
        clean(&mut front, indices);
    }
}

/// Tries the other profiles where their own points, joined by lines, lie beyond the front: points
/// of one profile do not dominate what lies between those of another.
fn rival(tracers: &[Tracer], points: &mut Vec<FrontPoint>) {
    let Some(first) = tracers.first() else { return };
    let kept = kept(first.indices);
    let Some(objective) = first.indices.iter().copied().find(|i| *i != kept) else {
        return;
    };
    let between = Between {
        objective,
        kept,
        bounds: &[],
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
            if let Some(better) = tracer.level(&between, level, points, false) {
                points.push(better);
            }
        }
    }
}

/// The index that is kept rather than pushed: the critical speed changes smoothly as a bound.
fn kept(indices: &[Index]) -> Index {
    let speed = indices.iter().find(|i| **i == Index::CriticalSpeed);
    *speed.unwrap_or(&indices[0])
}

struct Tracer<'a> {
    /// Which of the wheel profiles.
    profile: usize,
    /// Parameters and demands, without those on the indices traded off.
    study: Study,
    conditions: &'a [Condition],
    indices: &'a [Index],
    seed: u64,
    archive: &'a Archive<'a>,
    name: String,
}

type Bounds = Vec<(Index, f64)>;

impl Tracer<'_> {
    /// The front between `indices` where `bounds` on others are kept.
    fn front(
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
            let between = Between {
                objective,
                kept,
                bounds,
            };
            self.even(&between, [low, high], &mut points, wanted);
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
                // A slice without a design adds nothing.
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
            let known = points.iter().map(|p| p.x.clone()).collect();
            let start = Start::everywhere(self.seed).with(known).thoroughly();
            let alone = match self.solve(*best, bounds, &start) {
                Ok(Some(alone)) => alone,
                Ok(None) => continue,
                // What is done stays.
                Err(NoDesign::Stopped(_)) => break,
                Err(reason) => return Err(reason),
            };
            let mut found = false;
            let reached = of_badness(*best, self.badness_of(&alone, *best) + END);
            for other in indices.iter().filter(|i| *i != best) {
                let mut bounds: Bounds = bounds.to_vec();
                bounds.push((*best, reached));
                let near = Start {
                    radius: WIDE,
                    ..Start::near(vec![alone.x.clone()])
                };
                if self.archive.stopped().is_none()
                    && let Ok(Some(end)) = self.solve(*other, &bounds, &near)
                {
                    points.push(end);
                    found = true;
                }
            }
            // Among the designs that reach the best, those best in the others stand for it.
            if !found {
                points.push(alone);
            }
        }
        Ok(points)
    }

    /// Points at even steps of the index kept; some of them are searched for everywhere.
    fn even(
        &self,
        between: &Between,
        [low, high]: [f64; 2],
        points: &mut Vec<FrontPoint>,
        wanted: usize,
    ) {
        let steps = (1..=wanted).filter(|k| *k as f64 <= (EVEN * wanted as f64).ceil());
        let steps = steps.count();
        for k in 1..=steps {
            if self.archive.stopped().is_some() {
                return;
            }
            self.announce(&format!("point {k} of {steps}"));
            let level = low + k as f64 / (steps + 1) as f64 * (high - low);
            let everywhere = k % EVERYWHERE == EVERYWHERE / 2 + 1;
            points.extend(self.level(between, level, points, everywhere));
        }
    }

    /// The best objective where the index kept is no worse than `level`, in badness.
    fn level(
        &self,
        between: &Between,
        level: f64,
        known: &[FrontPoint],
        everywhere: bool,
    ) -> Option<FrontPoint> {
        let mut bounds: Bounds = between.bounds.to_vec();
        bounds.push((between.kept, of_badness(between.kept, level)));
        let near: Vec<Vec<f64>> = [false, true]
            .into_iter()
            .filter_map(|above| self.nearest(known, between.kept, level, above))
            .map(|p| p.x.clone())
            .collect();
        let start = if everywhere {
            Start::everywhere(self.seed).with(near)
        } else {
            Start {
                radius: WIDE / 2.0,
                ..Start::near(near)
            }
        };
        self.solve(between.objective, &bounds, &start)
            .ok()
            .flatten()
    }

    /// Searches again where another point's design is better than what was found.
    fn mend(&self, points: &mut [FrontPoint]) {
        for i in 0..points.len() {
            let badness = points[i].badness(self.indices);
            let better = points
                .iter()
                .find(|p| dominates(&p.badness(self.indices), &badness));
            let Some(better) = better.filter(|_| !points[i].bounds.is_empty()) else {
                continue;
            };
            if self.archive.stopped().is_some() {
                return;
            }
            let start = Start::near(vec![better.x.clone()]);
            let (objective, bounds) = (points[i].objective, points[i].bounds.clone());
            if let Ok(Some(point)) = self.solve(objective, &bounds, &start) {
                points[i] = point;
            }
        }
    }

    /// Makes the other indices of a point as good as they can be for next to nothing: where the bound
    /// on one of three is not active, the search for the best of another leaves it anywhere.
    fn spare(&self, point: &mut FrontPoint) {
        let objective = point.objective;
        for other in self.indices.iter().filter(|i| **i != objective) {
            if self.archive.stopped().is_some() {
                return;
            }
            self.announce(&format!("what {} can be for nothing", other.words()));
            let kept = self.indices.iter().filter(|i| *i != other);
            let bounds: Bounds = kept
                .map(|i| (*i, of_badness(*i, self.badness_of(point, *i) + END)))
                .collect();
            let near = Start {
                radius: WIDE,
                ..Start::near(vec![point.x.clone()])
            };
            if let Ok(Some(better)) = self.solve(*other, &bounds, &near)
                && better.explained.status == Status::Optimal
                && self.badness_of(&better, *other) < self.badness_of(point, *other) - END
            {
                *point = better;
            }
        }
    }

    /// One point; `None` if no design found keeps the bounds, or the run ended before it converged.
    fn solve(
        &self,
        objective: Index,
        bounds: &[(Index, f64)],
        start: &Start,
    ) -> Result<Option<FrontPoint>, NoDesign> {
        let mut study = self.study.clone();
        for condition in 0..study.conditions() {
            study = study.optimise(condition, objective, 0, 1.0);
            for (index, bound) in bounds {
                study = study.demand(condition, *index, *bound);
            }
        }
        let Some(searched) = search_feasible(&study, start, self.archive)? else {
            return Ok(None);
        };
        let Searched { study, solved, .. } = &searched;
        if matches!(solved.status, Status::BudgetSpent | Status::Interrupted) {
            return Ok(None);
        }
        let x = solved.point.x[..study.parameters().len()].to_vec();
        let case = study.design(&x);
        let values = self
            .indices
            .iter()
            .map(|i| worst_value(&case, self.conditions, *i));
        // A design without one of the indices is no point.
        let Ok(values) = values.collect::<Result<Vec<f64>, Failure>>() else {
            return Ok(None);
        };
        Ok(Some(FrontPoint {
            profile: self.profile,
            values,
            explained: Explained::new(&searched, format!("best {}", objective.words())),
            case,
            x,
            bounds: bounds.to_vec(),
            objective,
        }))
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

    fn badness_of(&self, point: &FrontPoint, index: Index) -> f64 {
        let at = self.indices.iter().position(|i| *i == index).unwrap_or(0);
        badness(index, point.values[at])
    }

    fn announce(&self, what: &str) {
        self.archive.stage(&format!("{}, {what}", self.name));
    }
}

/// A front in two indices within bounds on others.
struct Between<'a> {
    objective: Index,
    kept: Index,
    bounds: &'a [(Index, f64)],
}
