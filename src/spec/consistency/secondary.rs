//! Secondary suspensions that no truck has, where the spec gives them.

use super::situation::Situation;
use crate::closed_form::unusual::{Direction, secondary_oddities};
use crate::parameter::Parameter;
use crate::spec::DesignSpace;
use crate::spec::diagnostic::Diagnostic;

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
                    Parameter::SecondaryLateralStiffness,
                    Parameter::SecondaryLateralDamping,
                ],
            ),
            Direction::Vertical => (
                [
                    "suspension.secondary.vertical_stiffness",
                    "suspension.secondary.vertical_damping",
                    "vehicle.carbody.mass",
                ],
                [
                    Parameter::SecondaryVerticalStiffness,
                    Parameter::SecondaryVerticalDamping,
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
