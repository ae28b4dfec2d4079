//! Files that are no specs at all, or large, deep, long or treacherous: refused in short time, with a
//! short message that a terminal can show.

use std::{
    fs,
    time::{Duration, Instant},
};

use assert_cmd::Command;
use bogie::spec::{MAX_BYTES, Spec, printable};
use tempfile::TempDir;

const BASE: &str = "[vehicle]\nbase = \"prototype\"\n";

/// Exit code, standard output and standard error of `bogie check`.
fn check(path: &str, stdin: &[u8]) -> (i32, String, String) {
    let clock = Instant::now();
    let output = Command::new(env!("CARGO_BIN_EXE_bogie"))
        .args(["check", path])
        .write_stdin(stdin)
        .output()
        .unwrap();
    // The slowest takes some 0.2 s; ten seconds are for a busy machine.
    assert!(clock.elapsed() < Duration::from_secs(10), "{path}");
    let text = |bytes| String::from_utf8(bytes).unwrap();
    let (stdout, stderr) = (text(output.stdout), text(output.stderr));
    for text in [&stdout, &stderr] {
        assert!(text.len() < 50_000, "{} bytes", text.len());
        for line in text.lines() {
            assert_eq!(printable(line), line);
        }
    }
    (output.status.code().unwrap(), stdout, stderr)
}

/// The message on a spec from standard input that is refused.
fn refused(source: impl AsRef<[u8]>) -> String {
    let (code, stdout, stderr) = check("-", source.as_ref());
    assert_eq!((code, stdout.as_str()), (2, ""), "{stderr}");
    stderr
}

#[test]
fn a_file_of_100_mb_is_not_read() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("large.toml");
    fs::File::create(&path).unwrap().set_len(100 << 20).unwrap();
    let (code, _, stderr) = check(path.to_str().unwrap(), b"");
    assert_eq!(code, 2);
    assert!(stderr.contains("at most 1 MiB"), "{stderr}");
    assert!(refused(vec![b'#'; MAX_BYTES + 1]).contains("at most 1 MiB"));
    if fs::exists("/dev/zero").unwrap() {
        let (code, _, stderr) = check("/dev/zero", b"");
        assert!(code == 2 && stderr.contains("at most 1 MiB"), "{stderr}");
    }
}

#[test]
fn folders_and_absent_files() {
    let folder = TempDir::new().unwrap();
    let (code, _, stderr) = check(folder.path().to_str().unwrap(), b"");
    assert!(code == 2 && stderr.contains("it is a folder"), "{stderr}");
    let absent = folder.path().join("absent.toml");
    let (code, _, stderr) = check(absent.to_str().unwrap(), b"");
    assert!(code == 2 && stderr.contains("cannot read"), "{stderr}");
}

#[test]
fn deep_nesting() {
    let deep = [
        format!("{}a = 1", "a.".repeat(100_000)),
        format!("a = {}", "[".repeat(100_000)),
        format!("a = {}", "{a=".repeat(100_000)),
        format!("[{}a]", "a.".repeat(100_000)),
        format!("{BASE}[conditions.{}x]\ny = 1", "a.".repeat(60)),
        format!(
            "{BASE}[vehicle.carbody]\nmass = \"1 {}kg{}\"",
            "(".repeat(45),
            ")".repeat(45)
        ),
    ];
    for source in deep {
        let _ = check("-", source.as_bytes());
    }
}

#[test]
fn long_values_and_keys() {
    let long = "x".repeat(500_000);
    let digits = "9".repeat(500_000);
    for source in [
        format!("{BASE}[vehicle.carbody]\nmass = \"{long}\""),
        format!("{BASE}[vehicle.carbody]\nmass = \"{digits} kg\""),
        format!("{BASE}[vehicle.carbody]\nmass = {digits}"),
        format!("{BASE}[wheel_rail]\nfriction = 1.{digits}"),
        format!("{BASE}[vehicle.carbody]\n{long} = 1"),
        format!("{BASE}[{long}]\na = 1"),
        format!("{BASE}[service]\ntrack = \"{long}\""),
        format!("{BASE}[conditions.{long}]\nwheel_rail.conicity = 0.1"),
        format!("{BASE}[tracks.{long}]\nform = \"fra\""),
        format!("{BASE}[objective]\nmaximize = \"{long}\""),
        format!("{BASE}[design]\nconicity = {{ {long} = 1 }}"),
        format!("{BASE}[wheel_rail]\nfriction = {long}"),
    ] {
        refused(source);
    }
}

#[test]
fn many_mistakes() {
    use std::fmt::Write;
    let mut keys = format!("{BASE}[vehicle.carbody]\n");
    let mut names = format!("{BASE}[objective]\nmaximize = [");
    let mut conditions = BASE.to_owned();
    let mut syntax = String::new();
    for i in 0..50_000 {
        let _ = writeln!(keys, "k{i} = 1");
        let _ = write!(names, "\"n{i}\", ");
        let _ = writeln!(syntax, "= {i}");
        if i < 20_000 {
            let _ = writeln!(conditions, "[conditions.c{i}]\nlimits.a = {i}");
        }
    }
    names.push(']');
    for source in [keys, names, conditions, syntax] {
        let message = refused(source);
        assert!(message.matches("error:").count() <= 20, "{message}");
    }
}

/// Editors of other systems begin a file with a mark and end its lines with two characters; places
/// are those that the editor shows.
#[test]
fn byte_order_mark_and_line_ends() {
    let right = "\u{feff}[vehicle]\r\nbase = \"prototype\"\r\n";
    assert_eq!(Spec::parse(right).unwrap(), Spec::parse(BASE).unwrap());
    let message = refused(format!("{right}[vehicle.carbody]\r\nmas = 1\r\n"));
    assert!(message.contains("<standard input>:4:1"), "{message}");
    let message = refused("\u{feff}[vehicl]\r\nbase = \"prototype\"\r\n");
    assert!(message.contains("<standard input>:1:"), "{message}");
}

#[test]
fn nothing_of_the_file_is_obeyed_by_the_terminal() {
    // Raw, in a comment, a string, a key and a wrong place: TOML forbids control characters.
    for source in [
        &b"# \x1b[2J"[..],
        b"[vehicle]\nbase = \"\x1b]0;title\x07\"",
        b"\x1b[31m = 1",
        b"[vehicle]\nbase = \x1b[31m",
        b"\x00\x00\x00",
        b"[vehicle]\r\rbase = \"prototype\"",
        // U+009B begins a command as ESC [ does, U+202E turns the direction: TOML allows both.
        "[vehicle]\nbas = 1 # \u{9b}31m \u{85} \u{202e} \u{200b} \u{feff}".as_bytes(),
        "[vehicle]\n\"\u{9b}31m\" = \"\u{9b}31m\"".as_bytes(),
    ] {
        refused(source);
    }
}

/// Names of files may hold anything but a slash.
#[cfg(unix)]
#[test]
fn names_of_files_are_shown_not_obeyed() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("a\x1b[31mred\x07.toml");
    fs::write(&path, BASE).unwrap();
    let (code, stdout, _) = check(path.to_str().unwrap(), b"");
    assert!(code == 0 && stdout.contains("in order"), "{stdout:?}");
    fs::write(&path, "[vehicl]").unwrap();
    let (code, _, stderr) = check(path.to_str().unwrap(), b"");
    assert!(code == 2 && stderr.contains("vehicl"), "{stderr:?}");
}
