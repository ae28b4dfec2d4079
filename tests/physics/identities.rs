//! Physical limits and identities of the models.

use crate::support::{assert_ratio, problem, random_vehicle, reference_cases};
use approx::assert_relative_eq;
use bogie::{
    case::{Case, Crosslevel, CurvingCreep, TruckRoll},
    closed_form::{
        curving::{SimpleTruck, pure_rolling_line},
        kinematic, natural_frequencies as natural,
    },
    dynamics::{
        LateralModel,
        curving::{Breakaway, CurvingError, Side},
    },
    evaluate::{
        Evaluation,
        curving::{CurvingLimits, CurvingState},
        modes::VerticalShape,
        stability::Stability,
    },
    numerics::eigenvalues,
    vehicle::AirSpring,
};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// A case with plain cones, no spin creep and no gravitational terms.
fn bare(mut case: Case) -> Case {
    let w = &mut case.wheel_rail;
    for none in [
        &mut w.lateral_spin_creep,
        &mut w.spin_creep,
        &mut w.roll_coefficient,
        &mut w.contact_angle,
        &mut w.contact_angle_difference,
    ] {
        *none = Some(0.0);
    }
    case
}

/// Without springs the full wheelset equations give the free wheelset's wavelength (3.5-1).
#[test]
fn klingel_wavelength() {
    for conicity in [0.025, 0.05, 0.2] {
        let mut case = bare(Case::prototype());
        case.wheel_rail.conicity = conicity;
        case.vehicle.suspension.primary.longitudinal_stiffness = 1e-3;
        case.vehicle.suspension.primary.lateral_stiffness = 1e-3;
        // Slow, so that inertia (of order (V/200 m/s)²) does not matter.
        let speed = 0.05;
        let model = LateralModel::new(&case);
        let expected = speed / kinematic::wheelset_wavelength(&case.vehicle, conicity);
        let nearest = eigenvalues(model.forced.system.state_matrix(speed))
            .unwrap()
            .into_iter()
            .filter(|s| s.im > 0.0)
            .map(|s| s.im / std::f64::consts::TAU)
            .min_by(|a, b| (a - expected).abs().total_cmp(&(b - expected).abs()))
            .unwrap();
        assert_relative_eq!(nearest, expected, max_relative = 1e-5);
    }
}

/// Without yaw torque, spin and gravitational terms the full curving model is the simplified one
/// of Appendix A, whatever the secondary lateral springs.
#[test]
fn simplified_curving_is_the_limit_of_the_full_model() {
    for (name, case, _) in reference_cases() {
        let mut case = bare(case);
        let f = 9.0e6;
        case.wheel_rail.creep_factor = 1.0;
        case.wheel_rail.lateral_creep = Some(f);
        case.wheel_rail.longitudinal_creep = Some(f);
        case.vehicle.suspension.secondary.yaw_breakaway_torque = 0.0;
        let contact = case.wheel_rail.contact();
        let simple = SimpleTruck::new(&case.vehicle, &contact);
        let limits = CurvingLimits::new(&case, 0.0).unwrap();
        let flange = simple.flange_limit(case.wheel_rail.flange_clearance, 0.0, 0.0);
        assert_relative_eq!(limits.flange.unwrap().degree, flange, max_relative = 1e-8);
        let slip = simple.slip_limit(case.wheel_rail.friction * case.vehicle.wheel_load());
        assert_relative_eq!(limits.slip.unwrap().degree, slip, max_relative = 1e-8);

        let state = CurvingState::new(&case, 2.0, 0.0).unwrap();
        let curvature = bogie::track::curvature_of_degree(2.0);
        let expected = simple.wheelsets(curvature, 0.0, 0.0);
        let line = pure_rolling_line(&case.vehicle, contact.conicity, curvature);
        for i in 0..4 {
            let y = state.wheelset_lateral[i] - line;
            assert!(
                (y - expected.lateral[i % 2]).abs() < 1e-9,
                "{name} wheelset {i}"
            );
            assert!(
                (state.wheelset_yaw[i] - expected.yaw[i % 2]).abs() < 1e-9,
                "{name} wheelset {i}"
            );
        }
    }
}

/// Loads mirrored left to right give the mirrored state, outer and inner exchanged: on (almost)
/// straight track with cant deficiency to either side.
#[test]
fn mirror_symmetry() {
    for (name, mut case, _) in reference_cases() {
        for creep in [CurvingCreep::Static, CurvingCreep::LoadDependent] {
            case.model.curving_creep = creep;
            let [left, right] =
                [0.03, -0.03].map(|phi| CurvingState::new(&case, 1e-12, phi).unwrap());
            for i in 0..4 {
                assert_relative_eq!(
                    left.wheelset_lateral[i],
                    -right.wheelset_lateral[i],
                    max_relative = 1e-6
                );
                for (outer, inner) in [(0, 1), (1, 0)] {
                    let (a, b) = (left.wheels[i][outer], right.wheels[i][inner]);
                    assert_relative_eq!(a.lateral, -b.lateral, max_relative = 1e-6);
                    assert_relative_eq!(a.vertical, b.vertical, max_relative = 1e-12);
                }
            }
            assert_eq!(
                left.truck_side(0, Side::Outer) > 0.0,
                right.truck_side(0, Side::Inner) < 0.0,
                "{name}"
            );
        }
    }
}

/// In every curve the rails' lateral forces balance the weights times cant deficiency, and the
/// vertical loads the weight: of any vehicle, with either creep law, yaw elements stuck or slipping.
/// To 1e-8 of the weight: the creep forces that cancel in the sum are up to 1e4 times the weight, and
/// each is rounded to 1e-16 times the condition of the equations, up to 1e3.
#[test]
fn curving_forces_balance() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let random = std::iter::repeat_with(|| random_vehicle(&mut rng, 2.0)).take(300);
    let known = reference_cases().into_iter().map(|(_, case, _)| case);
    let (mut slipping, mut stuck) = (0, 0);
    for (n, mut case) in known.chain(random).enumerate() {
        for creep in [CurvingCreep::Static, CurvingCreep::LoadDependent] {
            case.model.curving_creep = creep;
            for (degree, phi) in [(0.5, 0.0), (2.0, 0.02), (6.0, 0.05), (6.0, -0.02)] {
                let state = match CurvingState::new(&case, degree, phi) {
                    Ok(state) => state,
                    Err(CurvingError::WheelLifted(_) | CurvingError::NoConsistentState) => continue,
                    Err(error) => panic!("vehicle {n}: {error}"),
                };
                for breakaway in state.breakaway {
                    match breakaway {
                        Breakaway::Stuck => stuck += 1,
                        _ => slipping += 1,
                    }
                }
                let weight = case.vehicle.mass() * bogie::vehicle::GRAVITY;
                let lateral: f64 = state.wheels.iter().flatten().map(|w| w.lateral).sum();
                let vertical: f64 = state.wheels.iter().flatten().map(|w| w.vertical).sum();
                let balance = lateral + weight * phi;
                assert!(
                    balance.abs() < 1e-8 * weight,
                    "vehicle {n}, {creep:?}, {degree}°, {phi}: {balance} N of {weight} N"
                );
                assert_relative_eq!(vertical, weight, max_relative = 1e-12);
            }
        }
    }
    assert!(slipping > 500 && stuck > 100, "{slipping} {stuck}");
}

/// All forces scaled alike (masses, springs, dampers, creep) leave every motion unchanged.
#[test]
fn scaling_all_forces_changes_no_motion() {
    for (name, case, _) in reference_cases() {
        let mut scaled = case.clone();
        for key in bogie::spec::keys::case() {
            let force = [
                "mass",
                "inertia",
                "stiffness",
                "damping",
                "torque",
                "_creep",
            ];
            let own = key.path.rsplit('.').next().unwrap();
            let is_force = force.iter().any(|kind| own.contains(kind))
                && !own.contains("ratio")
                && !own.contains("factor");
            if let (true, Some(value)) = (is_force, key.get(&case)) {
                key.set(&mut scaled, 3.0 * value);
            }
        }
        let [a, b] = [&case, &scaled].map(|case| Evaluation::new(case).unwrap());
        let speed = |e: &Evaluation| e.stability.critical_speed().unwrap();
        assert_ratio(&name, speed(&b), speed(&a), 1e-9);
        let degree = |e: &Evaluation| e.curving.as_ref().unwrap().degree();
        assert_ratio(&name, degree(&b), degree(&a), 1e-9);
        if let (Ok(a), Ok(b)) = (&a.lateral, &b.lateral) {
            assert_ratio(
                &name,
                b.average_acceleration(),
                a.average_acceleration(),
                1e-7,
            );
        }
        let [a, b] = [a, b].map(|e| e.vertical.unwrap());
        assert_ratio(&name, b.average_stroke(), a.average_stroke(), 1e-7);
        assert_ratio(&name, b.wheel_load[0], 3.0 * a.wheel_load[0], 1e-7);
    }
}

/// 3.5.3: frequencies without the other body are "usually" within 10 %.
#[test]
fn simple_frequencies_are_within_ten_per_cent() {
    for name in ["prototype", "intercity-130mph", "urban-80mph"] {
        let case = problem(name).case;
        let modes = Evaluation::new(&case).unwrap().vertical_modes;
        let full = |shape| modes.iter().find(|m| m.shape == shape).unwrap().frequency;
        let v = &case.vehicle;
        for (what, simple, full) in [
            (
                "heave",
                natural::carbody_vertical(v),
                full(VerticalShape::CarbodyHeave),
            ),
            (
                "pitch",
                natural::carbody_pitch(v),
                full(VerticalShape::CarbodyPitch),
            ),
            (
                "bounce",
                natural::truck_vertical(v),
                full(VerticalShape::TruckHeave),
            ),
            (
                "truck roll",
                natural::truck_roll(v),
                full(VerticalShape::TruckRoll),
            ),
        ] {
            assert_ratio(&format!("{name} {what}"), simple.frequency, full, 0.10);
        }
    }
}

/// The report's vehicles do not notice whether truck roll is free: 0.2 %.
#[test]
fn truck_roll_hardly_matters_to_the_prototype() {
    let case = Case::prototype();
    let mut free = case.clone();
    free.model.truck_roll = TruckRoll::Dynamic;
    let [a, b] = [&case, &free].map(|case| Evaluation::new(case).unwrap());
    let speed = |e: &Evaluation| e.stability.critical_speed().unwrap();
    assert_ratio("critical speed", speed(&b), speed(&a), 2e-3);
    let stroke = |e: &Evaluation| e.lateral.as_ref().unwrap().average_stroke();
    assert_ratio("stroke", stroke(&b), stroke(&a), 2e-3);
}

/// The complete form of crosslevel raises lateral strokes by 6–13 % on the report's vehicles and
/// leaves stability alone.
#[test]
fn complete_crosslevel_raises_strokes() {
    for name in ["prototype", "intercity-130mph", "urban-80mph"] {
        let case = problem(name).case;
        let mut complete = case.clone();
        complete.model.crosslevel = Crosslevel::Contact;
        let [a, b] = [&case, &complete].map(|case| Evaluation::new(case).unwrap().lateral.unwrap());
        let ratio = b.average_stroke() / a.average_stroke();
        assert!((1.05..1.14).contains(&ratio), "{name}: {ratio}");
    }
}

/// Unequal wheel loads change the creep coefficients, so with cant deficiency the curves; without
/// it there is nothing to change.
#[test]
fn load_dependent_creep_acts_with_cant_deficiency_only() {
    let case = Case::prototype();
    let mut dependent = case.clone();
    dependent.model.curving_creep = CurvingCreep::LoadDependent;
    let degree = |case: &Case, phi| CurvingLimits::new(case, phi).unwrap().degree();
    assert_relative_eq!(
        degree(&case, 0.0),
        degree(&dependent, 0.0),
        max_relative = 1e-12
    );
    let change = degree(&dependent, 0.05) / degree(&case, 0.05) - 1.0;
    assert!(change.abs() > 1e-3 && change.abs() < 0.2, "{change}");
}

/// A yaw element that can never slip, or that has no stiffness, needs no torque to decide.
#[test]
fn breakaway_at_its_limits() {
    let case = Case::prototype();
    let with = |k: f64, torque: f64| {
        let mut case = case.clone();
        case.vehicle.suspension.secondary.yaw_stiffness *= k;
        case.vehicle.suspension.secondary.yaw_breakaway_torque = torque;
        CurvingLimits::new(&case, 0.0).unwrap().degree()
    };
    let free = with(1.0, 0.0);
    assert_relative_eq!(with(0.0, 1e4), free, max_relative = 1e-9);
    // The more torque before it slips, the worse the curving (A.2).
    let torques = [0.0, 3e3, 1e4, 3e4, 1e9].map(|torque| with(1.0, torque));
    assert!(torques.is_sorted_by(|a, b| a >= b), "{torques:?}");
}

/// An air spring whose series spring is far stiffer than everything is the direct spring with the
/// orifice as its damper; one without orifice flow is both springs in parallel.
#[test]
fn air_spring_limits() {
    let conventional = problem("intercity-130mph").case;
    let secondary = conventional.vehicle.suspension.secondary;
    let (k, c) = (secondary.vertical_stiffness, secondary.vertical_damping);
    let with = |air_spring: AirSpring| {
        let mut case = conventional.clone();
        case.vehicle.suspension.secondary.air_spring = Some(air_spring);
        Evaluation::new(&case).unwrap()
    };
    let plain = Evaluation::new(&conventional).unwrap();
    let damper = with(AirSpring {
        direct_stiffness: k,
        series_stiffness: 1e5 * k,
        orifice_damping: c,
        reservoir_stiffness: 0.0,
    });
    let [a, b] = [&damper, &plain].map(|e| e.vertical.as_ref().unwrap());
    assert_ratio(
        "damper",
        a.average_acceleration(),
        b.average_acceleration(),
        1e-4,
    );
    assert_ratio("damper", a.average_stroke(), b.average_stroke(), 1e-4);

    // Hardly damped, so the carbody's frequencies are those of its springs.
    let blocked = with(AirSpring {
        direct_stiffness: 0.25 * k,
        series_stiffness: 0.75 * k,
        orifice_damping: 1e5 * c,
        reservoir_stiffness: 0.0,
    });
    let heave = |e: &Evaluation| {
        let shape = VerticalShape::CarbodyHeave;
        e.vertical_modes
            .iter()
            .find(|m| m.shape == shape)
            .unwrap()
            .frequency
    };
    let mut undamped = conventional.clone();
    undamped.vehicle.suspension.secondary.vertical_damping = 0.0;
    assert_ratio(
        "blocked",
        heave(&blocked),
        heave(&Evaluation::new(&undamped).unwrap()),
        1e-4,
    );
}

/// Just below the critical speed nothing grows, just above something
/// does.
#[test]
fn critical_speed_is_a_change_of_stability() {
    for (name, case, _) in reference_cases() {
        let model = LateralModel::new(&case);
        let found = Stability::by_spectra(&model, case.model.speed_range).unwrap();
        let growing = |speed: f64| {
            let values = eigenvalues(model.forced.system.state_matrix(speed)).unwrap();
            values.iter().filter(|s| s.im > 0.0 && s.re > 0.0).count()
        };
        let critical = found.critical_speed().unwrap();
        assert_eq!(growing(critical * (1.0 - 1e-5)), 0, "{name}");
        assert!(growing(critical * (1.0 + 1e-5)) > 0, "{name}");
    }
}
