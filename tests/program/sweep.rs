//! `bogie sweep`: the same lines however they come about, and the values of `bogie evaluate`.

use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;

const SPEC: &str = r#"
[service]
speed = "110 mph"
track = "fra-class-6"
[vehicle]
base = "prototype"
[design]
primary_bending_stiffness = ["1e6 lbf ft/rad", "2e7 lbf ft/rad"]
primary_lateral_stiffness = ["1e5 lbf/ft", "5e6 lbf/ft"]
conicity.choices = [0.05, 0.1]
[limits]
secondary_lateral_stroke = "2 in"
[requirements]
critical_speed = "150 mph"
"#;

fn bogie() -> Command {
    Command::cargo_bin("bogie").unwrap()
}

/// Standard output of a sweep of a spec on standard input.
fn sweep(spec: &str, arguments: &[&str]) -> String {
    let mut command = bogie();
    command.args(["sweep", "-"]).args(arguments);
    let output = command.write_stdin(spec).assert().success();
    String::from_utf8(output.get_output().stdout.clone()).unwrap()
}

#[test]
fn lines_do_not_depend_on_threads() {
    let on = |threads: &str| {
        let mut command = bogie();
        command.env("RAYON_NUM_THREADS", threads);
        command.args(["sweep", "-", "--designs", "300"]);
        let output = command.write_stdin(SPEC).assert().success();
        output.get_output().stdout.clone()
    };
    let one = on("1");
    assert_eq!(String::from_utf8_lossy(&one).lines().count(), 301);
    assert_eq!(one, on("2"));
    assert_eq!(one, on("5"));
}

/// The first designs of a longer sweep are those of a shorter one; another seed gives others.
#[test]
fn designs_are_a_numbered_sequence() {
    let long = sweep(SPEC, &["--designs", "60"]);
    let short = sweep(SPEC, &["--designs", "37"]);
    assert!(long.starts_with(&short));
    assert_ne!(long, sweep(SPEC, &["--designs", "60", "--seed", "5"]));
    assert_eq!(long, sweep(SPEC, &["--designs", "60", "--seed", "1"]));
}

#[test]
fn a_resumed_sweep_equals_a_whole_one() {
    for (format, heads) in [("csv", 1), ("json", 0)] {
        let whole = sweep(SPEC, &["--designs", "50", "--format", format]);
        let folder = tempfile::tempdir().unwrap();
        let run = |designs: &str, more: &[&str]| {
            let mut command = bogie();
            command.args(["sweep", "-", "--designs", designs, "--format", format]);
            command.arg("--out").arg(folder.path()).args(more);
            command.write_stdin(SPEC).assert().success();
        };
        run("20", &[]);
        let path = folder.path().join(format!("sweep.{format}"));
        let partial = folder.path().join(format!("sweep.{format}.partial"));
        let lines = |n: usize| -> String { whole.split_inclusive('\n').take(n).collect() };
        assert_eq!(std::fs::read_to_string(&path).unwrap(), lines(20 + heads));
        assert!(!partial.exists());
        // Cut off within a line, as by a crash; after the first line; at once.
        for cut in [lines(33).len() + 17, lines(1).len(), 0] {
            std::fs::write(&partial, &whole[..cut]).unwrap();
            run("50", &["--resume"]);
            assert_eq!(std::fs::read_to_string(&path).unwrap(), whole);
            assert!(!partial.exists());
        }
        // A finished sweep is gone on with where more are asked for, and cut where fewer are.
        run("20", &["--resume"]);
        assert_eq!(std::fs::read_to_string(&path).unwrap(), lines(20 + heads));
        run("50", &["--resume"]);
        assert_eq!(std::fs::read_to_string(&path).unwrap(), whole);
    }
}

#[test]
fn another_sweep_is_not_resumed() {
    let folder = tempfile::tempdir().unwrap();
    let run = |seed: &str, resume: &[&str]| {
        let mut command = bogie();
        command.args(["sweep", "-", "--designs", "3", "--seed", seed]);
        command.arg("--out").arg(folder.path()).args(resume);
        command.write_stdin(SPEC).assert()
    };
    run("1", &["--resume"]).code(2);
    run("1", &[]).success();
    let refused = run("2", &["--resume"]).code(2);
    let text = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(text.contains("belongs to another spec"), "{text}");
    run("1", &["--resume"]).success();
}

/// A design's line says what `bogie evaluate` says of a spec with its constants.
#[test]
fn values_are_those_of_evaluate() {
    let indices = "critical_speed,flange_limited_curve,slip_limited_curve,lateral_acceleration,\
                   vertical_acceleration";
    let text = sweep(
        SPEC,
        &["--designs", "12", "--format", "json", "--indices", indices],
    );
    let mut compared = 0;
    for line in text.lines() {
        let row: Value = serde_json::from_str(line).unwrap();
        let number = |key: &str| row[key].as_f64();
        let constants = format!(
            "[service]\nspeed = \"110 mph\"\ntrack = \"fra-class-6\"\n\
             [vehicle]\nbase = \"prototype\"\n[wheel_rail]\nconicity = {}\n\
             [suspension.primary]\nlongitudinal_stiffness = \"{:e} N/m\"\n\
             lateral_stiffness = \"{:e} N/m\"\n",
            number("conicity").unwrap(),
            // K_px = K_b / d_p², d_p = 2 ft.
            number("primary_bending_stiffness_n_m_per_rad").unwrap() / 0.6096_f64.powi(2),
            number("primary_lateral_stiffness_n_per_m").unwrap(),
        );
        let mut command = bogie();
        command.args(["evaluate", "-", "--format", "json"]);
        let output = command.write_stdin(constants).assert().success();
        let evaluated: Value = serde_json::from_slice(&output.get_output().stdout).unwrap();
        let pairs = [
            (
                "critical_speed_m_per_s",
                &evaluated["critical_speed_m_per_s"],
            ),
            (
                "flange_limited_curve_deg",
                &evaluated["flange_limited_curve_deg"],
            ),
            (
                "slip_limited_curve_deg",
                &evaluated["slip_limited_curve_deg"],
            ),
            (
                "lateral_acceleration_m_per_s2",
                &evaluated["lateral"]["acceleration_average_m_per_s2"],
            ),
            (
                "vertical_acceleration_m_per_s2",
                &evaluated["vertical"]["acceleration_average_m_per_s2"],
            ),
        ];
        for (key, expected) in pairs {
            match (number(key), expected.as_f64()) {
                (Some(value), Some(expected)) => {
                    // Constants pass through units and text, which costs a few last digits; K_b is
                    // set through K_px. RMS values are integrated to 1e-6 on panels that follow
                    // the poles.
                    assert!((value / expected - 1.0).abs() < 1e-9, "{key}: {row}");
                    compared += 1;
                }
                (None, None) => {}
                (value, expected) => panic!("{key}: {value:?} against {expected:?}: {row}"),
            }
        }
    }
    assert!(compared > 40, "only {compared} values compared");
}

/// Where a design has no value the cell is empty, the status says why, and nothing is met by it.
#[test]
fn what_has_no_value_says_so() {
    let spec = SPEC.replace("110 mph", "260 mph");
    let text = sweep(&spec, &["--designs", "64"]);
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let names = reader.headers().unwrap().clone();
    let at = |name: &str| names.iter().position(|n| n == name).unwrap();
    let (acceleration, met, status, codes) = (
        at("lateral_acceleration_m_per_s2"),
        at("meets_all"),
        at("status"),
        at("status_codes"),
    );
    let mut unstable = 0;
    for record in reader.records() {
        let record = record.unwrap();
        assert!(!record.iter().any(|field| field.contains("NaN")));
        if record[acceleration].is_empty() {
            unstable += 1;
            assert_eq!(&record[met], "no");
            assert!(
                record[status].contains("lateral_acceleration: unstable at the operating speed")
                    && record[codes].contains("lateral_acceleration: unstable")
            );
        }
    }
    assert!(unstable > 5, "{unstable}");
}

/// A demand on forces outside the model is not assessed; what is not met besides counts first; within the
/// model there is a value and a verdict.
#[test]
fn forces_outside_the_model_are_not_assessed() {
    let spec = SPEC.replace("track =", "curve = \"1 deg\"\ntrack =");
    let spec = format!("{spec}least_damping_ratio = 0.02\n").replace(
        "[limits]\n",
        "[limits]\nwheel_l_over_v = 0.8\nsecondary_lateral_stroke_in_curve = \"3 in\"\n",
    );
    let lines = sweep(&spec, &["--designs", "64", "--format", "json"]);
    let (mut open, mut failed, mut within) = (0, 0, 0);
    for line in lines.lines() {
        let row: Value = serde_json::from_str(line).unwrap();
        let status = row["status"].as_str().unwrap();
        let ratio = row["wheel_l_over_v"].as_f64();
        assert_eq!(
            ratio.is_none(),
            status.contains("wheel_l_over_v: outside-model")
        );
        let is_outside = ratio.is_none();
        if is_outside {
            assert!(row["secondary_lateral_stroke_in_curve_m"].is_null());
            let below = row["critical_speed_m_per_s"]
                .as_f64()
                .is_none_or(|v| v < 67.05);
            match row["meets_all"].as_str().unwrap() {
                "not-assessed" => {
                    assert!(!below, "{row}");
                    open += 1;
                }
                verdict => {
                    assert_eq!(verdict, "no", "{row}");
                    failed += 1;
                }
            }
        } else {
            assert_ne!(row["meets_all"], "not-assessed");
            within += 1;
        }
    }
    assert!(
        open > 3 && failed > 3 && within > 3,
        "{open} {failed} {within}"
    );
}

/// What is asked of the stroke in a curve holds in the conditions that give one.
#[test]
fn a_curve_in_a_condition_alone() {
    let spec = format!(
        "{SPEC}\n[conditions.curved]\nservice.curve = \"0.2 deg\"\nservice.cant_deficiency = \"1 deg\"\n"
    )
    .replace("[limits]\n", "[limits]\nsecondary_lateral_stroke_in_curve = \"BOUND\"\n");
    let met = |bound: &str| {
        let text = sweep(&spec.replace("BOUND", bound), &["--designs", "32"]);
        assert!(text.contains("secondary_lateral_stroke_in_curve: no curve in [service]"));
        text.matches(",yes,").count()
    };
    let [wide, narrow] = ["9 in", "0.1 in"].map(met);
    assert!(wide > 0 && narrow == 0, "{wide} {narrow}");
}

/// What is asked in a condition counts too.
#[test]
fn conditions_are_asked_as_well() {
    let met = |spec: &str| {
        let text = sweep(spec, &["--designs", "64", "--indices", "critical_speed"]);
        let lines = text.lines().skip(1);
        lines.map(|line| line.contains(",yes,")).collect::<Vec<_>>()
    };
    let alone = met(SPEC);
    let worn = met(&format!(
        "{SPEC}\n[conditions.worn]\nwheel_rail.conicity = 0.12\n"
    ));
    let count = |met: &[bool]| met.iter().filter(|met| **met).count();
    assert!(
        alone
            .iter()
            .zip(&worn)
            .all(|(alone, worn)| *alone || !*worn)
    );
    assert!(0 < count(&worn) && count(&worn) < count(&alone), "{worn:?}");
}

#[test]
fn bad_arguments() {
    let refuse = |spec: &str, arguments: &[&str], saying: &str| {
        let mut command = bogie();
        command.args(["sweep", "-"]).args(arguments);
        let refused = command.write_stdin(spec).assert().code(2).stdout("");
        let text = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
        assert!(text.contains(saying), "{text}");
    };
    refuse(SPEC, &[], "--designs");
    refuse(SPEC, &["--designs", "0"], "expected a whole number from 1");
    refuse(
        SPEC,
        &["--designs", "many"],
        "expected a whole number from 1",
    );
    refuse(SPEC, &["--designs", "3", "--resume"], "--out");
    refuse(
        SPEC,
        &["--designs", "3", "--indices", "comfort"],
        "unknown index `comfort`",
    );
    refuse(
        "[vehicle]\nbase = \"prototype\"",
        &["--designs", "3"],
        "design",
    );
}

/// A reader that has seen enough ends the sweep without a word.
#[cfg(unix)]
#[test]
fn a_closed_pipe_ends_it_quietly() {
    let folder = tempfile::tempdir().unwrap();
    let spec = folder.path().join("spec.toml");
    std::fs::write(&spec, SPEC).unwrap();
    let program: &Path = assert_cmd::cargo::cargo_bin!("bogie");
    let mut child = std::process::Command::new(program)
        .args(["sweep", "--designs", "1000000"])
        .arg(&spec)
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}
