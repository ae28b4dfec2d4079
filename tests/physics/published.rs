//! The report's published numbers, and the validation table of the documentation made from them.

use std::fmt::Write;

use crate::support::{LBF_FT, LBF_PER_FT, MPH, assert_ratio, problem};
use bogie::{
    case::Case,
    design::{compromise::shortfall, search, study::Study},
    dynamics::LateralModel,
    evaluate::{Evaluation, curving::CurvingLimits, stability::Stability},
    index,
    optimize::{
        archive::{Archive, Silent},
        local::Status,
        problem::Problem,
        solve::{Solved, Start},
    },
    parameter::Parameter,
    spec::{Interval, Spec},
    units::us::INCH,
    vehicle::GRAVITY,
};
use serde::Deserialize;

#[derive(Deserialize)]
struct Published {
    optimum: Vec<Optimum>,
    example: Vec<Example>,
    variation: Vec<Variation>,
}

#[derive(Deserialize)]
struct Optimum {
    conicity: f64,
    critical_speed_mph: f64,
    degree: f64,
    bending: f64,
    lateral: f64,
    ratios: [f64; 2],
}

#[derive(Deserialize)]
struct Example {
    problem: String,
    table: String,
    #[serde(flatten)]
    indices: std::collections::BTreeMap<String, Index>,
}

#[derive(Deserialize)]
struct Index {
    published: f64,
    ratio: f64,
}

#[derive(Deserialize)]
struct Variation {
    name: String,
    factors: [f64; 4],
    published_mph: f64,
    ours_mph: f64,
}

fn published() -> Published {
    toml::from_str(include_str!("../data/published.toml")).unwrap()
}

fn critical_speed_mph(case: &Case) -> f64 {
    let found = Stability::by_spectra(&LateralModel::new(case), case.model.speed_range).unwrap();
    found.critical_speed().unwrap() / MPH
}

fn degree(case: &Case) -> f64 {
    CurvingLimits::new(case, 0.0).unwrap().degree()
}

impl Optimum {
    fn case(&self) -> Case {
        let mut case = Case::prototype();
        case.wheel_rail.conicity = self.conicity;
        Parameter::PRIMARY_BENDING_STIFFNESS.set(&mut case, self.bending * LBF_FT);
        case.vehicle.suspension.primary.lateral_stiffness = self.lateral * LBF_PER_FT;
        case
    }

    /// The optimisation that the row answers: the highest degree curve at its critical speed, over
    /// the ranges of the report's charts.
    fn study(&self) -> Study {
        let bending = Interval::from([1e5 * LBF_FT, 2e7 * LBF_FT]);
        let lateral = Interval::from([2e4 * LBF_PER_FT, 5e6 * LBF_PER_FT]);
        Study::new(&self.case(), &[])
            .vary(Parameter::PRIMARY_BENDING_STIFFNESS, bending)
            .vary(Parameter::PRIMARY_LATERAL_STIFFNESS, lateral)
            .optimise(0, index::Index::DegreeCurve, 0, 1.0)
            .demand(
                0,
                index::Index::CriticalSpeed,
                self.critical_speed_mph * MPH,
            )
    }
}

fn solved(study: &Study) -> Solved {
    search(study, &Start::everywhere(1), &Archive::new(&Silent))
        .unwrap()
        .solved
}

/// The ratios were noted to two decimals; one of the eighteen degree curves (λ = 0.025, 300 mph)
/// comes out at 0.972 where 0.98 was noted.
const NOTED: f64 = 0.006;
const NOTED_DEGREE: f64 = 0.009;

#[test]
fn table_4_5_1_evaluated() {
    for row in published().optimum {
        let case = row.case();
        let what = format!("λ {} {} mph", row.conicity, row.critical_speed_mph);
        let speed = critical_speed_mph(&case) / row.critical_speed_mph;
        assert!(
            (speed - row.ratios[0]).abs() < NOTED,
            "{what}: speed ratio {speed}"
        );
        let degree = degree(&case) / row.degree;
        assert!(
            (degree - row.ratios[1]).abs() < NOTED_DEGREE,
            "{what}: degree ratio {degree}"
        );
    }
}

/// Each row asked of the optimiser.
///
/// The table was read off charts, so its designs miss their own critical speeds by up to 12 % in
/// our model and their degree curves by up to 26 %. The optimum may beat the table by softer K_b
/// with stiffer K_py, along which it is flat. So D must lie within 20 % of the table and K_b within
/// a factor of 1.75, in every row; and where the table's design meets the required speed in our
/// model, the optimum must be at least as good as it.
#[test]
fn table_4_5_1_optimised() {
    for row in published().optimum {
        let what = format!("λ {} {} mph", row.conicity, row.critical_speed_mph);
        let study = row.study();
        let solved = solved(&study);
        let case = study.design(&solved.point.x);
        let (speed, degree_reached) = (critical_speed_mph(&case), degree(&case));
        let reached = speed >= row.critical_speed_mph * (1.0 - 1e-5);
        // One row asks for more than the model can give: 250 mph at λ = 0.1.
        let possible =
            !(row.conicity > 0.09 && row.conicity < 0.11 && row.critical_speed_mph > 249.0);
        assert_eq!(reached, possible, "{what}: reached {speed} mph");
        let expected = if possible {
            Status::Optimal
        } else {
            Status::Infeasible
        };
        assert_eq!(solved.status, expected, "{what}");
        let table = row.case();
        if critical_speed_mph(&table) >= row.critical_speed_mph {
            assert!(
                degree_reached >= degree(&table),
                "{what}: {degree_reached} < {}",
                degree(&table)
            );
        }
        assert_ratio(&format!("{what} D"), degree_reached, row.degree, 0.20);
        let bending = case.vehicle.bending_stiffness() / LBF_FT / row.bending;
        assert!(
            (1.0 / 1.75..1.75).contains(&bending),
            "{what}: K_b ratio {bending}"
        );
    }
}

/// No design of a grid over the whole range beats the optimum, and where the optimiser reports a
/// required speed as out of reach, no design of the grid reaches it.
#[test]
fn no_grid_point_beats_the_optimum() {
    for row in published().optimum {
        let what = format!("λ {} {} mph", row.conicity, row.critical_speed_mph);
        // What cannot be met is judged by the shortfall of the speed itself.
        let study = row.study();
        let solved = solved(&study);
        let short = solved.status == Status::Infeasible;
        let problem = if short { shortfall(&study) } else { study };
        let best = problem.evaluate(&solved.point.x).unwrap();
        let n = 13;
        for i in 0..n {
            for j in 0..n {
                let x = [
                    f64::from(i) / f64::from(n - 1),
                    f64::from(j) / f64::from(n - 1),
                ];
                let values = problem.evaluate(&x).unwrap();
                if values.violation() <= 0.0 {
                    assert!(
                        values.objective() >= best.objective() - 1e-6,
                        "{what} {x:?}"
                    );
                }
            }
        }
    }
}

/// Value of a named index of Tables 4.7.1 and 4.7.2.
fn index(spec: &Spec, name: &str) -> f64 {
    let mut case = spec.case.clone();
    if name.contains("quarter_mass") {
        case.vehicle.carbody.bending.modal_mass_ratio = 0.25;
    }
    let evaluation = Evaluation::new(&case).unwrap();
    let lateral = evaluation.lateral.as_ref().unwrap();
    let vertical = evaluation.vertical.as_ref().unwrap();
    match name {
        "critical_speed_mph" => evaluation.stability.critical_speed().unwrap() / MPH,
        "degree_curve" => evaluation.curving.as_ref().unwrap().degree(),
        "kinematic_damping_ratio" => evaluation.modes.kinematic.as_ref().unwrap().damping_ratio,
        "primary_stroke_wheelset_4_in" => lateral.primary_stroke[3] / INCH,
        "wheelset_excursion_wheelset_1_in" => lateral.excursion[0] / INCH,
        "secondary_lateral_stroke_in" => lateral.average_stroke() / INCH,
        "lateral_acceleration_g" => lateral.average_acceleration() / GRAVITY,
        "secondary_vertical_stroke_in" => vertical.average_stroke() / INCH,
        "vertical_acceleration_g" | "vertical_acceleration_quarter_mass_g" => {
            vertical.average_acceleration() / GRAVITY
        }
        other => panic!("unknown index {other}"),
    }
}

#[test]
fn tables_4_7_1_and_4_7_2() {
    for example in published().example {
        let spec = problem(&example.problem);
        for (name, Index { published, ratio }) in &example.indices {
            let ours = index(&spec, name) / published;
            // Ratios near one were noted to three decimals for the critical speed.
            assert!(
                (ours - ratio).abs() < NOTED,
                "{} {name}: ratio {ours}, noted {ratio}",
                example.table
            );
        }
    }
}

fn varied(variation: &Variation) -> Case {
    let mut case = problem("urban-80mph").case;
    let [wheelset, wheelset_inertia, frame, frame_inertia] = variation.factors;
    case.vehicle.wheelset.mass *= wheelset;
    case.vehicle.wheelset.yaw_inertia *= wheelset_inertia;
    case.vehicle.wheelset.spin_inertia *= wheelset_inertia;
    case.vehicle.truck.mass *= frame;
    case.vehicle.truck.yaw_inertia *= frame_inertia;
    case
}

#[test]
fn variations_of_example_2() {
    for variation in published().variation {
        let ours = critical_speed_mph(&varied(&variation));
        // Noted to 0.1 mph.
        assert!(
            (ours - variation.ours_mph).abs() < 0.06,
            "{}: {ours}",
            variation.name
        );
    }
    let mut case = problem("urban-80mph").case;
    case.vehicle.suspension.secondary.yaw_stiffness = 6e6 * LBF_FT;
    let ours = critical_speed_mph(&case);
    assert!((ours - 167.1).abs() < 0.06, "{ours}");
    // The report's full model has 164 mph.
    assert_ratio("K_sψ = 6e6", ours, 164.0, 0.02);
}

/// The prototype: 280 mph in Figure 4.5.7; carbody modes between 0.4 and 1.1 Hz, the kinematic
/// mode at 2.16 and the next at 6.16 Hz at 110 mph (4.4); flanging at about 0.8–0.85° (4.5.2).
#[test]
fn prototype() {
    let spec = problem("prototype");
    let evaluation = Evaluation::new(&spec.case).unwrap();
    let critical = evaluation.stability.critical_speed().unwrap() / MPH;
    // The figure is read to about 1 mph.
    assert_ratio("critical speed", critical, 280.0, 0.004);
    let modes: Vec<f64> = evaluation
        .modes
        .oscillatory
        .iter()
        .map(|m| m.frequency)
        .collect();
    assert!(
        modes[..3].iter().all(|f| (0.4..1.1).contains(f)),
        "{modes:?}"
    );
    assert_ratio(
        "kinematic mode",
        evaluation.modes.kinematic.as_ref().unwrap().frequency,
        2.16,
        0.02,
    );
    // The fifth is nearly overdamped (ζ = 0.94), which makes its frequency uncertain.
    assert_ratio("fifth mode", modes[5], 6.16, 0.08);
    let flange = evaluation.curving.unwrap().flange.unwrap().degree;
    assert!((0.8..0.91).contains(&flange), "{flange}");
}

/// Writes or checks the table of the validation page: run with `BOGIE_BLESS=1` to write it.
#[test]
fn validation_table_is_up_to_date() {
    let text = validation_table();
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/src/validation-table.md");
    if std::env::var_os("BOGIE_BLESS").is_some() {
        std::fs::write(path, &text).unwrap();
    }
    let written = std::fs::read_to_string(path).expect(path);
    assert!(
        written == text,
        "{path} is out of date: run the tests with BOGIE_BLESS=1"
    );
}

fn validation_table() -> String {
    let data = published();
    let mut text = String::from(
        "<!-- Written by tests/physics/published.rs from tests/data/published.toml. -->\n\n\
         ### Tables 4.7.1 and 4.7.2: the design examples, full model\n\n\
         | index | example 1, published | ours | ratio | example 2, published | ours | ratio |\n\
         |---|---|---|---|---|---|---|\n",
    );
    let specs: Vec<Spec> = data.example.iter().map(|e| problem(&e.problem)).collect();
    for name in data.example[0].indices.keys() {
        let _ = write!(text, "| {} ", name.replace('_', " "));
        for (example, spec) in data.example.iter().zip(&specs) {
            let (ours, published) = (index(spec, name), example.indices[name].published);
            let _ = write!(text, "| {published} | {ours:.4} | {:.3} ", ours / published);
        }
        text.push_str("|\n");
    }
    text.push_str(
        "\n### Variations of example 2: critical speed\n\n\
         | variation | published, mph | ours, mph | ratio |\n|---|---|---|---|\n",
    );
    for variation in &data.variation {
        let ours = critical_speed_mph(&varied(variation));
        let ratio = ours / variation.published_mph;
        let _ = writeln!(
            text,
            "| {} | {} | {ours:.1} | {ratio:.3} |",
            variation.name, variation.published_mph
        );
    }
    text.push_str(
        "\n### Table 4.5.1: the table's designs evaluated, and its questions asked of the optimiser\n\n\
         K_b in 10⁶ ft-lbf/rad, K_py in 10⁶ lbf/ft.\n\n\
         | λ | V_cr | D | K_b | K_py | our V_cr | our D | best D | at V_cr | K_b | K_py | status |\n\
         |---|---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for row in &data.optimum {
        let table = row.case();
        let study = row.study();
        let solved = solved(&study);
        let best = study.design(&solved.point.x);
        let status = match solved.status {
            Status::Optimal => "optimal",
            Status::BestFound => "best found",
            Status::Stalled => "stalled",
            Status::Infeasible => "out of reach",
            Status::BudgetSpent | Status::Interrupted => "ended early",
            Status::Failed(_) => "not evaluated",
        };
        let _ = writeln!(
            text,
            "| {} | {} | {} | {:.2} | {:.2} | {:.1} | {:.3} | {:.3} | {:.1} | {:.2} | {:.2} | {status} |",
            row.conicity,
            row.critical_speed_mph,
            row.degree,
            row.bending / 1e6,
            row.lateral / 1e6,
            critical_speed_mph(&table),
            degree(&table),
            degree(&best),
            critical_speed_mph(&best),
            best.vehicle.bending_stiffness() / LBF_FT / 1e6,
            best.vehicle.suspension.primary.lateral_stiffness / LBF_PER_FT / 1e6,
        );
    }
    text
}
