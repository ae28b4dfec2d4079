//! Numbers of `[wheel_rail]`.

use super::{CONICITY_MAX, WheelRail};
use crate::units::{
    Need::{Optional, Required},
    Number,
    Range::{Any, Between, NonNegative, Positive, PositiveUpTo},
    Table, number,
};

/// λ, whose range depends on which coefficients are given.
pub const CONICITY: &str = "wheel_rail.conicity";

/// Numbers of `[wheel_rail]`.
#[rustfmt::skip]
pub static WHEEL_RAIL: Table<WheelRail> = Table {
    path: "wheel_rail",
    meaning: "Wheel and rail. Coefficients that are not given come from Table 4.1.1 for the conicity.",
    numbers: &[
        number!("wheel_rail.conicity", "λ", Dimensionless, PositiveUpTo(CONICITY_MAX), Required, "wheel conicity, equivalent where the tread is worn", conicity),
        number!("wheel_rail.friction", "μ", Dimensionless, PositiveUpTo(1.0), Required, "coefficient of friction between wheel and rail", friction),
        number!("wheel_rail.creep_factor", "", Dimensionless, PositiveUpTo(2.0), Optional("1"), "factor on all creep coefficients: 1 is full Kalker, 0.5 the report's final check", creep_factor),
        number!("wheel_rail.flange_clearance", "", Stroke, Positive, Optional("0.5 in"), "lateral clearance between flange and rail of a centred wheelset", flange_clearance),
        // Explicit coefficients: where all are given, the report's table is not read.
        number!("wheel_rail.lateral_creep", "f11", Force, Positive, Optional("Table 4.1.1"), "lateral creep coefficient, per wheel", lateral_creep, |wheel_rail, _| Some(wheel_rail.full_creep().f11)),
        number!("wheel_rail.lateral_spin_creep", "f12", LateralSpinCreep, NonNegative, Optional("Table 4.1.1"), "lateral–spin creep coefficient, per wheel", lateral_spin_creep, |wheel_rail, _| Some(wheel_rail.full_creep().f12)),
        number!("wheel_rail.spin_creep", "f22", SpinCreep, NonNegative, Optional("Table 4.1.1"), "spin creep coefficient, per wheel", spin_creep, |wheel_rail, _| Some(wheel_rail.full_creep().f22)),
        number!("wheel_rail.longitudinal_creep", "f33", Force, Positive, Optional("Table 4.1.1"), "longitudinal creep coefficient, per wheel", longitudinal_creep, |wheel_rail, _| Some(wheel_rail.full_creep().f33)),
        number!("wheel_rail.roll_coefficient", "a11", Dimensionless, Any, Optional("Table 4.1.1"), "wheelset roll per lateral displacement, times half_contact_distance", roll_coefficient, |wheel_rail, _| Some(wheel_rail.full_creep().a11)),
        number!("wheel_rail.contact_angle", "δ0", Angle, Between(0.0, std::f64::consts::FRAC_PI_2), Optional("Table 4.1.1"), "contact angle of the centred wheelset", contact_angle, |wheel_rail, _| Some(wheel_rail.full_creep().delta_0)),
        number!("wheel_rail.contact_angle_difference", "Δ", Dimensionless, Any, Optional("Table 4.1.1"), "contact angle difference coefficient", contact_angle_difference, |wheel_rail, _| Some(wheel_rail.full_creep().delta)),
    ],
};

/// Numbers of the explicit coefficients.
pub fn coefficients() -> impl Iterator<Item = &'static Number<WheelRail>> {
    WHEEL_RAIL
        .numbers
        .iter()
        .filter(|number| matches!(number.key.need, Optional("Table 4.1.1")))
}
