//! Doubts about a result that a designer should see beside it.

use super::{Evaluation, limits, ride::NoRide};
use crate::{
    case::{Case, TruckRoll},
    closed_form::natural_frequencies::{secondary_damping_ratio, truck_roll},
    units::us::MILE,
};

/// Damping ratios of the carbody on its secondary suspension outside which something is amiss: the
/// report looks at 0.1 to 0.6 (4.3, 4.4).
const DAMPING_RATIO: [f64; 2] = [0.05, 1.0];

/// Static deflection beyond what coil springs of a passenger truck have, m. The prototype's springs
/// settle by 0.32 m (0.89 Hz); at 0.7 Hz, the lowest that the report looks at, it is 0.51 m.
const COIL_DEFLECTION: f64 = 0.35;

/// Advice on a case and its evaluation.
pub fn warnings(case: &Case, evaluation: &Evaluation) -> Vec<String> {
    let mut list = Vec::new();
    let speed = case.service.speed;
    let mph = |v: f64| v * 3600.0 / MILE;
    if let Some(critical) = evaluation.stability.critical_speed()
        && critical <= speed
    {
        list.push(format!(
            "the critical speed, {:.1} mph, is not above the operating speed, {:.1} mph",
            mph(critical),
            mph(speed)
        ));
    }
    if evaluation.stability.divergence.is_some() {
        list.push("a non-oscillatory motion grows: the vehicle is statically unstable".into());
    }
    if case.model.truck_roll == TruckRoll::Prescribed
        && let Some(onset) = evaluation.stability.onsets.first()
    {
        let roll = truck_roll(&case.vehicle).frequency;
        let ratio = roll / onset.frequency;
        if (1.0 / limits::SEPARATION..limits::SEPARATION).contains(&ratio) {
            list.push(format!(
                "truck roll ({roll:.1} Hz, 3.5-11) is within a factor of two of hunting \
                 ({:.1} Hz): check with truck_roll = \"dynamic\" in [model]",
                onset.frequency
            ));
        }
    }
    if let Ok(ride) = &evaluation.lateral {
        let clearance = case.wheel_rail.flange_clearance;
        let largest = ride.excursion.iter().copied().fold(0.0, f64::max);
        if 3.0 * largest > clearance {
            list.push(format!(
                "flange contact lies at {:.1} standard deviations of wheelset excursion: the \
                 linear wheel–rail model is exceeded at times",
                clearance / largest
            ));
        }
    }
    let rides = [
        ("lateral", evaluation.lateral.as_ref().err()),
        ("vertical", evaluation.vertical.as_ref().err()),
    ];
    for (direction, reason) in rides {
        if let Some(NoRide::NotConverged) = reason {
            list.push(format!(
                "the {direction} random response did not reach its accuracy"
            ));
        }
    }
    if let Ok(ride) = &evaluation.vertical {
        let largest = ride.wheel_load.iter().copied().fold(0.0, f64::max);
        if 3.0 * largest > case.vehicle.wheel_load() {
            list.push(format!(
                "three standard deviations of wheel load variation are {:.0} % of the static wheel \
                 load: with massless wheels on rigid rails a stiff primary suspension overstates it",
                300.0 * largest / case.vehicle.wheel_load()
            ));
        }
    }
    suspension(case, &mut list);
    if case.wheel_rail.conicity < 0.02 {
        list.push("at so low a conicity the vehicle hardly centres itself".into());
    }
    list
}

/// Secondary suspensions that no truck has in this form.
fn suspension(case: &Case, list: &mut Vec<String>) {
    let mass = case.vehicle.carbody.mass;
    let s = &case.vehicle.suspension.secondary;
    let has_coils = s.air_spring.is_none();
    let mut damping = |name: &str, k: f64, c: f64| {
        let ratio = secondary_damping_ratio(mass, k, c);
        if ratio > DAMPING_RATIO[1] {
            list.push(format!(
                "the damping ratio of the secondary {name} suspension is {ratio:.2}: above 1 the \
                 dampers hold carbody and trucks together rather than apart"
            ));
        } else if ratio < DAMPING_RATIO[0] {
            list.push(format!(
                "the damping ratio of the secondary {name} suspension is {ratio:.3}: its resonance \
                 is hardly damped"
            ));
        }
    };
    damping("lateral", s.lateral_stiffness, s.lateral_damping);
    if has_coils {
        damping("vertical", s.vertical_stiffness, s.vertical_damping);
        let deflection = case.vehicle.secondary_static_deflection();
        if deflection > COIL_DEFLECTION {
            list.push(format!(
                "the secondary springs settle by {deflection:.2} m under the carbody: more than \
                 coil springs can, so think of air springs, or limit secondary_static_deflection"
            ));
        }
    }
}
