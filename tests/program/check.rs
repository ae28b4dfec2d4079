//! `bogie check` and `bogie schema`, and the doubts about a spec in the results of other commands.

use std::fs;

use assert_cmd::Command;
use serde_json::Value;
use sha2::{Digest, Sha256};

const DOUBTFUL: &str = "problems/doubtful/critical-speed-below-speed.toml";

/// Exit code, standard output as JSON, standard error.
fn json(args: &[&str]) -> (i32, Value, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_bogie"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(args)
        .output()
        .unwrap();
    let value = serde_json::from_slice(&output.stdout).expect("JSON");
    let stderr = String::from_utf8(output.stderr).unwrap();
    (output.status.code().unwrap(), value, stderr)
}

#[test]
fn mistakes_as_json_stand_where_an_editor_shows_them() {
    let args = [
        "check",
        "problems/invalid/several-mistakes.toml",
        "--format",
        "json",
    ];
    let (code, answer, _) = json(&args);
    assert_eq!((code, &answer["valid"]), (2, &Value::Bool(false)));
    let mistakes = answer["mistakes"].as_array().unwrap();
    assert_eq!(mistakes.len(), 7);
    let third = &mistakes[2];
    assert_eq!((&third["line"], &third["column"]), (&9.into(), &1.into()));
    assert_eq!(third["help"], "did you mean `mass`?");
}

#[test]
fn a_spec_in_order_is_said_to_be() {
    let (code, answer, stderr) = json(&["check", "problems/prototype.toml", "--format", "json"]);
    assert_eq!((code, stderr.as_str()), (0, ""));
    assert_eq!(answer["valid"], true);
    assert_eq!(answer["warnings"], Value::Array(Vec::new()));
}

/// Text has them on standard error with their lines, JSON in the result as well, beside what it comes
/// from.
#[test]
fn doubts_stand_in_every_result() {
    for command in ["evaluate", "modes", "curve", "psd"] {
        let (code, result, stderr) = json(&[command, DOUBTFUL, "--format", "json"]);
        assert_eq!(code, 0, "{command}");
        assert!(
            stderr.contains("critical-speed-below-speed.toml:8:18"),
            "{command}: {stderr}"
        );
        let warnings = result["warnings"].as_array().unwrap().iter();
        let of_the_spec = warnings.filter(|w| w.as_str().unwrap().contains("asked for"));
        assert_eq!(of_the_spec.count(), 2, "{command}");
        assert_eq!(
            result["program"],
            concat!("bogie ", env!("CARGO_PKG_VERSION"))
        );
        let digest = format!("{:x}", Sha256::digest(fs::read(DOUBTFUL).unwrap()));
        assert_eq!(result["spec_sha256"], digest.as_str(), "{command}");
    }
    let (code, answer, _) = json(&["check", DOUBTFUL, "--format", "json"]);
    assert_eq!(code, 0);
    assert_eq!(answer["warnings"][0]["line"], 8);
}

/// Whatever the command, its JSON says which program wrote it and which version its keys have.
#[test]
fn every_result_names_program_and_schema_version() {
    let spec = "problems/conicity-0.10.toml";
    for args in [
        &["evaluate", spec][..],
        &["modes", spec],
        &["curve", spec],
        &["psd", spec, "--points", "5"],
        &["check", spec],
        &["check", "problems/invalid/several-mistakes.toml"],
        &["optimize", spec, "--budget", "5"],
        &["pareto", spec, "--budget", "5"],
        &["sensitivity", spec, "--samples", "2"],
        &["chart", "--list"],
        &["chart", spec, "3.4.3", "--files", "json"],
    ] {
        let (_, result, _) = json(&[args, &["--format", "json"]].concat());
        let program = concat!("bogie ", env!("CARGO_PKG_VERSION"));
        assert_eq!(result["program"], program, "{args:?}");
        assert_eq!(result["schema_version"], 1, "{args:?}");
    }
}

#[test]
fn the_schema_is_printed() {
    let (code, schema, _) = json(&["schema"]);
    assert_eq!(code, 0);
    assert_eq!(schema, bogie::spec::schema::schema());
}
