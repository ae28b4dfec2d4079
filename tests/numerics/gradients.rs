//! Derivatives of the performance indices against differences of the indices themselves.

use crate::support::{random_vehicle, ten};
use bogie::{
    case::{Case, CurvingCreep, TruckRoll},
    design::measure::{Wanted, measure, measure_graded},
    dynamics::{LateralModel, VerticalModel, curving::CurvingModel},
    evaluate::{
        curving::{CurvingLimits, CurvingState, Limit, ServiceCurve},
        gradients::{Constants, curving::CurvingTangents, modes},
        ride::{LateralRide, VerticalRide},
        stability::Stability,
    },
    index::Index,
    numerics::Poles,
    optimize::problem::Piece,
    parameter::Parameter,
};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
/// Numbers by which a vehicle is differentiated beside those of Table 4.1.1; in turn all are.
const OTHERS: usize = 12;

/// The numbers by which vehicle `n` is differentiated: relative steps need a value.
fn numbers(case: &mut Case, n: usize) -> Vec<Parameter> {
    let mut others: Vec<Parameter> = Parameter::plain().filter(|p| !ten().contains(p)).collect();
    let count = others.len();
    others.rotate_left(n * OTHERS % count);
    others.truncate(OTHERS);
    others.retain(|p| p.find(case).is_some_and(|value| value != 0.0));
    let numbers: Vec<Parameter> = ten().into_iter().chain(others).collect();
    // A number that follows from others is one of its own from now on.
    for number in &numbers {
        let value = number.get(case);
        number.set(case, value);
    }
    numbers
}

/// Relative steps: the derivative of the polynomial through five values around is taken.
const STEP: f64 = 5e-4;

/// Derivatives by the logarithm of a constant, of what is measured of a case.
fn differences(case: &Case, constant: Parameter, of: impl Fn(&Case) -> Vec<f64>) -> Vec<f64> {
    let value = constant.get(case);
    let at = |k: f64| {
        let mut case = case.clone();
        constant.set(&mut case, value * (1.0 + k * STEP));
        of(&case)
    };
    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(at);
    (0..a.len())
        .map(|i| (a[i] - 8.0 * b[i] + 8.0 * c[i] - d[i]) / (12.0 * STEP))
        .collect()
}

/// Compares, by the logarithm of each constant and relative to the largest derivative of the index.
fn compare(
    what: &str,
    (case, numbers): (&Case, &[Parameter]),
    exact: &[Vec<f64>],
    tolerance: f64,
    of: impl Fn(&Case) -> Vec<f64>,
) {
    let values = of(case);
    let numeric: Vec<Vec<f64>> = numbers
        .iter()
        .map(|constant| differences(case, *constant, &of))
        .collect();
    for (k, value) in values.iter().enumerate() {
        let scale = numeric
            .iter()
            .map(|d| d[k].abs())
            .fold(1e-3 * value.abs(), f64::max);
        for (p, constant) in numbers.iter().enumerate() {
            let exact = exact[p][k] * constant.get(case);
            let difference = (exact - numeric[p][k]).abs();
            assert!(
                difference <= tolerance * scale,
                "{what} {k} by {}: {exact:e}, {:e} by differences, of {scale:e}",
                constant.name(),
                numeric[p][k],
            );
        }
    }
}

/// Random vehicles away from the rows of the table of profiles, where coefficients have a kink.
fn vehicles(seed: u64, count: usize, factor: f64) -> Vec<Case> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let smooth = |case: &Case| {
        let rows = bogie::wheel_rail::PROFILES.into_iter();
        rows.map(|row| (case.wheel_rail.conicity / row - 1.0).abs())
            .all(|apart| apart > 3.0 * STEP)
    };
    let mut vehicles: Vec<Case> = std::iter::repeat_with(|| random_vehicle(&mut rng, factor))
        .filter(smooth)
        .take(count)
        .collect();
    // Every third has a trailing end that differs.
    let own = [
        ("trailing.suspension.primary.lateral_stiffness", 1.3),
        ("trailing.vehicle.truck.mass", 1.2),
        ("trailing.vehicle.truck.half_wheelbase", 0.9),
    ];
    for case in vehicles.iter_mut().skip(2).step_by(3) {
        for (name, factor) in own {
            let number = Parameter::named(name).unwrap();
            let value = number.get(case);
            number.set(case, factor * value);
        }
    }
    vehicles
}

/// 1e-5 of the largest derivative: speeds found by following the modes and by full spectra agree to 1e-9,
/// which the step divides by 5e-4.
#[test]
fn critical_speeds() {
    let mut compared = 0;
    for (n, mut case) in vehicles(1, 160, 2.0).into_iter().enumerate() {
        let numbers = numbers(&mut case, n);
        let speed = |case: &Case| Stability::of(case).unwrap().critical_speed();
        let stability = Stability::of(&case).unwrap();
        let Some(onset) = stability
            .onsets
            .first()
            .filter(|_| !stability.unstable_at_start)
        else {
            continue;
        };
        // Where two modes change places or an instability is born nearby, with a speed that goes as a
        // square root, a difference is no derivative.
        let near = |f: f64| {
            numbers.iter().all(|constant| {
                let mut other = case.clone();
                constant.set(&mut other, constant.get(&case) * (1.0 + f));
                speed(&other).is_some_and(|v| (v / onset.speed - 1.0).abs() < 4.0 * STEP)
            })
        };
        if stability.onsets.len() > 1 && stability.onsets[1].speed < 1.02 * onset.speed
            || !near(2.0 * STEP)
            || !near(-2.0 * STEP)
        {
            continue;
        }
        let model = LateralModel::new(&case);
        let tangents = Constants::new(&case, &numbers).lateral(&model).unwrap();
        let exact = modes::critical_speed(&model.forced.system, &tangents, onset);
        let exact: Vec<Vec<f64>> = exact.into_iter().map(|d| vec![d]).collect();
        compare("critical speed", (&case, &numbers), &exact, 1e-5, |case| {
            vec![speed(case).unwrap()]
        });
        compared += 1;
    }
    assert!(compared >= 30, "{compared}");
}

/// 1e-4 of the largest derivative: RMS values are good to 1e-6 at worst, and their differences
/// accordingly less.
#[test]
fn rides() {
    let mut compared = 0;
    for (n, mut case) in vehicles(2, 40, 2.0).into_iter().enumerate() {
        let numbers = numbers(&mut case, n);
        let (lateral, vertical) = (LateralModel::new(&case), VerticalModel::new(&case));
        let constants = Constants::new(&case, &numbers);
        let poles = |model| Poles::at(model, case.service.speed).unwrap();
        let all = |ride: &LateralRide| {
            let mut all = ride.acceleration.to_vec();
            all.push(ride.roll_acceleration);
            all.extend(ride.secondary_stroke);
            all.extend(ride.primary_stroke);
            all.extend(ride.longitudinal_stroke);
            all.extend(ride.excursion);
            all
        };
        let tangents = constants.lateral(&lateral).unwrap();
        if let Ok((ride, exact)) =
            LateralRide::with_derivatives(&lateral, &case, &poles(&lateral.forced), &tangents)
        {
            assert_eq!(Ok(ride), LateralRide::new(&lateral, &case));
            let exact: Vec<Vec<f64>> = exact.iter().map(all).collect();
            compare("lateral", (&case, &numbers), &exact, 1e-4, |case| {
                all(&LateralRide::new(&LateralModel::new(case), case).unwrap())
            });
            compared += 1;
        }
        let all = |ride: &VerticalRide| {
            let mut all = ride.acceleration.to_vec();
            all.push(ride.roll_acceleration);
            all.extend(ride.secondary_stroke);
            all.extend(ride.primary_stroke);
            all.extend(ride.wheel_load);
            all
        };
        let tangents = constants.vertical(&vertical).unwrap();
        let (_, exact) =
            VerticalRide::with_derivatives(&vertical, &case, &poles(&vertical.forced), &tangents)
                .unwrap();
        let exact: Vec<Vec<f64>> = exact.iter().map(all).collect();
        compare("vertical", (&case, &numbers), &exact, 1e-4, |case| {
            all(&VerticalRide::new(&VerticalModel::new(case), case).unwrap())
        });
    }
    assert!(compared >= 20, "{compared}");
}

/// Both creep laws, with and without breakaway; 1e-7 as the equations are solved exactly.
#[test]
fn curves() {
    let mut compared = 0;
    for (n, mut case) in vehicles(3, 60, 2.0).into_iter().enumerate() {
        if n % 2 == 1 {
            case.model.curving_creep = CurvingCreep::LoadDependent;
            case.model.truck_roll = TruckRoll::Prescribed;
        }
        let numbers = numbers(&mut case, n);
        let cant_deficiency = [0.0, 0.05][n / 2 % 2];
        let Ok(model) = CurvingModel::new(&case, cant_deficiency) else {
            continue;
        };
        let constants = Constants::new(&case, &numbers);
        let tangents = CurvingTangents::new(&model, &constants, cant_deficiency);
        let clearance = |case: &Case| case.wheel_rail.flange_clearance;
        let clearances = constants.slopes(clearance(&case), clearance);
        let pieces = CurvingLimits::new(&case, cant_deficiency).unwrap().pieces;
        for (k, limit) in Limit::ALL.into_iter().enumerate() {
            let Some(degree) = pieces[k].filter(|degree| *degree > 0.0) else {
                continue;
            };
            let Some(exact) = tangents.limit(limit, degree, &clearances) else {
                continue;
            };
            let of = |case: &Case| {
                let limits = CurvingLimits::new(case, cant_deficiency).unwrap();
                limits.pieces[k]
            };
            // Not across a breakaway, where the slope changes.
            let state = |case: &Case| {
                let model = CurvingModel::new(case, cant_deficiency).unwrap();
                let curvature = bogie::track::curvature_of_degree(of(case).unwrap_or(degree));
                model.segment_at(curvature).breakaway
            };
            let smooth = numbers.iter().all(|constant| {
                [-2.0, 2.0].into_iter().all(|k| {
                    let mut other = case.clone();
                    constant.set(&mut other, constant.get(&case) * (1.0 + k * STEP));
                    of(&other).is_some() && state(&other) == state(&case)
                })
            });
            if smooth {
                let exact: Vec<Vec<f64>> = exact.into_iter().map(|d| vec![d]).collect();
                compare(
                    &limit.to_string(),
                    (&case, &numbers),
                    &exact,
                    1e-7,
                    |case| vec![of(case).unwrap()],
                );
                compared += 1;
            }
        }
        let degree = 1.0;
        let exact = tangents.state(degree, &vec![0.0; numbers.len()]).unwrap();
        // Without cant deficiency the carbody does not lean, but for rounding.
        let leans = |strokes: [f64; 2]| strokes.into_iter().filter(|_| cant_deficiency > 0.0);
        let all = |state: &CurvingState| {
            let wheels = state.wheels.iter().flatten();
            let forces = wheels.flat_map(|w| [w.lateral / w.vertical, w.adhesion_used]);
            let places = state.wheelset_lateral.into_iter();
            let strokes = leans(state.secondary_lateral_stroke);
            forces.chain(places).chain(strokes).collect::<Vec<f64>>()
        };
        let state = CurvingState::new(&case, degree, cant_deficiency).unwrap();
        let exact: Vec<Vec<f64>> = exact
            .iter()
            .map(|change| {
                let wheels = change.wheels.iter().flatten();
                let pairs = wheels.zip(state.wheels.iter().flatten());
                let forces = pairs.flat_map(|(d, w)| {
                    let heavier = w.lateral / w.vertical * d.vertical;
                    [(d.lateral - heavier) / w.vertical, d.adhesion_used]
                });
                let places = change.wheelset_lateral;
                let strokes = leans(change.secondary_lateral_stroke);
                forces.chain(places).chain(strokes).collect()
            })
            .collect();
        let same = |case: &Case| CurvingState::new(case, degree, cant_deficiency).unwrap();
        let smooth = numbers.iter().all(|constant| {
            [-2.0, 2.0].into_iter().all(|k| {
                let mut other = case.clone();
                constant.set(&mut other, constant.get(&case) * (1.0 + k * STEP));
                same(&other).breakaway == state.breakaway
            })
        });
        if smooth {
            compare(
                "state in a curve",
                (&case, &numbers),
                &exact,
                1e-6,
                |case| all(&same(case)),
            );
        }
    }
    assert!(compared >= 100, "{compared}");
}

/// Of the indices of the service curve, piece by piece, with the curve given and with the tightest,
/// which itself changes: 1e-4 of the largest derivative, as the random stroke is part of one of them.
#[test]
fn indices_of_the_service_curve() {
    let mut compared = [0; 2];
    for (n, mut case) in vehicles(4, 60, 1.5).into_iter().enumerate() {
        case.service.curve = [Some(0.01), None][n % 2];
        case.service.cant_deficiency = [None, Some(0.03)][n / 2 % 2];
        let numbers = numbers(&mut case, n);
        let indices = [Index::CurveLimitRatio, Index::SecondaryLateralStrokeInCurve];
        for (index, compared) in indices.into_iter().zip(&mut compared) {
            let wanted = [Wanted::Index(index)];
            let Ok(mut graded) = measure_graded(&case, &wanted, &numbers) else {
                continue;
            };
            let pieces = graded.remove(0);
            let values = |case: &Case| -> Option<Vec<f64>> {
                let pieces = measure(case, &wanted).ok()?.remove(0);
                Some(pieces.iter().map(|piece| piece.value).collect())
            };
            // Not across a breakaway or another limit that governs, where the slope changes.
            let place = |case: &Case| {
                let curve = ServiceCurve::of(case).ok()?;
                let limits = CurvingLimits::new(case, 0.0).ok()?;
                let governing = limits.governing().map(|limited| limited.limit);
                let state = curve.state?;
                let sides = state.wheelset_lateral.map(|y| y > 0.0);
                Some((state.breakaway, governing, sides))
            };
            let smooth = numbers.iter().all(|constant| {
                [-2.0, 2.0].into_iter().all(|k| {
                    let mut other = case.clone();
                    constant.set(&mut other, constant.get(&case) * (1.0 + k * STEP));
                    values(&other).is_some() && place(&other) == place(&case)
                })
            });
            if !smooth || pieces.is_empty() {
                continue;
            }
            let exact: Vec<Vec<f64>> = (0..numbers.len())
                .map(|p| {
                    let slope = |piece: &Piece| piece.gradient.as_ref().unwrap()[p];
                    pieces.iter().map(slope).collect()
                })
                .collect();
            compare(index.name(), (&case, &numbers), &exact, 1e-4, |case| {
                values(case).unwrap()
            });
            *compared += 1;
        }
    }
    assert!(compared.iter().all(|count| *count > 10), "{compared:?}");
}
