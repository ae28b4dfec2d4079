//! Verdicts of `optimize`: met, out of reach, or left as given, each with what is delivered.

use crate::support::{self, assert_ratio};
use bogie::{
    case::Case,
    design::{
        doubts::warnings,
        margin::{Margin, Verdict, margins, value},
        outcome::{Delivered, DesignResult},
        procedure::design,
        sweep::Sweep,
    },
    export::status,
    index::Index,
    optimize::{
        archive::{Archive, Silent},
        local::Status,
        problem::Failure,
    },
    parameter::Parameter,
    spec::Spec,
};

fn read(name: &str) -> Spec {
    let path = format!(
        "{}/tests/data/verdicts/{name}.toml",
        env!("CARGO_MANIFEST_DIR")
    );
    Spec::read(&std::fs::read(&path).unwrap()).unwrap_or_else(|_| panic!("{name} is no spec"))
}

fn run(spec: &Spec) -> DesignResult {
    design(spec, &Archive::new(&Silent)).unwrap()
}

const G: f64 = bogie::vehicle::GRAVITY;

/// In turn 350 km/h is missed, because the lateral suspension that the ride wants takes speed; all at
/// once it is met.
#[test]
fn the_joint_design_is_delivered_where_the_sequence_misses() {
    let result = run(&read("met-all-at-once-only"));
    assert!(result.met() && result.joint_in_place_of_sequence());
    assert_eq!(result.conflict, None);
    let joint = result.joint.as_ref().unwrap();
    assert_eq!(result.optimum, joint.case);
    // The design delivered loses a little for being nearer to the one as given: the bound holds at the
    // optimum.
    let speed = value(&result.optimum, Index::CriticalSpeed).unwrap();
    assert_ratio("critical speed", speed, 350.0 / 3.6, 1e-4);
    let in_turn = &result.stages[1];
    assert_eq!(in_turn.explained.status, Status::Infeasible);
    assert_eq!(status::of_run(&result), "optimal");
}

/// The vertical stroke cannot be kept; the lateral damping ratio is still chosen for the ride.
#[test]
fn the_objective_decides_among_the_designs_of_least_violation() {
    let result = run(&read("one-limit-out-of-reach"));
    assert!(!result.met());
    let ratio = |parameter: Parameter| parameter.get(&result.case);
    // 0.223 and 0.0662 g by a dense search over both ratios, in three digits.
    let lateral = ratio(Parameter::SECONDARY_LATERAL_DAMPING_RATIO);
    assert!((lateral - 0.223).abs() < 1e-3, "{lateral}");
    let vertical = ratio(Parameter::SECONDARY_VERTICAL_DAMPING_RATIO);
    assert!(vertical > 0.6 - 1e-4, "{vertical}");
    let acceleration = value(&result.case, Index::LateralAcceleration).unwrap() / G;
    assert!((acceleration - 0.0662).abs() < 5e-5, "{acceleration}");
    let conflict = result.conflict.unwrap();
    let [missed] = &conflict.demands[..] else {
        panic!("{conflict:?}")
    };
    assert!(missed.influenced && missed.index == Index::SecondaryVerticalStroke);
}

/// A limit that no variable changes is named, and the rest is as good as without it.
#[test]
fn a_limit_without_variable_is_named_and_leaves_the_rest_alone() {
    let mut spec = read("limit-without-variable");
    let result = run(&spec);
    let ratio = Parameter::SECONDARY_LATERAL_DAMPING_RATIO.get(&result.case);
    assert!((ratio - 0.219).abs() < 1e-3, "{ratio}");
    let conflict = result.conflict.unwrap();
    assert!(conflict.demands.iter().all(|opposed| !opposed.influenced));
    spec.demands.remove(Index::SecondaryVerticalStroke);
    let without = run(&spec);
    let alone = Parameter::SECONDARY_LATERAL_DAMPING_RATIO.get(&without.optimum);
    // 1e-4: the tolerance on first-order conditions, on a flat optimum.
    assert!((ratio / alone - 1.0).abs() < 1e-3, "{ratio} {alone}");
    assert!(without.met());
}

/// The vertical trade-off alone chooses springs on which the carbody overturns, so that nothing in the
/// others can be evaluated: all at once finds a design that stands.
#[test]
fn a_stage_without_a_performance_is_not_the_last_word() {
    let source = "[vehicle]\nbase = \"prototype\"\n[design]\n\
                  primary_longitudinal_stiffness = [\"4373 kN/m\", \"3.88e6 lbf/ft\"]\n\
                  secondary_vertical_frequency = [\"0.1594 Hz\", \"1.612 Hz\"]\n\
                  [requirements]\ndegree_curve = \"0.628 deg\"\n";
    let spec = Spec::read(source.as_bytes()).unwrap_or_else(|_| panic!("{source}"));
    let result = run(&spec);
    assert!(result.stages.iter().any(|stage| stage.failure().is_some()));
    assert!(result.met() && result.delivered == Delivered::AllAtOnce);
}

/// A run that ends before its first search delivers a design that may be chosen: within the bounds,
/// with one of the profiles, as near to the one given as these allow.
#[test]
fn a_run_cut_short_delivers_a_design_within_the_bounds() {
    let source = "[vehicle]\nbase = \"prototype\"\n[design]\n\
                  conicity = { choices = [0.10, 0.15] }\n\
                  primary_lateral_stiffness = [\"1 MN/m\", \"2 MN/m\"]\n\
                  secondary_lateral_damping_ratio = 0.3\n\
                  [requirements]\ncritical_speed = \"150 mph\"\n";
    let spec = Spec::read(source.as_bytes()).unwrap_or_else(|_| panic!("{source}"));
    let archive = Archive::new(&Silent).with_budget(Some(1));
    let result = design(&spec, &archive).unwrap();
    assert_eq!(status::of_run(&result), "ended-early");
    let has = |parameter: Parameter| parameter.get(&result.case);
    assert!((has(Parameter::PRIMARY_LATERAL_STIFFNESS) / 2e6 - 1.0).abs() < 1e-9);
    assert!((has(Parameter::SECONDARY_LATERAL_DAMPING_RATIO) - 0.3).abs() < 1e-12);
    assert!((has(Parameter::CONICITY) - 0.10).abs() < 1e-12);
}

/// Adhesion in a curve of 300 m cannot be assessed; what can be met is met by a design that runs.
#[test]
fn a_limit_on_adhesion_out_of_reach_leaves_the_rest_met() {
    let result = run(&read("adhesion-beyond-slip"));
    for margin in &result.margins {
        let expected = match margin.index {
            Index::AdhesionUsed => Verdict::NotAssessed,
            _ => Verdict::Met,
        };
        assert_eq!(margin.verdict(), expected, "{:?}", margin.index);
    }
    assert_eq!(status::of_run(&result), "not-assessed");
}

/// Demands within the tolerance are met: nothing in the same result says that they are out of reach.
#[test]
fn one_tolerance_decides_whether_a_demand_is_met() {
    let result = run(&read("met-within-tolerance"));
    assert!(result.met() && result.conflict.is_none());
    let statuses = result.stages.iter().map(|stage| stage.explained.status);
    assert!(statuses.clone().all(|s| s != Status::Infeasible));
    assert_ne!(status::of_run(&result), "infeasible");
}

/// At 500 mph every design hunts. The design stays as given, and the result says why.
#[test]
fn where_nothing_can_be_evaluated_the_design_stays_as_given() {
    for order in ["in-turn", "joint"] {
        let order = if order == "joint" {
            "order = \"joint\"\n"
        } else {
            ""
        };
        let source = format!(
            "[vehicle]\nbase = \"prototype\"\n[service]\nspeed = \"500 mph\"\n[design]\n{order}\
             secondary_lateral_damping_ratio = [0.1, 0.5]\n"
        );
        let spec = Spec::read(source.as_bytes()).unwrap_or_else(|_| panic!("{source}"));
        let result = run(&spec);
        assert_eq!(result.failure(), Some(Failure::Unstable), "{order}");
        assert!(!result.met() && result.case == spec.case);
        assert_eq!(status::of_run(&result), "unstable");
    }
}

/// A study whose solution has the critical speed as a further variable is followed in the next round
/// of the coupling loop.
#[test]
fn lifted_solutions_are_followed_from_round_to_round() {
    let result = run(&read("lifted-profile-followed"));
    assert!(result.met() && result.settled && result.rounds > 1);
}

/// With an air spring K_sz, its frequency and its damping ratio change nothing in the vertical
/// trade-off: they are named and keep their values.
#[test]
fn parameters_out_of_use_are_not_designed() {
    let spec = read("air-spring-beside-k-sz");
    let result = run(&spec);
    let vertical = &result.stages[0];
    assert!(vertical.explained.chosen.is_empty());
    assert_eq!(
        vertical.unused,
        [
            Parameter::SECONDARY_VERTICAL_FREQUENCY,
            Parameter::SECONDARY_VERTICAL_DAMPING_RATIO
        ]
    );
}

/// Relative change of an index as a parameter goes up by a share, by evaluation.
fn relative_change(case: &Case, index: Index, parameter: Parameter, share: f64) -> f64 {
    let at = |factor: f64| {
        let mut moved = case.clone();
        parameter.set(&mut moved, factor * parameter.get(case));
        value(&moved, index).unwrap()
    };
    (at(1.0 + share) - at(1.0 - share)) / (2.0 * share * at(1.0))
}

/// “1 % more” of a variable is the relative change of the index that is made as good as can be, also
/// where that is the critical speed or a damping ratio.
#[test]
fn elasticities_are_those_of_the_index() {
    for (name, index) in [
        ("critical-speed-as-objective", Index::CriticalSpeed),
        ("damping-ratio-as-objective", Index::KinematicDampingRatio),
    ] {
        let result = run(&read(name));
        let explained = &result.stages[0].explained;
        assert_eq!(explained.status, Status::Optimal, "{name}");
        for chosen in &explained.chosen {
            let gain = explained.gain_per_share(chosen).unwrap();
            let change = relative_change(&result.optimum, index, chosen.parameter, 1e-4);
            // 1e-3: the critical speed is found to 1e-8, over a difference of 2e-4.
            assert!(
                (gain - change).abs() < 1e-3 * change.abs().max(1.0),
                "{name} {}: {gain} {change}",
                chosen.variable.symbol
            );
        }
    }
}

/// The price, multiplier and elasticities of a required critical speed are those of the speed.
#[test]
fn prices_of_a_critical_speed_are_in_terms_of_the_speed() {
    let spec = support::problem("intercity-130mph");
    let result = run(&spec);
    let stage = &result.stages[1].explained;
    let price = stage
        .prices
        .iter()
        .find(|p| p.index == Index::CriticalSpeed);
    let price = price.unwrap();
    assert_ratio(
        "multiplier",
        price.multiplier,
        price.per_unit * price.bound,
        1e-12,
    );
    for (chosen, elasticity) in stage.chosen.iter().zip(&price.elasticities) {
        let mut case = result.optimum.clone();
        // The stage was solved beside the lateral suspension of the round before, within 1e-4.
        chosen.parameter.set(&mut case, chosen.value);
        let change = relative_change(&case, Index::CriticalSpeed, chosen.parameter, 1e-4);
        let elasticity = elasticity.unwrap();
        assert!(
            (elasticity - change).abs() < 2e-3,
            "{}: {elasticity} {change}",
            chosen.variable.symbol
        );
    }
}

/// In a curve that no suspension runs without flange contact, a limit on L/V is neither met nor missed;
/// the curve is brought as near to the model as the other demands allow.
#[test]
fn forces_beyond_flange_contact_are_not_assessed() {
    let spec = read("curve-beyond-flange-contact");
    let result = run(&spec);
    let forces = result
        .margins
        .iter()
        .find(|m| m.index == Index::WheelLOverV);
    let forces = forces.unwrap();
    assert_eq!(forces.verdict(), Verdict::NotAssessed);
    assert_eq!(forces.reached, Err(Failure::OutsideModel));
    assert!(!result.met());
    let mut others = result
        .margins
        .iter()
        .filter(|m| m.index != Index::WheelLOverV);
    assert!(others.all(Margin::met));
    assert_eq!(status::of_run(&result), "not-assessed");
    let ratio = |case: &Case| value(case, Index::CurveLimitRatio).unwrap();
    assert!(ratio(&result.case) < ratio(&spec.case));
}

/// Where a lighter demand can be had within the model, it is: at 1° the same limit is assessed and met.
#[test]
fn forces_within_the_model_are_assessed() {
    let mut spec = read("curve-beyond-flange-contact");
    spec.case.service.curve = Some(1.0_f64.to_radians());
    let result = run(&spec);
    assert!(result.met(), "{:?}", result.margins);
    assert!(value(&result.case, Index::CurveLimitRatio).unwrap() <= 1.0 + 1e-4);
}

/// A wheel that lifts at the service's cant deficiency has no forces, whatever the suspension: the
/// demand on them is not assessed and the rest is designed.
#[test]
fn a_lifted_wheel_leaves_demands_on_forces_unassessed() {
    let lifted = read("lifted-wheel").case;
    let source = "[vehicle]\nbase = \"prototype\"\n[design]\n\
                  primary_bending_stiffness = [\"1 MN m/rad\", \"9 MN m/rad\"]\n\
                  [requirements]\ncritical_speed = \"150 mph\"\n[limits]\nwheel_l_over_v = 0.8\n";
    let mut spec = Spec::read(source.as_bytes()).unwrap_or_else(|_| panic!("{source}"));
    spec.case = lifted;
    let result = run(&spec);
    let verdict = |index| {
        let margin = result.margins.iter().find(|m| m.index == index);
        margin.unwrap().verdict()
    };
    assert_eq!(verdict(Index::WheelLOverV), Verdict::NotAssessed);
    assert_eq!(verdict(Index::CriticalSpeed), Verdict::Met);
    assert_eq!(status::of_run(&result), "not-assessed");
    assert_eq!(result.stages[0].explained.status, Status::Optimal);
}

/// Stops of 25 mm: without a limit on the stroke in the curve the vehicle leans on them, with it the
/// springs are chosen so that it does not.
#[test]
fn stops_see_the_curve() {
    let mut spec = read("stops-in-curve");
    let stops = spec.demands.get(Index::SecondaryLateralStroke).unwrap();
    let in_curve = |result: &DesignResult| {
        let mut case = result.case.clone();
        // Slip ends the model just short of this curve.
        case.service.curve = Some(1.0_f64.to_radians());
        value(&case, Index::SecondaryLateralStrokeInCurve).unwrap()
    };
    let without = run(&spec);
    assert!(without.met() && in_curve(&without) > 2.0 * stops);
    spec.demands
        .set(Index::SecondaryLateralStrokeInCurve, stops);
    let with = run(&spec);
    let margin = with
        .margins
        .iter()
        .find(|m| m.index == Index::SecondaryLateralStrokeInCurve);
    assert_eq!(margin.unwrap().verdict(), Verdict::Met);
    assert!(in_curve(&with) < 1.01 * stops);
}

/// The prototype at 130 mph with its primary suspension open, and what is added.
fn open_primary(added: &str) -> Spec {
    let source = format!(
        "[service]\nspeed = \"130 mph\"\n{}\n[vehicle]\nbase = \"prototype\"\n[design]\n\
         primary_bending_stiffness = [\"1e5 lbf ft/rad\", \"2e7 lbf ft/rad\"]\n\
         primary_lateral_stiffness = [\"4e4 lbf/ft\", \"5e6 lbf/ft\"]\n{added}",
        if added.contains("adhesion_used") {
            "curve = \"1 deg\""
        } else {
            ""
        },
    );
    Spec::read(source.as_bytes()).unwrap_or_else(|_| panic!("{source}"))
}

/// A demand that nothing can change leaves all others as well met as without it.
#[test]
fn a_hopeless_demand_does_not_hide_others() {
    let spec = open_primary(
        "secondary_lateral_frequency = [\"0.7 Hz\", \"1.5 Hz\"]\n\
         secondary_lateral_damping_ratio = [0.1, 0.6]\n\
         [requirements]\ncritical_speed = \"200 mph\"\nlateral_acceleration = \"0.06 g\"\n\
         vertical_acceleration = \"0.02 g\"\n[limits]\nsecondary_lateral_stroke = \"1.5 in\"\n",
    );
    let result = run(&spec);
    let unmet: Vec<Index> = result.unmet().map(|margin| margin.index).collect();
    assert_eq!(unmet, [Index::VerticalAcceleration]);
    assert_eq!(result.delivered, Delivered::AllAtOnce);
}

/// A design that is assessed and misses a little is better than one that cannot be assessed.
#[test]
fn what_can_be_assessed_is_preferred() {
    let spec = open_primary(
        "[requirements]\ncritical_speed = \"148 mph\"\n[limits]\nadhesion_used = 0.28\n",
    );
    let given = margins(&spec.case, &spec.demands, &spec.conditions);
    assert!(
        given
            .iter()
            .any(|margin| margin.verdict() == Verdict::NotAssessed)
    );
    let result = run(&spec);
    assert_eq!(status::of_run(&result), "infeasible");
    // Forces within the model are weighed against the critical speed: the smaller of the two margins is
    // as large as can be, so that both are missed alike.
    let short: Vec<f64> = result.margins.iter().map(Margin::shortfall).collect();
    let logarithmic = [-(1.0 - short[0]).ln(), (1.0 + short[1]).ln()];
    assert_ratio("shortfalls", logarithmic[0], logarithmic[1], 0.01);
    assert!(logarithmic[0] > 0.01);
    // A sweep has designs at most as good.
    let sweep = Sweep::new(&spec, &[Index::CriticalSpeed, Index::AdhesionUsed], 1).unwrap();
    for design in sweep.designs(1..400) {
        if let [Ok(speed), Ok(adhesion)] = design.values[..] {
            let speed_short = (spec.demands.get(Index::CriticalSpeed).unwrap() / speed).ln();
            let worst = speed_short.max((adhesion / 0.28).ln());
            assert!(worst > logarithmic[0] - 1e-3, "{worst} {logarithmic:?}");
        }
    }
}

/// Conditions that share a bound share its price.
#[test]
fn the_price_of_a_bound_holds_for_all_conditions_that_share_it() {
    let source = |mph: f64| {
        format!(
            "[requirements]\ncritical_speed = \"{mph} mph\"\n\
             [conditions.a]\npassenger.longitudinal_offset = \"7 m\"\n\
             [conditions.b]\npassenger.longitudinal_offset = \"8 m\"\n"
        )
    };
    let degree = |result: &DesignResult| value(&result.optimum, Index::DegreeCurve).unwrap();
    let result = run(&open_primary(&source(150.0)));
    let explained = &result.stages[0].explained;
    let prices: Vec<_> = explained.prices.iter().collect();
    let [price] = prices[..] else {
        panic!("{prices:?}")
    };
    assert_eq!(price.conditions.len(), 3);
    let dearer = degree(&run(&open_primary(&source(150.1))));
    let change = (dearer - degree(&result)) / (0.1 * support::MPH);
    // Over a tenth of a mile per hour the curve is straight to a hundredth.
    assert_ratio("price", explained.price(price), change, 0.01);
}

/// A limit on the random stroke alone: the result warns that the vehicle leans beyond its stops.
#[test]
fn stops_forgotten_in_a_curve_are_warned_of() {
    let mut spec = read("stops-in-curve");
    let result = run(&spec);
    let warned = |spec: &Spec| {
        let all = warnings(&result.case, &result.evaluation, &spec.demands);
        all.iter()
            .any(|text| text.contains("secondary_lateral_stroke_in_curve"))
    };
    assert!(result.met() && warned(&spec));
    spec.demands.set(Index::SecondaryLateralStrokeInCurve, 1.0);
    assert!(!warned(&spec));
}
