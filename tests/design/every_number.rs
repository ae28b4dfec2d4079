//! Every number of a vehicle, of wheel and rail and of the passenger points may vary, whatever it is.

use bogie::{
    Case, Index, Parameter, Spec,
    design::study::Study,
    optimize::problem::{Detail, Problem},
    spec::Freedom,
    units::Quantity,
};

/// The prototype with an air spring and an anti-roll bar; its conicity is off the rows of the table, where
/// coefficients have a kink.
const VEHICLE: &str = r#"
[service]
speed = "100 mph"
track = "fra-class-5"
[vehicle]
base = "prototype"
[suspension.secondary.air_spring]
direct_stiffness = "50 kN/m"
series_stiffness = "600 kN/m"
orifice_damping = "20 kN s/m"
reservoir_stiffness = "300 kN/m"
[wheel_rail]
conicity = 0.07
[suspension.anti_roll_bar]
stiffness = "500 kN m/rad"
"#;

fn written(si: f64, quantity: Quantity) -> String {
    let unit = quantity.si();
    match quantity {
        Quantity::Dimensionless => format!("{si:e}"),
        _ => format!("\"{:e} {}\"", unit.of(si), unit.label),
    }
}

/// A design over ± 5 % of one number, or from nothing where it is zero: the spec is read, both bounds are reached,
/// and derivatives are those of differences.
///
/// 1e-4 of the value: RMS values are good to 1e-7, which the step of 1e-3 divides.
#[test]
fn every_number_can_be_a_variable() {
    const STEP: f64 = 1e-3;
    let given = Spec::parse(VEHICLE).unwrap();
    let mut acting = 0;
    for parameter in Parameter::plain() {
        let value = parameter.find(&given.case);
        let value = value.unwrap_or_else(|| panic!("{parameter:?} has no value"));
        let reach = if value == 0.0 {
            1e-3
        } else {
            0.05 * value.abs()
        };
        let bounds = [value - reach, value + reach].map(|b| {
            let [low, high] = [0.0, 0.25];
            // The conicity's table ends at 0.25; what is not negative begins at 0.
            if parameter == Parameter::CONICITY {
                b.clamp(low, high)
            } else if parameter.range().contains(b) {
                b
            } else {
                value
            }
        });
        let [low, high] = bounds.map(|b| written(b, parameter.quantity()));
        let line = format!("[design]\n\"{}\" = [{low}, {high}]\n", parameter.name());
        let spec = Spec::parse(&format!("{VEHICLE}{line}"))
            .unwrap_or_else(|mistakes| panic!("{}: {mistakes:?}", parameter.name()));
        let [(read, Freedom::Between(interval))] = &spec.design.parameters[..] else {
            panic!("{}: {:?}", parameter.name(), spec.design.parameters);
        };
        assert_eq!(*read, parameter);
        let study = Study::new(&spec.case, &[])
            .vary(parameter, *interval)
            .optimise(0, Index::LateralAcceleration, 0, 1.0)
            .optimise(0, Index::VerticalAcceleration, 1, 1.0);
        for (x, bound) in [(0.0, interval.lower), (1.0, interval.upper)] {
            let reached = parameter.get(&study.design(&[x]));
            assert!(
                (reached - bound).abs() <= 1e-12 * bound.abs().max(reach),
                "{parameter:?}"
            );
        }
        let at = |x: f64| -> Vec<f64> {
            let pieces = study.measure(&[x], Detail::Values).unwrap();
            pieces.iter().map(|piece| piece.value).collect()
        };
        let pieces = study.measure(&[0.5], Detail::Gradients).unwrap();
        let (before, after) = (at(0.5 - STEP), at(0.5 + STEP));
        for (k, piece) in pieces.iter().enumerate() {
            let slope = (after[k] - before[k]) / (2.0 * STEP);
            let gradient = piece.gradient.as_ref();
            let exact = gradient.map_or(f64::NAN, |gradient| gradient[0]);
            assert!(
                (exact - slope).abs() < 1e-4 * piece.value,
                "{parameter:?}: {exact:e} {slope:e}"
            );
            acting += usize::from(exact.abs() > 1e-6 * piece.value);
        }
    }
    assert!(acting > 80, "{acting}");
}

/// Two designs that differ in one number, whichever it is, are two designs for the archive.
#[test]
fn no_design_is_taken_for_another() {
    let spec = Spec::parse(VEHICLE).unwrap();
    let mut keys = Vec::new();
    for parameter in Parameter::plain() {
        let mut case: Case = spec.case.clone();
        let value = parameter.get(&case);
        parameter.set(&mut case, value * 1.01 + 1e-6);
        let study = Study::new(&case, &[]).optimise(0, Index::VerticalAcceleration, 0, 1.0);
        keys.push(format!("{:?}", study.key(&[])));
    }
    let count = keys.len();
    keys.sort();
    keys.dedup();
    assert_eq!(keys.len(), count);
}

/// An air spring that is not there cannot vary.
#[test]
fn a_part_that_is_not_there_cannot_vary() {
    let text = "[service]\nspeed = \"100 mph\"\ntrack = \"fra-class-5\"\n[vehicle]\nbase = \"prototype\"\n\
                [design]\n\"suspension.secondary.air_spring.orifice_damping\" = [\"1 kN s/m\", \"50 kN s/m\"]\n";
    let mistakes = Spec::parse(text).unwrap_err();
    let message = format!("{mistakes:?}");
    assert!(message.contains("has no value to start from"), "{message}");
}
