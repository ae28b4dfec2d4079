//! Vehicles at the edges of the models: each has a status of its own, and no number where there is
//! none.

use crate::support::{MPH, assert_ratio, numerics};
use bogie::{
    case::Case,
    closed_form::natural_frequencies::carbody_roll,
    dynamics::{LateralModel, curving::CurvingError},
    evaluate::{
        Evaluation,
        curving::CurvingState,
        ride::NoRide,
        stability::{Outcome, Stability},
        warnings::warnings,
    },
    export::{evaluation_json::evaluation as json, modes::Modes, psd::Spectra},
    index::Index,
    numerics::{Poles, eigenvalues},
    optimize::problem::Failure,
};
use serde_json::Value;

/// What `bogie evaluate --format json` says of a case.
fn result(case: &Case) -> (Evaluation, Value) {
    let evaluation = Evaluation::new(case).unwrap();
    let list = warnings(case, &evaluation);
    let value = json("edge", case, &evaluation, &list);
    (evaluation, value)
}

fn warned(value: &Value, of: &str) -> bool {
    let list = value["warnings"].as_array().unwrap().iter();
    list.filter_map(Value::as_str).any(|text| text.contains(of))
}

/// Springs so soft that the weight, above them, overturns the carbody.
#[test]
fn a_carbody_that_rolls_over() {
    let mut case = Case::prototype();
    case.vehicle.suspension.secondary.vertical_stiffness /= 100.0;
    case.vehicle.suspension.secondary.lateral_stiffness /= 100.0;
    assert!(carbody_roll(&case.vehicle).is_none());
    let (evaluation, value) = result(&case);
    assert!(evaluation.stability.divergence.is_some());
    assert_eq!(evaluation.lateral, Err(NoRide::Diverges));
    assert_eq!(value["lateral_status"], "diverges");
    assert_eq!(value["stability"]["status"], "diverges");
    assert!(value["critical_speed_m_per_s"].is_null());
    assert!(evaluation.lateral_passengers.is_none() && value["lateral"].is_null());
    assert_eq!(value["stable_at_speed"], false);
    assert!(warned(&value, "statically unstable"));
    // Nothing of that is in the vertical model, which has its own ride.
    assert!(evaluation.vertical.is_ok());
    // The closed form that has no frequency is left out, and so is its separation from others.
    let checks = value["checks"].as_array().unwrap().iter();
    let names: Vec<&str> = checks.filter_map(|c| c["name"].as_str()).collect();
    assert!(names.iter().any(|n| n.ends_with("frequency, yaw")));
    assert!(!names.iter().any(|n| n.ends_with("frequency, roll")));
}

/// Whoever asks is told the same of a carbody that overturns: no index of its lateral motion has a number.
#[test]
fn divergence_is_called_so_everywhere() {
    let spec = numerics("divergence-evaluate-vs-sweep");
    let (evaluation, value) = result(&spec.case);
    assert_eq!(evaluation.stability.outcome().code(), "diverges");
    assert_ratio(
        "start of the range",
        evaluation.stability.divergence.unwrap(),
        2.235,
        1e-3,
    );
    assert_eq!(evaluation.stability.critical_speed(), None);
    for (key, code) in [("stability", "status"), ("lateral_status", "")] {
        let status = if code.is_empty() {
            &value[key]
        } else {
            &value[key][code]
        };
        assert_eq!(status, "diverges", "{key}");
    }
    let modes = Modes::new(&spec.case, &[10.0, 60.0]).unwrap();
    let modes = modes.json("edge", &spec.case);
    assert_eq!(modes["status"], "diverges");
    for at_speed in modes["against_speed"].as_array().unwrap() {
        assert_eq!(at_speed["status"], "diverges");
    }
    let lateral = [
        Index::CriticalSpeed,
        Index::KinematicDampingRatio,
        Index::LeastDampingRatio,
        Index::LeastDampingRatioToSpeed,
        Index::LateralAcceleration,
    ];
    for index in lateral {
        let reached = bogie::design::margin::value(&spec.case, index);
        assert_eq!(reached, Err(Failure::Diverges), "{index:?}");
    }
    let sweep = bogie::design::sweep::Sweep::new(&spec, &lateral, 1).unwrap();
    for design in sweep.designs(1..3) {
        for value in design.values {
            let reason = value.unwrap_err();
            assert!(reason.to_string().starts_with("diverges"), "{reason}");
        }
    }
    assert_eq!(serde_json::to_value(Failure::Diverges).unwrap(), "diverges");
}

/// A contact angle that falls as the wheelset moves out pushes it further out: it leaves the centre
/// without oscillation, at any speed.
#[test]
fn a_wheelset_that_diverges() {
    let mut case = Case::prototype();
    case.wheel_rail.contact_angle_difference = Some(-1000.0);
    // Nor does it steer back.
    case.wheel_rail.conicity = 1e-6;
    let (evaluation, value) = result(&case);
    let start = evaluation.stability.range[0];
    assert_eq!(evaluation.stability.divergence, Some(start));
    assert_eq!(value["stability"]["divergence_m_per_s"], start);
    assert_eq!(evaluation.stability.outcome(), Outcome::Diverges);
    assert_eq!(evaluation.lateral, Err(NoRide::Diverges));
    // The trucks themselves diverge: they have no kinematic mode.
    assert!(evaluation.modes.kinematic.is_none() && value["kinematic_mode"].is_null());
    assert!(warned(&value, "statically unstable"));
    assert!(!evaluation.modes.stable());
    let model = LateralModel::new(&case);
    let values = eigenvalues(model.forced.system.state_matrix(start)).unwrap();
    assert!(values.iter().any(|s| s.im == 0.0 && s.re > 0.0));
}

/// Dampers ten times critical: the carbody's modes turn into real ones, and the ride is still a ride.
#[test]
fn overdamped_modes() {
    let mut case = Case::prototype();
    let secondary = &mut case.vehicle.suspension.secondary;
    secondary.lateral_damping *= 100.0;
    secondary.vertical_damping *= 100.0;
    let before = Evaluation::new(&Case::prototype()).unwrap();
    let (evaluation, value) = result(&case);
    assert!(evaluation.modes.real.len() > before.modes.real.len());
    assert!(evaluation.vertical_modes.len() < before.vertical_modes.len());
    assert!(warned(&value, "damping ratio of the secondary lateral"));
    let stroke = |e: &Evaluation| e.vertical.as_ref().unwrap().average_stroke();
    // The dampers hold carbody and trucks together.
    assert!(stroke(&evaluation) < 0.2 * stroke(&before));
    assert!(evaluation.lateral.is_ok());
}

/// Cones on springs of almost nothing, without the weight that centres worn wheels, hunt as soon as they
/// roll.
#[test]
fn unstable_at_every_speed() {
    let mut case = Case::prototype();
    case.wheel_rail.conicity = 0.25;
    for none in [
        &mut case.wheel_rail.lateral_spin_creep,
        &mut case.wheel_rail.spin_creep,
        &mut case.wheel_rail.roll_coefficient,
        &mut case.wheel_rail.contact_angle,
        &mut case.wheel_rail.contact_angle_difference,
    ] {
        *none = Some(0.0);
    }
    let suspension = &mut case.vehicle.suspension;
    suspension.primary.longitudinal_stiffness = 1.0;
    suspension.primary.lateral_stiffness = 1.0;
    let (evaluation, value) = result(&case);
    assert!(evaluation.stability.unstable_at_start);
    let [start, end] = evaluation.stability.range;
    assert_eq!(evaluation.stability.critical_speed(), Some(start));
    assert_eq!(value["critical_speed_m_per_s"], start);
    assert_eq!(value["stability"]["status"], "unstable");
    assert_eq!(
        value["stability"]["status_text"],
        "unstable at the lowest speed searched"
    );
    assert_eq!(value["lateral_status"], "unstable");
    assert_eq!(evaluation.lateral, Err(NoRide::Unstable));
    assert!(warned(&value, "is not above the operating speed"));
    // It is so: something grows at any speed looked at.
    let model = LateralModel::new(&case);
    for speed in [start, 10.0, 40.0, 100.0, end] {
        let values = eigenvalues(model.forced.system.state_matrix(speed)).unwrap();
        assert!(values.iter().any(|s| s.re > 0.0), "{speed} m/s");
    }
}

/// Cylindrical wheels have nothing to hunt with.
#[test]
fn stable_at_every_speed() {
    let mut case = Case::prototype();
    case.wheel_rail.conicity = 1e-6;
    let (evaluation, value) = result(&case);
    assert!(evaluation.stability.onsets.is_empty() && !evaluation.stability.unstable_at_start);
    assert_eq!(evaluation.stability.critical_speed(), None);
    assert!(value["critical_speed_m_per_s"].is_null());
    assert_eq!(value["stability"]["status"], "stable-over-range");
    assert_eq!(
        value["stability"]["status_text"],
        "stable over the whole range searched"
    );
    assert_eq!(value["lateral_status"], "solved");
    assert!(warned(&value, "hardly centres itself"));
    let model = LateralModel::new(&case);
    for speed in [
        evaluation.stability.range[0],
        50.0,
        evaluation.stability.range[1],
    ] {
        assert!(
            Poles::at(&model.forced, speed).unwrap().stable(),
            "{speed} m/s"
        );
    }
    assert!(evaluation.lateral.is_ok());
}

/// What may be zero in a spec is: no yaw element and no dampers at all.
#[test]
fn nothing_but_springs() {
    let mut case = Case::prototype();
    let suspension = &mut case.vehicle.suspension;
    suspension.primary.longitudinal_damping = Some(0.0);
    suspension.primary.lateral_damping = Some(0.0);
    suspension.primary.vertical_damping = Some(0.0);
    let secondary = &mut suspension.secondary;
    secondary.lateral_damping = 0.0;
    secondary.vertical_damping = 0.0;
    secondary.yaw_stiffness = 0.0;
    secondary.yaw_breakaway_torque = 0.0;
    for mode in [
        &mut case.vehicle.carbody.bending,
        &mut case.vehicle.carbody.torsion_1,
        &mut case.vehicle.carbody.torsion_2,
    ] {
        mode.damping_ratio = 0.0;
    }
    let (evaluation, value) = result(&case);
    // Undamped vertical motion grows without limit at its resonances: there is no stationary ride, and
    // rounding does not make one.
    assert_eq!(evaluation.vertical, Err(NoRide::Unstable));
    assert!(value["vertical"].is_null());
    let spectra = Spectra::new(&case, 20).unwrap();
    assert!(spectra.vertical.is_err());
    assert_eq!(value["vertical_status"], "unstable");
    assert_eq!(value["vertical_status_text"], NoRide::Unstable.to_string());
    assert!(warned(&value, "hardly damped"));
    assert!(evaluation.curving.is_ok());
}

/// Without lateral and yaw springs nothing ties the carbody to its trucks in a curve.
#[test]
fn a_carbody_that_nothing_holds() {
    let mut case = Case::prototype();
    let secondary = &mut case.vehicle.suspension.secondary;
    secondary.lateral_stiffness = 0.0;
    secondary.yaw_stiffness = 0.0;
    let (evaluation, value) = result(&case);
    assert_eq!(
        evaluation.curving.as_ref().err(),
        Some(&CurvingError::Singular)
    );
    assert_eq!(
        value["curving_status"],
        "the steady-state curving equations are singular"
    );
    assert!(value["flange_limited_curve_deg"].is_null() && value["slip_limit"].is_null());
    assert_eq!(
        CurvingState::new(&case, 1.0, 0.0).err(),
        Some(CurvingError::Singular)
    );
    // It drifts: a stationary response needs everything to come back.
    assert_eq!(evaluation.lateral, Err(NoRide::Unstable));
    let checks = value["checks"].as_array().unwrap();
    assert!(
        checks
            .iter()
            .all(|c| !c["name"].as_str().unwrap().contains("L/V"))
    );
}

/// A carbody on next to no springs: the two trucks run alone, and every mode of one has a twin of the
/// other. The searches must not lose one of them, nor take two for one.
#[test]
fn modes_in_pairs() {
    let mut case = Case::prototype();
    let secondary = &mut case.vehicle.suspension.secondary;
    for constant in [
        &mut secondary.lateral_stiffness,
        &mut secondary.lateral_damping,
        &mut secondary.yaw_stiffness,
    ] {
        *constant *= 1e-6;
    }
    // Nothing to roll over about.
    case.vehicle.carbody.height_above_secondary = 0.0;
    let model = LateralModel::new(&case);
    let speed = 100.0 * MPH;
    let mut values: Vec<_> = Poles::at(&model.forced, speed)
        .unwrap()
        .oscillatory()
        .filter(|s| s.norm() > 5.0)
        .collect();
    values.sort_by(|a, b| a.im.total_cmp(&b.im));
    let twins = values
        .windows(2)
        .filter(|w| (w[0] - w[1]).norm() < 1e-4 * w[0].norm());
    assert!(twins.count() >= 4, "{values:?}");

    let stability = Stability::of(&case).unwrap();
    let plain = Stability::by_spectra(&model, case.model.speed_range).unwrap();
    match (stability.critical_speed(), plain.critical_speed()) {
        (Some(a), Some(b)) => assert_ratio("critical speed", a, b, 1e-6),
        (a, b) => assert_eq!(a, b),
    }
    let critical = stability.critical_speed().unwrap();
    let growing = |speed: f64| {
        let values = eigenvalues(model.forced.system.state_matrix(speed)).unwrap();
        values.iter().filter(|s| s.im > 0.0 && s.re > 0.0).count()
    };
    assert_eq!(growing(critical * (1.0 - 1e-4)), 0);
    assert_eq!(growing(critical * (1.0 + 1e-4)), 2, "both trucks hunt");
    let (evaluation, _) = result(&case);
    assert!(evaluation.vertical.is_ok());
}

/// All masses, springs and dampers a million times smaller or larger: the same motions.
#[test]
fn from_grams_to_gigagrams() {
    let of = |scale: f64| {
        let mut case = Case::prototype();
        let contact = case.wheel_rail.contact();
        let w = &mut case.wheel_rail;
        w.lateral_creep = Some(contact.f11);
        w.lateral_spin_creep = Some(contact.f12);
        w.spin_creep = Some(contact.f22);
        w.longitudinal_creep = Some(contact.f33);
        for key in bogie::spec::keys::case() {
            if let (1, Some(value)) = (key.quantity.dimension().mass, key.get(&case)) {
                key.set(&mut case, scale * value);
            }
        }
        result(&case).0
    };
    let full = of(1.0);
    for scale in [1e-6, 1e6] {
        let scaled = of(scale);
        let same = |what: &str, a: f64, b: f64| assert_ratio(what, a, b, 1e-8);
        let critical = |e: &Evaluation| e.stability.critical_speed().unwrap();
        same("critical speed", critical(&scaled), critical(&full));
        let degree = |e: &Evaluation| e.curving.as_ref().unwrap().degree();
        same("degree curve", degree(&scaled), degree(&full));
        let lateral = |e: &Evaluation| e.lateral.as_ref().unwrap().average_acceleration();
        same("lateral acceleration", lateral(&scaled), lateral(&full));
        let vertical = |e: &Evaluation| e.vertical.as_ref().unwrap().average_stroke();
        same("vertical stroke", vertical(&scaled), vertical(&full));
    }
}
