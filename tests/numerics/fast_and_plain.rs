//! The fast evaluators against the plain ones, over random vehicles.

use crate::support::{MPH, assert_ratio, problem, random_vehicle};
use bogie::{
    case::Case,
    design::tasks::Tasks,
    dynamics::{ForcedModel, LateralModel, VerticalModel},
    evaluate::{
        ride::response::{Response, plain},
        stability::{DampingRange, Stability},
    },
    index::Index,
    numerics::{Poles, eigenvalues, elimination::LANES},
    vehicle::{AirSpring, Suspension},
};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// Vehicles near the prototype, and ones far from it: stable everywhere, unstable everywhere,
/// overturning, lightly damped.
fn vehicles(seed: u64, count: usize) -> Vec<(String, Case)> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let factors = [1.2, 1.5, 3.0, 8.0];
    (0..count)
        .map(|i| {
            let case = random_vehicle(&mut rng, factors[i % factors.len()]);
            (format!("vehicle {i} of seed {seed}"), case)
        })
        .collect()
}

/// Poles at the speed of operation.
fn poles(model: &LateralModel, case: &Case) -> Poles {
    Poles::at(&model.forced, case.service.speed).unwrap()
}

/// Where the modes can be followed, the critical speed is that of full spectra. Where they cannot,
/// nothing is returned: rarely near the prototype, at times far from it.
#[test]
fn critical_speeds_are_those_of_full_spectra() {
    for (factor, count, followed) in [(1.2, 120, 0.97), (2.0, 120, 0.93), (8.0, 80, 0.75)] {
        let mut rng = ChaCha8Rng::seed_from_u64(21);
        let mut compared = 0;
        for i in 0..count {
            let case = random_vehicle(&mut rng, factor);
            let name = format!("vehicle {i} of factor {factor}");
            let (model, range) = (LateralModel::new(&case), case.model.speed_range);
            let poles = poles(&model, &case);
            let Some(fast) = Stability::by_following(&model, &poles, range, 1.0) else {
                continue;
            };
            compared += 1;
            let plain = Stability::by_spectra(&model, range).unwrap();
            assert_eq!(fast.unstable_at_start, plain.unstable_at_start, "{name}");
            assert_eq!(
                fast.divergence.is_some(),
                plain.divergence.is_some(),
                "{name}"
            );
            match (fast.critical_speed(), plain.critical_speed()) {
                (Some(fast), Some(plain)) => assert_ratio(&name, fast, plain, 1e-9),
                (fast, plain) => assert_eq!(fast, plain, "{name}"),
            }
        }
        let share = f64::from(compared) / f64::from(count);
        assert!(
            share >= followed,
            "{compared} of {count} followed at {factor}"
        );
    }
}

/// Vehicles that hunt from 22 to 41 mph at most, and again from much higher speeds on: steps over the
/// speed that are too long pass over the first, or take one of two modes nearby for the other.
#[test]
fn brief_instabilities_far_below_another_are_found() {
    for (conicity, longitudinal, lateral, mph) in [
        (0.05, 618_556.365_226_948_4, 10_866_311.267_168_801, 35.4),
        (0.10, 392_708.419_161_130_4, 775_955.219_905_104_7, 22.1),
        (0.05, 532_684.450_048_975_4, 3_110_928.461_751_77, 32.33),
        (0.10, 413_900.884_023_913_1, 708_904.8, 22.17),
    ] {
        let mut case = Case::prototype();
        case.service.speed = 110.0 * MPH;
        case.wheel_rail.conicity = conicity;
        case.vehicle.suspension.primary.longitudinal_stiffness = longitudinal;
        case.vehicle.suspension.primary.lateral_stiffness = lateral;
        let found = Stability::of(&case).unwrap().critical_speed().unwrap();
        // From a scan of 3000 speeds, 0.2 % apart.
        assert_ratio("critical speed", found / MPH, mph, 3e-3);
    }
}

/// It does not matter from which speed the modes are followed.
#[test]
fn the_critical_speed_does_not_depend_on_where_the_search_starts() {
    for (name, case) in vehicles(22, 60) {
        let (model, range) = (LateralModel::new(&case), case.model.speed_range);
        let from = |speed: f64| {
            let poles = Poles::at(&model.forced, speed).unwrap();
            Stability::new(&model, &poles, range, 1.0).unwrap()
        };
        let expected = from(case.service.speed).critical_speed();
        for mph in [10.0, 90.0, 180.0, 400.0] {
            match (from(mph * MPH).critical_speed(), expected) {
                (Some(found), Some(expected)) => assert_ratio(&name, found, expected, 1e-9),
                (found, expected) => assert_eq!(found, expected, "{name} from {mph} mph"),
            }
        }
    }
}

/// The least damping up to a speed. Full spectra at the speeds of a grid may pass over a dip that
/// following the modes finds; the other way round only dips shallower than what the steps are
/// laid for are passed over.
#[test]
fn least_damping_is_that_of_full_spectra_or_lower() {
    let (mut compared, mut lower) = (0, 0);
    for (name, case) in vehicles(24, 160) {
        let model = LateralModel::new(&case);
        let (range, below) = ([2.2, 1.3 * case.service.speed], 0.05);
        let poles = poles(&model, &case);
        let Some(fast) = DampingRange::by_following(&model, &poles, range, below) else {
            continue;
        };
        let plain = DampingRange::by_spectra(&model, range, below).unwrap();
        let [fast, plain] = [fast, plain].map(|found| found.least().expect(&name).damping_ratio);
        if plain > below && fast > below {
            continue;
        }
        compared += 1;
        lower += i32::from(fast < plain - 1e-9);
        assert!(
            fast < plain + 1e-9 || fast < plain + 1e-3 && plain > 0.0,
            "{name}: {fast} against {plain}"
        );
    }
    assert!(compared > 60, "{compared} compared");
    assert!(lower < compared / 20, "{lower} of {compared} lower");
}

/// Designs of the urban example whose trucks' modes lose their damping one after the other: what is
/// found of one must not be the other, which at that speed is still damped.
#[test]
fn twins_are_told_apart_where_they_lose_their_damping() {
    let spec = problem("urban-80mph");
    let tasks = Tasks::new(&spec);
    let profiles: Vec<f64> = tasks.profiles(&spec.case);
    for (profile, i) in [(0, 54.0_f64), (1, 7.0)] {
        let mut case = spec.case.clone();
        case.wheel_rail.conicity = profiles[profile];
        let study = tasks.bare(&case, &Index::ALL);
        let primes = [2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0_f64];
        let x: Vec<f64> = primes.iter().map(|p| (i * p.sqrt()).fract()).collect();
        let case = study.design(&x[..study.parameters().len()]);
        let model = LateralModel::new(&case);
        let poles = poles(&model, &case);
        let fast = Stability::new(&model, &poles, case.model.speed_range, 1.0).unwrap();
        let critical = fast.critical_speed().unwrap();
        for (share, stable) in [(1.0 - 1e-6, true), (1.0 + 1e-6, false)] {
            let poles = Poles::at(&model.forced, critical * share).unwrap();
            assert_eq!(poles.stable(), stable, "profile {profile}, {share}");
        }
    }
}

/// The symmetric vertical model's eigenvalues, found in parts, are those of the whole: also with air
/// springs, whose inner points have no mass. 1e-7: two that are nearly equal, as those of the
/// trucks, are good to the square root of rounding.
#[test]
fn eigenvalues_of_parts_are_those_of_the_whole() {
    for (i, (name, mut case)) in vehicles(8, 80).into_iter().enumerate() {
        let secondary = &mut case.vehicle.suspension.secondary;
        if i.is_multiple_of(2) {
            secondary.air_spring = Some(AirSpring {
                direct_stiffness: 0.1 * secondary.vertical_stiffness,
                series_stiffness: 2.0 * secondary.vertical_stiffness,
                reservoir_stiffness: secondary.vertical_stiffness,
                orifice_damping: secondary.vertical_damping,
            });
        }
        let model = VerticalModel::new(&case).forced;
        assert_whole(&name, &model, case.service.speed, [0.0, 1e-7]);
    }
}

/// The lateral model's eigenvalues, refined from those of one truck and of the carbody, are those of
/// the whole, at the speed of service, where many modes have become pairs of real ones, and where
/// growing ones are near: each to 1e-8 of itself (2e-10 was the most in 5000 vehicles), but for what
/// rounding leaves of the smallest in the whole.
#[test]
fn refined_eigenvalues_are_those_of_the_whole() {
    for (name, case) in vehicles(31, 300) {
        let model = LateralModel::new(&case).forced;
        for speed in [case.service.speed, 1.0, 12.0, 150.0] {
            assert_whole(&name, &model, speed, [1e-8, 1e-13]);
        }
    }
}

/// Trucks that know nothing of each other, whose eigenvalues are the same; nothing that holds the
/// carbody; no damping but the rails'; wheelsets nearly free: 1e-7 of the largest, as double roots are
/// good to the square root of rounding.
#[test]
fn degenerate_vehicles_have_the_eigenvalues_of_the_whole() {
    let changes: [fn(&mut Suspension); 5] = [
        |suspension| {
            suspension.secondary.lateral_stiffness = 0.0;
            suspension.secondary.lateral_damping = 0.0;
            suspension.secondary.yaw_stiffness = 0.0;
        },
        |suspension| suspension.secondary.yaw_stiffness *= 1e3,
        |suspension| {
            suspension.secondary.lateral_damping = 0.0;
            suspension.secondary.vertical_damping = 0.0;
        },
        |suspension| suspension.primary.longitudinal_stiffness *= 1e-6,
        |suspension| {
            suspension.primary.longitudinal_stiffness = 0.0;
            suspension.primary.lateral_stiffness = 0.0;
        },
    ];
    for (i, change) in changes.into_iter().enumerate() {
        let mut case = Case::prototype();
        change(&mut case.vehicle.suspension);
        let model = LateralModel::new(&case).forced;
        for speed in [3.0, 20.0, 49.0, 110.0] {
            assert_whole(&format!("change {i}"), &model, speed, [0.0, 1e-7]);
        }
    }
}

/// Asserts that eigenvalues are those of the whole system's matrix, within shares of themselves and of
/// the largest.
fn assert_whole(name: &str, model: &ForcedModel, speed: f64, [own, of_largest]: [f64; 2]) {
    let mut whole = eigenvalues(model.system.state_matrix(speed)).unwrap();
    let values = Poles::at(model, speed).unwrap().values;
    assert_eq!(values.len(), whole.len(), "{name}");
    let largest = whole.iter().map(|s| s.norm()).fold(0.0, f64::max);
    for s in values {
        let apart = |i: &usize| (whole[*i] - s).norm();
        let nearest = (0..whole.len()).min_by(|i, j| apart(i).total_cmp(&apart(j)));
        let other = whole.swap_remove(nearest.unwrap());
        let allowed = own * other.norm() + of_largest * largest;
        assert!(
            (other - s).norm() < allowed,
            "{name}, {speed}: {s}, {other}"
        );
    }
}

/// Transfer functions by elimination in the order of the structure, without pivoting, against a
/// dense pivoted factorisation. Strokes at low frequency are differences of much larger motions,
/// which costs both some digits.
#[test]
fn spectra_are_those_of_a_dense_factorisation() {
    let frequencies = [0.05, 0.3, 0.8, 1.7, 3.1, 7.0, 18.0, 45.0];
    for (name, case) in vehicles(23, 120) {
        let (track, speed) = (&case.service.track, case.service.speed);
        let models = [
            LateralModel::new(&case).forced,
            VerticalModel::new(&case).forced,
        ];
        for model in &models {
            let mut fast = vec![[0.0; LANES]; model.outputs.len()];
            Response::new(model, track, speed).densities(&frequencies, &mut fast);
            let mut dense = vec![0.0; model.outputs.len()];
            for (l, f) in frequencies.into_iter().enumerate() {
                plain::densities(model, track, speed, f, &mut dense);
                for (k, (fast, dense)) in fast.iter().zip(&dense).enumerate() {
                    let largest = fast.iter().copied().fold(0.0, f64::max);
                    let slack = 1e-7 * dense + 1e-9 * largest;
                    assert!(
                        (fast[l] - dense).abs() <= slack,
                        "{name}, output {k}, {f} Hz: {} against {dense}",
                        fast[l]
                    );
                }
            }
        }
    }
}
