//! The design procedure on vehicles of its own, each result compared with a grid.

mod support;

use bogie::{
    case::Case,
    closed_form::{corrections, natural_frequencies::truck_vertical},
    design::{
        local::Status,
        problem::Problem,
        procedure::{DesignError, design},
        ride::{Direction, Goal as RideGoal, Limits as RideLimits, Ride},
        solve::{Silent, Start, solve},
        stability_curving::{Goal, Limits, Open, StabilityCurving},
    },
    dynamics::LateralModel,
    evaluate::{Evaluation, critical_speed::Stability},
    spec::Spec,
    units::us::INCH,
};
use support::{LBF_FT, LBF_PER_FT, MPH, assert_ratio, reference_cases};

const EVERYWHERE: Start<'static> = Start::Everywhere {
    seed: 3,
    also: &[],
    beat: f64::INFINITY,
};

/// Solves a problem in two variables and checks it against an `n` × `n` grid.
fn solve_and_check(what: &str, problem: &dyn Problem, n: usize) -> Vec<f64> {
    let solved = solve(problem, EVERYWHERE, &Silent).unwrap();
    let best = solved.solution.point.values.clone().unwrap();
    for i in 0..n {
        for j in 0..n {
            let x = [i, j].map(|k| k as f64 / (n - 1) as f64);
            let Ok(values) = problem.evaluate(&x) else {
                continue;
            };
            if best.violation() > 1e-6 {
                assert!(values.violation() > best.violation() - 1e-6, "{what} {x:?}");
            } else if values.violation() <= 0.0 {
                // 1e-4: a hundredth of a per cent of acceleration, speed or curve.
                assert!(values.objective() > best.objective() - 1e-4, "{what} {x:?}");
            }
        }
    }
    if best.violation() <= 1e-6 {
        assert_eq!(
            solved.solution.status,
            Status::Optimal,
            "{what} {:e}",
            solved.solution.kkt_residual
        );
    }
    solved.solution.point.x
}

#[test]
fn ride_optima_on_the_reference_vehicles() {
    for (name, case, expected) in reference_cases() {
        if expected["lateral"].is_null() {
            continue;
        }
        for direction in [Direction::Lateral, Direction::Vertical] {
            let limits = RideLimits {
                secondary_stroke: Some(1.5 * INCH),
                ..RideLimits::default()
            };
            let bounds = [Some([0.5, 2.0]), Some([0.08, 0.8])];
            let ride = Ride::new(
                direction,
                &case,
                RideGoal::Acceleration,
                limits,
                bounds,
                None,
            );
            solve_and_check(&format!("{name} {direction:?}"), &ride, 12);
        }
    }
}

#[test]
fn least_stroke_for_a_required_acceleration() {
    let case = Case::prototype();
    let goal = RideGoal::Stroke { acceleration: 0.5 };
    let bounds = [Some([0.5, 2.0]), Some([0.08, 0.8])];
    let ride = Ride::new(
        Direction::Lateral,
        &case,
        goal,
        RideLimits::default(),
        bounds,
        None,
    );
    let x = solve_and_check("stroke", &ride, 15);
    let reached = Evaluation::new(&ride.design(&x)).unwrap().lateral.unwrap();
    // The requirement is what holds the design back.
    assert_ratio("acceleration", reached.average_acceleration(), 0.5, 1e-5);
}

#[test]
fn stability_goals_agree_with_one_another() {
    let case = Case::prototype();
    let open = Open {
        bending_stiffness: Some([5e5 * LBF_FT, 1e7 * LBF_FT]),
        lateral_stiffness: Some([2e5 * LBF_PER_FT, 5e6 * LBF_PER_FT]),
        conicity: None,
    };
    let problem = |goal| StabilityCurving::new(&case, goal, Limits::default(), open);
    let speed = 180.0 * MPH;
    let curving = problem(Goal::Curving {
        critical_speed: speed,
    });
    let x = solve_and_check("curving", &curving, 12);
    let degree = Evaluation::new(&curving.design(&x))
        .unwrap()
        .curving
        .unwrap()
        .degree();
    // Asked for that degree curve, the highest critical speed is the one required before.
    let stability = problem(Goal::Stability { degree });
    let x = solve_and_check("stability", &stability, 12);
    let found = Stability::search(
        &LateralModel::new(&stability.design(&x)),
        case.model.speed_range,
    );
    assert_ratio(
        "critical speed",
        found.unwrap().critical_speed().unwrap(),
        speed,
        1e-4,
    );
    // Asked for both, both margins vanish.
    let both = problem(Goal::Both {
        critical_speed: speed,
        degree,
    });
    let solved = solve(&both, EVERYWHERE, &Silent).unwrap();
    assert!(solved.solution.point.values.unwrap().objective().abs() < 1e-4);
}

#[test]
fn conicity_as_a_continuous_variable() {
    let case = Case::prototype();
    let open = Open {
        bending_stiffness: Some([5e5 * LBF_FT, 1e7 * LBF_FT]),
        lateral_stiffness: Some([2e5 * LBF_PER_FT, 5e6 * LBF_PER_FT]),
        conicity: Some([0.03, 0.2]),
    };
    let goal = Goal::Curving {
        critical_speed: 150.0 * MPH,
    };
    let problem = StabilityCurving::new(&case, goal, Limits::default(), open);
    let best = solve(&problem, EVERYWHERE, &Silent)
        .unwrap()
        .solution
        .point
        .values
        .unwrap()
        .objective();
    // At least as good as every profile of the table on its own.
    for conicity in [0.05, 0.10, 0.15] {
        let mut case = case.clone();
        case.wheel_rail.conicity = conicity;
        let fixed = StabilityCurving::new(
            &case,
            goal,
            Limits::default(),
            Open {
                conicity: None,
                ..open
            },
        );
        let alone = solve(&fixed, EVERYWHERE, &Silent)
            .unwrap()
            .solution
            .point
            .values
            .unwrap();
        assert!(best <= alone.objective() + 1e-4, "λ = {conicity}");
    }
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
    let result = design(
        &spec.case,
        &spec.design,
        &spec.requirements,
        &spec.limits,
        &Silent,
    )
    .unwrap();
    assert_ratio(
        "bounce",
        truck_vertical(&result.case.vehicle).frequency,
        10.0,
        1e-12,
    );
    assert!(result.settled && result.unmet.is_empty());
}

#[test]
fn nothing_to_design_or_to_choose_by_is_said() {
    let run = |source: &str| {
        let spec = spec(source);
        design(
            &spec.case,
            &spec.design,
            &spec.requirements,
            &spec.limits,
            &Silent,
        )
        .map(|_| ())
    };
    assert_eq!(
        run("[vehicle]\nbase = \"prototype\"\n"),
        Err(DesignError::NothingOpen)
    );
    let open = "[vehicle]\nbase = \"prototype\"\n[design]\nprimary_lateral_stiffness = [\"1 MN/m\", \"9 MN/m\"]\n";
    assert_eq!(run(open), Err(DesignError::NoRequirement));
    // At 500 mph every design is unstable: there is no lateral ride to improve.
    let fast = "[vehicle]\nbase = \"prototype\"\n[service]\nspeed = \"500 mph\"\n[design]\n\
                secondary_lateral_damping_ratio = [0.1, 0.5]\n";
    assert!(matches!(
        run(fast),
        Err(DesignError::NothingEvaluated { .. })
    ));
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
        design(
            &spec.case,
            &spec.design,
            &spec.requirements,
            &spec.limits,
            &Silent,
        )
        .unwrap()
    };
    let profiles = run("conicity = { choices = [0.05, 0.10, 0.15, 0.25] }");
    assert!(profiles.unmet.is_empty());
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
    assert_eq!(line.stages[0].status, Status::Optimal);
    let speed = line.evaluation.stability.critical_speed().unwrap();
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
                Stability::search(&LateralModel::new(case), case.model.speed_range).unwrap();
            found.critical_speed().unwrap()
        };
        let corrected = corrections::for_mass(speed(&heavy), &heavy.vehicle, &light.vehicle);
        assert_ratio(&format!("mass × {factor}"), corrected, speed(&light), 0.03);
    }
}
