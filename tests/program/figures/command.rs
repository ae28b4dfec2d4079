//! `bogie chart` as a user calls it.

use std::fs;

use assert_cmd::Command;
use serde_json::Value;
use tempfile::TempDir;

fn chart(args: &[&str]) -> (i32, Vec<u8>, String) {
    let mut call = vec!["problems/prototype.toml"];
    call.extend(args);
    run(&call)
}

fn run(args: &[&str]) -> (i32, Vec<u8>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_bogie"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .arg("chart")
        .args(args)
        .output()
        .unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    (output.status.code().unwrap(), output.stdout, errors)
}

#[test]
fn it_lists_the_book() {
    let (code, text, _) = run(&["--list"]);
    let text = String::from_utf8(text).unwrap();
    assert_eq!(code, 0);
    for part in ["3.2.1", "4.5.11, 4.6.1", "envelopes", "A.2"] {
        assert!(text.contains(part), "{part}");
    }
    let (code, json, _) = run(&["--list", "--format", "json"]);
    let value: Value = serde_json::from_slice(&json).unwrap();
    assert_eq!((code, value["charts"].as_array().unwrap().len()), (0, 38));
}

#[test]
fn one_chart_goes_to_standard_output() {
    let (code, svg, _) = chart(&["3.4.3"]);
    let svg = String::from_utf8(svg).unwrap();
    assert_eq!(code, 0);
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
    let (code, si, _) = chart(&["track-crosslevel", "--units", "si"]);
    assert_eq!(code, 0);
    assert!(si != svg.as_bytes());
}

/// A build without the feature names it, and draws nothing.
#[test]
fn a_picture_needs_a_feature_of_the_build() {
    let (code, png, errors) = chart(&["Figure 3.4.3", "--files", "png"]);
    if cfg!(feature = "png") {
        assert_eq!(code, 0, "{errors}");
        assert!(png.starts_with(b"\x89PNG") && png.ends_with(b"IEND\xaeB`\x82"));
    } else {
        assert_eq!((code, png.len()), (2, 0));
        let message = "charts as PNG need a build with `--features png`";
        assert!(errors.contains(message), "{errors}");
    }
}

#[test]
fn files_are_written_and_listed() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("charts");
    let out = out.to_str().unwrap();
    let (code, json, errors) = chart(&["4.4.2", "A.2", "--out", out, "--format", "json"]);
    assert_eq!(code, 0, "{errors}");
    let value: Value = serde_json::from_slice(&json).unwrap();
    let files: Vec<&str> = value["charts"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|chart| chart["files"].as_array().unwrap())
        .map(|file| file.as_str().unwrap())
        .collect();
    assert_eq!(
        files,
        [
            "4.4.2-lateral-spectrum.svg",
            "4.4.2-lateral-spectrum-c.csv",
            "4.4.2-lateral-spectrum-d.csv",
            "A.2-breakaway-torque.svg",
            "A.2-breakaway-torque.csv",
        ]
    );
    let mut there: Vec<String> = fs::read_dir(out)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    there.sort();
    let mut files = files;
    files.sort_unstable();
    assert_eq!(there, files);
}

#[test]
fn wrong_calls_are_told() {
    for (args, told) in [
        (vec![], "<NAME>"),
        (vec!["--list"], "cannot be used with"),
        (vec!["4.6.99"], "did you mean `4.6.9`?"),
        (vec!["envelope"], "did you mean `envelopes`?"),
        (vec!["4.6.6", "4.6.7"], "--out DIR"),
        (vec!["--all"], "--out DIR"),
        (vec!["4.4.2", "--files", "csv"], "--out DIR"),
        (vec!["3.4.3", "--files", "pdf"], "possible values"),
        (vec!["3.4.3", "--all"], "cannot be used with"),
    ] {
        let (code, output, errors) = chart(&args);
        assert_eq!(code, 2, "{args:?}: {errors}");
        assert!(errors.contains(told), "{args:?}: {errors}");
        assert!(output.is_empty());
    }
}

/// A folder that cannot be written is a failure, not a wrong call.
#[test]
fn a_folder_that_cannot_be_written() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "in the way").unwrap();
    let (code, _, errors) = chart(&["3.4.3", "--out", file.to_str().unwrap()]);
    assert_eq!(code, 1, "{errors}");
    assert_eq!(fs::read_to_string(&file).unwrap(), "in the way");
}
