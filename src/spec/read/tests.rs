use proptest::prelude::*;

use super::*;
use crate::index::Index;
use crate::parameter::Parameter;
use crate::spec::{Freedom, Order, inputs_si};
use crate::track::{Spectrum, Track};
use crate::units::us::{FOOT, LBF, MILE, SLUG};

const BASE: &str = "[vehicle]\nbase = \"prototype\"\n";
const INTERCITY: &str = include_str!("../../../problems/intercity-130mph.toml");

fn parse(source: &str) -> Spec {
    Spec::parse(source).unwrap_or_else(|m| panic!("{}", m.render("test", source, false)))
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * b.abs()
}

/// A spec with every value of a case, in the quantities' SI or US display units.
fn write(values: &[(&str, f64)], us: bool) -> String {
    let key = |path: &str| keys::at(path).unwrap();
    let line = |&(path, si): &(&str, f64)| {
        let quantity = key(path).quantity;
        let unit = if us { quantity.us() } else { quantity.si() };
        match unit.label {
            "" => format!("{path} = {si:?}\n"),
            label => format!("{path} = \"{} {label}\"\n", unit.of(si)),
        }
    };
    values.iter().map(line).collect()
}

#[test]
fn base_alone_is_the_prototype() {
    let spec = parse(BASE);
    assert_eq!(spec.case, Case::prototype());
    assert_eq!(spec.design, DesignSpace::default());
    assert_eq!(spec.demands, Demands::default());
    assert!(spec.objective.is_empty() && spec.conditions.is_empty());
}

#[test]
fn every_key_reads_what_it_writes() {
    let mut case = Case::prototype();
    for (i, key) in (1..).zip(keys::case()) {
        // Different from every other key and within every range.
        let value = f64::from(i) * 1e-3;
        assert!(key.range.contains(value), "{}", key.path);
        key.set(&mut case, value);
        assert_eq!(key.get(&case), Some(value), "{}", key.path);
    }
    let values = inputs_si(&case);
    assert_eq!(values.len(), keys::case().count());
    for (i, (path, value)) in (1..).zip(values) {
        assert!(close(value, f64::from(i) * 1e-3), "{path} shares a field");
    }
}

#[test]
fn paths_are_unique() {
    let mut paths = keys::paths();
    let count = paths.len();
    paths.sort_unstable();
    paths.dedup();
    assert_eq!(paths.len(), count);
}

#[test]
fn si_and_us_units_give_the_same_case() {
    let values = inputs_si(&Case::prototype());
    let complete = [false, true].map(|us| parse(&write(&values, us)).case);
    for case in &complete {
        assert_eq!(case.service.track, Track::fra_class(6).unwrap());
        for ((path, value), (_, expected)) in inputs_si(case).iter().zip(&values) {
            assert!(close(*value, *expected), "{path}: {value} {expected}");
        }
    }
}

/// The inputs of the reference cases come back as they went in, without a base.
#[test]
fn reference_cases_round_trip() {
    let cases: Vec<serde_json::Value> =
        serde_json::from_str(include_str!("../../../tests/data/cases.json")).unwrap();
    for reference in cases {
        let inputs = reference["inputs_si"].as_object().unwrap();
        let speed = reference["speed_m_per_s"].as_f64().unwrap();
        let mut values = vec![("service.speed", speed)];
        values.extend(
            inputs
                .iter()
                .filter_map(|(path, v)| Some((path.as_str(), v.as_f64()?))),
        );
        let option = format!("model.truck_roll = {}\n", inputs["model.truck_roll"]);
        let spec = parse(&(option + &write(&values, false)));
        let read = inputs_si(&spec.case);
        for (path, si) in values {
            let found = read.iter().find(|(p, _)| *p == path).unwrap();
            assert!(close(found.1, si), "{path}: {} {si}", found.1);
        }
        let dynamic = spec.case.model.truck_roll == crate::case::TruckRoll::Dynamic;
        assert_eq!(dynamic, inputs["model.truck_roll"] == "dynamic");
    }
}

#[test]
fn all_problems_and_the_starter_parse() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/problems");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            parse(&std::fs::read_to_string(path).unwrap());
            count += 1;
        }
    }
    assert_eq!(count, 11);
    parse(STARTER);
}

#[test]
fn example_1_reads_as_printed() {
    let spec = parse(INTERCITY);
    let vehicle = &spec.case.vehicle;
    assert!(close(vehicle.carbody.mass, 2500.0 * SLUG));
    assert!(close(vehicle.bending_stiffness(), 1.8e6 * LBF * FOOT));
    assert!(close(spec.case.service.speed, 130.0 * MILE / 3600.0));
    let Some(Freedom::Between(bending)) = spec.design.freedom(Parameter::PRIMARY_BENDING_STIFFNESS)
    else {
        panic!("K_b is open");
    };
    assert!(close(bending.lower, 1e5 * LBF * FOOT) && close(bending.upper, 2e7 * LBF * FOOT));
    assert_eq!(
        spec.design.freedom(Parameter::CONICITY),
        Some(&Freedom::Choices(vec![0.05, 0.10, 0.15, 0.25]))
    );
    assert!(close(
        spec.demands.get(Index::SecondaryLateralStroke).unwrap(),
        1.5 * 0.0254
    ));
}

/// The problems are the reference cases of the same design.
#[test]
fn problems_have_the_inputs_of_their_reference_cases() {
    let cases: Vec<serde_json::Value> =
        serde_json::from_str(include_str!("../../../tests/data/cases.json")).unwrap();
    for (name, source) in [
        (
            "prototype",
            include_str!("../../../problems/prototype.toml"),
        ),
        ("example-1", INTERCITY),
        (
            "example-2",
            include_str!("../../../problems/urban-80mph.toml"),
        ),
    ] {
        let reference = cases.iter().find(|case| case["name"] == name).unwrap();
        let read = inputs_si(&parse(source).case);
        for (path, value) in reference["inputs_si"].as_object().unwrap() {
            if let (Some(si), Some((_, found))) =
                (value.as_f64(), read.iter().find(|(p, _)| p == path))
            {
                assert!(close(*found, si), "{name} {path}: {found} {si}");
            }
        }
    }
}

#[test]
fn passengers_stay_on_the_floor() {
    let low = parse(&format!(
        "{BASE}[vehicle.carbody]\nheight_above_secondary = \"1 m\""
    ));
    assert!(close(
        low.case.vehicle.passenger.height_above_carbody_cg,
        -1.0
    ));
    let given = parse(&format!(
        "{BASE}[passenger]\nheight_above_carbody_cg = \"0 m\""
    ));
    assert!(given.case.vehicle.passenger.height_above_carbody_cg.abs() < 1e-15);
}

#[test]
fn what_a_parameter_may_do() {
    let source = "[design]\norder = \"joint\"\nseed = 7\n\
        primary_longitudinal_stiffness = [\"1 MN/m\", \"2 MN/m\"]\n\
        primary_lateral_stiffness = { tied_to = \"primary_longitudinal_stiffness\", ratio = 0.5 }\n\
        secondary_lateral_frequency = \"0.9 Hz\"\n\
        secondary_yaw_breakaway_torque = [\"0 N m\", \"20 kN m\"]\n";
    let design = parse(&format!("{BASE}{source}")).design;
    assert_eq!((design.order, design.seed), (Order::Joint, 7));
    let freedom = |parameter| design.freedom(parameter).unwrap();
    assert!(matches!(
        freedom(Parameter::PRIMARY_LONGITUDINAL_STIFFNESS),
        Freedom::Between(bounds) if close(bounds.lower, 1e6) && close(bounds.upper, 2e6)
    ));
    let tied = Freedom::Tied {
        to: Parameter::PRIMARY_LONGITUDINAL_STIFFNESS,
        ratio: 0.5,
    };
    assert_eq!(*freedom(Parameter::PRIMARY_LATERAL_STIFFNESS), tied);
    assert_eq!(
        *freedom(Parameter::SECONDARY_LATERAL_FREQUENCY),
        Freedom::Fixed(0.9)
    );
    assert!(matches!(
        freedom(Parameter::SECONDARY_YAW_BREAKAWAY_TORQUE),
        Freedom::Between(bounds) if bounds.lower == 0.0
    ));
}

#[test]
fn objectives_fronts_and_conditions() {
    let source = "[objective]\nmaximize = \"degree_curve\"\n\
        minimize = { lateral_acceleration = 2.0 }\n\
        [requirements]\ncritical_speed = \"200 mph\"\nleast_damping_ratio_to_speed = 0.05\n\
        [limits]\nwheel_l_over_v = 0.8\n\
        [pareto]\nindices = [\"critical_speed\", \"lateral_acceleration\"]\npoints = 9\n\
        bounds = { critical_speed = \"75 mph\" }\n\
        [conditions.worn]\nwheel_rail.conicity = 0.15\nservice.track = \"fra-class-4\"\n\
        [conditions.worn.requirements]\ncritical_speed = \"150 mph\"\n\
        [conditions.loaded.vehicle.carbody]\nmass = \"48 t\"\n";
    let spec = parse(&format!("{BASE}{source}"));
    let goals: Vec<(Index, f64)> = spec.objective.iter().map(|g| (g.index, g.weight)).collect();
    assert_eq!(
        goals,
        [(Index::DegreeCurve, 1.0), (Index::LateralAcceleration, 2.0)]
    );
    assert_eq!(
        spec.demands.get(Index::LeastDampingRatioToSpeed),
        Some(0.05)
    );
    assert_eq!(spec.demands.get(Index::WheelLOverV), Some(0.8));
    assert_eq!(
        spec.front.indices,
        [Index::CriticalSpeed, Index::LateralAcceleration]
    );
    assert_eq!(spec.front.points, 9);
    let bound = spec.front.bounds.get(Index::CriticalSpeed).unwrap();
    assert!(close(bound, 75.0 * MILE / 3600.0));
    let worn = spec.conditions.iter().find(|c| c.name == "worn").unwrap();
    let case = worn.apply(&spec.case);
    assert!(close(case.wheel_rail.conicity, 0.15));
    assert_eq!(case.service.track.name, "fra-class-4");
    let demands = spec.demands.overridden(&worn.demands);
    assert!(close(
        demands.get(Index::CriticalSpeed).unwrap(),
        150.0 * MILE / 3600.0
    ));
    assert_eq!(demands.get(Index::WheelLOverV), Some(0.8));
    let loaded = spec.conditions.iter().find(|c| c.name == "loaded").unwrap();
    assert!(close(
        loaded.apply(&spec.case).vehicle.carbody.mass,
        48_000.0
    ));
}

#[test]
fn degree_curve_is_kept_in_degrees() {
    let spec = parse(&format!("{BASE}[requirements]\ndegree_curve = \"25 deg\""));
    let degree = spec.demands.get(Index::DegreeCurve).unwrap().to_degrees();
    assert!(close(degree, 25.0));
}

#[test]
fn tracks_of_ones_own() {
    let class_6 = "form = \"fra\"\nvertical_roughness = \"0.00159 in^2 rad/ft\"\n\
                   alignment_roughness = \"0.00159 in^2 rad/ft\"\n\
                   crosslevel_corner_wavenumber = \"0.1335 rad/ft\"";
    let source = format!("{BASE}[service]\ntrack = \"ours\"\n[tracks.ours]\n{class_6}");
    let track = parse(&source).case.service.track;
    let published = Track::fra_class(6).unwrap();
    assert_eq!(track.name, "ours");
    for omega in [0.01, 0.5, 3.0] {
        let (ours, theirs) = (
            track.crosslevel.density(omega),
            published.crosslevel.density(omega),
        );
        assert!(close(ours, theirs));
        assert!(close(
            track.vertical.density(omega),
            published.vertical.density(omega)
        ));
    }

    let points = "wavenumber = [\"0.1 rad/m\", \"1 rad/m\"]\n\
                  density = [\"1e-5 m^2/(rad/m)\", \"1e-7 m^2/(rad/m)\"]\n";
    let tables =
        ["vertical", "alignment", "crosslevel"].map(|t| format!("[tracks.ours.{t}]\n{points}"));
    let source = format!("{BASE}[service]\ntrack = \"ours\"\n{}", tables.concat());
    let track = parse(&source).case.service.track;
    assert_eq!(
        track.alignment,
        Spectrum::Points(vec![[0.1, 1e-5], [1.0, 1e-7]])
    );
}

#[test]
fn own_coefficients_lift_the_bound_of_the_conicity() {
    let coefficients = "lateral_creep = \"9 MN\"\nlateral_spin_creep = \"20 kN m\"\n\
                        spin_creep = \"60 N m^2\"\nlongitudinal_creep = \"10 MN\"\n\
                        roll_coefficient = 0.1\ncontact_angle = \"5 deg\"\n\
                        contact_angle_difference = 20\n";
    let source = format!("{BASE}[wheel_rail]\nconicity = 0.4\n{coefficients}");
    assert!(close(parse(&source).case.wheel_rail.conicity, 0.4));
    assert!(Spec::parse(&source.replace("roll_coefficient = 0.1\n", "")).is_err());
}

/// A condition takes what it does not give from `[wheel_rail]`.
#[test]
fn coefficients_of_a_condition_lift_the_bound_of_its_conicity() {
    let creep = [
        "lateral_creep = \"9 MN\"",
        "lateral_spin_creep = \"20 kN m\"",
        "spin_creep = \"60 N m^2\"",
        "longitudinal_creep = \"10 MN\"",
    ];
    let geometry = [
        "roll_coefficient = 0.1",
        "contact_angle = \"5 deg\"",
        "contact_angle_difference = 20",
    ];
    let source = |nominal: &[&str], worn: &[&str]| {
        format!(
            "{BASE}[wheel_rail]\n{}\n[conditions.worn.wheel_rail]\nconicity = 0.35\n{}\n",
            nominal.join("\n"),
            worn.join("\n")
        )
    };
    let all = [&creep[..], &geometry].concat();
    // One doubt where coefficients meant for the nominal profile stay.
    for (nominal, worn, doubts) in [
        (&[][..], &all[..], 0),
        (&creep, &geometry, 1),
        (&all, &[], 1),
        (&all, &all, 0),
    ] {
        let spec = parse(&source(nominal, worn));
        let case = spec.conditions[0].apply(&spec.case);
        assert!(close(case.wheel_rail.conicity, 0.35));
        assert_eq!(spec.doubts.iter().count(), doubts, "{nominal:?} {worn:?}");
    }
    assert!(Spec::parse(&source(&creep[1..], &geometry)).is_err());
}

/// A value in `[design]` is for the design; the vehicle as given keeps its own.
#[test]
fn a_plain_value_in_the_design_stands_beside_the_vehicles_own() {
    let source = "[suspension.primary]\nlateral_stiffness = \"7.3 MN/m\"\n[design]\n";
    let of = |value: &str| {
        let value = format!("primary_lateral_stiffness = \"{value}\"\n");
        parse(&format!("{BASE}{source}{value}"))
    };
    let spec = of("5 MN/m");
    let freedom = spec.design.freedom(Parameter::PRIMARY_LATERAL_STIFFNESS);
    assert_eq!(freedom, Some(&Freedom::Fixed(5e6)));
    assert!(close(
        Parameter::PRIMARY_LATERAL_STIFFNESS.get(&spec.case),
        7.3e6
    ));
    assert_eq!(spec.doubts.iter().count(), 1);
    assert_eq!(of("7300 N/mm").doubts.iter().count(), 0);
}

#[test]
fn all_mistakes_are_found_in_the_order_of_lines() {
    let source = "[limits]\nprimary_lateral_stroke = 1\n[vehicle]\nbase = \"prototype\"\n\
                  [vehicle.truck]\nmass = \"1 m\"\n[wheel_rail]\nfriction = 2\nfrition = 0.2";
    let mistakes = Spec::parse(source).unwrap_err();
    let starts: Vec<usize> = mistakes
        .iter()
        .map(|m| m.span.clone().unwrap().start)
        .collect();
    assert_eq!(starts.len(), 4);
    assert!(starts.is_sorted());
}

#[test]
fn files_that_are_no_text_are_refused() {
    let error = Spec::read(b"[vehicle]\nbase = \"\xff\"").unwrap_err();
    assert!(error.to_string().contains("byte 18, in line 2"), "{error}");
    let error = Spec::read(&vec![b' '; MAX_BYTES + 1]).unwrap_err();
    assert!(error.to_string().contains("at most 1 MiB"), "{error}");
}

#[test]
fn deep_nesting_is_a_mistake() {
    for deep in [
        "a.".repeat(100_000) + "a = 1",
        format!("a = {}", "[".repeat(100_000)),
    ] {
        assert!(Spec::read(deep.as_bytes()).is_err());
    }
}

proptest! {
    #[test]
    fn mutated_specs_never_panic(
        edits in prop::collection::vec((any::<prop::sample::Index>(), 0..8usize, "\\PC{0,4}"), 1..6),
        starter in any::<bool>(),
    ) {
        let mut text: Vec<char> = if starter { STARTER } else { INTERCITY }.chars().collect();
        for (place, removed, inserted) in edits {
            let at = place.index(text.len());
            let end = (at + removed).min(text.len());
            text.splice(at..end, inserted.chars());
        }
        let source: String = text.into_iter().collect();
        if let Err(mistakes) = Spec::read(source.as_bytes()) {
            prop_assert!(mistakes.iter().count() > 0);
            mistakes.render("mutated.toml", &source, true);
        }
    }

    #[test]
    fn bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = Spec::read(&bytes);
    }
}
