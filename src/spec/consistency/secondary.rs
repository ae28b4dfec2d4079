//! Secondary suspensions that no truck has, where the spec gives them.

use super::situation::{Situation, shown};
use crate::closed_form::unusual::{Direction, secondary_oddities};
use crate::parameter::Parameter;
use crate::spec::DesignSpace;
use crate::spec::diagnostic::Diagnostic;
use crate::units::Quantity;

/// Share by which K_sz may differ from the static stiffness of the air spring beside it.
const STIFFNESS_DIFFERENCE: f64 = 0.1;

/// Doubts about springs and dampers that the design does not choose.
pub fn odd_secondary(situation: &Situation, design: &DesignSpace, doubts: &mut Vec<Diagnostic>) {
    for oddity in secondary_oddities(&situation.case.vehicle) {
        let (paths, constants) = match oddity.direction {
            Direction::Lateral => (
                [
                    "suspension.secondary.lateral_damping",
                    "suspension.secondary.lateral_stiffness",
                    "vehicle.carbody.mass",
                ],
                [
                    Parameter::SECONDARY_LATERAL_STIFFNESS,
                    Parameter::SECONDARY_LATERAL_DAMPING,
                ],
            ),
            Direction::Vertical => (
                [
                    "suspension.secondary.vertical_stiffness",
                    "suspension.secondary.vertical_damping",
                    "vehicle.carbody.mass",
                ],
                [
                    Parameter::SECONDARY_VERTICAL_STIFFNESS,
                    Parameter::SECONDARY_VERTICAL_DAMPING,
                ],
            ),
        };
        let mut chosen = design.parameters.iter().map(|(p, _)| p.constant());
        if chosen.any(|constant| constants.contains(&constant)) {
            continue;
        }
        if let Some(place) = situation.place(&paths) {
            let message = oddity.message + &situation.suffix();
            doubts.push(Diagnostic::at(place, message, oddity.advice));
        }
    }
}

/// With an air spring the vertical model takes the air spring, the roll of the lateral model K_sz and C_sz
/// (3.4.3, 3.4.4): K_sz has to be the air spring's static stiffness, or two vehicles are computed.
pub fn two_vertical_springs(situation: &Situation, doubts: &mut Vec<Diagnostic>) {
    let secondary = &situation.case.vehicle.suspension.secondary;
    let Some(air_spring) = secondary.air_spring else {
        return;
    };
    let (k_sz, air) = (secondary.vertical_stiffness, air_spring.static_stiffness());
    let paths = [
        "suspension.secondary.vertical_stiffness",
        "suspension.secondary.air_spring.direct_stiffness",
        "suspension.secondary.air_spring.series_stiffness",
        "suspension.secondary.air_spring.reservoir_stiffness",
    ];
    if (k_sz / air - 1.0).abs() > STIFFNESS_DIFFERENCE
        && let Some(place) = situation.place(&paths)
    {
        let carries = air > 0.0;
        let [k_sz, air] = [k_sz, air].map(|k| shown(k, Quantity::Stiffness));
        let remedy = if carries {
            format!(
                "write vertical_stiffness = \"{air}\" in [suspension.secondary], or mend the air spring"
            )
        } else {
            "give the air spring a direct or a reservoir stiffness: a load at rest is carried by them"
                .to_owned()
        };
        doubts.push(
            Diagnostic::at(
                place,
                format!(
                    "`vertical_stiffness` is {k_sz}, the air spring's static stiffness {air}{}",
                    situation.suffix()
                ),
                "the carbody rolls on the one and bounces on the other",
            )
            .help(remedy),
        );
    }
}
