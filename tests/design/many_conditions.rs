//! Studies of many conditions: solved through those that matter, they are those of all conditions.

use std::{fmt::Write, path::Path};

use bogie::{
    case::Case,
    design::{
        margin::margins, outcome::DesignResult, procedure::design, screened::MANY, search,
        search::Searched, search_in_all, study::Study, tasks::Tasks,
    },
    export::status,
    index::{Demands, Index},
    optimize::{
        archive::{Archive, Silent},
        journal::{Header, Journal},
        local::Status,
        problem::{Detail, Problem},
        solve::Start,
    },
    parameter::Parameter,
    spec::{Condition, Interval, Spec},
};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

const MPH: f64 = 0.44704;
/// A hundredth of a per cent, as for any random design: what a stall may cost; a missed basin costs more.
const TOLERANCE: f64 = 1e-4;

/// Conditions that differ in wear, load, creep and speed.
fn conditions(rng: &mut ChaCha8Rng, count: usize) -> Vec<Condition> {
    let condition = |i: usize| Condition {
        name: format!("c{i}"),
        values: vec![
            ("wheel_rail.conicity", rng.random_range(0.05..0.2)),
            ("wheel_rail.creep_factor", rng.random_range(0.5..1.0)),
            ("vehicle.carbody.mass", rng.random_range(3.2e4..4.6e4)),
            ("service.speed", MPH * rng.random_range(90.0..130.0)),
        ],
        track: None,
        demands: Demands::default(),
    };
    (0..count).map(condition).collect()
}

/// The highest degree curve with a critical speed, or the least lateral acceleration within a stroke, in
/// every condition.
fn study(conditions: &[Condition], lateral: bool, bound: f64) -> Study {
    let interval = |lower: f64, upper: f64| Interval { lower, upper };
    let mut study = Study::new(&Case::prototype(), conditions);
    let (objective, limit) = if lateral {
        study = study
            .vary(Parameter::SECONDARY_LATERAL_FREQUENCY, interval(0.5, 2.0))
            .vary(
                Parameter::SECONDARY_LATERAL_DAMPING_RATIO,
                interval(0.08, 0.8),
            );
        (Index::LateralAcceleration, Index::SecondaryLateralStroke)
    } else {
        study = study
            .vary(Parameter::PRIMARY_BENDING_STIFFNESS, interval(2e5, 3e7))
            .vary(Parameter::PRIMARY_LATERAL_STIFFNESS, interval(6e5, 7e7));
        (Index::DegreeCurve, Index::CriticalSpeed)
    };
    for condition in 0..study.conditions() {
        study = study
            .optimise(condition, objective, 0, 1.0)
            .demand(condition, limit, bound);
    }
    study
}

/// Objective and violation of a design found, in all conditions of a study.
fn judged(study: &Study, found: &Searched) -> [f64; 2] {
    let x = &found.solved.point.x[..study.parameters().len()];
    let pieces = study.measure(x, Detail::Values).unwrap();
    let values = study.judge(&pieces);
    [values.objective(), values.violation()]
}

#[test]
fn the_screened_optimum_is_that_of_all_conditions() {
    for (seed, lateral, bound) in [
        (1, false, 150.0 * MPH),
        (2, false, 130.0 * MPH),
        (3, true, 0.055),
        (4, true, 0.06),
    ] {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let conditions = conditions(&mut rng, 12);
        assert!(conditions.len() > MANY);
        let study = study(&conditions, lateral, bound);
        let start = Start::everywhere(seed);
        let screened = search(&study, &start, &Archive::new(&Silent)).unwrap();
        let plain = search_in_all(&study, &start, &Archive::new(&Silent)).unwrap();
        assert_eq!(plain.solved.status, Status::Optimal, "seed {seed}");
        assert_eq!(screened.solved.status, Status::Optimal, "seed {seed}");
        let [own, violation] = judged(&study, &screened);
        let [all, _] = judged(&study, &plain);
        assert!(
            (own - all).abs() < TOLERANCE,
            "seed {seed}: {own}, in all {all}"
        );
        // What counts as feasible.
        assert!(violation <= 1e-6, "seed {seed}: {violation}");
        // The certificate is one of all conditions.
        let pieces = study
            .measure(&screened.solved.point.x, Detail::Values)
            .unwrap();
        let certificate = screened.solved.certificate.as_ref().unwrap();
        let certified = certificate.objective_multipliers.iter().flatten().count()
            + certificate.constraint_multipliers.len();
        assert_eq!(certified, pieces.len(), "seed {seed}");
    }
}

/// Out of reach: the largest violation is the least for all conditions, and every demand missed is told.
#[test]
fn the_largest_violation_is_that_of_all_conditions() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let conditions = conditions(&mut rng, 12);
    let study = study(&conditions, false, 330.0 * MPH);
    let start = Start::everywhere(5);
    let screened = search(&study, &start, &Archive::new(&Silent)).unwrap();
    let plain = search_in_all(&study, &start, &Archive::new(&Silent)).unwrap();
    for found in [&screened, &plain] {
        assert_eq!(found.solved.status, Status::Infeasible);
    }
    let [own, all] = [&screened, &plain].map(Searched::violation);
    // Within what counts as meeting a demand.
    assert!(
        own > 0.01 && (own - all).abs() < 2e-4,
        "{own}, in all {all}"
    );
    let case = study.design(&screened.solved.point.x[..2]);
    let mut demands = Demands::default();
    demands.set(Index::CriticalSpeed, 330.0 * MPH);
    let margins = margins(&case, &demands, &conditions);
    for margin in margins.iter().filter(|margin| !margin.met()) {
        let missed = screened
            .missed
            .iter()
            .find(|m| m.condition == margin.condition);
        assert!(
            missed.is_some_and(|missed| !missed.met()),
            "{:?}",
            margin.condition
        );
    }
}

fn spec(text: &str) -> Spec {
    Spec::parse(text).unwrap()
}

fn file() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/many-conditions.toml");
    std::fs::read_to_string(path).unwrap()
}

/// A design and how many conditions were measured on the way, each evaluation counting as often as it has
/// conditions.
fn counted(spec: &Spec) -> (DesignResult, usize) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.jsonl");
    let header = Header {
        program: "bogie".into(),
        digest: String::new(),
    };
    let journal = Journal::create(&path, &header).unwrap();
    let archive = Archive::new(&Silent).with_journal(journal, Vec::new());
    let result = design(spec, &archive).unwrap();
    drop(archive);
    let measured = std::fs::read_to_string(&path).unwrap();
    // Every condition asks for the objective.
    (result, measured.matches(Index::DegreeCurve.name()).count())
}

#[test]
fn a_verdict_holds_in_every_condition() {
    let spec = spec(&file());
    let (result, _) = counted(&spec);
    assert_eq!(status::of_run(&result), "optimal");
    assert_eq!(result.margins.len(), 1 + spec.conditions.len());
    assert!(result.margins.iter().all(|margin| margin.met()));
    // The bound is reached in one of them: nothing was left on the table.
    let least = result.margins.iter().map(|m| *m.reached.as_ref().unwrap());
    let least = least.fold(f64::INFINITY, f64::min);
    assert!(
        (least / (150.0 * MPH) - 1.0).abs() < 1e-4,
        "{}",
        least / MPH
    );
}

/// With twice the conditions, no more than twice the work; and far less than all of them at every design.
#[test]
fn work_grows_no_faster_than_the_number_of_conditions() {
    let counts = [24, 48, 96].map(|count| {
        let mut text = file().split("[conditions").next().unwrap().to_owned();
        for i in 0..count {
            let wear = 0.05 + 0.1 * f64::from(i) / f64::from(count - 1);
            let mass = 34_000 + 900 * (7 * i % 13);
            let _ = write!(
                text,
                "[conditions.c{i}]\nwheel_rail.conicity = {wear:.5}\nvehicle.carbody.mass = \"{mass} kg\"\n"
            );
        }
        let (result, count) = counted(&spec(&text));
        assert_eq!(status::of_run(&result), "optimal");
        (count, result.effort.evaluations)
    });
    for pair in counts.windows(2) {
        // A tenth for another way of the search.
        assert!(pair[1].0 as f64 <= 2.2 * pair[0].0 as f64, "{counts:?}");
    }
    let (measured, evaluations) = counts[2];
    assert!(2 * measured < 97 * evaluations, "{counts:?}");
}

/// One task for each stage of the study, whatever the number of conditions.
#[test]
fn the_task_asks_in_every_condition() {
    let spec = spec(&file());
    let task = Tasks::new(&spec).joint(&spec.case);
    assert_eq!(task.study.conditions_asked().len(), 25);
}
