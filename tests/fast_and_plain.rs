//! The fast evaluators against the plain ones, over random vehicles.

mod support;

use bogie::{
    case::Case,
    dynamics::{LateralModel, Poles, VerticalModel, elimination::LANES},
    evaluate::{
        critical_speed::Stability,
        response::{Response, plain},
    },
};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use support::{MPH, assert_ratio, random_vehicle};

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

/// Poles at a speed near usual critical speeds.
fn poles(model: &LateralModel) -> Poles {
    Poles::at(&model.forced.system, 180.0 * MPH).unwrap()
}

#[test]
fn onsets_are_those_of_full_spectra() {
    let (mut compared, mut exact) = (0, 0);
    for (name, case) in vehicles(21, 120) {
        let model = LateralModel::new(&case);
        let range = case.model.speed_range;
        let Some(fast) = Stability::followed(&model, &poles(&model), range, f64::INFINITY) else {
            continue;
        };
        let plain = Stability::search(&model, range).unwrap();
        assert_eq!(fast.unstable_at_start, plain.unstable_at_start, "{name}");
        compared += 1;
        match (fast.critical_speed(), plain.critical_speed()) {
            // Onsets have been seen to differ by 5e-7, for a reason not known yet. That nothing
            // grows is certified for speeds 1e-4 lower.
            (Some(fast), Some(plain)) => {
                assert_ratio(&name, fast, plain, 1e-4);
                exact += usize::from((fast / plain - 1.0).abs() < 1e-9);
            }
            (fast, plain) => {
                assert_eq!(fast, plain, "{name}");
                exact += 1;
            }
        }
    }
    assert!(compared > 40, "{compared} compared");
    assert!(10 * exact > 9 * compared, "{exact} of {compared} to 1e-9");
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
