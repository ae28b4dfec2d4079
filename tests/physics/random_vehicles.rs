//! Random vehicles: no panic, nothing that is not a number, and the critical speed is the one that
//! a dense scan finds.

use crate::support::{LBF_FT, LBF_PER_FT, MPH, random_vehicle as random};
use bogie::{
    case::Case,
    dynamics::{LateralModel, VerticalModel},
    evaluate::{
        Evaluation,
        ride::{panels::response_panels, response::Response},
        stability::{DampingRange, Stability},
    },
    numerics::{Poles, eigenvalues, quadrature::integrate},
    parameter::Parameter,
};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

#[test]
fn every_number_is_a_number() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for i in 0..600 {
        let factor = if i % 3 == 0 { 10.0 } else { 1.5 };
        let case = random(&mut rng, factor);
        let evaluation = Evaluation::new(&case).unwrap();
        let value = bogie::export::evaluation_json::evaluation("random", &case, &evaluation, &[]);
        // serde_json writes NaN and infinities as null: ride values must be numbers.
        for direction in ["lateral", "vertical"] {
            if let Some(ride) = value[direction].as_object() {
                for key in [
                    "acceleration_rms_m_per_s2",
                    "secondary_stroke_rms_m",
                    "sperling_wz",
                ] {
                    for x in ride[key].as_array().unwrap() {
                        assert!(
                            x.as_f64().is_some_and(|x| x >= 0.0),
                            "vehicle {i}: {direction} {key}"
                        );
                    }
                }
            }
        }
        assert_eq!(
            value["lateral"].is_null(),
            !evaluation.modes.stable(),
            "vehicle {i}"
        );
        for mode in &evaluation.modes.oscillatory {
            assert!(mode.frequency.is_finite() && mode.damping_ratio.is_finite());
        }
    }
}

/// The number of growing oscillations at 1500 speeds. Where the scan sees the first one, the
/// search must have found an onset between that speed and the one before.
#[test]
fn critical_speed_is_what_a_dense_scan_finds() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let mut compared = 0;
    for i in 0..60 {
        let case = random(&mut rng, if i % 2 == 0 { 1.5 } else { 3.0 });
        let model = LateralModel::new(&case);
        let [low, high] = case.model.speed_range;
        let found = Stability::of(&case).unwrap();
        let ratio = (high / low).powf(1.0 / 1499.0);
        let growing = |v: f64| {
            let values = eigenvalues(model.forced.system.state_matrix(v)).unwrap();
            values.iter().any(|s| s.im > 0.0 && s.re >= 0.0)
        };
        let speeds = (0..1500).map(|k| low * ratio.powi(k));
        let onset = found.onsets.first().map(|onset| onset.speed);
        let searched = if found.unstable_at_start {
            Some(low)
        } else {
            onset
        };
        match (speeds.clone().find(|v| growing(*v)), searched) {
            (None, None) => {}
            (Some(first), Some(critical)) => {
                let slack = 1e-6;
                assert!(
                    critical <= first * (1.0 + slack) && critical >= first / ratio * (1.0 - slack),
                    "vehicle {i}: {critical} found, scan sees {first}"
                );
                compared += 1;
            }
            // An instability narrower than the scan's steps may be seen by the search alone.
            (None, Some(critical)) => {
                assert!(growing(critical * 1.0001), "vehicle {i}: {critical}");
            }
            (Some(first), None) => panic!("vehicle {i}: the scan sees {first}, the search nothing"),
        }
    }
    assert!(compared > 40, "{compared}");
}

/// A real eigenvalue changes its sign where det K does, which is at no speed: a vehicle diverges at every
/// speed or begins to at none. Real eigenvalues that grow in pairs come from an oscillation that grew
/// before. At 200 speeds of vehicles with springs so soft that some overturn.
#[test]
fn divergence_begins_at_no_speed() {
    let mut rng = ChaCha8Rng::seed_from_u64(21);
    let mut diverging = 0;
    for i in 0..200 {
        let mut case = random(&mut rng, if i % 2 == 0 { 2.0 } else { 4.0 });
        let secondary = &mut case.vehicle.suspension.secondary;
        secondary.vertical_stiffness *= 0.3;
        let model = LateralModel::new(&case);
        let [low, high] = case.model.speed_range;
        let found = Stability::of(&case).unwrap();
        let growing = |v: f64| {
            let values = eigenvalues(model.forced.system.state_matrix(v)).unwrap();
            values.iter().filter(|s| s.im == 0.0 && s.re > 1e-9).count()
        };
        let at_start = Poles::at(&model.forced, low).unwrap();
        assert_eq!(
            found.divergence.is_some(),
            at_start.diverge(),
            "vehicle {i}"
        );
        assert!(growing(low) == 0 || at_start.diverge(), "vehicle {i}");
        if found.divergence.is_some() {
            assert_eq!(found.divergence, Some(low));
            assert_eq!(found.critical_speed(), None, "vehicle {i}");
            diverging += 1;
        }
        let odd = growing(low) % 2;
        for k in 0..200 {
            let v = low * (high / low).powf(f64::from(k) / 199.0);
            let growing = growing(v);
            assert_eq!(growing % 2, odd, "vehicle {i} at {v} m/s");
            let critical = found.critical_speed().unwrap_or(high);
            if found.divergence.is_none() && v < critical {
                assert_eq!(growing, 0, "vehicle {i} at {v} m/s");
            }
        }
    }
    assert!((20..180).contains(&diverging), "{diverging}");
}

/// Refining the frequency grid changes no mean square by more than the 1e-6 that is promised.
#[test]
fn refinement_changes_nothing() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut compared = 0;
    while compared < 100 {
        let case = random(&mut rng, 2.0);
        let lateral = LateralModel::new(&case);
        let speed = case.service.speed;
        if !Poles::at(&lateral.forced, speed).unwrap().stable() {
            continue;
        }
        for model in [lateral.forced, VerticalModel::new(&case).forced] {
            let outputs = model.outputs.len();
            let edges = response_panels(&model, &case, &Poles::at(&model, speed).unwrap());
            let [coarse, fine] = [1e-6, 1e-12].map(|tolerance| {
                let mut response = Response::new(&model, &case.service.track, speed);
                integrate(&edges, [outputs; 2], tolerance, |f, v| {
                    response.densities(f, v);
                })
            });
            assert!(coarse.converged && fine.converged);
            for k in 0..outputs {
                let ratio = coarse.total(k) / fine.total(k);
                assert!(
                    (ratio - 1.0).abs() < 1e-6,
                    "output {k} at {} m/s: {ratio}",
                    case.service.speed
                );
            }
        }
        compared += 1;
    }
}

/// The prototype on wheels of conicity 0.10 with the stiffest K_b of the report's charts: at these
/// K_py an instability is born and dies between about 184 and 210 mph, narrower than the steps of
/// the search.
fn briefly_unstable() -> Vec<(String, Case)> {
    [
        61e3, 64e3, 67e3, 70e3, 70.2e3, 70.5e3, 71e3, 73e3, 76e3, 80e3,
    ]
    .into_iter()
    .map(|lateral| {
        let mut case = Case::prototype();
        case.wheel_rail.conicity = 0.10;
        Parameter::PRIMARY_BENDING_STIFFNESS.set(&mut case, 2e7 * LBF_FT);
        Parameter::PRIMARY_LATERAL_STIFFNESS.set(&mut case, lateral * LBF_PER_FT);
        (format!("K_py {lateral} lbf/ft"), case)
    })
    .collect()
}

/// The least damping ratio of an oscillation at each speed.
fn least_damping(model: &LateralModel, speeds: &[f64]) -> Vec<f64> {
    let at = |v: f64| {
        let values = eigenvalues(model.forced.system.state_matrix(v)).unwrap();
        let oscillatory = values.iter().filter(|s| s.im > 0.0);
        oscillatory
            .map(|s| -s.re / s.norm())
            .fold(f64::INFINITY, f64::min)
    };
    speeds.iter().map(|v| at(*v)).collect()
}

fn dense(low: f64, high: f64) -> Vec<f64> {
    let last = 1499;
    let step = |k: i32| low * (high / low).powf(f64::from(k) / f64::from(last));
    (0..=last).map(step).collect()
}

#[test]
fn an_instability_that_is_born_and_dies_between_two_speeds_is_found() {
    let mut brief = 0;
    for (what, case) in briefly_unstable() {
        let model = LateralModel::new(&case);
        let [low, high] = case.model.speed_range;
        let speeds = dense(low, high);
        let damping = least_damping(&model, &speeds);
        let first = damping.iter().position(|z| *z < 0.0).expect(&what);
        let followed = Stability::of(&case).unwrap();
        let searched = Stability::by_spectra(&model, [low, high]).unwrap();
        for found in [followed, searched] {
            let critical = found.critical_speed().expect(&what);
            // Rounding of the scan's own speeds.
            let slack = 1e-9;
            assert!(
                critical <= speeds[first] * (1.0 + slack)
                    && critical >= speeds[first - 1] * (1.0 - slack),
                "{what}: {} mph found, the scan sees {} mph",
                critical / MPH,
                speeds[first] / MPH
            );
        }
        // Where it dies again before the next one is born: what this test is for.
        brief += i32::from(damping[first..].iter().any(|z| *z > 0.0));
    }
    assert_eq!(brief, 6, "instabilities that die again");
}

/// `DampingRange` against 1500 speeds up to a given one. What it finds is a damping ratio that some
/// mode has, so it can only be lower than the scan where the minimum lies between two of the scan's
/// speeds: by no more than the damping ratio rises from one of these to the next.
fn agrees_with_the_scan(what: &str, case: &Case, speed: f64) {
    let model = LateralModel::new(case);
    let low = case.model.speed_range[0].min(0.5 * speed);
    let speeds = dense(low, speed);
    let damping = least_damping(&model, &speeds);
    let (k, least) = damping
        .iter()
        .copied()
        .enumerate()
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .expect("1500 speeds");
    let beside = [k.saturating_sub(1), (k + 1).min(damping.len() - 1)];
    let rise = beside.map(|i| damping[i] - least);
    // 1e-9: the search ends where a step changes ζ by less than 1e-11.
    let (most, fewest) = (least + 1e-9, least - rise[0].max(rise[1]) - 1e-9);
    let mut found = vec![DampingRange::by_spectra(&model, [low, speed], f64::INFINITY).unwrap()];
    if least < 0.05 {
        let poles = Poles::at(&model.forced, case.service.speed).unwrap();
        found.push(DampingRange::new(&model, &poles, [low, speed], 0.05).unwrap());
    }
    for found in found {
        let found = found.least().expect(what);
        assert!(
            (fewest..=most).contains(&found.damping_ratio),
            "{what} up to {} mph: ζ {} at {} mph found, the scan sees {least} at {} mph",
            speed / MPH,
            found.damping_ratio,
            found.speed / MPH,
            speeds[k] / MPH
        );
    }
}

#[test]
fn the_least_damping_up_to_a_speed_is_what_a_dense_scan_finds() {
    for (what, case) in briefly_unstable() {
        for speed in [150.0, 190.0, 200.0, 215.0, 300.0] {
            agrees_with_the_scan(&what, &case, speed * MPH);
        }
    }
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    for i in 0..40 {
        let case = random(&mut rng, if i % 2 == 0 { 1.5 } else { 3.0 });
        for speed in [60.0, 150.0, 350.0] {
            agrees_with_the_scan(&format!("vehicle {i}"), &case, speed * MPH);
        }
    }
}
