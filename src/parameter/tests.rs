use super::*;
use crate::vehicle::AIR_SPRING;

/// The prototype with an air spring, so that every number has a value.
fn case() -> Case {
    let mut case = Case::prototype();
    for (number, value) in AIR_SPRING.numbers.iter().zip([1e5, 5e5, 2e4, 3e5]) {
        (number.key.set)(&mut case.vehicle, value);
    }
    case
}

#[test]
fn a_value_that_is_set_is_in_force() {
    for parameter in Parameter::all() {
        let mut case = case();
        let value = 1.1 * parameter.get(&case) + f64::from(u8::from(parameter.get(&case) == 0.0));
        parameter.set(&mut case, value);
        let ratio = parameter.get(&case) / value;
        assert!((ratio - 1.0).abs() < 1e-12, "{parameter:?}: {ratio}");
        let constant = parameter.constant();
        assert_eq!(constant.constant(), constant);
        assert_eq!(Parameter::named(parameter.name()), Some(parameter));
    }
}

#[test]
fn the_parameters_of_the_table_have_their_numbers() {
    assert_eq!(Parameter::CONICITY.name(), "conicity");
    assert_eq!(Parameter::PRIMARY_BENDING_STIFFNESS.symbol(), "K_b");
    assert_eq!(Parameter::SECONDARY_VERTICAL_DAMPING.symbol(), "C_sz");
    assert_eq!(Parameter::PRIMARY_VERTICAL_FREQUENCY.symbol(), "f_nP");
    assert_eq!(Parameter::plain_of_table().count(), 10);
}

/// Names and paths are unique.
#[test]
fn every_parameter_has_a_name_of_its_own() {
    let mut names: Vec<&str> = Parameter::all().map(Parameter::name).collect();
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count);
}

/// A case whose every number is set to that of another, apart from the service, is the other.
#[test]
fn the_plain_parameters_are_the_whole_design() {
    let mut other = case();
    for (i, parameter) in Parameter::plain().enumerate() {
        let value = parameter.get(&other);
        parameter.set(&mut other, value * (1.0 + 0.001 * i as f64) + 1e-3);
    }
    let mut set = case();
    for parameter in Parameter::plain() {
        parameter.set(&mut set, parameter.get(&other));
    }
    assert_eq!(set, other);
}

/// A number of the leading end is the trailing end's too, unless that has its own.
#[test]
fn the_trailing_end_follows_but_in_its_own_numbers() {
    let mut case = case();
    let leading = Parameter::PRIMARY_LATERAL_STIFFNESS;
    let trailing = Parameter::named("trailing.suspension.primary.lateral_stiffness").unwrap();
    let other = Parameter::PRIMARY_VERTICAL_STIFFNESS;
    leading.set(&mut case, 1e6);
    assert_eq!(trailing.get(&case).to_bits(), 1e6_f64.to_bits());
    trailing.set(&mut case, 2e6);
    leading.set(&mut case, 3e6);
    other.set(&mut case, 4e6);
    let [front, rear] = [0, 1].map(|j| case.vehicle.end(j).suspension.primary);
    let same = |a: f64, b: f64| a.to_bits() == b.to_bits();
    assert!(same(front.lateral_stiffness, 3e6) && same(rear.lateral_stiffness, 2e6));
    assert!(same(front.vertical_stiffness, 4e6) && same(rear.vertical_stiffness, 4e6));
    // A derived damping follows from the end's own stiffness.
    assert!((rear.c_py() - 2e6 / 250.0).abs() < 1e-9);
}

#[test]
fn a_frequency_keeps_the_damping_ratio() {
    let mut case = Case::prototype();
    let ratio = Parameter::SECONDARY_LATERAL_DAMPING_RATIO.get(&case);
    Parameter::SECONDARY_LATERAL_FREQUENCY.set(&mut case, 0.6);
    let kept = Parameter::SECONDARY_LATERAL_DAMPING_RATIO.get(&case);
    assert!((kept / ratio - 1.0).abs() < 1e-12);
}
