//! The design procedure on vehicles of its own, each result compared with a grid.

use crate::support::{self, LBF_FT, LBF_PER_FT, MPH, assert_ratio, reference_cases};
use bogie::{
    case::Case,
    closed_form::{corrections, natural_frequencies::truck_vertical},
    design::{
        compromise::shortfall,
        margin::value,
        outcome::DesignResult,
        procedure::{DesignError, design},
        search,
        study::Study,
    },
    dynamics::LateralModel,
    evaluate::{Evaluation, stability::Stability},
    index::Index,
    optimize::{
        archive::{Archive, Silent},
        local::Status,
        problem::{Failure, Problem},
        solve::{Solved, Start},
    },
    parameter::Parameter,
    spec::{Interval, Spec},
    units::us::INCH,
};

fn solved(study: &Study) -> Solved {
    search(study, &Start::everywhere(3), &Archive::new(&Silent))
        .unwrap()
        .solved
}

/// Solves a study in two variables and checks it against an `n` × `n` grid.
fn solve_and_check(what: &str, study: &Study, n: usize) -> Vec<f64> {
    let solved = solved(study);
    let short = solved.status == Status::Infeasible;
    // What cannot be met is judged by how far it falls short.
    let problem = if short {
        shortfall(study)
    } else {
        study.clone()
    };
    let x = solved.point.x[..2].to_vec();
    let best = problem.evaluate(&x).unwrap();
    for i in 0..n {
        for j in 0..n {
            let x = [i, j].map(|k| k as f64 / (n - 1) as f64);
            let Ok(values) = problem.evaluate(&x) else {
                continue;
            };
            if values.violation() <= 0.0 {
                // 1e-4: a hundredth of a per cent of acceleration, speed or curve.
                assert!(values.objective() > best.objective() - 1e-4, "{what} {x:?}");
            }
        }
    }
    if !short {
        let residual = solved.certificate.map(|c| c.kkt_residual);
        assert_eq!(solved.status, Status::Optimal, "{what} {residual:?}");
    }
    x
}

/// The case with its secondary suspension open, lateral or vertical.
fn ride(case: &Case, lateral: bool) -> Study {
    let (frequency, damping_ratio) = if lateral {
        (
            Parameter::SECONDARY_LATERAL_FREQUENCY,
            Parameter::SECONDARY_LATERAL_DAMPING_RATIO,
        )
    } else {
        (
            Parameter::SECONDARY_VERTICAL_FREQUENCY,
            Parameter::SECONDARY_VERTICAL_DAMPING_RATIO,
        )
    };
    Study::new(case, &[])
        .vary(frequency, Interval::from([0.5, 2.0]))
        .vary(damping_ratio, Interval::from([0.08, 0.8]))
}

/// The case with its primary suspension open.
fn primary(case: &Case) -> Study {
    let bending = Interval::from([5e5 * LBF_FT, 1e7 * LBF_FT]);
    let lateral = Interval::from([2e5 * LBF_PER_FT, 5e6 * LBF_PER_FT]);
    Study::new(case, &[])
        .vary(Parameter::PRIMARY_BENDING_STIFFNESS, bending)
        .vary(Parameter::PRIMARY_LATERAL_STIFFNESS, lateral)
}

#[test]
fn ride_optima_on_the_reference_vehicles() {
    for (name, case, expected) in reference_cases() {
        if expected["lateral"].is_null() {
            continue;
        }
        for lateral in [true, false] {
            let (acceleration, stroke) = if lateral {
                (Index::LateralAcceleration, Index::SecondaryLateralStroke)
            } else {
                (Index::VerticalAcceleration, Index::SecondaryVerticalStroke)
            };
            let study = ride(&case, lateral)
                .optimise(0, acceleration, 0, 1.0)
                .demand(0, stroke, 1.5 * INCH);
            solve_and_check(&format!("{name} {acceleration:?}"), &study, 12);
        }
    }
}

#[test]
fn least_stroke_for_a_required_acceleration() {
    let study = ride(&Case::prototype(), true)
        .optimise(0, Index::SecondaryLateralStroke, 0, 1.0)
        .demand(0, Index::LateralAcceleration, 0.5);
    let x = solve_and_check("stroke", &study, 15);
    // The requirement is what holds the design back.
    let reached = value(&study.design(&x), Index::LateralAcceleration).unwrap();
    assert_ratio("acceleration", reached, 0.5, 1e-5);
}

#[test]
fn stability_goals_agree_with_one_another() {
    let case = Case::prototype();
    let speed = 180.0 * MPH;
    let curving = primary(&case)
        .optimise(0, Index::DegreeCurve, 0, 1.0)
        .demand(0, Index::CriticalSpeed, speed);
    let x = solve_and_check("curving", &curving, 12);
    let degree = value(&curving.design(&x), Index::DegreeCurve).unwrap();
    // Asked for that degree curve, the highest critical speed is the one required before.
    let stability = primary(&case)
        .optimise(0, Index::CriticalSpeed, 0, 1.0)
        .demand(0, Index::DegreeCurve, degree);
    let x = solve_and_check("stability", &stability, 12);
    let reached = value(&stability.design(&x), Index::CriticalSpeed).unwrap();
    assert_ratio("critical speed", reached, speed, 1e-4);
    // Asked for both, both margins vanish.
    let both = primary(&case)
        .optimise_from(0, Index::CriticalSpeed, 0, 1.0, speed)
        .optimise_from(0, Index::DegreeCurve, 0, 1.0, degree);
    let margin = solved(&both).point.values.unwrap().objective();
    assert!(margin.abs() < 1e-4, "{margin}");
}

#[test]
fn conicity_as_a_continuous_variable() {
    let case = Case::prototype();
    let speed = 150.0 * MPH;
    let best_of = |study: Study| {
        let study =
            study
                .optimise(0, Index::DegreeCurve, 0, 1.0)
                .demand(0, Index::CriticalSpeed, speed);
        solved(&study).point.values.unwrap().objective()
    };
    let best = best_of(primary(&case).vary(Parameter::CONICITY, Interval::from([0.03, 0.2])));
    // At least as good as every profile of the table on its own.
    for conicity in [0.05, 0.10, 0.15] {
        let mut case = case.clone();
        case.wheel_rail.conicity = conicity;
        assert!(best <= best_of(primary(&case)) + 1e-4, "λ = {conicity}");
    }
}

fn designed(spec: &Spec) -> Result<DesignResult, DesignError> {
    design(spec, &Archive::new(&Silent))
}

fn spec(source: &str) -> Spec {
    Spec::parse(source).unwrap_or_else(|m| panic!("{}", m.render("test", source, false)))
}

#[test]
fn the_ten_hertz_rule_sets_the_primary_vertical_stiffness() {
    let spec = spec(
        "[vehicle]\nbase = \"prototype\"\n[design]\nprimary_vertical_frequency = \"10 Hz\"\n\
         secondary_vertical_frequency = [\"0.7 Hz\", \"1.2 Hz\"]\n\
         secondary_vertical_damping_ratio = [0.1, 0.5]\n",
    );
    let result = designed(&spec).unwrap();
    assert_ratio(
        "bounce",
        truck_vertical(&result.case.vehicle).frequency,
        10.0,
        1e-12,
    );
    assert!(result.settled && result.met());
}

#[test]
fn nothing_to_design_or_to_choose_by_is_said() {
    let run = |source: &str| {
        let spec = spec(source);
        designed(&spec).map(|_| ())
    };
    assert_eq!(
        run("[vehicle]\nbase = \"prototype\"\n"),
        Err(DesignError::NothingOpen)
    );
    let open = "[vehicle]\nbase = \"prototype\"\n[design]\nprimary_lateral_stiffness = [\"1 MN/m\", \"9 MN/m\"]\n";
    assert_eq!(run(open), Err(DesignError::NoRequirement));
    // At 500 mph every design is unstable: there is no lateral ride to improve, and the design stays
    // as given.
    let fast = "[vehicle]\nbase = \"prototype\"\n[service]\nspeed = \"500 mph\"\n[design]\n\
                secondary_lateral_damping_ratio = [0.1, 0.5]\n";
    let fast = spec(fast);
    let result = designed(&fast).unwrap();
    assert_eq!(result.failure(), Some(Failure::Unstable));
    assert!(!result.met() && result.case == fast.case);
}

/// With the stiffnesses fixed the choice is among the profiles as they are; with one variable the
/// search is along a line.
#[test]
fn few_variables() {
    let source = |design: &str| {
        format!(
            "[vehicle]\nbase = \"prototype\"\n[design]\n{design}\n\
             [requirements]\ncritical_speed = \"120 mph\"\n"
        )
    };
    let run = |text: &str| {
        let spec = spec(&source(text));
        designed(&spec).unwrap()
    };
    let profiles = run("conicity = { choices = [0.05, 0.10, 0.15, 0.25] }");
    assert!(profiles.met());
    let best = profiles.evaluation.curving.unwrap().degree();
    for conicity in [0.05, 0.10, 0.15, 0.25] {
        let mut case = Case::prototype();
        case.wheel_rail.conicity = conicity;
        let evaluation = Evaluation::new(&case).unwrap();
        if evaluation.stability.critical_speed().unwrap() >= 120.0 * MPH {
            assert!(
                evaluation.curving.unwrap().degree() <= best,
                "λ = {conicity}"
            );
        }
    }
    let line = run("primary_bending_stiffness = [\"2e5 lbf ft/rad\", \"1e7 lbf ft/rad\"]");
    assert_eq!(line.stages[0].explained.status, Status::Optimal);
    // The bound holds the optimum; the design delivered lies nearer to the one as given.
    let speed = value(&line.optimum, Index::CriticalSpeed).unwrap();
    assert_ratio("critical speed", speed, 120.0 * MPH, 1e-5);
}

/// (4.6-2) foretells the critical speed of lighter running gear within 3 % where masses and
/// inertias change together.
#[test]
fn mass_correction() {
    let heavy = support::problem("urban-80mph").case;
    for factor in [0.6, 0.8, 1.2, 1.4] {
        let mut light = heavy.clone();
        let (w, t) = (&mut light.vehicle.wheelset, &mut light.vehicle.truck);
        for inertia in [
            &mut w.mass,
            &mut w.yaw_inertia,
            &mut w.spin_inertia,
            &mut t.mass,
            &mut t.yaw_inertia,
        ] {
            *inertia *= factor;
        }
        let speed = |case: &Case| {
            let found =
                Stability::by_spectra(&LateralModel::new(case), case.model.speed_range).unwrap();
            found.critical_speed().unwrap()
        };
        let corrected = corrections::for_mass(speed(&heavy), &heavy.vehicle, &light.vehicle);
        assert_ratio(&format!("mass × {factor}"), corrected, speed(&light), 0.03);
    }
}
