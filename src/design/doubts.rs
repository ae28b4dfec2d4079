//! Doubts about a design in the light of its demands.

use crate::{
    case::Case,
    evaluate::{Evaluation, stroke_in_curve::taken, warnings},
    index::{Demand, Demands, Index},
};

/// Advice on an evaluated case, and on indices without a demand.
pub fn warnings(case: &Case, evaluation: &Evaluation, demands: &Demands) -> Vec<String> {
    let mut list = warnings::warnings(case, evaluation);
    list.extend(stops_in_curve(evaluation, demands));
    list
}

/// Secondary stops within which the random stroke is kept, and which the vehicle leans beyond in the
/// curve of its service.
fn stops_in_curve(evaluation: &Evaluation, demands: &Demands) -> Option<String> {
    if demands.get(Index::SecondaryLateralStrokeInCurve).is_some() {
        return None;
    }
    let stops = Demand {
        index: Index::SecondaryLateralStroke,
        bound: demands.get(Index::SecondaryLateralStroke)?,
    };
    let curve = evaluation.service_curve.as_ref().ok()?;
    // Outside the model the lean is an extrapolation, but a large one tells enough.
    let state = curve.state.as_ref().filter(|_| curve.is_given)?;
    let ride = evaluation.lateral.as_ref().ok()?;
    let strokes =
        (0..2).map(|j| taken(state.secondary_lateral_stroke[j], ride.secondary_stroke[j]));
    let taken = strokes.fold(0.0, f64::max);
    (!stops.met_by(taken)).then(|| {
        format!(
            "in the curve of the service the secondary lateral springs take about {:.1} mm with 3σ, \
             beyond the {:.1} mm allowed for random motion alone: limit \
             secondary_lateral_stroke_in_curve",
            1e3 * taken,
            1e3 * stops.bound
        )
    })
}
