//! Where results go: written whole or not at all, and a failure to write is said.

use std::{
    fs,
    path::Path,
    process::{Command, Output, Stdio},
};

use tempfile::TempDir;

fn bogie(args: &[&str]) -> Command {
    let mut call = Command::new(env!("CARGO_BIN_EXE_bogie"));
    call.current_dir(env!("CARGO_MANIFEST_DIR"));
    call.args(args).stdin(Stdio::null());
    call
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names.collect()
}

/// Standard output on a device without space.
#[test]
fn a_full_device_is_a_failure() {
    if !fs::exists("/dev/full").unwrap() {
        eprintln!("skipped: there is no /dev/full");
        return;
    }
    for args in [
        &["evaluate", "problems/prototype.toml"][..],
        &["psd", "problems/prototype.toml", "--csv"],
        &["check", "problems/prototype.toml"],
        &["schema"],
        &["init", "-"],
    ] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let output = bogie(args)
            .stdout(full)
            .stderr(Stdio::piped())
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(1), "{args:?}");
        let message = stderr(&output);
        assert!(
            message.contains("cannot write to standard output"),
            "{args:?}: {message}"
        );
    }
}

/// A disk that fills up in the middle of a file, as a limit on the size of files: what was there
/// before is still there, and nothing else.
#[cfg(unix)]
#[test]
fn a_disk_that_fills_up_leaves_the_old_file() {
    let folder = TempDir::new().unwrap();
    let result = folder.path().join("evaluate.json");
    fs::write(&result, "the old one").unwrap();
    let script = format!(
        "trap '' XFSZ; ulimit -f 1; exec '{}' evaluate problems/prototype.toml --format json \
         --out '{}'",
        env!("CARGO_BIN_EXE_bogie"),
        folder.path().display()
    );
    let output = Command::new("sh")
        .args(["-c", &script])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(
        stderr(&output).contains("cannot write"),
        "{}",
        stderr(&output)
    );
    assert_eq!(fs::read_to_string(&result).unwrap(), "the old one");
    assert_eq!(names(folder.path()), ["evaluate.json"]);
}

/// A call whose text nobody reads.
fn unread(args: &[&str]) -> Output {
    let mut call = bogie(args);
    let call = call.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = call.spawn().unwrap();
    drop(child.stdout.take());
    child.wait_with_output().unwrap()
}

/// As with `bogie … | head -1`.
#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let spec = "problems/prototype.toml";
    let output = unread(&["psd", spec, "--csv", "--points", "5000"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    assert_eq!(stderr(&output), "");
}

/// What goes to standard error is lost where nobody hears it; the work and its exit code are not.
#[test]
fn nobody_hears_the_messages() {
    if !fs::exists("/dev/full").unwrap() {
        eprintln!("skipped: there is no /dev/full");
        return;
    }
    let spec = "problems/intercity-130mph.toml";
    for (args, code) in [
        (&["check", "problems/invalid/wrong-type.toml"][..], 2),
        (&["evaluate", "problems/no-such-file.toml"], 2),
        (&["evaluate", "problems/doubtful/hunts-at-speed.toml"], 0),
        (&["evaluate", spec, "--out", "/dev/full"], 1),
        // Ends early, and says so.
        (&["pareto", spec, "--budget", "1"], 4),
    ] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let mut call = bogie(args);
        let status = call.stdout(Stdio::null()).stderr(full).status().unwrap();
        assert_eq!(status.code(), Some(code), "{args:?}");
        let mut child = bogie(args)
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stderr.take());
        assert_eq!(child.wait().unwrap().code(), Some(code), "{args:?}");
    }
}

/// A reader of the text that goes away does not keep the report from being written, nor does it change
/// what the exit code says.
#[test]
fn the_report_is_written_whoever_reads_the_text() {
    let folder = TempDir::new().unwrap();
    let page = folder.path().join("page.html");
    let spec = "problems/intercity-130mph.toml";
    let page_name = page.display().to_string();
    let output = unread(&["optimize", spec, "--budget", "1", "--report", &page_name]);
    // One evaluation is the whole budget.
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    assert!(page.exists());
}

/// A folder that cannot be, because a file is in its place, or that the system gives to nobody. A long
/// search says so before it begins.
#[test]
fn a_folder_that_cannot_be_written() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "kept").unwrap();
    let mut places = vec![
        file.display().to_string(),
        file.join("results").display().to_string(),
    ];
    if fs::exists("/proc/self").unwrap() {
        places.push("/proc/results".into());
    }
    for place in places {
        for command in [
            &["evaluate"][..],
            &["modes"],
            &["curve"],
            &["psd"],
            &["optimize"],
            &["pareto"],
            &["sensitivity"],
            &["sweep", "--designs", "1"],
            &["chart", "4.6.1"],
        ] {
            let spec = "problems/intercity-130mph.toml";
            let args = [&command[..1], &[spec], &command[1..], &["--out", &place]].concat();
            let output = bogie(&args).output().unwrap();
            assert_eq!(output.status.code(), Some(1), "{args:?}");
            let message = stderr(&output);
            assert!(message.contains("cannot write"), "{args:?}: {message}");
            assert!(message.contains(&place), "{args:?}: {message}");
            if !place.starts_with("/proc") {
                let remedy = format!("{} is a file; name a folder", file.display());
                assert!(message.contains(&remedy), "{args:?}: {message}");
            }
        }
    }
    assert_eq!(fs::read_to_string(&file).unwrap(), "kept");
}

/// Results replace each other whole, however many are written into one place at once.
#[test]
fn results_written_at_once_do_not_mix() {
    let folder = TempDir::new().unwrap();
    let out = folder.path().to_str().unwrap();
    let specs = ["prototype", "intercity-130mph", "urban-80mph"];
    let all: Vec<String> = specs
        .iter()
        .map(|name| {
            let spec = format!("problems/{name}.toml");
            let args = ["evaluate", &spec, "--format", "json"];
            String::from_utf8(bogie(&args).output().unwrap().stdout).unwrap()
        })
        .collect();
    let children: Vec<_> = (0..4)
        .flat_map(|_| specs)
        .map(|name| {
            let spec = format!("problems/{name}.toml");
            let args = ["evaluate", &spec, "--format", "json", "--out", out];
            bogie(&args).stderr(Stdio::null()).spawn().unwrap()
        })
        .collect();
    for mut child in children {
        assert!(child.wait().unwrap().success());
    }
    let written = fs::read_to_string(folder.path().join("evaluate.json")).unwrap();
    assert!(all.contains(&written));
    assert_eq!(names(folder.path()), ["evaluate.json"]);
}
