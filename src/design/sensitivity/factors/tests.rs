use super::*;
use crate::spec::Spec;

fn factors(design: &str, spread: f64) -> Factors {
    let source = format!("[vehicle]\nbase = \"prototype\"\n[design]\n{design}\n");
    let spec = Spec::parse(&source).unwrap_or_else(|m| panic!("{}", m.render("", &source, false)));
    Factors::new(&spec.case, &spec.design, spread)
}

fn paths(factors: &Factors) -> Vec<&'static str> {
    factors.list().iter().map(|f| f.path).collect()
}

#[test]
fn the_middle_is_the_case_itself() {
    let factors = Factors::new(&Case::prototype(), &DesignSpace::default(), 0.1);
    let middle = factors.case(&vec![0.5; factors.list().len()]);
    for ((path, a), (_, b)) in keys::inputs_si(&middle)
        .into_iter()
        .zip(keys::inputs_si(&Case::prototype()))
    {
        assert!((a - b).abs() <= 1e-12 * b.abs(), "{path}: {a} {b}");
    }
    let low = factors.case(&vec![0.0; factors.list().len()]);
    assert!((low.wheel_rail.friction - 0.18).abs() < 1e-12);
    // -h_cs, and K_px/250, follow what they come from.
    let (h, h_cs) = (
        low.vehicle.passenger.height_above_carbody_cg,
        low.vehicle.carbody.height_above_secondary,
    );
    assert!(
        (h + h_cs).abs() < 1e-15
            && low
                .vehicle
                .suspension
                .primary
                .longitudinal_damping
                .is_none()
    );
}

#[test]
fn what_the_design_determines_is_no_factor() {
    let factors = factors(
        "primary_bending_stiffness = [\"1e5 lbf ft/rad\", \"2e7 lbf ft/rad\"]\n\
         primary_lateral_stiffness = { tied_to = \"primary_longitudinal_stiffness\", ratio = 0.5 }\n\
         conicity = { choices = [0.05, 0.25, 0.10] }\n\
         primary_vertical_frequency = \"10 Hz\"\n\
         secondary_lateral_frequency = [\"0.7 Hz\", \"1.5 Hz\"]\n\
         secondary_yaw_stiffness = [\"0 lbf ft/rad\", \"5e6 lbf ft/rad\"]",
        0.1,
    );
    let list = paths(&factors);
    for determined in [
        "suspension.primary.longitudinal_stiffness",
        "suspension.primary.lateral_stiffness",
        "suspension.primary.vertical_stiffness",
        "suspension.secondary.lateral_stiffness",
        "suspension.secondary.yaw_stiffness",
        "wheel_rail.conicity",
        "service.speed",
        "passenger.height_above_carbody_cg",
        "vehicle.wheelset.roll_inertia",
    ] {
        assert!(!list.contains(&determined), "{determined}");
    }
    // A frequency keeps the damping ratio, but the ratio is still the base's.
    assert!(list.contains(&"suspension.secondary.lateral_damping"));
    assert!(list.contains(&"suspension.secondary.vertical_stiffness"));
    let open: Vec<&Factor> = factors.list().iter().filter(|f| f.open).collect();
    assert_eq!(open.len(), 4);
    assert_eq!(
        (open[0].variable.scale, open[0].variable.bounds),
        (Scale::Linear, [0.05, 0.25])
    );
    assert_eq!(open[1].variable.scale, Scale::Logarithmic);
    assert_eq!(open[2].variable.scale, Scale::Linear);
    let case = factors.case(&vec![0.9; list.len()]);
    let primary = &case.vehicle.suspension.primary;
    let ratio = primary.lateral_stiffness / primary.longitudinal_stiffness;
    assert!((ratio - 0.5).abs() < 1e-12);
    let frequency = Parameter::PRIMARY_VERTICAL_FREQUENCY.get(&case);
    assert!((frequency - 10.0).abs() < 1e-9, "{frequency}");
}

#[test]
fn a_spread_of_nothing_leaves_the_open_parameters() {
    let open = factors("secondary_vertical_damping_ratio = [0.1, 0.6]", 0.0);
    assert_eq!(paths(&open), ["design.secondary_vertical_damping_ratio"]);
}

#[test]
fn bounds_stay_physical() {
    for (value, spread, range, expected) in [
        (0.95, 0.1, Range::PositiveUpTo(1.0), (0.855, 1.0)),
        (-2.0, 0.5, Range::Any, (-3.0, -1.0)),
        (0.5, 0.5, Range::PositiveUpTo(0.25), (0.25, 0.75)),
        (0.96, 0.5, Range::Between(0.0, 1.0), (0.48, 1.0)),
    ] {
        let [lower, upper] = around(value, spread, range);
        assert_eq!((lower, upper), expected);
    }
}

#[test]
fn labels() {
    let factors = Factors::new(&Case::prototype(), &DesignSpace::default(), 0.1);
    let labels: Vec<&str> = factors.list().iter().map(Factor::label).collect();
    for label in [
        "M_c",
        "bending.frequency",
        "wheel_rail.creep_factor",
        "T_sψ",
    ] {
        assert!(labels.contains(&label), "{labels:?}");
    }
    let mut unique = labels.clone();
    unique.sort_unstable();
    unique.dedup();
    assert_eq!(unique.len(), labels.len());
}
