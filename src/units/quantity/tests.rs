use proptest::prelude::*;

use super::*;
use crate::units::us::{FOOT, INCH, LBF, MILE, SLUG};

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-14 * b.abs()
}

#[test]
fn values_as_engineers_write_them() {
    use Quantity as Q;
    let deg = std::f64::consts::PI / 180.0;
    for (quantity, text, si) in [
        (Q::Mass, "2500 slug", 2500.0 * SLUG),
        (Q::Mass, "41740 kg", 41_740.0),
        (Q::Mass, "41.74t", 41_740.0),
        (Q::Mass, "1 lbm", 0.453_592_37),
        (
            Q::Inertia,
            "1.764e6 slug ft^2",
            1.764e6 * SLUG * FOOT * FOOT,
        ),
        (Q::Inertia, "103500 kg·m²", 103_500.0),
        (Q::Stiffness, "24000 lbf/ft", 24_000.0 * LBF / FOOT),
        (Q::Stiffness, "350.7 kN/m", 350_700.0),
        (Q::Stiffness, "2 kip/in", 2000.0 * LBF / INCH),
        (Q::Stiffness, "1 N m^-1", 1.0),
        (Q::Damping, "1200 lbf s/ft", 1200.0 * LBF / FOOT),
        (Q::Damping, "17530 N s/m", 17_530.0),
        (Q::Damping, "17.53 kN/(m/s)", 17_530.0),
        (Q::Damping, "17.53 kN*s*m⁻¹", 17_530.0),
        (Q::RotationalStiffness, "1e6 lbf ft/rad", 1e6 * LBF * FOOT),
        (Q::RotationalStiffness, "1.36e6 N m/rad", 1.36e6),
        (Q::RotationalStiffness, "1.36 MN m", 1.36e6),
        (Q::RotationalDamping, "5420 N m s/rad", 5420.0),
        (Q::RotationalDamping, "5420 N m s", 5420.0),
        (Q::Torque, "7500 lbf ft", 7500.0 * LBF * FOOT),
        (Q::Speed, "130 mph", 130.0 * MILE / 3600.0),
        (Q::Speed, "58.1 m/s", 58.1),
        (Q::Speed, "210 km/h", 210.0 * (1000.0 / 3600.0)),
        (Q::Speed, "1 mi/min", MILE / 60.0),
        (Q::Stroke, "0.5 in", 0.0127),
        (Q::Stroke, "12.7 mm", 12.7 * 1e-3),
        (Q::Stroke, "+.5e0 in", 0.0127),
        (Q::Frequency, "7.1 Hz", 7.1),
        (Q::Angle, "1.5 deg", 1.5 * deg),
        (Q::Angle, "1.5°", 1.5 * deg),
        (Q::Angle, "-2 mrad", -2e-3),
        (Q::Acceleration, "0.05 g", 0.05 * 9.806_65),
        (Q::Acceleration, "0.5 m/s/s", 0.5),
        (
            Q::Roughness,
            "1.59e-3 in^2 rad/ft",
            1.59e-3 * INCH * INCH / FOOT,
        ),
        (Q::Roughness, "4.032e-7 m rad", 4.032e-7),
        (Q::SpectralDensity, "1e-6 m^2/(rad/m)", 1e-6),
        (Q::Wavenumber, "0.1 rad/m", 0.1),
        (Q::SpinCreep, "160 lbf ft^2", 160.0 * LBF * FOOT * FOOT),
    ] {
        let value = quantity
            .parse(text)
            .unwrap_or_else(|e| panic!("{text}: {e}"));
        assert!(close(value, si), "{text}: {value} against {si}");
    }
}

#[rustfmt::skip]
#[test]
fn what_is_wrong_is_said() {
    use Quantity as Q;
    for (quantity, text, message, help) in [
        (Q::Mass, "2500", "`2500` has no unit", None),
        (Q::Mass, "", "no number at the beginning of ``", None),
        (Q::Mass, "heavy", "no number at the beginning of `heavy`", None),
        (Q::Mass, "nan kg", "no number at the beginning of `nan kg`", None),
        (Q::Mass, "1e999 kg", "`1e999 kg` is not a finite number", None),
        (Q::Mass, "1e308 t", "`1e308 t` is not a finite number", None),
        (Q::Mass, "2500 lb", "`lb` may be a force or a mass", Some("write `lbf` for a force, `lbm` or `slug` for a mass")),
        (Q::Mass, "2500 slgu", "unknown unit `slgu`", Some("did you mean `slug`?")),
        (Q::Mass, "2500 KG", "unknown unit `KG`", Some("did you mean `kg`?")),
        (Q::Speed, "130 kph", "unknown unit `kph`", Some("did you mean `km/h`?")),
        (Q::Length, "3 blorks", "unknown unit `blorks`", None),
        (Q::Mass, "2500 lbf", "`lbf` is the unit of a force, not a mass", None),
        (Q::Torque, "7500 lbf ft/rad", "`lbf ft/rad` is the unit of a rotational stiffness, not a torque", None),
        (Q::Length, "3 m rad", "`m rad` is the unit of a roughness constant, not a length", None),
        (Q::Frequency, "44 rad/s", "`rad/s` is s^-1 rad in base units, not a frequency", None),
        (Q::Wavenumber, "0.1 1/m", "`1/m` is m^-1 in base units, not a wavenumber", Some("wavenumbers are in radians: 1 cycle/m is 6.2832 rad/m")),
        (Q::Mass, "2,500 kg", "cannot read the unit from `,500 kg` on", Some("write the number without thousands separators")),
        (Q::Damping, "3 N s/", "cannot read the unit from `the end` on", Some("write units like `lbf s/ft`, `kg m^2` or `m^2/(rad/m)`")),
        (Q::Damping, "3 N s/(m", "cannot read the unit from `the end` on", Some("write units like `lbf s/ft`, `kg m^2` or `m^2/(rad/m)`")),
        (Q::Damping, "3 N^22", "cannot read the unit from `^22` on", Some("write units like `lbf s/ft`, `kg m^2` or `m^2/(rad/m)`")),
        (Q::Length, "3 m^¹", "cannot read the unit from `^¹` on", Some("write units like `lbf s/ft`, `kg m^2` or `m^2/(rad/m)`")),
        (Q::Length, "3 m1", "cannot read the unit from `1` on", Some("write units like `lbf s/ft`, `kg m^2` or `m^2/(rad/m)`")),
        (Q::Mass, &format!("1{} kg", "0".repeat(100)), "a value has at most 100 characters", None),
        (Q::Dimensionless, "0.05", "a dimensionless value is a plain number, without quotes", None),
    ] {
        let error = quantity.parse(text).unwrap_err();
        assert_eq!(error.to_string(), message, "{text}");
        assert_eq!(error.help().as_deref(), help, "{text}");
    }
}

#[test]
fn examples_and_display_units_are_of_the_quantity() {
    for quantity in Quantity::ALL {
        if quantity == Quantity::Dimensionless {
            continue;
        }
        for example in quantity.examples() {
            assert!(quantity.parse(example).is_ok(), "{example}");
        }
        for unit in [quantity.si(), quantity.us()] {
            let text = format!("1 {}", unit.label);
            assert_eq!(quantity.parse(&text), Ok(unit.factor), "{text}");
        }
    }
}

proptest! {
    #[test]
    fn display_units_round_trip(value in -1e9f64..1e9, index in 0..20usize) {
        let quantity = Quantity::ALL[index];
        for unit in [quantity.si(), quantity.us()] {
            let text = format!("{} {}", unit.of(value), unit.label);
            let read = quantity.parse(&text).unwrap();
            prop_assert!((read - value).abs() <= 1e-14 * value.abs(), "{text}");
        }
    }

    #[test]
    fn no_text_panics(text in "\\PC*", index in 0..21usize) {
        let _ = Quantity::ALL[index].parse(&text).map_err(|e| (e.to_string(), e.help()));
    }

    #[test]
    fn no_likely_text_panics(text in "[-+0-9.eE]{0,4}[ kmNsftlb/^()°²⁻·*µ1-9%]{0,30}") {
        for quantity in Quantity::ALL {
            if let Ok(value) = quantity.parse(&text) {
                prop_assert!(value.is_finite());
            }
        }
    }
}
