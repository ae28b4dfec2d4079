//! The test of a front's points against fresh designs.

use super::{front::FrontPoint, tracer::Tracer};

/// Gain of the objective, in badness, above which another design takes a point's place.
const BETTER: f64 = 2e-5;

/// Searches everywhere for every point not yet verified; where a better design turns up it takes the
/// point's place, and its basin is tried at all others. Whether any did.
pub(super) fn verify(tracers: &[Tracer], points: &mut [FrontPoint]) -> bool {
    let mut any = false;
    for i in 0..points.len() {
        let Some(is_better) = verified(tracers, points, i) else {
            return any;
        };
        if is_better {
            any = true;
            try_at_others(tracers, points, i);
        }
    }
    any
}

/// Verifies one point. Whether a better design took its place; `None` if the run ended.
fn verified(tracers: &[Tracer], points: &mut [FrontPoint], i: usize) -> Option<bool> {
    let point = &points[i];
    let tracer = &tracers[point.profile];
    if point.is_verified {
        return Some(false);
    }
    tracer.announce(&format!("verifying point {} of {}", i + 1, points.len()));
    let found = tracer.verify(&point.aim, vec![point.x.clone()]);
    if tracer.archive.stopped().is_some() {
        return None;
    }
    let Ok(Some(found)) = found else {
        // No other design keeps the bounds; the point itself does within the tolerance of the searches.
        points[i].is_verified = true;
        return Some(false);
    };
    let objective = point.aim.objective;
    let gain = tracer.badness_of(point, objective) - tracer.badness_of(&found, objective);
    points[i] = FrontPoint {
        is_spared: point.is_spared && gain <= BETTER,
        ..found
    };
    Some(gain > BETTER)
}

/// Tries the design of a point as a start for all other points of its profile.
fn try_at_others(tracers: &[Tracer], points: &mut [FrontPoint], better: usize) {
    let (x, profile) = (points[better].x.clone(), points[better].profile);
    let tracer = &tracers[profile];
    for (k, point) in points.iter_mut().enumerate() {
        if k == better || point.profile != profile || tracer.archive.stopped().is_some() {
            continue;
        }
        tracer.announce("a better basin");
        let Some(found) = tracer.follow(&point.aim, vec![x.clone()]) else {
            continue;
        };
        let objective = point.aim.objective;
        if tracer.badness_of(point, objective) - tracer.badness_of(&found, objective) > BETTER {
            *point = found;
        }
    }
}
