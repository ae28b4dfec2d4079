//! Demands that ask for too little, or for what nothing within the bounds can give.

use super::contradictions::design_space_end;
use super::situation::{Situation, shown};
use crate::index::Index;
use crate::parameter::Parameter;
use crate::spec::DesignSpace;
use crate::spec::diagnostic::Diagnostic;
use crate::units::Quantity;
use crate::vehicle::GRAVITY;

/// Doubts about requirements and limits in one condition.
pub fn odd_demands(situation: &Situation, design: &DesignSpace, doubts: &mut Vec<Diagnostic>) {
    let suffix = situation.suffix();
    let case = &situation.case;
    if let Some(bound) = situation.demands.get(Index::CriticalSpeed)
        && bound < case.service.speed
        && let Some(place) = situation.place(&[Index::CriticalSpeed.path(), "service.speed"])
    {
        let [bound, speed] = [bound, case.service.speed].map(|v| shown(v, Quantity::Speed));
        doubts.push(
            Diagnostic::at(
                place,
                format!(
                    "the critical speed asked for, {bound}, is below the operating speed{suffix}"
                ),
                format!("{speed} is run: the vehicle may hunt there"),
            )
            .help("a vehicle that hunts has no stationary lateral response either".to_owned()),
        );
    }
    let clearance = case.wheel_rail.flange_clearance;
    if let Some(bound) = situation.demands.get(Index::WheelsetExcursion)
        && bound > clearance
        && let Some(place) = situation.place(&[
            Index::WheelsetExcursion.path(),
            "wheel_rail.flange_clearance",
        ])
    {
        let clearance = shown(clearance, Quantity::Stroke);
        doubts.push(
            Diagnostic::at(
                place,
                format!("`wheelset_excursion` allows more than the flange does{suffix}"),
                format!("the flange meets the rail at {clearance}"),
            )
            .help("the models know no flange force: excursions beyond it are not those of the vehicle".to_owned()),
        );
    }
    static_deflection(situation, design, doubts);
    slack_springs(situation, design, doubts);
    lateral_stops(situation, design, doubts);
}

/// A spring that moves up by more than it is compressed gets slack before the stop is met.
fn slack_springs(situation: &Situation, design: &DesignSpace, doubts: &mut Vec<Diagnostic>) {
    let index = Index::SecondaryVerticalStroke;
    let stiffest = design_space_end(situation, design, |bounds| bounds.upper);
    let deflection = stiffest.vehicle.secondary_static_deflection();
    if situation
        .case
        .vehicle
        .suspension
        .secondary
        .air_spring
        .is_none()
        && let Some(stop) = situation.demands.get(index)
        && stop > deflection
        && let Some(place) = situation.place(&[index.path(), "vehicle.carbody.mass"])
    {
        let [stop, deflection] = [stop, deflection].map(|m| shown(m, Quantity::Stroke));
        doubts.push(
            Diagnostic::at(
                place,
                format!(
                    "`{}` allows {stop}, springs may settle by only {deflection}{}",
                    index.name(),
                    situation.suffix()
                ),
                "a spring that rises by more than it is compressed gets slack",
            )
            .help("the models take springs to pull as they push: allow less stroke".to_owned()),
        );
    }
}

/// In the service curve the carbody leans on its lateral springs by M_c g φ_d / 4 K_sy: beyond the
/// stops there is nothing left for random motion.
fn lateral_stops(situation: &Situation, design: &DesignSpace, doubts: &mut Vec<Diagnostic>) {
    let index = Index::SecondaryLateralStroke;
    let case = &situation.case;
    let secondary = &case.vehicle.suspension.secondary;
    let mut chosen = design.parameters.iter().map(|(p, _)| p.constant());
    let is_open = chosen.any(|constant| constant == Parameter::SECONDARY_LATERAL_STIFFNESS);
    let weight = case.vehicle.carbody.mass * GRAVITY;
    let lean = weight * case.service.cant_deficiency().abs() / (4.0 * secondary.lateral_stiffness);
    if !is_open
        && let Some(stop) = situation.demands.get(index)
        && lean > stop
        && let Some(place) = situation.place(&[
            index.path(),
            "service.cant_deficiency",
            "suspension.secondary.lateral_stiffness",
            "vehicle.carbody.mass",
        ])
    {
        let [stop, lean] = [stop, lean].map(|m| shown(m, Quantity::Stroke));
        doubts.push(
            Diagnostic::at(
                place,
                format!(
                    "in the service curve the carbody leans by {lean} on its lateral springs{}",
                    situation.suffix()
                ),
                format!("its stops are at {stop}: it rests on them"),
            )
            .help("stiffer springs, wider stops or less cant deficiency".to_owned()),
        );
    }
}

/// A carbody settles by M_c g / 4 K_sz on its secondary springs: stiffer ones than the bounds allow
/// cannot be chosen.
fn static_deflection(situation: &Situation, design: &DesignSpace, doubts: &mut Vec<Diagnostic>) {
    let index = Index::SecondaryStaticDeflection;
    let Some(bound) = situation.demands.get(index) else {
        return;
    };
    // A condition's own mass changes the frequency of the springs, not the springs.
    let stiffest = design_space_end(situation, design, |bounds| bounds.upper);
    let least = stiffest.vehicle.secondary_static_deflection();
    if situation.condition.is_none()
        && bound < least
        && let Some(place) = situation.place(&[index.path(), "vehicle.carbody.mass"])
    {
        doubts.push(
            Diagnostic::at(
                place,
                format!("`{}` is out of reach", index.name()),
                format!(
                    "the stiffest springs that may be chosen settle by {}",
                    shown(least, Quantity::Stroke)
                ),
            )
            .help("allow stiffer secondary springs in [design], or more deflection".to_owned()),
        );
    }
}
