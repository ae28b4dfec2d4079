//! Long runs as a user has them: cut by a budget, interrupted, killed and resumed, on any number of
//! threads. A run that goes on must end at the very bytes of one that was never stopped.
//!
//! Moments are defined by the size of the journal, never by the clock.

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Child, Command, Output, Stdio},
    thread::sleep,
    time::Duration,
};

use serde_json::Value;
use tempfile::TempDir;

/// The secondary vertical suspension: the quickest of the report's trade-offs.
const QUICK: &str = r#"
[vehicle]
base = "prototype"
[design]
secondary_vertical_frequency = ["0.7 Hz", "1.5 Hz"]
secondary_vertical_damping_ratio = [0.1, 0.6]
[limits]
secondary_vertical_stroke = "1.5 in"
[pareto]
indices = ["vertical_acceleration", "secondary_vertical_stroke"]
points = 6
"#;

/// A folder with a spec, and runs of it into folders of their own.
struct Runs {
    folder: TempDir,
    spec: PathBuf,
}

impl Runs {
    fn new(source: &str) -> Self {
        let folder = TempDir::new().unwrap();
        let spec = folder.path().join("spec.toml");
        fs::write(&spec, source).unwrap();
        Self { folder, spec }
    }

    /// A spec of `problems/`.
    fn of(problem: &str) -> Self {
        let path = format!("{}/problems/{problem}.toml", env!("CARGO_MANIFEST_DIR"));
        Self::new(&fs::read_to_string(path).unwrap())
    }

    fn out(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn command(&self, command: &str, out: &str, more: &[&str]) -> Command {
        let mut call = Command::new(env!("CARGO_BIN_EXE_bogie"));
        call.arg(command).arg(&self.spec);
        call.arg("--out").arg(self.out(out));
        call.args(["--format", "json"]).args(more);
        call.stdin(Stdio::null());
        call
    }

    fn run(&self, command: &str, out: &str, more: &[&str]) -> Output {
        self.command(command, out, more).output().unwrap()
    }

    /// Runs to the end, which must be a design that meets all that is asked.
    fn complete(&self, command: &str, out: &str, more: &[&str]) {
        let output = self.run(command, out, more);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    }

    /// Starts a run and waits until its journal has `lines` measurements.
    fn until(&self, command: &str, out: &str, lines: usize) -> Child {
        let mut call = self.command(command, out, &[]);
        let mut child = call.stderr(Stdio::piped()).spawn().unwrap();
        let journal = self.out(out).join(format!("{command}.journal"));
        while fs::read(&journal).map_or(0, |bytes| count_lines(&bytes)) <= lines {
            let ended = child.try_wait().unwrap();
            assert_eq!(ended, None, "over before {lines} measurements were made");
            sleep(Duration::from_millis(1));
        }
        child
    }

    fn json(&self, command: &str, out: &str) -> Value {
        let path = self.out(out).join(format!("{command}.json"));
        serde_json::from_slice(&fs::read(&path).unwrap()).unwrap()
    }

    fn file(&self, out: &str, name: &str) -> Vec<u8> {
        let path = self.out(out).join(name);
        fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
    }

    fn journal(&self, command: &str, out: &str) -> Vec<u8> {
        self.file(out, &format!("{command}.journal"))
    }

    /// Results of two runs, byte by byte, and their journals, whose lines stand in the order in which
    /// searches side by side came to them.
    fn same(&self, command: &str, a: &str, b: &str) {
        let name = format!("{command}.json");
        assert!(
            self.file(a, &name) == self.file(b, &name),
            "{name} of the run `{a}` differs from that of `{b}`"
        );
        assert!(
            sorted_lines(&self.journal(command, a)) == sorted_lines(&self.journal(command, b)),
            "the journal of the run `{a}` differs from that of `{b}`"
        );
    }
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn sorted_lines(bytes: &[u8]) -> Vec<&[u8]> {
    let mut lines: Vec<&[u8]> = bytes.split(|b| *b == b'\n').collect();
    lines.sort_unstable();
    lines
}

fn count_lines(bytes: &[u8]) -> usize {
    bytes.split(|b| *b == b'\n').count() - 1
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
    }
}

#[test]
fn a_budget_is_kept_exactly_and_a_resumed_run_ends_where_an_uninterrupted_one_does() {
    let runs = Runs::new(QUICK);
    runs.complete("optimize", "whole", &[]);
    let whole = runs.json("optimize", "whole");
    assert_eq!(whole["stopped"], Value::Null);
    let all = whole["evaluations"].as_u64().unwrap();
    // Lines are the measurements and the header.
    let lines = count_lines(&runs.journal("optimize", "whole"));
    assert_eq!(lines as u64, all + 1);

    // Cut within the uniform points and within a local search.
    for budget in [7, 44] {
        let out = format!("cut-{budget}");
        let text = budget.to_string();
        let output = runs.run("optimize", &out, &["--budget", &text]);
        let cut = runs.json("optimize", &out);
        assert_eq!(cut["evaluations"], budget, "{}", stderr(&output));
        let stopped = cut["stopped"].as_str().unwrap();
        assert!(stopped.contains("budget"), "{stopped}");
        assert_eq!(output.status.code(), Some(4));
        let journal = runs.journal("optimize", &out);
        assert_eq!(count_lines(&journal), budget + 1);
        // What was measured is part of what the whole run measured.
        let whole = runs.journal("optimize", "whole");
        let whole = sorted_lines(&whole);
        let lines = sorted_lines(&journal);
        assert!(lines.iter().all(|line| whole.binary_search(line).is_ok()));
    }

    // A line cut in the middle is measured again.
    copy(&runs.out("cut-44"), &runs.out("torn"));
    let torn = runs.out("torn").join("optimize.journal");
    let journal = fs::read(&torn).unwrap();
    fs::write(&torn, &journal[..journal.len() - 20]).unwrap();
    runs.complete("optimize", "torn", &["--resume"]);
    runs.same("optimize", "torn", "whole");

    // With a larger budget, then with one that is not spent.
    runs.run("optimize", "cut-7", &["--resume", "--budget", "44"]);
    runs.same("optimize", "cut-7", "cut-44");
    runs.complete("optimize", "cut-7", &["--resume", "--budget", "100000"]);
    runs.same("optimize", "cut-7", "whole");
}

/// The best so far is a design, whether or not it is one that will do.
#[test]
fn a_run_cut_short_of_its_requirements_says_so() {
    let runs = Runs::new(&format!(
        "{QUICK}[requirements]\nvertical_acceleration = \"0.01 m/s^2\"\n"
    ));
    let output = runs.run("optimize", "cut", &["--budget", "25"]);
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    let cut = runs.json("optimize", "cut");
    assert_eq!(cut["evaluations"], 25);
    assert_eq!(cut["requirements_met"], false);
    assert_eq!(cut["unmet"][0]["key"], "requirements.vertical_acceleration");
}

#[test]
fn a_front_that_was_killed_goes_on_to_the_same_bytes() {
    let runs = Runs::new(QUICK);
    runs.complete("pareto", "whole", &[]);
    for lines in [5, 60, 150] {
        let out = format!("killed-{lines}");
        let mut child = runs.until("pareto", &out, lines);
        // SIGKILL: nothing can be tidied up.
        child.kill().unwrap();
        let status = child.wait().unwrap();
        assert!(!status.success() && !runs.out(&out).join("pareto.json").exists());
        runs.complete("pareto", &out, &["--resume"]);
        runs.same("pareto", &out, "whole");
    }
    // Cut by a budget before the first point is done, it has none.
    let output = runs.run("pareto", "early", &["--budget", "10"]);
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    let early = runs.json("pareto", "early");
    assert_eq!(early["evaluations"], 10);
    assert_eq!(early["points"], Value::Array(Vec::new()));
    // Cut in between, it holds those that are done.
    let output = runs.run("pareto", "cut", &["--budget", "150"]);
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    let cut = runs.json("pareto", "cut");
    assert_eq!(cut["evaluations"], 150);
    assert!(cut["stopped"].as_str().unwrap().contains("budget"));
    let points = cut["points"].as_array().unwrap();
    assert!(!points.is_empty() && points.len() < 6, "{}", points.len());
    assert!(points.iter().all(|p| p["status"] == "optimal"));
    runs.complete("pareto", "cut", &["--resume"]);
    runs.same("pareto", "cut", "whole");
}

fn signal(child: &Child, name: &str) {
    let id = child.id().to_string();
    let sent = Command::new("kill").args([name, &id]).status().unwrap();
    assert!(sent.success());
}

/// Ctrl-C.
fn interrupt(child: Child) -> Output {
    signal(&child, "-INT");
    child.wait_with_output().unwrap()
}

#[test]
fn an_interrupted_search_ends_with_the_best_so_far() {
    // Thousands of evaluations: it is far from done after forty.
    let runs = Runs::of("intercity-130mph");
    let output = interrupt(runs.until("optimize", "stopped", 40));
    let stopped = runs.json("optimize", "stopped");
    assert_eq!(stopped["stopped"], "interrupted", "{}", stderr(&output));
    assert_eq!(output.status.code(), Some(4));
    let made = stopped["evaluations"].as_u64().unwrap();
    assert!((40..500).contains(&made), "{made}");
    assert_eq!(
        count_lines(&runs.journal("optimize", "stopped")) as u64,
        made + 1
    );
}

/// The measurements that an interruption kept from being made come later in the journal; the
/// result is the same.
#[test]
fn an_interrupted_front_goes_on_to_the_same_result() {
    let runs = Runs::new(QUICK);
    runs.complete("pareto", "whole", &[]);
    let output = interrupt(runs.until("pareto", "stopped", 60));
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    runs.complete("pareto", "stopped", &["--resume"]);
    let [a, b] = ["stopped", "whole"].map(|out| runs.file(out, "pareto.json"));
    assert!(a == b, "the results differ");
    let [a, b] = ["stopped", "whole"].map(|out| {
        let text = String::from_utf8(runs.journal("pareto", out)).unwrap();
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        lines.sort();
        lines
    });
    assert_eq!(a, b);
}

/// A sweep that is cut off leaves its lines in a file that does not have the name of a whole one.
#[test]
fn an_interrupted_sweep_says_so() {
    let runs = Runs::new(QUICK);
    let partial = runs.out("stopped").join("sweep.json.partial");
    let mut call = runs.command("sweep", "stopped", &["--designs", "1000000"]);
    let mut child = call.stderr(Stdio::piped()).spawn().unwrap();
    while fs::metadata(&partial).map_or(0, |file| file.len()) == 0 {
        assert_eq!(child.try_wait().unwrap(), None, "over before a line");
        sleep(Duration::from_millis(1));
    }
    let output = interrupt(child);
    assert_eq!(output.status.code(), Some(4), "{}", stderr(&output));
    assert!(partial.exists() && !runs.out("stopped").join("sweep.json").exists());
}

#[test]
fn only_a_journal_of_the_same_search_is_gone_on_with() {
    let refused = |runs: &Runs, more: &[&str]| {
        let output = runs.run("pareto", "out", more);
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert!(output.stdout.is_empty() && !runs.out("out").join("pareto.json").exists());
        stderr(&output)
    };
    let runs = Runs::new(QUICK);
    let missing = refused(&runs, &["--resume"]);
    assert!(missing.contains("there is no journal"), "{missing}");
    runs.run("pareto", "out", &["--budget", "10"]);
    fs::remove_file(runs.out("out").join("pareto.json")).unwrap();
    let journal = runs.journal("pareto", "out");
    // Other points are another search, and so is any change of the spec.
    let foreign = refused(&runs, &["--resume", "--points", "7"]);
    assert!(foreign.contains("another spec"), "{foreign}");
    fs::write(&runs.spec, QUICK.replace("1.5 in", "1.4 in")).unwrap();
    let foreign = refused(&runs, &["--resume"]);
    assert!(foreign.contains("another spec"), "{foreign}");
    assert!(journal == runs.journal("pareto", "out"), "it was changed");
    // Without a folder there is nothing to go on from.
    let mut call = Command::new(env!("CARGO_BIN_EXE_bogie"));
    let output = call.arg("pareto").arg(&runs.spec).arg("--resume").output();
    assert_eq!(output.unwrap().status.code(), Some(2));
}

/// Two runs into one folder would mix their journals.
#[test]
fn a_second_run_into_a_folder_in_use_is_turned_away() {
    let runs = Runs::new(QUICK);
    runs.complete("pareto", "whole", &[]);
    let first = runs.until("pareto", "shared", 20);
    // Held still, so that it cannot be over before the others are.
    signal(&first, "-STOP");
    for more in [&[][..], &["--resume"]] {
        let output = runs.run("pareto", "shared", more);
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
        assert!(
            stderr(&output).contains("another run"),
            "{}",
            stderr(&output)
        );
        assert!(output.stdout.is_empty());
    }
    signal(&first, "-CONT");
    assert!(first.wait_with_output().unwrap().status.success());
    runs.same("pareto", "shared", "whole");
}

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let quick = Runs::new(QUICK);
    let ride = ["--indices", "vertical_acceleration,degree_curve"];
    for (command, more) in [
        ("optimize", &[][..]),
        ("pareto", &[]),
        ("sensitivity", &ride),
    ] {
        for threads in ["1", "2", "5"] {
            let mut call = quick.command(command, threads, more);
            let status = call.env("RAYON_NUM_THREADS", threads).output().unwrap();
            assert_eq!(status.status.code(), Some(0), "{}", stderr(&status));
        }
        for threads in ["2", "5"] {
            if command == "sensitivity" {
                let name = "sensitivity.json";
                assert!(quick.file(threads, name) == quick.file("1", name));
            } else {
                quick.same(command, threads, "1");
            }
        }
    }
}

/// The front of [`QUICK`] in one form.
fn front(runs: &Runs, format: &str) -> Vec<u8> {
    let mut call = Command::new(env!("CARGO_BIN_EXE_bogie"));
    call.arg("pareto").arg(&runs.spec);
    let output = call.args(["--format", format]).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    output.stdout
}

/// Rows as text; numbers as they are printed to be read back bit for bit.
fn json_rows(bytes: &[u8]) -> Vec<Vec<(String, String)>> {
    let front: Value = serde_json::from_slice(bytes).unwrap();
    let points = front["points"].as_array().unwrap();
    let cell = |value: &Value| match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        number => format!("{:?}", number.as_f64().unwrap()),
    };
    let row = |point: &Value| {
        let cells = point.as_object().unwrap().iter();
        cells
            .map(|(name, value)| (name.clone(), cell(value)))
            .collect()
    };
    points.iter().map(row).collect()
}

fn csv_rows(bytes: &[u8]) -> Vec<Vec<(String, String)>> {
    let mut reader = csv::Reader::from_reader(bytes);
    let names = reader.headers().unwrap().clone();
    let cell = |text: &str| match text.parse::<f64>() {
        Ok(number) => format!("{number:?}"),
        Err(_) => text.to_owned(),
    };
    let row = |record: csv::StringRecord| {
        let pairs = names.iter().zip(record.iter());
        pairs
            .map(|(name, text)| (name.to_owned(), cell(text)))
            .collect()
    };
    reader
        .records()
        .map(|record| row(record.unwrap()))
        .collect()
}

#[cfg(feature = "parquet")]
fn parquet_rows(bytes: &[u8]) -> Vec<Vec<(String, String)>> {
    use parquet::{
        file::reader::{FileReader, SerializedFileReader},
        record::Field,
    };
    use std::io::Write;

    let mut file = tempfile::tempfile().unwrap();
    file.write_all(bytes).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let cell = |field: &Field| match field {
        Field::Null => String::new(),
        Field::Double(number) => format!("{number:?}"),
        Field::Str(text) => text.clone(),
        other => panic!("{other:?}"),
    };
    let rows = reader.get_row_iter(None).unwrap();
    rows.map(|row| {
        let row = row.unwrap();
        let cells = row.get_column_iter();
        cells
            .map(|(name, field)| (name.clone(), cell(field)))
            .collect()
    })
    .collect()
}

/// A build without the feature names it, and searches nothing.
#[cfg(not(feature = "parquet"))]
#[test]
fn a_parquet_table_needs_a_feature_of_the_build() {
    let runs = Runs::new(QUICK);
    let mut call = Command::new(env!("CARGO_BIN_EXE_bogie"));
    call.arg("pareto").arg(&runs.spec).arg("--out");
    call.arg(runs.out("parquet")).args(["--format", "parquet"]);
    let output = call.output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let message = "tables as Parquet need a build with `--features parquet`";
    assert!(stderr(&output).contains(message), "{}", stderr(&output));
    assert!(!runs.out("parquet").exists());
}

#[test]
fn a_front_is_the_same_in_every_form_and_none_of_its_points_is_dominated() {
    let runs = Runs::new(QUICK);
    let rows = json_rows(&front(&runs, "json"));
    assert_eq!(rows, csv_rows(&front(&runs, "csv")));
    #[cfg(feature = "parquet")]
    assert_eq!(rows, parquet_rows(&front(&runs, "parquet")));

    assert_eq!(rows.len(), 6);
    let column = |name: &str| -> Vec<f64> {
        let cell = |row: &Vec<(String, String)>| {
            let found = row.iter().find(|(n, _)| n == name).expect(name);
            found.1.parse::<f64>().unwrap()
        };
        rows.iter().map(cell).collect()
    };
    // In the order of the first index; where it is worse the other must be better.
    let acceleration = column("vertical_acceleration_m_per_s2");
    let stroke = column("secondary_vertical_stroke_m");
    assert!(acceleration.is_sorted() && stroke.iter().rev().is_sorted());
    // The ends are the best of either alone.
    for (aim, values) in [
        ("vertical_acceleration", &acceleration),
        ("secondary_vertical_stroke", &stroke),
    ] {
        let source = QUICK.replace("[limits]\nsecondary_vertical_stroke = \"1.5 in\"", "");
        let runs = Runs::new(&format!("{source}[objective]\nminimize = \"{aim}\"\n"));
        runs.complete("optimize", "alone", &[]);
        let alone = runs.json("optimize", "alone");
        let found = &alone["trade_offs"][0]["objective"];
        let best = found["value_si"]
            .as_f64()
            .unwrap_or_else(|| panic!("{found}"));
        let end = values.iter().copied().fold(f64::INFINITY, f64::min);
        // The front takes what comes within 1e-3 of the best alone and is best in the other: closer,
        // the price of the last share grows without bound and nothing can be certified.
        assert!(
            (end / best - 1.0).abs() < 1.2e-3,
            "{aim}: {end}, alone {best}"
        );
    }
}
