//! What several test programs share.
#![allow(dead_code)]

use bogie::{
    case::{Case, Crosslevel, TruckRoll},
    spec::{Spec, keys},
    units::us::{FOOT, LBF, MILE},
};
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use serde_json::Value;

/// One mile per hour, m/s.
pub const MPH: f64 = MILE / 3600.0;
/// One ft-lbf/rad, N m/rad.
pub const LBF_FT: f64 = LBF * FOOT;
/// One lbf/ft, N/m.
pub const LBF_PER_FT: f64 = LBF / FOOT;

/// The vehicles with results from an independent program.
pub fn reference_cases() -> Vec<(String, Case, Value)> {
    let cases: Value = serde_json::from_str(include_str!("../data/cases.json")).unwrap();
    let cases = cases.as_array().unwrap().iter();
    cases
        .map(|entry| {
            let name = entry["name"].as_str().unwrap().to_string();
            (name, case_of(entry), entry["outputs_si"].clone())
        })
        .collect()
}

fn case_of(entry: &Value) -> Case {
    let mut case = Case::prototype();
    case.service.speed = entry["speed_m_per_s"].as_f64().unwrap();
    for (path, value) in entry["inputs_si"].as_object().unwrap() {
        if path == "model.truck_roll" {
            if value == "dynamic" {
                case.model.truck_roll = TruckRoll::Dynamic;
            }
            continue;
        }
        let key = keys::at(path).expect(path);
        key.set(&mut case, value.as_f64().unwrap());
    }
    case
}

/// A vehicle with every parameter of the prototype's changed by up to a factor either way.
pub fn random_vehicle(rng: &mut ChaCha8Rng, factor: f64) -> Case {
    let prototype = Case::prototype();
    let mut case = prototype.clone();
    for key in keys::case() {
        if let Some(value) = key.get(&prototype) {
            let changed = value * factor.powf(rng.random_range(-1.0..1.0));
            if key.range.contains(changed) {
                key.set(&mut case, changed);
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

/// A spec of `problems/`.
pub fn problem(name: &str) -> Spec {
    let path = format!("{}/problems/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    let source = std::fs::read_to_string(&path).expect(&path);
    Spec::parse(&source)
        .unwrap_or_else(|mistakes| panic!("{}", mistakes.render(name, &source, false)))
}

/// Asserts that a ratio is what it should be within a tolerance.
pub fn assert_ratio(what: &str, ours: f64, theirs: f64, tolerance: f64) {
    let ratio = ours / theirs;
    assert!(
        (ratio - 1.0).abs() <= tolerance,
        "{what}: {ours} against {theirs}, ratio {ratio}, tolerance {tolerance}"
    );
}

/// Names and bytes of the specs in a folder of `problems/`, sorted; "" for `problems/` itself.
pub fn problem_files(folder: &str) -> Vec<(String, Vec<u8>)> {
    let folder = format!("{}/problems/{folder}", env!("CARGO_MANIFEST_DIR"));
    let entries = std::fs::read_dir(&folder).expect(&folder);
    let mut files: Vec<(String, Vec<u8>)> = entries
        .map(|entry| entry.expect("an entry of a folder").path())
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "toml")
        })
        .map(|path| {
            let name = path.file_name().expect("a file").to_string_lossy();
            (
                name.into_owned(),
                std::fs::read(&path).expect("a readable file"),
            )
        })
        .collect();
    files.sort();
    files
}

/// A spec of `tests/data/numerics/`.
pub fn numerics(name: &str) -> Spec {
    let path = format!(
        "{}/tests/data/numerics/{name}.toml",
        env!("CARGO_MANIFEST_DIR")
    );
    let source = std::fs::read_to_string(&path).expect(&path);
    Spec::parse(&source)
        .unwrap_or_else(|mistakes| panic!("{}", mistakes.render(name, &source, false)))
}

/// The plain parameters of Table 4.1.1.
#[allow(dead_code)]
pub fn ten() -> Vec<bogie::parameter::Parameter> {
    bogie::parameter::Parameter::plain_of_table().collect()
}
