//! The command as a user calls it.

use std::fs;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

fn bogie() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_bogie"));
    command.current_dir(env!("CARGO_MANIFEST_DIR"));
    command
}

fn output(args: &[&str]) -> (i32, String, String) {
    let output = bogie().args(args).output().unwrap();
    (
        output.status.code().unwrap(),
        String::from_utf8(output.stdout).unwrap(),
        String::from_utf8(output.stderr).unwrap(),
    )
}

fn json(args: &[&str]) -> (i32, Value) {
    let (code, stdout, stderr) = output(args);
    let value = serde_json::from_str(&stdout).unwrap_or_else(|e| panic!("{e}: {stdout}{stderr}"));
    (code, value)
}

#[test]
fn evaluate_writes_the_agreed_keys() {
    let (code, value) = json(&["evaluate", "problems/prototype.toml", "--format", "json"]);
    assert_eq!(code, 0);
    let cases: Value = serde_json::from_str(include_str!("../data/cases.json")).unwrap();
    assert_eq!(cases[0]["name"], "prototype");
    same_keys(&cases[0]["outputs_si"], &value, "");
    assert_eq!(value["modes_at_speed"].as_array().unwrap().len(), 13);
    let speed = value["critical_speed_m_per_s"].as_f64().unwrap();
    let expected = cases[0]["outputs_si"]["critical_speed_m_per_s"]
        .as_f64()
        .unwrap();
    assert!((speed / expected - 1.0).abs() < 1e-5);
    assert_eq!(value["inputs_si"]["wheel_rail.conicity"], 0.05);
}

/// Every key of `expected` is in `found` with a value of the same kind.
fn same_keys(expected: &Value, found: &Value, path: &str) {
    if let Some(object) = expected.as_object() {
        for (key, value) in object {
            assert!(found.get(key).is_some(), "{path}.{key} is missing");
            same_keys(value, &found[key], &format!("{path}.{key}"));
        }
    } else if let Some(list) = expected.as_array() {
        assert_eq!(found.as_array().map(Vec::len), Some(list.len()), "{path}");
    } else {
        assert_eq!(found.is_number(), expected.is_number(), "{path}");
    }
}

#[test]
fn a_spec_may_come_from_standard_input() {
    let source = fs::read(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/problems/prototype.toml"
    ))
    .unwrap();
    let piped = bogie()
        .args(["evaluate", "-", "--format", "json"])
        .write_stdin(source)
        .output()
        .unwrap();
    let piped: Value = serde_json::from_slice(&piped.stdout).unwrap();
    let (_, named) = json(&["evaluate", "problems/prototype.toml", "--format", "json"]);
    assert_eq!(piped["lateral"], named["lateral"]);
}

#[test]
fn every_command_writes_text_and_json() {
    for command in ["evaluate", "modes", "curve", "psd"] {
        let (code, text, _) = output(&[command, "problems/urban-80mph.toml"]);
        assert_eq!(code, 0, "{command}");
        assert!(text.contains("80.00 mph"), "{command}: {text}");
        assert!(!text.contains("NaN"), "{command}: {text}");
        let (code, value) = json(&[command, "problems/urban-80mph.toml", "--format", "json"]);
        assert_eq!(code, 0, "{command}");
        assert!(value.is_object());
    }
}

#[test]
fn curve_at_a_given_degree_and_cant_deficiency() {
    let args = [
        "curve",
        "problems/prototype.toml",
        "--degree",
        "3",
        "--cant-deficiency",
        "3 in",
    ];
    let (code, value) = json(&[&args[..], &["--format", "json"]].concat());
    assert_eq!(code, 0);
    // 3 in over 56 in: the report's 3.07°.
    let angle = value["cant_deficiency_rad"].as_f64().unwrap().to_degrees();
    assert!((angle - 3.07).abs() < 0.005, "{angle}");
    // 50 ft / sin 1.5°
    assert!((value["radius_m"].as_f64().unwrap() - 582.2).abs() < 0.1);
    let (code, _, stderr) = output(&["curve", "problems/prototype.toml", "--degree", "40"]);
    assert_eq!(code, 2);
    assert!(stderr.contains("0.001 to 25"), "{stderr}");
}

#[test]
fn psd_as_csv() {
    let (code, text, _) = output(&["psd", "problems/prototype.toml", "--csv", "--points", "50"]);
    assert_eq!(code, 0);
    assert_eq!(text.lines().count(), 51);
    let columns = text.lines().next().unwrap().split(',').count();
    for line in text.lines().skip(1) {
        let values: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
        assert!(values.len() == columns && values.iter().all(|x| x.is_finite() && *x >= 0.0));
    }
}

#[test]
fn optimize_meets_the_requirements_of_the_example() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().to_str().unwrap();
    let args = [
        "optimize",
        "problems/intercity-130mph.toml",
        "--format",
        "json",
        "--out",
        out,
    ];
    let (code, stdout, _) = output(&args);
    assert_eq!((code, stdout.as_str()), (0, ""));
    let value: Value =
        serde_json::from_str(&fs::read_to_string(folder.path().join("optimize.json")).unwrap())
            .unwrap();
    assert_eq!(value["requirements_met"], true);
    // 200 mph, and more curve than the published design has in our model.
    assert!(value["critical_speed_m_per_s"].as_f64().unwrap() >= 200.0 * 0.44704 * (1.0 - 1e-4));
    let degree = value["flange_limited_curve_deg"].as_f64().unwrap();
    assert!(
        degree
            > value["as_given"]["flange_limited_curve_deg"]
                .as_f64()
                .unwrap()
    );
    // The profile that the report reads off its Figure 4.5.13.
    assert_eq!(value["design_si"]["wheel_rail.conicity"], 0.05);
    for stroke in value["lateral"]["secondary_stroke_rms_m"]
        .as_array()
        .unwrap()
    {
        assert!(3.0 * stroke.as_f64().unwrap() <= 1.5 * 0.0254 * (1.0 + 1e-5));
    }
    // Each variable of the trade-offs is free over a range that holds the optimum and the design delivered.
    assert_eq!(value["prefer"], "as-given");
    assert!(value["loss"].as_f64().unwrap() <= 1e-3 * (1.0 + 1e-6));
    let stages = value["trade_offs"].as_array().unwrap().iter();
    let variables: Vec<&Value> = stages
        .flat_map(|stage| stage["variables"].as_array().unwrap())
        .collect();
    assert_eq!(variables.len(), 6);
    for variable in variables {
        let number = |key: &str| variable[key].as_f64().unwrap();
        let range = number("free_from_si")..=number("free_to_si");
        for key in ["value_si", "delivered_si"] {
            // Rounding of a coordinate on the way to a value and back.
            let near = |factor: f64| range.contains(&(factor * number(key)));
            assert!(near(1.0 - 1e-9) || near(1.0 + 1e-9), "{variable}");
        }
        assert!((number("free_within") - 0.01).abs() < 1e-15);
    }
    // Only the result and its journal are left in the folder: nothing half-written.
    let mut left: Vec<_> = fs::read_dir(folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    left.sort();
    assert_eq!(left, ["optimize.journal", "optimize.json"]);
}

const IMPOSSIBLE: &str = r#"
[vehicle]
base = "prototype"
[wheel_rail]
conicity = 0.25
[design]
primary_bending_stiffness = ["1e6 lbf ft/rad", "1e7 lbf ft/rad"]
primary_lateral_stiffness = ["5e5 lbf/ft", "5e6 lbf/ft"]
[requirements]
critical_speed = "400 mph"
"#;

#[test]
fn what_cannot_be_met_exits_with_3_and_the_best_compromise() {
    let run = bogie()
        .args(["optimize", "-", "--format", "json"])
        .write_stdin(IMPOSSIBLE)
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(3));
    let value: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(value["requirements_met"], false);
    let unmet = &value["unmet"][0];
    assert_eq!(unmet["key"], "requirements.critical_speed");
    let reached = unmet["reached_si"].as_f64().unwrap();
    assert_eq!(value["critical_speed_m_per_s"], reached);
    assert!(reached > 100.0 * 0.44704 && reached < 400.0 * 0.44704);
}

/// The same spec and seed give the same bits on any number of threads.
#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let runs = ["1", "2", "5"].map(|threads| {
        let args = [
            "optimize",
            "problems/conicity-0.10.toml",
            "--format",
            "json",
        ];
        bogie()
            .args(args)
            .env("RAYON_NUM_THREADS", threads)
            .output()
            .unwrap()
            .stdout
    });
    assert!(!runs[0].is_empty());
    assert!(runs[0] == runs[1] && runs[1] == runs[2]);
}

#[test]
fn a_wrong_spec_exits_with_2_and_writes_nothing() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("results");
    let source = "[vehicle]\nbase = \"prototype\"\n[vehicle.carbody]\nmas = \"2500 slug\"\n";
    let run = bogie()
        .args(["optimize", "-", "--out", out.to_str().unwrap()])
        .write_stdin(source)
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(2));
    assert!(run.stdout.is_empty() && !out.exists());
    let stderr = String::from_utf8(run.stderr).unwrap();
    assert!(
        stderr.contains("4:1") && stderr.contains("`mass`"),
        "{stderr}"
    );
}

#[test]
fn wrong_calls_exit_with_2() {
    for args in [
        &["evaluate"][..],
        &["evaluate", "no-such-file.toml"],
        &["evaluate", "problems"],
        &["evaluate", "problems/prototype.toml", "--format", "yaml"],
        &["frobnicate", "problems/prototype.toml"],
        &["modes", "problems/prototype.toml", "--speeds", "60 parsecs"],
        &["optimize", "problems/prototype.toml"],
    ] {
        let (code, stdout, stderr) = output(args);
        assert_eq!(code, 2, "{args:?}: {stderr}");
        assert!(stdout.is_empty() && !stderr.is_empty(), "{args:?}");
    }
}

/// Every command's help ends with the same exit codes.
#[test]
fn every_help_states_the_exit_codes() {
    let help = |args: &[&str]| {
        let (code, stdout, _) = output(&[args, &["--help"]].concat());
        assert_eq!(code, 0);
        let at = stdout.find("Exit codes:").expect("exit codes");
        (stdout[at..].to_owned(), stdout)
    };
    let (codes, whole) = help(&[]);
    for code in [
        "0  done",
        "1  a failure",
        "2  a wrong call",
        "3  requirements",
        "4  ended early",
    ] {
        assert!(codes.contains(&format!("\n  {code}")), "{codes}");
    }
    let commands = whole
        .lines()
        .skip_while(|line| *line != "Commands:")
        .skip(1);
    // Descriptions that take a second line are set further in.
    let names: Vec<&str> = commands
        .take_while(|line| !line.is_empty())
        .filter(|line| !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|name| *name != "help")
        .collect();
    assert_eq!(names.len(), 13, "{names:?}");
    for name in names {
        assert_eq!(help(&[name]).0, codes, "{name}");
    }
}

/// Numbers out of range are answered with the range.
#[test]
fn options_out_of_range() {
    let spec = "problems/intercity-130mph.toml";
    for (args, remedy) in [
        (&["sweep", spec, "--designs", "0"][..], "from 1 to"),
        (&["sweep", spec, "--designs", "-3"], "from 1 to"),
        (&["pareto", spec, "--points", "1"], "expected 2 to 2000"),
        (&["pareto", spec, "--budget", "0"], "not in 1.."),
        (
            &["sensitivity", spec, "--spread", "-1"],
            "from 0 to below 1",
        ),
        (&["sensitivity", spec, "--samples", "1"], "not in 2.."),
        (&["psd", spec, "--points", "-1"], "not in 2.."),
        (&["curve", spec, "--degree", "-1"], "0.001 to 25"),
        (&["curve", spec, "--degree", "nan"], "0.001 to 25"),
        // A radius that no number holds.
        (&["curve", spec, "--degree", "5e-324"], "0.001 to 25"),
        (&["modes", spec, "--speeds", "0 mph"], "0.001 m/s to"),
        (&["modes", spec, "--speeds", "1e300 mph"], "to 10000 m/s"),
        (
            &["modes", spec, "--speeds", "1e400 mph"],
            "not a finite number",
        ),
    ] {
        let (code, stdout, stderr) = output(args);
        assert_eq!((code, stdout.as_str()), (2, ""), "{args:?}: {stderr}");
        assert!(stderr.contains(remedy), "{args:?}: {stderr}");
    }
}

#[test]
fn an_unwritable_place_is_a_failure() {
    let (code, _, stderr) = output(&[
        "evaluate",
        "problems/prototype.toml",
        "--out",
        "/proc/nowhere",
    ]);
    assert_eq!(code, 1);
    assert!(stderr.contains("cannot write"), "{stderr}");
}

#[test]
fn init_writes_a_spec_that_checks_and_never_overwrites() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("new.toml");
    let path = path.to_str().unwrap();
    assert_eq!(output(&["init", path]).0, 0);
    assert_eq!(output(&["check", path]).0, 0);
    assert_eq!(output(&["optimize", path]).0, 0);
    assert_eq!(output(&["init", path]).0, 2);
}

#[test]
fn an_unstable_vehicle_has_no_lateral_ride() {
    let source = "[vehicle]\nbase = \"prototype\"\n[service]\nspeed = \"300 mph\"\n";
    let run = bogie()
        .args(["evaluate", "-", "--format", "json"])
        .write_stdin(source)
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(0));
    let value: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert!(value["lateral"].is_null() && value["vertical"].is_object());
    assert!(!value["warnings"].as_array().unwrap().is_empty());
}
