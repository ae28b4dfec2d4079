//! The vehicle in the curve of its service: forces that balance, and a status instead of a number
//! wherever the linear model has none.

use crate::support::{assert_ratio, random_vehicle};
use assert_cmd::Command;
use bogie::{
    case::{Case, CurvingCreep},
    design::measure::{Wanted, measure, measure_each},
    dynamics::curving::{CurvingError, lifting_cant_deficiency},
    evaluate::{
        Evaluation,
        checks::{NotAssessed, Verdict, checks},
        curving::{AT_LIMIT, CurveStatus, CurvingLimits, CurvingState, Limit, ServiceCurve},
        limits::PEAK,
        stroke_in_curve::NoStroke,
    },
    index::Index,
    optimize::problem::Failure,
    spec::Spec,
    vehicle::GRAVITY,
};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::Value;

const FORCES: [Index; 4] = [
    Index::WheelLOverV,
    Index::TruckSideLOverV,
    Index::NetAxleLOverV,
    Index::AdhesionUsed,
];

fn file(name: &str) -> String {
    format!("{}/tests/data/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

fn spec(name: &str) -> Spec {
    let source = std::fs::read_to_string(file(name)).unwrap();
    Spec::parse(&source).unwrap_or_else(|m| panic!("{}", m.render(name, &source, false)))
}

/// Random vehicles in random curves at random cant deficiencies, with either creep law.
fn vehicles(seed: u64, count: usize) -> impl Iterator<Item = Case> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    std::iter::repeat_with(move || {
        let mut case = random_vehicle(&mut rng, 2.0);
        case.service.curve = Some(rng.random_range(0.05_f64..4.0).to_radians());
        case.service.cant_deficiency = Some(rng.random_range(-0.2..0.2));
        if rng.random_bool(0.5) {
            case.model.curving_creep = CurvingCreep::LoadDependent;
        }
        case
    })
    .take(count)
}

fn json(arguments: &[&str]) -> Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_bogie"));
    let output = command.args(arguments).args(["--format", "json"]).output();
    let output = output.unwrap();
    assert_eq!(output.status.code(), Some(0), "{arguments:?}");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// As a user reads it: the forces of 3 in cant deficiency at a conicity of 0.25, where the contact
/// angle is large.
#[test]
fn forces_of_the_curve_command_balance() {
    let name = file("net-axle-equilibrium");
    let value = json(&["curve", &name, "--cant-deficiency", "3 in"]);
    let wheels = value["wheels_outer_inner"].as_array().unwrap();
    let wheels = wheels.iter().flat_map(|pair| pair.as_array().unwrap());
    let lateral: f64 = wheels.map(|w| w["lateral_force_n"].as_f64().unwrap()).sum();
    let mass = spec("net-axle-equilibrium").case.vehicle.mass();
    let angle = value["cant_deficiency_rad"].as_f64().unwrap();
    // Rounding of forces of 1e4 N.
    assert_ratio("lateral force", -lateral, angle * GRAVITY * mass, 1e-9);
    assert!((angle * GRAVITY * mass - 29_441.0).abs() < 0.5);
}

/// Load of the inner wheels: −14.8 kN. No command has a force of it.
#[test]
fn a_lifted_wheel_has_no_forces() {
    let case = spec("lifted-wheel").case;
    let (c, t, w) = (
        case.vehicle.carbody,
        case.vehicle.truck,
        case.vehicle.wheelset,
    );
    let frame = w.rolling_radius + t.height_above_primary;
    let carbody = frame + t.depth_below_secondary + c.height_above_secondary;
    let moment = c.mass * carbody / 4.0 + t.mass * frame / 2.0 + w.mass * w.rolling_radius;
    let transfer = 11_f64.to_radians() * GRAVITY * moment / (2.0 * w.half_contact_distance);
    // Its last printed digit.
    assert!((case.vehicle.wheel_load() - transfer + 14.8e3).abs() < 50.0);

    let name = file("lifted-wheel");
    let curve = json(&["curve", &name]);
    assert_eq!(curve["status"], "wheel-lifted");
    for key in [
        "wheels_outer_inner",
        "largest_wheel_l_over_v",
        "largest_truck_side_l_over_v",
        "largest_net_axle_l_over_v",
        "secondary_lateral_stroke_m",
        "wheelset_lateral_m",
    ] {
        assert!(curve[key].is_null(), "{key}");
    }
    assert_eq!(curve["limits"]["status"], "wheel-lifted");
    assert!(curve["limits"]["slip"].is_null());
    // The boundary up to 6° is short of where the wheels lift.
    let boundary = curve["performance_boundary"].as_array().unwrap();
    assert!(boundary.iter().all(|limits| limits["status"] == "solved"));

    let evaluated = json(&["evaluate", &name]);
    assert_eq!(evaluated["service_curve"]["status"], "wheel-lifted");
    assert!(evaluated["secondary_lateral_stroke_in_curve_m"].is_null());
    let checks = evaluated["checks"].as_array().unwrap();
    let in_curve: Vec<&Value> = checks
        .iter()
        .filter(|check| check["name"].as_str().unwrap().contains("service curve"))
        .collect();
    assert_eq!(in_curve.len(), 7);
    for check in in_curve {
        assert_eq!(check["status"], "not-assessed");
        assert_eq!(check["value_status"], "wheel-lifted");
        assert!(check["value_si"].is_null() && check["satisfied"].is_null());
    }
    for index in FORCES.into_iter().chain([Index::CurveLimitRatio]) {
        let failed = Err(Failure::WheelLifted);
        assert_eq!(measure(&case, &[Wanted::Index(index)]), failed.clone());
        assert_eq!(
            measure_each(&case, &[Wanted::Index(index)])[0],
            failed.map(|mut all: Vec<_>| all.remove(0))
        );
    }
}

/// In a curve of 300 m the leading wheelset would be at 27.7 mm, behind a clearance of 7 mm. The wheel
/// that slips first as the curve tightens is named.
#[test]
fn a_curve_far_beyond_flange_contact_has_no_forces() {
    let case = spec("coach-r300").case;
    let curve = ServiceCurve::of(&case).unwrap();
    let state = curve.state.as_ref().unwrap();
    // The last digits of 27.7 mm.
    assert!((state.limit_ratios[0] - 27.7 / 7.0).abs() < 0.01);
    let limits = CurvingLimits::new(&case, 0.0).unwrap();
    let first = limits.governing().unwrap();
    let CurveStatus::OutsideModel { limit, ratio } = curve.status else {
        panic!("{:?}", curve.status);
    };
    assert_eq!(limit, first.limit);
    let place = Limit::ALL.iter().position(|l| *l == limit).unwrap();
    assert_eq!(ratio.to_bits(), state.limit_ratios[place].to_bits());

    let evaluation = Evaluation::new(&case).unwrap();
    let open: Vec<String> = checks(&case, &evaluation)
        .into_iter()
        .filter(|check| check.verdict() == Verdict::NotAssessed)
        .map(|check| check.name)
        .collect();
    assert_eq!(open.len(), 7, "{open:?}");
    // No cant deficiency is given: the FRA's for the quasi-static strokes.
    assert!(open[0].ends_with("service curve, 5.82° at zero cant deficiency"));
    assert!(open[3].ends_with("service curve, 5.82° at 3 in cant deficiency"));

    // The search goes on along the extrapolation; a verdict is none.
    let wanted = FORCES.map(Wanted::Index);
    assert!(measure(&case, &wanted).is_ok());
    for measured in measure_each(&case, &wanted) {
        assert_eq!(measured, Err(Failure::OutsideModel));
    }
    let ratio = measure_each(&case, &[Wanted::Index(Index::CurveLimitRatio)]).remove(0);
    let pieces = ratio.unwrap();
    for (piece, ratio) in pieces.iter().zip(state.limit_ratios) {
        assert_eq!(piece.value.to_bits(), ratio.to_bits());
    }
    assert_eq!(pieces.len(), 12);
}

/// At the limited curve the largest ratio is 1, so that it is within the model; just beyond, the limit
/// met is the one named.
#[test]
fn the_model_ends_at_the_limited_curve() {
    let mut compared = 0;
    for case in vehicles(21, 300) {
        let angle = case.service.cant_deficiency();
        let Ok(limits) = CurvingLimits::new(&case, angle) else {
            continue;
        };
        let Some(first) = limits.governing().filter(|first| first.degree > 0.0) else {
            continue;
        };
        let at = |share: f64| CurvingState::new(&case, share * first.degree, angle).unwrap();
        let here = at(1.0);
        let largest = here.limit_ratios.iter().copied().fold(0.0, f64::max);
        // The roots of the quadratics lose at most seven of sixteen digits where they nearly coincide.
        assert!((largest - 1.0).abs() < 1e-9, "{largest}");
        assert_eq!(here.status, CurveStatus::WithinModel);
        assert_eq!(at(1.0 - 1e-4).status, CurveStatus::WithinModel);
        // Well beyond the tolerance within which a limit counts as kept.
        let beyond = at(1.0 + 1e-2);
        let largest = beyond.limit_ratios.iter().copied().fold(0.0, f64::max);
        // Where the limit is only grazed nothing is exceeded.
        if largest > AT_LIMIT {
            let exceeded = beyond.status.exceeded().unwrap();
            assert_eq!(exceeded.0, first.limit);
            assert!(exceeded.1 > 1.0);
            compared += 1;
        }
    }
    assert!(compared > 150, "{compared}");
}

/// The wheels of a side lift where the load transfer reaches their static load, and nowhere else.
#[test]
fn wheels_lift_where_their_load_is_gone() {
    let (mut lifted, mut loaded) = (0, 0);
    for case in vehicles(22, 300) {
        let limit = lifting_cant_deficiency(&case.vehicle);
        for share in [-1.5, -1.0, -0.99, 0.5, 0.99, 1.0, 1.5] {
            match CurvingState::new(&case, 0.5, share * limit) {
                Err(CurvingError::WheelLifted(side)) => {
                    assert!(share.abs() >= 1.0 - 1e-12, "{share}");
                    assert_eq!(
                        side.to_string(),
                        if share > 0.0 { "inner" } else { "outer" }
                    );
                    lifted += 1;
                }
                Ok(state) => {
                    // Rounding decides at the limit itself.
                    assert!(share.abs() <= 1.0, "{share}");
                    let loads = state.wheels.iter().flatten().map(|w| w.vertical);
                    assert!(loads.fold(f64::INFINITY, f64::min) > 0.0);
                    loaded += 1;
                }
                Err(error) => assert_ne!(error, CurvingError::Singular),
            }
        }
    }
    assert!(lifted > 600 && loaded > 600, "{lifted} {loaded}");
}

/// Evaluation, measurement, checks and the curve command have the same status of the same curve.
#[test]
fn statuses_agree() {
    let mut seen = [0; 3];
    for (n, mut case) in vehicles(23, 200).enumerate() {
        if n % 5 == 0 {
            let angle = case.service.cant_deficiency().signum();
            let share = [0.5, 1.5][n / 5 % 2];
            case.service.cant_deficiency =
                Some(share * angle * lifting_cant_deficiency(&case.vehicle));
        }
        let Ok(evaluation) = Evaluation::new(&case) else {
            continue;
        };
        let Ok(curve) = &evaluation.service_curve else {
            continue;
        };
        let status = curve.status;
        assert_eq!(ServiceCurve::of(&case).unwrap().status, status);
        let shown = bogie::export::curve::Curving::new(&case, None, None).unwrap();
        assert_eq!(shown.status(), status);
        assert_eq!(shown.degree, Some(curve.degree));
        let failure = match status {
            CurveStatus::WithinModel => None,
            CurveStatus::OutsideModel { .. } => Some(Failure::OutsideModel),
            CurveStatus::WheelLifted(_) => Some(Failure::WheelLifted),
        };
        seen[match status {
            CurveStatus::WithinModel => 0,
            CurveStatus::OutsideModel { .. } => 1,
            CurveStatus::WheelLifted(_) => 2,
        }] += 1;
        for measured in measure_each(&case, &FORCES.map(Wanted::Index)) {
            assert_eq!(measured.err(), failure);
        }
        for check in checks(&case, &evaluation) {
            let of_ride = check.name.contains("3σ") && evaluation.lateral.is_err();
            if check.name.contains("curve,") && !of_ride {
                assert_eq!(
                    check.value.err(),
                    failure.map(|_| NotAssessed::Curve(status))
                );
                assert_eq!(check.verdict() == Verdict::NotAssessed, failure.is_some());
            }
        }
        let stroke = evaluation.secondary_lateral_stroke_in_curve();
        match (stroke, failure, &evaluation.lateral) {
            (Err(NoStroke::NotCovered(why)), Some(_), _) => assert_eq!(why, status),
            (Err(NoStroke::NoRide(_)), None, Err(_)) => {}
            (Ok(strokes), None, Ok(ride)) => {
                let state = curve.covered().unwrap();
                let wanted = Wanted::Index(Index::SecondaryLateralStrokeInCurve);
                let pieces = measure_each(&case, &[wanted]).remove(0).unwrap();
                for j in 0..2 {
                    let expected =
                        state.secondary_lateral_stroke[j].abs() + PEAK * ride.secondary_stroke[j];
                    // The same sums.
                    assert_ratio("stroke", strokes[j], expected, 1e-12);
                    assert_ratio("piece", pieces[j].value, expected, 1e-12);
                }
            }
            other => panic!("{other:?}"),
        }
    }
    assert!(seen.iter().all(|count| *count > 5), "{seen:?}");
}

/// A vehicle without yaw torque leans on its secondary springs by its weight times cant deficiency:
/// M_c g φ_d over the four springs, on straight track; the carbody's roll adds to it.
#[test]
fn the_quasi_static_stroke_is_the_lean() {
    let mut case = Case::prototype();
    case.vehicle.suspension.secondary.yaw_breakaway_torque = 0.0;
    case.service.curve = Some(1e-9);
    case.service.cant_deficiency = Some(0.02);
    let springs = 4.0 * case.vehicle.suspension.secondary.lateral_stiffness;
    let lean = case.vehicle.carbody.mass * GRAVITY * 0.02 / springs;
    let curve = ServiceCurve::of(&case).unwrap();
    for stroke in curve.covered().unwrap().secondary_lateral_stroke {
        // The curvature of 1e-9° offsets the springs by less than 1e-9 m.
        assert_ratio("lean", stroke, lean, 1e-6);
    }
}

/// In a condition without a curve the stroke in a curve is absent, and nothing is asked of it there.
#[test]
fn without_a_curve_there_is_no_stroke_in_it() {
    let mut case = Case::prototype();
    let index = Wanted::Index(Index::SecondaryLateralStrokeInCurve);
    assert_eq!(measure(&case, &[index]), Ok(vec![Vec::new()]));
    // Not even where it has no ride.
    case.service.speed = 200.0;
    assert_eq!(measure(&case, &[index]), Ok(vec![Vec::new()]));
    let evaluation = Evaluation::new(&case).unwrap();
    let stroke = evaluation.secondary_lateral_stroke_in_curve();
    assert_eq!(stroke, Err(NoStroke::NotAsked));

    let text = "[vehicle]\nbase = \"prototype\"\n[limits]\n\
                secondary_lateral_stroke_in_curve = \"60 mm\"\n";
    assert!(Spec::parse(text).is_err());
    let in_condition = format!("{text}[conditions.curved]\nservice.curve = \"0.3 deg\"\n");
    assert!(Spec::parse(&in_condition).is_ok());
    for asked in [
        "[objective]\nminimize = \"secondary_lateral_stroke_in_curve\"",
        "[pareto]\nindices = [\"critical_speed\", \"secondary_lateral_stroke_in_curve\"]",
    ] {
        let spec = format!("[vehicle]\nbase = \"prototype\"\n{asked}\n");
        assert!(Spec::parse(&spec).is_err(), "{asked}");
        let with = format!("{spec}[service]\ncurve = \"0.3 deg\"\n");
        assert!(Spec::parse(&with).is_ok(), "{asked}");
    }
}

/// `bogie curve` shows the service curve, unless asked for another.
#[test]
fn the_curve_command_shows_the_service_curve() {
    let name = file("net-axle-equilibrium");
    let value = json(&["curve", &name]);
    assert_eq!(value["curve_shown"], "service curve");
    assert_eq!(value["degree_curve_deg"].as_f64(), Some(0.5));
    let angle = value["cant_deficiency_rad"].as_f64().unwrap().to_degrees();
    assert!((angle - 3.0695).abs() < 1e-9);
    let other = json(&[
        "curve",
        &name,
        "--degree",
        "0.7",
        "--cant-deficiency",
        "0 deg",
    ]);
    assert_eq!(other["curve_shown"], "curve asked for");
    assert_eq!(other["degree_curve_deg"].as_f64(), Some(0.7));
    assert_eq!(other["cant_deficiency_rad"].as_f64(), Some(0.0));
    let part = json(&["curve", &name, "--cant-deficiency", "1 in"]);
    assert_eq!(part["degree_curve_deg"].as_f64(), Some(0.5));

    let name = format!("{}/problems/prototype.toml", env!("CARGO_MANIFEST_DIR"));
    let tightest = json(&["curve", &name]);
    assert_eq!(
        tightest["curve_shown"],
        "tightest curve at zero cant deficiency"
    );
    assert_eq!(
        tightest["degree_curve_deg"],
        tightest["limits"]["flange"]["degree_curve_deg"]
    );
    assert_eq!(tightest["status"], "within-model");
    let here = json(&["curve", &name, "--cant-deficiency", "2 in"]);
    assert_eq!(
        here["curve_shown"],
        "tightest curve at this cant deficiency"
    );
    assert_eq!(here["status"], "within-model");
    let lifted = json(&["curve", &name, "--cant-deficiency", "29 deg"]);
    assert_eq!(lifted["status"], "wheel-lifted");
    assert!(lifted["degree_curve_deg"].is_null());
}
