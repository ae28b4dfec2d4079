//! Ten thousand random vehicles, each from its own seed: whatever they are, every result is a number
//! or says why it is none, and is the same in any system of units.

use crate::support::{assert_ratio, random_vehicle};
use bogie::{
    case::{Case, CurvingCreep},
    dynamics::{LateralModel, VerticalModel},
    evaluate::{
        Evaluation,
        ride::{
            panels::response_panels,
            response::{Response, plain},
        },
        stability::Stability,
        warnings::warnings,
    },
    export,
    numerics::{Poles, elimination::LANES, quadrature::integrate},
    spec::{Spec, keys},
    track::{Spectrum, Track, curvature_of_degree},
    units::{DisplayUnit, Quantity},
    vehicle::AirSpring,
};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde_json::Value;

const VEHICLES: u64 = 10_000;

/// A vehicle that a spec can describe: from near the prototype to far beyond what runs on rails, on
/// any built-in track, one in four on air springs.
fn vehicle(seed: u64) -> Case {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let factors = [1.2, 1.5, 3.0, 8.0, 30.0];
    let factor = factors[usize::try_from(seed % 5).unwrap()];
    loop {
        let case = any_vehicle(&mut rng, factor);
        if Spec::parse(&spec_text(&case, Quantity::si)).is_ok() {
            return case;
        }
    }
}

/// Parts that mostly fit together: its lengths differ less from the prototype's than the rest.
fn any_vehicle(rng: &mut ChaCha8Rng, factor: f64) -> Case {
    let mut case = random_vehicle(rng, factor);
    let nearer = random_vehicle(rng, factor.min(1.5));
    for key in keys::case().filter(|key| key.quantity == Quantity::Length) {
        if let Some(length) = key.get(&nearer) {
            key.set(&mut case, length);
        }
    }
    let body = &mut case.vehicle.carbody;
    // Of M (l/2)², which all of the mass at the ends would give.
    for inertia in [&mut body.pitch_inertia, &mut body.yaw_inertia] {
        *inertia = rng.random_range(0.05..0.95) * body.mass * (body.length / 2.0).powi(2);
    }
    if rng.random_bool(0.25) {
        let k = case.vehicle.suspension.secondary.vertical_stiffness;
        let c = case.vehicle.suspension.secondary.vertical_damping;
        case.vehicle.suspension.secondary.air_spring = Some(AirSpring {
            direct_stiffness: k * rng.random_range(0.0..1.0),
            series_stiffness: k * rng.random_range(0.1..10.0),
            orifice_damping: c * rng.random_range(0.0..10.0),
            reservoir_stiffness: k * rng.random_range(0.0..3.0),
        });
    }
    if rng.random_bool(0.3) {
        case.model.curving_creep = CurvingCreep::LoadDependent;
    }
    let names: Vec<String> = Track::names().collect();
    let name = &names[rng.random_range(0..names.len())];
    case.service.track = Track::named(name).unwrap();
    if rng.random_bool(0.5) {
        case.service.curve = Some(rng.random_range(0.01_f64..10.0).to_radians());
        case.service.cant_deficiency = Some(rng.random_range(-0.2..0.2));
    }
    case
}

/// Where a value of JSON is null: its keys, joined by points.
fn nulls(value: &Value, path: &str, found: &mut Vec<String>) {
    match value {
        Value::Null => found.push(path.to_owned()),
        Value::Array(list) => list.iter().for_each(|value| nulls(value, path, found)),
        Value::Object(object) => {
            for (key, value) in object {
                nulls(value, &format!("{path}.{key}"), found);
            }
        }
        _ => {}
    }
}

/// serde_json writes what is no number as null, so each null must be one that says something else.
fn is_explained(path: &str, result: &Value) -> bool {
    let none_found = |key: &str| result[key].is_null();
    match path {
        ".critical_speed_m_per_s" => {
            let status = &result["stability"]["status"];
            status == "stable-over-range" || status == "diverges"
        }
        ".lateral" => result["stable_at_speed"] == false,
        ".flange_limit" | ".flange_limited_curve_deg" => none_found("flange_limit"),
        ".slip_limit" | ".slip_limited_curve_deg" => none_found("slip_limit"),
        ".secondary_lateral_stroke_in_curve_m" => {
            result["secondary_lateral_stroke_in_curve_status"] != "within-model"
        }
        ".checks.value_si" | ".checks.satisfied" => {
            result["checks"].as_array().unwrap().iter().all(|check| {
                let is_open = check["status"] == "not-assessed";
                check["value_si"].is_null() == is_open
                    && check["satisfied"].is_null() == is_open
                    && check["value_status"].is_string() == is_open
            })
        }
        ".kinematic_mode" | ".least_damped_mode" | ".stability.divergence_m_per_s" => true,
        // The boundary begins at 1 Hz.
        path => {
            path.ends_with(".third_octave_bands.reduced_comfort_1h_m_per_s2")
                // Not every closed form has a full result beside it.
                || path == ".closed_forms.full_model_si"
        }
    }
}

/// Every field of every evaluation, as `{:?}` shows it, and every number of the result that a user
/// gets.
#[test]
fn every_number_is_a_number() {
    let is_number = |text: &str| !text.contains("NaN") && !text.contains("inf");
    (0..VEHICLES).into_par_iter().for_each(|seed| {
        let case = vehicle(seed);
        let evaluation = Evaluation::new(&case).unwrap_or_else(|e| panic!("vehicle {seed}: {e}"));
        let fields = format!("{evaluation:?}");
        assert!(is_number(&fields), "vehicle {seed}: {fields}");
        let list = warnings(&case, &evaluation);
        assert!(list.iter().all(|text| is_number(text)), "{list:?}");
        // With closed forms and more searches for critical speeds: slower.
        if seed / 5 % 5 == 0 {
            let result = export::evaluation_json::evaluation("random", &case, &evaluation, &list);
            let mut found = Vec::new();
            nulls(&result, "", &mut found);
            for path in found {
                assert!(is_explained(&path, &result), "vehicle {seed}: {path}");
            }
        }
    });
}

/// The other commands look at more of the same models.
#[test]
fn every_number_of_curves_modes_and_spectra_is_a_number() {
    (0..VEHICLES / 10).into_par_iter().for_each(|seed| {
        let case = vehicle(seed);
        let mut found = Vec::new();
        let spectra = export::psd::Spectra::new(&case, 20).unwrap();
        let modes = export::modes::Modes::new(&case, &[0.5, 20.0, 200.0]).unwrap();
        nulls(&modes.json("random", &case), "modes", &mut found);
        let all = [&spectra.lateral, &spectra.vertical];
        for (name, values) in all.into_iter().flatten().flatten() {
            let is_density = |x: &f64| x.is_finite() && *x >= 0.0;
            assert!(values.iter().all(is_density), "vehicle {seed}: {name}");
        }
        let cant = 0.1 * (seed as f64 / VEHICLES as f64);
        if let Ok(curving) = export::curve::Curving::new(&case, Some(3.0), Some(cant)) {
            let value = curving.json("random", &case);
            let mut of_curve = Vec::new();
            nulls(&value, "curve", &mut of_curve);
            // Forces and strokes are none outside the model, and only there.
            let forces = [
                "stroke_m",
                "torque_n_m",
                "yaw_state",
                "outer_inner",
                "l_over_v",
            ];
            let is_force = |path: &String| forces.iter().any(|end| path.ends_with(end));
            let none = of_curve.iter().filter(|path| is_force(path)).count();
            let within = value["status"] == "within-model";
            assert_eq!(none, if within { 0 } else { 9 }, "vehicle {seed}");
            if value["status"] != "wheel-lifted" {
                found.extend(of_curve.into_iter().filter(|path| !is_force(path)));
            }
        }
        // No limit up to the tightest curve searched; no mode of that kind.
        let known = [
            "flange",
            "slip",
            "_deg",
            "kinematic_mode",
            "least_damped_mode",
        ];
        found.retain(|path| !known.iter().any(|end| path.ends_with(end)));
        assert!(found.is_empty(), "vehicle {seed}: {found:?}");
    });
}

/// A spec in one system of units. Damping and creep that the case leaves out are left out.
fn spec_text(case: &Case, unit: impl Fn(Quantity) -> DisplayUnit) -> String {
    let mut text = format!("service.track = \"{}\"\n", case.service.track.name);
    for key in keys::case() {
        let Some(si) = key.get(case) else { continue };
        let unit = unit(key.quantity);
        let value = unit.of(si);
        let value = match key.quantity {
            Quantity::Dimensionless => format!("{value:?}"),
            _ => format!("\"{value:?} {}\"", unit.label),
        };
        text.extend([key.path, " = ", &value, "\n"]);
    }
    text
}

/// In SI and in US customary units a spec is the same vehicle to rounding, with the same mistakes and
/// the same doubts.
#[test]
fn systems_of_units_agree() {
    let accepted: u64 = (0..VEHICLES / 2)
        .into_par_iter()
        .map(|seed| {
            let case = any_vehicle(&mut ChaCha8Rng::seed_from_u64(seed), 2.0);
            let read =
                [Quantity::si, Quantity::us].map(|unit| Spec::parse(&spec_text(&case, unit)));
            let [si, us] = match read {
                [Ok(si), Ok(us)] => [si, us],
                [Err(si), Err(us)] => {
                    assert_eq!(si.to_string(), us.to_string(), "vehicle {seed}");
                    return 0;
                }
                [si, us] => panic!("vehicle {seed}: {si:?} against {us:?}"),
            };
            assert_eq!(
                si.doubts.iter().count(),
                us.doubts.iter().count(),
                "vehicle {seed}"
            );
            for key in keys::case() {
                match [&si, &us].map(|spec| key.get(&spec.case)) {
                    // A few roundings of 1e-16 each.
                    [Some(si), Some(us)] => {
                        assert!(
                            (si - us).abs() <= 1e-14 * si.abs(),
                            "{}: {si} {us}",
                            key.path
                        );
                    }
                    [si, us] => assert_eq!(si, us, "{}", key.path),
                }
            }
            1
        })
        .sum();
    assert!(accepted > VEHICLES / 4, "{accepted}");
}

/// Every constant of a case times the powers of the scales of mass, length and time that its
/// dimension has. Gravity stays what it is, so lengths go by the square of times.
fn scaled(case: &Case, mass: f64, time: f64) -> Case {
    let length = time * time;
    let mut scaled = explicit(case);
    for key in keys::case() {
        if let Some(si) = key.get(&scaled) {
            let d = key.quantity.dimension();
            let factor = mass.powi(d.mass) * length.powi(d.length) * time.powi(d.time);
            key.set(&mut scaled, factor * si);
        }
    }
    let model = &mut scaled.model;
    model.frequency_band = model.frequency_band.map(|f| f / time);
    model.speed_range = model.speed_range.map(|v| v * length / time);
    let track = &mut scaled.service.track;
    for spectrum in [
        &mut track.vertical,
        &mut track.alignment,
        &mut track.crosslevel,
    ] {
        let Spectrum::Rational {
            gain,
            power,
            corners,
        } = spectrum
        else {
            panic!("built-in tracks are rational");
        };
        // S' (Ω/L) = L³ S(Ω)
        *gain *= length.powi(3 + 2 * *power - 2 * i32::try_from(corners.len()).unwrap());
        for corner in corners {
            *corner /= length;
        }
    }
    scaled
}

/// A case with nothing left to default values, some of which have a dimension.
fn explicit(case: &Case) -> Case {
    let mut case = case.clone();
    let suspension = case.vehicle.suspension;
    let contact = case.wheel_rail.contact();
    let primary = &mut case.vehicle.suspension.primary;
    primary.longitudinal_damping = Some(suspension.primary.c_px());
    primary.lateral_damping = Some(suspension.primary.c_py());
    primary.vertical_damping = Some(suspension.primary.c_pz());
    case.vehicle.suspension.secondary.yaw_damping = Some(suspension.secondary.c_spsi());
    let w = &mut case.wheel_rail;
    w.creep_factor = 1.0;
    w.lateral_creep = Some(contact.f11);
    w.lateral_spin_creep = Some(contact.f12);
    w.spin_creep = Some(contact.f22);
    w.longitudinal_creep = Some(contact.f33);
    w.roll_coefficient = Some(contact.a11);
    w.contact_angle = Some(contact.delta_0);
    w.contact_angle_difference = Some(contact.delta);
    case
}

/// Froude's law of models: with all lengths 4 times, all times 2 times and all masses 8 times as
/// large, every result is, by its dimension. An equation whose terms differ in dimension, or that
/// holds a constant with one, breaks it. The scales are powers of two, so rounding is the same.
#[test]
fn a_model_vehicle_behaves_as_the_full_size_one() {
    (0..VEHICLES / 10).into_par_iter().for_each(|seed| {
        let case = vehicle(seed);
        let (mass, time) = (8.0, 2.0);
        let length = time * time;
        let model = scaled(&case, mass, time);
        let [full, model] = [&explicit(&case), &model].map(|case| Evaluation::new(case).unwrap());
        let same = |what: &str, full: f64, model: f64, scale: f64| {
            // A limit may be exceeded on straight track.
            if full == 0.0 && model == 0.0 {
                return;
            }
            assert_ratio(
                &format!("vehicle {seed}: {what}"),
                model / scale,
                full,
                1e-9,
            );
        };
        let critical = |e: &Evaluation| e.stability.critical_speed();
        assert_eq!(
            critical(&full).is_some(),
            critical(&model).is_some(),
            "vehicle {seed}"
        );
        if let (Some(full), Some(model)) = (critical(&full), critical(&model)) {
            same("critical speed", full, model, length / time);
        }
        // Near ζ = 1 rounding makes two real modes of one, or one of two.
        let lateral = &model.modes.oscillatory;
        for mode in full
            .modes
            .oscillatory
            .iter()
            .filter(|m| m.damping_ratio < 0.999)
        {
            let wanted = mode.frequency / time;
            let nearest = lateral
                .iter()
                .map(|m| m.frequency)
                .min_by(|a, b| (a - wanted).abs().total_cmp(&(b - wanted).abs()));
            same("frequency", mode.frequency, nearest.unwrap(), 1.0 / time);
        }
        for (full, model) in full.vertical_modes.iter().zip(&model.vertical_modes) {
            same("frequency", full.frequency, model.frequency, 1.0 / time);
        }
        assert_eq!(
            full.curving.is_ok(),
            model.curving.is_ok(),
            "vehicle {seed}"
        );
        if let (Ok(full), Ok(model)) = (&full.curving, &model.curving) {
            // The model's curves are wider, so what the full-size vehicle has lies in the range.
            for (full, model) in full.pieces.iter().zip(&model.pieces) {
                if let Some(full) = full {
                    let [full, model] = [*full, model.unwrap()].map(curvature_of_degree);
                    same("curvature", full, model, 1.0 / length);
                }
            }
        }
        assert_eq!(
            full.lateral.is_ok(),
            model.lateral.is_ok(),
            "vehicle {seed}"
        );
        if let (Ok(full), Ok(model)) = (&full.lateral, &model.lateral) {
            same(
                "acceleration",
                full.acceleration[1],
                model.acceleration[1],
                1.0,
            );
            same(
                "stroke",
                full.secondary_stroke[0],
                model.secondary_stroke[0],
                length,
            );
            same("excursion", full.excursion[3], model.excursion[3], length);
        }
        let [full, model] = [full, model].map(|e| e.vertical.unwrap());
        same(
            "acceleration",
            full.acceleration[2],
            model.acceleration[2],
            1.0,
        );
        same("wheel load", full.wheel_load[0], model.wheel_load[0], mass);
    });
}

/// Transfer functions by elimination in the order of the structure against a dense pivoted
/// factorisation, as in `fast_and_plain.rs`, over many more vehicles.
#[test]
fn spectra_are_those_of_a_dense_factorisation() {
    let frequencies = [0.05, 0.3, 0.8, 1.7, 3.1, 7.0, 18.0, 45.0];
    (0..VEHICLES / 10).into_par_iter().for_each(|seed| {
        let case = vehicle(seed);
        let (track, speed) = (&case.service.track, case.service.speed);
        for model in [
            LateralModel::new(&case).forced,
            VerticalModel::new(&case).forced,
        ] {
            let mut fast = vec![[0.0; LANES]; model.outputs.len()];
            Response::new(&model, track, speed).densities(&frequencies, &mut fast);
            let mut dense = vec![0.0; model.outputs.len()];
            for (l, f) in frequencies.into_iter().enumerate() {
                plain::densities(&model, track, speed, f, &mut dense);
                for (k, (fast, dense)) in fast.iter().zip(&dense).enumerate() {
                    // Strokes at low frequency are differences of much larger motions.
                    let largest = fast.iter().copied().fold(0.0, f64::max);
                    let slack = 1e-6 * dense + 1e-8 * largest;
                    assert!(
                        (fast[l] - dense).abs() <= slack,
                        "vehicle {seed}, output {k}, {f} Hz: {} against {dense}",
                        fast[l]
                    );
                }
            }
        }
    });
}

/// Critical speeds by following the modes against those by full spectra.
#[test]
fn critical_speeds_are_those_of_full_spectra() {
    let compared: u64 = (0..VEHICLES / 50)
        .into_par_iter()
        .map(|seed| {
            let case = vehicle(seed);
            let model = LateralModel::new(&case);
            let fast = Stability::of(&case).unwrap();
            let plain = Stability::by_spectra(&model, case.model.speed_range).unwrap();
            assert_eq!(
                fast.unstable_at_start, plain.unstable_at_start,
                "vehicle {seed}"
            );
            match (fast.critical_speed(), plain.critical_speed()) {
                // As sure as `Stability` promises.
                (Some(fast), Some(plain)) => {
                    assert_ratio(&format!("vehicle {seed}"), fast, plain, 1e-4);
                    1
                }
                (fast, plain) => {
                    assert_eq!(fast, plain, "vehicle {seed}");
                    0
                }
            }
        })
        .sum();
    assert!(compared > VEHICLES / 200, "{compared}");
}

/// Refining the frequency grid changes no mean square by more than the 1e-6 that is promised.
#[test]
fn refinement_changes_nothing() {
    (0..VEHICLES / 10).into_par_iter().for_each(|seed| {
        let case = vehicle(seed);
        let speed = case.service.speed;
        for model in [
            LateralModel::new(&case).forced,
            VerticalModel::new(&case).forced,
        ] {
            let poles = Poles::at(&model, speed).unwrap();
            if !poles.stable() {
                continue;
            }
            let outputs = model.outputs.len();
            let edges = response_panels(&model, &case, &poles);
            let halves = edges.windows(2).map(|ends| (ends[0] * ends[1]).sqrt());
            let mut finer: Vec<f64> = edges.iter().copied().chain(halves).collect();
            finer.sort_by(f64::total_cmp);
            let [coarse, fine] = [(&edges, 1e-6), (&finer, 1e-11)].map(|(edges, tolerance)| {
                let mut response = Response::new(&model, &case.service.track, speed);
                integrate(edges, [outputs; 2], tolerance, |f, v| {
                    response.densities(f, v);
                })
            });
            assert!(coarse.converged && fine.converged, "vehicle {seed}");
            for k in 0..outputs {
                let what = format!("vehicle {seed}, output {k} at {speed} m/s");
                assert_ratio(&what, coarse.total(k), fine.total(k), 1e-6);
            }
        }
    });
}
