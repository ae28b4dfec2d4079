//! Pareto fronts between two or three indices by the ε-constraint method (Haimes, Lasdon, Wismer
//! 1971): one index is optimised while the others keep a bound, and the bounds sweep the front.
//!
//! The front is first *traced* from its ends, each point from its neighbours' designs and from the
//! basins seen so far; then, in turn, *filled* where neighbouring points are far apart and
//! *verified*: every remaining point is searched for globally, and a better point replaces it and is
//! tried at the others.
//!
//! Requirements and limits on the indices traded off are left out: the front shows them, and ends
//! where `[pareto.bounds]` says.

mod fill;
mod front;
mod trace;
mod tracer;
mod verify;

use std::collections::BTreeMap;

pub use front::FrontPoint;

use super::{study::Study, tasks::Tasks};
use crate::{
    index::Index,
    optimize::{
        archive::{Archive, Stop},
        problem::Failure,
        solve::{NoDesign, Start},
    },
    parameter::Parameter,
    spec::Spec,
};
use fill::Filling;
use front::{bargains, clean, converged, thin};
use tracer::{Pool, Tracer};

/// A front.
#[derive(Debug, Clone)]
pub struct Front {
    /// Indices traded off, in the order asked for.
    pub indices: Vec<Index>,
    /// The parameters that vary, the conicity among them where it is chosen from profiles.
    pub parameters: Vec<Parameter>,
    /// Points, none of which another dominates, in the order of the first index.
    pub points: Vec<FrontPoint>,
    /// Points asked for.
    pub asked: usize,
    /// Reason for fewer points or wider gaps than asked for.
    pub sparse: Option<Sparse>,
    /// Points found but dominated by others.
    pub dominated: usize,
    /// Reason why there is no point: no design could be evaluated.
    pub failure: Option<Failure>,
    /// Reason for an early end of the run.
    pub stopped: Option<Stop>,
    /// Full-model evaluations.
    pub evaluations: usize,
    /// Number of them without values, by reason.
    pub failures: BTreeMap<Failure, usize>,
}

/// Shortcoming of a front: fewer points than asked for, or gaps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sparse {
    /// Places between neighbouring points at which a search came to no other point: the front jumps
    /// there, or has shrunk to a point.
    pub jumps: usize,
    /// Gaps that are wider than three times the mean.
    pub gaps: usize,
}

/// Passes of filling and verifying; two are normal.
const PASSES: usize = 5;

/// Traces the front of a spec. A run that is stopped before its first point, and one in which no
/// design could be evaluated, give a front without points.
pub fn pareto(spec: &Spec, archive: &Archive) -> Front {
    let before = archive.spent();
    let indices = &spec.front.indices;
    let asked = spec.front.points;
    let tracers = tracers(spec, archive);
    let (mut points, failure) = trace(&tracers, asked);
    trace::rival(&tracers, &mut points);
    let mut dominated = clean(&mut points, indices);
    let mut filling = Filling::default();
    for _ in 0..PASSES {
        if indices.len() > 2 {
            spare(&tracers, &mut points);
            dominated += clean(&mut points, indices);
            dominated += bargains(&mut points, indices);
        }
        fill::fill(&tracers, &mut points, asked, &mut filling);
        dominated += clean(&mut points, indices);
        thin(&mut points, indices, asked);
        let is_better = verify::verify(&tracers, &mut points);
        dominated += clean(&mut points, indices);
        converged(&mut points, indices);
        let is_done = !is_better && points.iter().all(|point| point.is_verified);
        if is_done && (filling.is_at_end() || points.len() >= asked) || archive.stopped().is_some()
        {
            break;
        }
    }
    points.sort_by(|a, b| a.values[0].total_cmp(&b.values[0]));
    let gaps = fill::wide_gaps(&points, indices);
    let spent = archive.spent().since(&before);
    let is_sparse = (points.len() < asked || gaps > 0) && !points.is_empty();
    Front {
        indices: indices.clone(),
        parameters: parameters(&tracers),
        asked,
        sparse: is_sparse.then_some(Sparse {
            jumps: filling.jumps(),
            gaps,
        }),
        failure: failure.filter(|_| points.is_empty()),
        points,
        dominated,
        stopped: archive.stopped(),
        evaluations: spent.evaluations,
        failures: spent.failures,
    }
}

/// A tracer for every wheel profile to choose from.
fn tracers<'a>(spec: &'a Spec, archive: &'a Archive<'a>) -> Vec<Tracer<'a>> {
    let tasks = Tasks::new(spec);
    let profiles = tasks.profiles(&spec.case);
    let name = |conicity: f64| match profiles.len() {
        1 => "front".into(),
        _ => format!("front of conicity {conicity}"),
    };
    let numbered = profiles.iter().enumerate();
    numbered
        .map(|(profile, conicity)| {
            let mut case = spec.case.clone();
            case.wheel_rail.conicity = *conicity;
            let study = bounded(tasks.bare(&case, &spec.front.indices), spec);
            Tracer {
                profile,
                pool: Pool::new(study.coordinates(&case)),
                study,
                conditions: &spec.conditions,
                indices: &spec.front.indices,
                everywhere: Start::everywhere(spec.design.seed).until(spec.design.unseen),
                archive,
                name: name(*conicity),
            }
        })
        .collect()
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

fn parameters(tracers: &[Tracer]) -> Vec<Parameter> {
    let own = tracers.first().map(|tracer| tracer.study.parameters());
    let mut parameters = own.unwrap_or_default().to_vec();
    if tracers.len() > 1 {
        parameters.push(Parameter::CONICITY);
    }
    parameters
}

/// The fronts of all profiles, one after the other; and why one has none.
fn trace(tracers: &[Tracer], asked: usize) -> (Vec<FrontPoint>, Option<Failure>) {
    /// Fewest points that show the shape of one profile's front.
    const SHAPE: usize = 6;
    // Gaps are filled where a profile turns out to be the best.
    let wanted = match tracers.len() {
        1 => asked,
        n => asked.div_ceil(n).max(SHAPE),
    };
    let mut points = Vec::new();
    let mut failure = None;
    for tracer in tracers {
        match tracer.front(tracer.indices, &[], wanted) {
            Ok(found) => points.extend(found),
            Err(NoDesign::Failed(reason)) => failure = Some(reason),
            Err(NoDesign::Stopped(_)) => {}
        }
        if tracer.archive.stopped().is_some() {
            break;
        }
    }
    (points, failure)
}

/// Improves the other indices of every point at no more than a negligible loss.
fn spare(tracers: &[Tracer], points: &mut [FrontPoint]) {
    for point in points.iter_mut().filter(|point| !point.is_spared) {
        tracers[point.profile].spare(point);
        point.is_spared = true;
    }
}
