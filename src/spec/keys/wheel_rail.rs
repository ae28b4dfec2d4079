//! Keys of `[wheel_rail]`.

use super::Need::{Optional, Required};
use super::Range::{Any, Between, NonNegative, Positive, PositiveUpTo};
use super::key::{Key, key};
use crate::case::Case;
use crate::wheel_rail::CONICITY_MAX;

/// λ, whose range depends on which coefficients are given.
pub(in crate::spec) const CONICITY: &str = "wheel_rail.conicity";

#[rustfmt::skip]
pub(super) static WHEEL_RAIL: &[Key<Case>] = &[
    key!("wheel_rail.conicity", "λ", Dimensionless, PositiveUpTo(CONICITY_MAX), Required, "(equivalent) conicity of the wheel tread", wheel_rail.conicity),
    key!("wheel_rail.friction", "μ", Dimensionless, PositiveUpTo(1.0), Required, "coefficient of friction between wheel and rail", wheel_rail.friction),
    key!("wheel_rail.creep_factor", "", Dimensionless, PositiveUpTo(2.0), Optional("1"), "factor on all creep coefficients: 1 is full Kalker, 0.5 the report's final check", wheel_rail.creep_factor),
    key!("wheel_rail.flange_clearance", "", Stroke, Positive, Optional("0.5 in"), "lateral clearance between flange and rail of a centred wheelset", wheel_rail.flange_clearance),
];

/// Where all are given, nothing is taken from the report's table.
#[rustfmt::skip]
pub(in crate::spec) static COEFFICIENTS: &[Key<Case>] = &[
    key!("wheel_rail.lateral_creep", "f11", Force, Positive, Optional("Table 4.1.1"), "lateral creep coefficient, per wheel", wheel_rail.lateral_creep),
    key!("wheel_rail.lateral_spin_creep", "f12", LateralSpinCreep, NonNegative, Optional("Table 4.1.1"), "lateral–spin creep coefficient, per wheel", wheel_rail.lateral_spin_creep),
    key!("wheel_rail.spin_creep", "f22", SpinCreep, NonNegative, Optional("Table 4.1.1"), "spin creep coefficient, per wheel", wheel_rail.spin_creep),
    key!("wheel_rail.longitudinal_creep", "f33", Force, Positive, Optional("Table 4.1.1"), "longitudinal creep coefficient, per wheel", wheel_rail.longitudinal_creep),
    key!("wheel_rail.roll_coefficient", "a11", Dimensionless, Any, Optional("Table 4.1.1"), "wheelset roll per lateral displacement, times half_contact_distance", wheel_rail.roll_coefficient),
    key!("wheel_rail.contact_angle", "δ0", Angle, Between(0.0, std::f64::consts::FRAC_PI_2), Optional("Table 4.1.1"), "contact angle of the centred wheelset", wheel_rail.contact_angle),
    key!("wheel_rail.contact_angle_difference", "Δ", Dimensionless, Any, Optional("Table 4.1.1"), "contact angle difference coefficient", wheel_rail.contact_angle_difference),
];
