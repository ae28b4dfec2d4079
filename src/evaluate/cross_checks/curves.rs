//! Simplified curving (4.5.2, Appendix A).

use super::CrossCheck;
use crate::{
    case::Case,
    closed_form::curving::{SimpleTruck, pure_rolling_line, rigid_truck_excursion},
    evaluate::Evaluation,
    track::curvature_of_degree,
    units::Quantity,
};

pub(super) fn curves(list: &mut Vec<CrossCheck>, case: &Case, evaluation: &Evaluation) {
    let (vehicle, contact) = (&case.vehicle, case.wheel_rail.contact());
    let truck = SimpleTruck::new(vehicle, &contact);
    let limits = evaluation.curving.as_ref().ok();
    let adhesion = case.wheel_rail.friction * vehicle.wheel_load();
    let clearance = case.wheel_rail.flange_clearance;
    for (name, equation, degree, full) in [
        (
            "flange-limited curve",
            "A-11, 4.5-5",
            truck.flange_limit(clearance, 0.0, 0.0),
            limits.and_then(|l| l.flange),
        ),
        (
            "slip-limited curve",
            "A-14, 4.5-6",
            truck.slip_limit(adhesion),
            limits.and_then(|l| l.slip),
        ),
    ] {
        // No limit in any curve: radii below half of the 100-ft chord have no degree.
        if !degree.is_finite() {
            continue;
        }
        list.push(CrossCheck {
            name: name.into(),
            equation,
            quantity: Quantity::DegreeOfCurve,
            closed_form: degree.to_radians(),
            full_model: full.map(|l| l.degree.to_radians()),
        });
    }
    if let Some(flange) = limits.and_then(|l| l.flange) {
        let curvature = curvature_of_degree(flange.degree);
        let excursion = |name: &str, equation, closed_form| CrossCheck {
            name: name.into(),
            equation,
            quantity: Quantity::Stroke,
            closed_form,
            full_model: Some(clearance),
        };
        let free = pure_rolling_line(vehicle, contact.conicity, curvature);
        let rigid = rigid_truck_excursion(vehicle, contact.conicity, curvature);
        let simple = truck.wheelsets(curvature, 0.0, 0.0);
        let force = truck.flanging_force(curvature, clearance, 0.0);
        list.extend([
            excursion(
                "pure rolling line in that flange-limited curve",
                "4.5-1",
                free,
            ),
            excursion("excursion of a rigid truck there", "4.5-4", rigid),
            excursion(
                "leading wheelset of the simple truck there",
                "A-6",
                simple.lateral[0] + free,
            ),
            CrossCheck {
                name: "flanging force of the simple truck there".into(),
                equation: "A-19, 4.5-9",
                quantity: Quantity::Force,
                closed_form: force,
                full_model: None,
            },
        ]);
    }
}
