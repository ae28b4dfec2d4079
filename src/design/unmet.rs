//! Requirements and limits that a design does not meet.

use super::ride::PEAK;
use crate::{
    evaluate::Evaluation,
    spec::{Limits, Requirements},
    units::Quantity,
};

/// A requirement or limit that the design does not meet.
#[derive(Debug, Clone, PartialEq)]
pub struct Unmet {
    /// Key in the spec.
    pub key: &'static str,
    /// Kind of quantity, for units.
    pub quantity: Quantity,
    /// What was asked for, SI.
    pub required: f64,
    /// What was reached, SI; `None`: an unstable vehicle has no such performance.
    pub reached: Option<f64>,
}

/// A requirement counts as met within this share of it: what the coupling loop leaves.
const MET: f64 = 1e-4;

/// The requirements and limits that an evaluated design does not meet.
pub fn unmet(evaluation: &Evaluation, requirements: &Requirements, limits: &Limits) -> Vec<Unmet> {
    let lateral = evaluation.lateral.as_ref();
    let vertical = evaluation.vertical.as_ref();
    let peak = |rms: &[f64]| PEAK * rms.iter().copied().fold(0.0, f64::max);
    let degree = evaluation
        .curving
        .as_ref()
        .ok()
        .map(|c| c.degree().to_radians());
    // Stable over the whole range searched: the end of the range is reached at least.
    let speed = evaluation
        .stability
        .critical_speed()
        .unwrap_or(evaluation.stability.range[1]);
    let at_least = [
        (
            "requirements.critical_speed",
            Quantity::Speed,
            requirements.critical_speed,
            Some(speed),
        ),
        (
            "requirements.degree_curve",
            Quantity::DegreeOfCurve,
            requirements.degree_curve.map(f64::to_radians),
            degree,
        ),
    ];
    let at_most = [
        (
            "requirements.lateral_acceleration",
            Quantity::Acceleration,
            requirements.lateral_acceleration,
            lateral.map(super::super::evaluate::ride::LateralRide::average_acceleration),
        ),
        (
            "requirements.vertical_acceleration",
            Quantity::Acceleration,
            requirements.vertical_acceleration,
            vertical.map(super::super::evaluate::ride::VerticalRide::average_acceleration),
        ),
        (
            "limits.secondary_lateral_stroke",
            Quantity::Stroke,
            limits.secondary_lateral_stroke,
            lateral.map(|r| peak(&r.secondary_stroke)),
        ),
        (
            "limits.primary_lateral_stroke",
            Quantity::Stroke,
            limits.primary_lateral_stroke,
            lateral.map(|r| peak(&r.primary_stroke)),
        ),
        (
            "limits.wheelset_excursion",
            Quantity::Stroke,
            limits.wheelset_excursion,
            lateral.map(|r| peak(&r.excursion)),
        ),
        (
            "limits.secondary_vertical_stroke",
            Quantity::Stroke,
            limits.secondary_vertical_stroke,
            vertical.map(|r| peak(&r.secondary_stroke)),
        ),
    ];
    let mut unmet = Vec::new();
    for (sign, (key, quantity, required, reached)) in at_least
        .into_iter()
        .map(|r| (1.0, r))
        .chain(at_most.into_iter().map(|r| (-1.0, r)))
    {
        let Some(required) = required else { continue };
        if reached.is_none_or(|reached| sign * (reached - required) < -MET * required) {
            unmet.push(Unmet {
                key,
                quantity,
                required,
                reached,
            });
        }
    }
    unmet
}
