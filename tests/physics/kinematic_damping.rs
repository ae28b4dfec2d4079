//! The damping ratio of the kinematic mode: continuous in every parameter, with exact derivatives.

use crate::support::{assert_ratio, numerics, problem, random_vehicle, ten};
use bogie::{
    case::Case,
    design::measure::{Wanted, measure, measure_graded},
    dynamics::LateralModel,
    evaluate::{
        Evaluation,
        modes::{KinematicMode, LateralModes},
    },
    index::Index,
    numerics::Poles,
    optimize::problem::Failure,
    parameter::Parameter,
};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// `None` if the vehicle diverges.
fn index(case: &Case) -> Option<f64> {
    match measure(case, &[Wanted::Index(Index::KinematicDampingRatio)]) {
        Ok(pieces) => pieces[0].iter().map(|piece| piece.value).reduce(f64::min),
        Err(failure) => {
            assert_eq!(failure, Failure::Diverges);
            None
        }
    }
}

/// What is swept.
#[derive(Debug, Clone, Copy)]
enum Over {
    Conicity,
    Speed,
    Decade(Parameter),
}

const SWEEPS: [Over; 4] = [
    Over::Conicity,
    Over::Speed,
    Over::Decade(Parameter::SECONDARY_LATERAL_STIFFNESS),
    Over::Decade(Parameter::SECONDARY_LATERAL_DAMPING),
];

/// The case a share `t` of the way along a sweep.
fn along(case: &Case, over: Over, t: f64) -> Case {
    let mut case = case.clone();
    match over {
        Over::Conicity => case.wheel_rail.conicity = 0.04 + 0.02 * t,
        Over::Speed => case.service.speed = 5.0 + 55.0 * t,
        Over::Decade(parameter) => {
            let own = parameter.get(&case);
            parameter.set(&mut case, own * 10_f64.powf(t - 0.5));
        }
    }
    case
}

/// Values of the index at 400 points: conicities of 0.04 to 0.06, speeds of 5 to 60 m/s, or a decade
/// about a parameter's own value. `None` if the vehicle diverges anywhere.
fn sweep(case: &Case, over: Over) -> Option<Vec<f64>> {
    const POINTS: u32 = 400;
    (0..POINTS)
        .map(|k| index(&along(case, over, f64::from(k) / f64::from(POINTS - 1))))
        .collect()
}

/// Largest step over the mean one.
fn roughness(values: &[f64]) -> f64 {
    let steps: Vec<f64> = values.windows(2).map(|w| (w[1] - w[0]).abs()).collect();
    let mean = steps.iter().sum::<f64>() / steps.len() as f64;
    // Of values that hardly move rounding is the steps.
    steps.iter().copied().fold(0.0, f64::max) / mean.max(1e-9)
}

/// Five times the mean step: of a smooth curve over 400 points the steepest part may be that much steeper
/// than the mean, a jump is some hundred.
#[test]
fn sweeps_have_no_jumps() {
    let vehicles = [
        ("jump", numerics("kinematic-label-jump").case),
        ("prototype", Case::prototype()),
        ("intercity", problem("intercity-130mph").case),
        ("urban", problem("urban-80mph").case),
    ];
    for (name, case) in vehicles {
        for over in SWEEPS {
            let steep = roughness(&sweep(&case, over).unwrap());
            assert!(steep < 5.0, "{name} over {over:?}: {steep}");
        }
    }
}

/// Of random vehicles the index may bend where one motion of the truck takes over from another, and be
/// flat elsewhere, so that no steepness is too much; but a step between two points falls with their distance.
#[test]
fn steps_of_random_vehicles_fall_with_the_distance() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let mut swept = 0;
    for n in 0..60 {
        let case = random_vehicle(&mut rng, if n % 2 == 0 { 1.5 } else { 3.0 });
        for over in SWEEPS {
            let Some(values) = sweep(&case, over) else {
                continue;
            };
            swept += 1;
            let steps = values.windows(2).enumerate();
            let (at, _) = steps
                .max_by(|(_, a), (_, b)| (a[1] - a[0]).abs().total_cmp(&(b[1] - b[0]).abs()))
                .unwrap();
            // Between the two points with the largest step, a thousand times finer.
            let part = |t: f64| index(&along(&case, over, (at as f64 + t) / 399.0)).unwrap();
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..10 {
                let middle = f64::midpoint(low, high);
                let [a, m, b] = [low, middle, high].map(part);
                if (m - a).abs() > (b - m).abs() {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            let whole = (part(1.0) - part(0.0)).abs();
            let finest = (part(high) - part(low)).abs();
            // A kink keeps at most all of its slope, a root of the distance a thirtieth; a jump is kept.
            assert!(
                finest <= 0.1 * whole + 1e-9,
                "vehicle {n} over {over:?}: {whole} over a step, {finest} over a thousandth"
            );
        }
    }
    assert!(swept > 150, "{swept}");
}

/// Exact derivatives against differences: 1e-6 of the largest, as a step of 5e-4 leaves its fourth power
/// and eigenvalues are good to 1e-12.
#[test]
fn derivatives_are_exact() {
    const STEP: f64 = 5e-4;
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let mut compared = 0;
    for n in 0..60 {
        let case = random_vehicle(&mut rng, if n % 2 == 0 { 1.5 } else { 3.0 });
        let near_row = |row: f64| (case.wheel_rail.conicity / row - 1.0).abs() < 3.0 * STEP;
        if bogie::wheel_rail::PROFILES.into_iter().any(near_row) {
            continue;
        }
        let wanted = [Wanted::Index(Index::KinematicDampingRatio)];
        let Ok(pieces) = measure_graded(&case, &wanted, &ten()) else {
            continue;
        };
        let least = pieces[0]
            .iter()
            .min_by(|a, b| a.value.total_cmp(&b.value))
            .unwrap();
        // Where another motion is about to take over the least of both has a kink.
        let second = pieces[0].iter().filter(|p| p.value > least.value);
        let second = second.map(|p| p.value).fold(1.0, f64::min);
        if second - least.value < 0.02 {
            continue;
        }
        let gradient = least.gradient.as_ref().unwrap();
        let numeric: Vec<f64> = ten()
            .into_iter()
            .map(|parameter| {
                let own = parameter.get(&case);
                let at = |k: f64| {
                    let mut case = case.clone();
                    parameter.set(&mut case, own * (1.0 + k * STEP));
                    index(&case).unwrap()
                };
                let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(at);
                (a - 8.0 * b + 8.0 * c - d) / (12.0 * STEP)
            })
            .collect();
        let scale = numeric.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
        for ((parameter, exact), numeric) in ten().into_iter().zip(gradient).zip(&numeric) {
            let exact = exact * parameter.get(&case);
            assert!(
                (exact - numeric).abs() <= 1e-6 * scale + 1e-9,
                "vehicle {n} by {}: {exact} against {numeric}",
                parameter.name()
            );
        }
        compared += 1;
    }
    assert!(compared >= 30, "{compared}");
}

/// Where the trucks' hunting is clear, it is that of the whole vehicle but for what the carbody gives way:
/// its frequency is a third of theirs or less, and (1/3)² of the secondary spring's part of the damping
/// remains.
#[test]
fn hunting_of_the_whole_vehicle() {
    for (name, published) in [("intercity-130mph", 0.144), ("urban-80mph", 0.163)] {
        let case = problem(name).case;
        let evaluation = Evaluation::new(&case).unwrap();
        let mode = evaluation.modes.kinematic.as_ref().unwrap();
        let whole = evaluation.modes.least_damped().unwrap();
        assert_ratio(name, mode.damping_ratio, whole.damping_ratio, 0.01);
        assert_ratio(name, mode.frequency, whole.frequency, 0.01);
        // 16 % in example 2, like that of the whole vehicle.
        assert_ratio(name, mode.damping_ratio, published, 0.17);
        assert_ratio(name, index(&case).unwrap(), mode.damping_ratio, 1e-15);
    }
}

/// Results that are read are the index: in an evaluation, and of the modes over speed.
#[test]
fn what_is_shown_is_the_index() {
    let case = numerics("kinematic-label-jump").case;
    let evaluation = Evaluation::new(&case).unwrap();
    let value = bogie::export::evaluation_json::evaluation("jump", &case, &evaluation, &[]);
    assert_eq!(
        value["kinematic_mode"]["damping_ratio"],
        index(&case).unwrap()
    );
    let modes = bogie::export::modes::Modes::new(&case, &[case.service.speed]).unwrap();
    let modes = modes.json("jump", &case);
    for shown in [&modes, &modes["against_speed"][0]] {
        assert_eq!(shown["kinematic_mode"], value["kinematic_mode"]);
    }
}

/// A truck with a relaxation slower than its hunting: what grows is shown, and never as damped.
#[test]
fn hunting_is_not_hidden_by_slower_motions() {
    let mut case = Case::prototype();
    case.service.speed = 65.0;
    case.wheel_rail.conicity = 0.2;
    let (p, s) = (
        &mut case.vehicle.suspension.primary,
        &mut case.vehicle.suspension.secondary,
    );
    (p.longitudinal_stiffness, p.lateral_stiffness) = (30e6, 1e6);
    (s.lateral_stiffness, s.lateral_damping) = (500e3, 200e3);
    s.yaw_stiffness = 1e6;
    // -0.0773 at 6.976 Hz by the eigenvalues of the truck alone, from an independent program.
    assert!((index(&case).unwrap() + 0.0773).abs() < 1e-4);
    // The sign is that of the least damped motion of the truck, whatever the vehicle.
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut hunting = 0;
    for _ in 0..200 {
        let mut case = random_vehicle(&mut rng, 3.0);
        case.service.speed *= 2.0;
        let model = LateralModel::new(&case);
        let Ok(Some(mode)) = KinematicMode::new(&model, &case, case.service.speed) else {
            continue;
        };
        let grows = mode.motions.iter().any(|m| m.eigenvalue.re > 0.0);
        assert_eq!(mode.damping_ratio < 0.0, grows);
        hunting += usize::from(grows);
    }
    assert!(hunting > 20, "{hunting}");
}

/// Cylinders do not hunt, they creep back: a damping ratio of one, and no slope.
#[test]
fn overdamped_hunting() {
    let mut case = Case::prototype();
    case.service.speed = 2.0;
    case.wheel_rail.conicity = 1e-6;
    // Springs that bring yaw back faster than lateral motion: at like rates both go on as an oscillation.
    case.vehicle.suspension.secondary.yaw_stiffness *= 4.0;
    let model = LateralModel::new(&case);
    let mode = KinematicMode::new(&model, &case, case.service.speed)
        .unwrap()
        .unwrap();
    assert!(!mode.motions[0].oscillates(), "{:?}", mode.motions);
    let pieces = measure_graded(
        &case,
        &[Wanted::Index(Index::KinematicDampingRatio)],
        &ten(),
    )
    .unwrap();
    assert_eq!(pieces[0].len(), 1);
    assert_ratio("index", pieces[0][0].value, 1.0, 1e-15);
    assert_eq!(pieces[0][0].gradient, Some(vec![0.0; ten().len()]));
}

/// The truck under a carbody at rest is a vehicle whose carbody weighs without limit and whose rails hold
/// its weight as before.
#[test]
fn a_carbody_at_rest_is_a_heavy_one() {
    let mut case = Case::prototype();
    let model = LateralModel::new(&case);
    let speed = case.service.speed;
    let mode = KinematicMode::new(&model, &case, speed).unwrap().unwrap();
    case.vehicle.carbody.roll_inertia *= 1e8;
    case.vehicle.carbody.yaw_inertia *= 1e8;
    let mut heavy = LateralModel::new(&case);
    let carbody = heavy.forced.system.order() - 3;
    heavy.forced.system.mass[carbody] *= 1e8;
    let poles = Poles::at(&heavy.forced, speed).unwrap();
    let modes = LateralModes::new(&heavy, &case, &poles).unwrap();
    let same = modes.oscillatory.iter().filter(|m| {
        (m.frequency / mode.frequency - 1.0).abs() < 1e-6
            && (m.damping_ratio - mode.damping_ratio).abs() < 1e-6
    });
    assert_eq!(same.count(), 2, "both trucks");
}
