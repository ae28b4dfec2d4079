//! Random vehicles: no panic, nothing that is not a number, and the critical speed is the one that
//! a dense scan finds.

use bogie::{
    case::{Case, Crosslevel, TruckRoll},
    comfort::third_octave,
    dynamics::{LateralModel, VerticalModel, eigenvalues},
    evaluate::{Evaluation, critical_speed::Stability, integration::integrate, response::Response},
    spec::keys,
};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A vehicle with every parameter of the prototype's changed by up to a factor either way.
fn random(rng: &mut ChaCha8Rng, factor: f64) -> Case {
    let prototype = Case::prototype();
    let mut case = prototype.clone();
    for key in keys::case() {
        if let Some(value) = (key.get)(&prototype) {
            let changed = value * factor.powf(rng.random_range(-1.0..1.0));
            if key.range.contains(changed) {
                (key.set)(&mut case, changed);
            }
        }
    }
    case.wheel_rail.conicity = rng.random_range(0.02..0.25);
    case.service.speed = rng.random_range(5.0..90.0);
    if rng.random_bool(0.5) {
        case.model.truck_roll = TruckRoll::Dynamic;
    }
    if rng.random_bool(0.3) {
        case.model.crosslevel = Crosslevel::Contact;
    }
    case
}

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
        let found = Stability::search(&model, [low, high]).unwrap();
        let ratio = (high / low).powf(1.0 / 1499.0);
        let growing = |v: f64| {
            let values = eigenvalues(model.forced.system.state_matrix(v)).unwrap();
            values.iter().any(|s| s.im > 0.0 && s.re >= 0.0)
        };
        let speeds = (0..1500).map(|k| low * ratio.powi(k));
        match (speeds.clone().find(|v| growing(*v)), found.critical_speed()) {
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

/// Refining the frequency grid changes no mean square by more than the 1e-6 that is promised.
#[test]
fn refinement_changes_nothing() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut compared = 0;
    while compared < 30 {
        let case = random(&mut rng, 2.0);
        let lateral = LateralModel::new(&case);
        let state = lateral.forced.system.state_matrix(case.service.speed);
        if eigenvalues(state).unwrap().iter().any(|s| s.re >= 0.0) {
            continue;
        }
        for model in [lateral.forced, VerticalModel::new(&case).forced] {
            let outputs = model.outputs.len();
            let edges = third_octave::edges_between(0.02, 50.0);
            let [coarse, fine] = [1e-6, 1e-12].map(|tolerance| {
                let mut response = Response::new(&model, &case.service.track, case.service.speed);
                integrate(&edges, outputs, tolerance, |f, v| response.densities(f, v))
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
