//! Instructions that the parts of an evaluation take, counted by Callgrind:
//! `cargo bench --bench instructions`.
//!
//! Counts do not depend on what else the machine does, so that small changes show. Valgrind has no
//! AVX-512: with it, vectors are those of AVX2 everywhere. Counts kept for reference stand in
//! `instructions.txt`; each holds for its compiler.
//!
//! Needs `valgrind` and `gungraun-runner`, of the version of the crate; without them nothing is
//! measured.

use std::{
    path::{Path, PathBuf},
    process::{Command, ExitCode, Stdio},
};

/// Counts to compare with.
const KEPT: &str = include_str!("instructions.txt");
/// Share by which a count may be above the one kept.
const NEAR: f64 = 0.01;

/// What is counted.
mod counted {
    use std::hint::black_box;

    use bogie::{
        case::Case,
        dynamics::{LateralModel, VerticalModel, curving::CurvingError},
        evaluate::{
            Evaluation,
            curving::CurvingLimits,
            ride::{LateralRide, NoRide, VerticalRide},
            stability::Stability,
        },
        numerics::{EigenError, Poles},
    };
    use gungraun::{library_benchmark, library_benchmark_group, main};

    fn lateral() -> (Case, LateralModel, Poles) {
        let case = Case::prototype();
        let model = LateralModel::new(&case);
        let poles = Poles::at(&model.forced, case.service.speed);
        (case, model, poles.expect("the prototype has eigenvalues"))
    }

    fn vertical() -> (Case, VerticalModel, Poles) {
        let case = Case::prototype();
        let model = VerticalModel::new(&case);
        let poles = Poles::at(&model.forced, case.service.speed);
        (case, model, poles.expect("the prototype has eigenvalues"))
    }

    #[library_benchmark]
    #[bench::prototype(Case::prototype())]
    fn models(case: Case) -> (LateralModel, VerticalModel) {
        let case = black_box(&case);
        (LateralModel::new(case), VerticalModel::new(case))
    }

    #[library_benchmark]
    #[bench::prototype(lateral())]
    fn poles((_, model, _): (Case, LateralModel, Poles)) -> Result<Poles, EigenError> {
        Poles::at(&model.forced, black_box(50.0))
    }

    #[library_benchmark]
    #[bench::prototype(Case::prototype())]
    fn critical_speed(case: Case) -> Result<Stability, EigenError> {
        Stability::of(black_box(&case))
    }

    #[library_benchmark]
    #[bench::prototype(Case::prototype())]
    fn degree_curves(case: Case) -> Result<CurvingLimits, CurvingError> {
        CurvingLimits::new(black_box(&case), 0.0)
    }

    #[library_benchmark]
    #[bench::poles_known(lateral())]
    fn lateral_ride(
        (case, model, poles): (Case, LateralModel, Poles),
    ) -> Result<LateralRide, NoRide> {
        LateralRide::from_poles(black_box(&model), &case, &poles)
    }

    #[library_benchmark]
    #[bench::poles_known(vertical())]
    fn vertical_ride(
        (case, model, poles): (Case, VerticalModel, Poles),
    ) -> Result<VerticalRide, NoRide> {
        VerticalRide::from_poles(black_box(&model), &case, &poles)
    }

    #[library_benchmark]
    #[bench::prototype(Case::prototype())]
    fn full_evaluation(case: Case) -> Result<Evaluation, EigenError> {
        Evaluation::new(black_box(&case))
    }

    library_benchmark_group!(
        name = evaluation,
        benchmarks = [
            models,
            poles,
            critical_speed,
            degree_curves,
            lateral_ride,
            vertical_ride,
            full_evaluation
        ]
    );

    main!(library_benchmark_groups = evaluation);

    /// Hands over to the runner.
    pub fn run() {
        main();
    }
}

/// Whether a program answers.
fn runs(program: &str) -> bool {
    let mut command = Command::new(program);
    let quiet = command.stdout(Stdio::null()).stderr(Stdio::null());
    quiet.arg("--version").status().is_ok()
}

/// Instructions of each part, from what Callgrind left.
fn counts(target: &Path) -> std::io::Result<Vec<(String, u64)>> {
    let mut counts = Vec::new();
    // The runner puts the package's name between where it can tell it.
    let folders = ["gungraun/bogie", "gungraun"].map(|folder| target.join(folder));
    let folder = folders
        .iter()
        .find(|folder| folder.join("instructions").is_dir());
    let folder = folder.unwrap_or(&folders[0]);
    for part in std::fs::read_dir(folder.join("instructions/counted/evaluation"))? {
        let part = part?;
        for file in std::fs::read_dir(part.path())? {
            let path = file?.path();
            if path.extension().is_none_or(|ending| ending != "out") {
                continue;
            }
            let text = std::fs::read_to_string(path)?;
            let mut lines = text.lines();
            let total = lines.find_map(|line| line.strip_prefix("summary: "));
            let first = total.and_then(|total| total.split(' ').next()?.parse().ok());
            let name = part.file_name().to_string_lossy().into_owned();
            counts.extend(first.map(|count| (name, count)));
        }
    }
    counts.sort();
    Ok(counts)
}

/// Shows counts beside those kept; whether all are near them or below.
fn compare(counts: &[(String, u64)]) -> bool {
    let kept = |name: &str| -> Option<f64> {
        let mut lines = KEPT.lines().filter_map(|line| line.split_once(' '));
        lines.find(|(part, _)| *part == name)?.1.trim().parse().ok()
    };
    println!("\n| part | instructions | kept | change |\n|---|---|---|---|");
    let mut near = true;
    for (name, count) in counts {
        let part = name.split('.').next().unwrap_or(name).replace('_', " ");
        match kept(name) {
            Some(kept) => {
                let change = *count as f64 / kept - 1.0;
                near &= change <= NEAR;
                println!(
                    "| {part} | {count} | {kept:.0} | {:+.2} % |",
                    100.0 * change
                );
            }
            None => println!("| {part} | {count} | | |"),
        }
    }
    near
}

fn main() -> std::io::Result<ExitCode> {
    // The runner calls this program again, within Valgrind.
    if std::env::args().any(|argument| argument == "--gungraun-run") {
        counted::run();
        return Ok(ExitCode::SUCCESS);
    }
    let runner = option_env!("GUNGRAUN_RUNNER").unwrap_or("gungraun-runner");
    let missing: Vec<&str> = ["valgrind", runner]
        .into_iter()
        .filter(|program| !runs(program))
        .collect();
    if !missing.is_empty() {
        println!(
            "instructions: not counted, for want of {}; see docs/src/speed.md",
            missing.join(" and ")
        );
        return Ok(ExitCode::SUCCESS);
    }
    counted::run();
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("target"),
        PathBuf::from,
    );
    let counts = counts(&target)?;
    let lines = counts
        .iter()
        .map(|(name, count)| format!("{name} {count}\n"));
    let file = target.join("instructions.txt");
    std::fs::write(&file, lines.collect::<String>())?;
    if compare(&counts) {
        return Ok(ExitCode::SUCCESS);
    }
    println!(
        "\nMore instructions than those kept. If that is meant to be so, keep these: copy {} to \
         benches/instructions.txt.",
        file.display()
    );
    Ok(ExitCode::FAILURE)
}
