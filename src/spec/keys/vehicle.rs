//! Keys of `[service]`, `[vehicle.*]` and `[passenger]`.

use super::Need::{Optional, Required};
use super::Range::{Any, Between, NonNegative, Positive, PositiveUpTo};
use super::key::{Key, key};
use crate::case::Case;
use crate::track::MAX_DEGREE;

const RADIANS: f64 = std::f64::consts::PI / 180.0;

#[rustfmt::skip]
pub(super) static SERVICE: &[Key<Case>] = &[
    key!("service.speed", "V", Speed, Positive, Required, "operating speed", service.speed),
    key!("service.curve", "D", DegreeOfCurve, PositiveUpTo(MAX_DEGREE * RADIANS), Optional("the tightest without flange contact or slip"), "degree of the curve in which forces on the rails are judged", service.curve),
    // Its value in force is zero where it is not given.
    Key {
        get: |case| Some(case.service.cant_deficiency()),
        ..key!("service.cant_deficiency", "φ_d", Angle, Between(-0.2, 0.2), Optional("0"), "cant deficiency there", service.cant_deficiency)
    },
];

#[rustfmt::skip]
pub(super) static CARBODY: &[Key<Case>] = &[
    key!("vehicle.carbody.mass", "M_c", Mass, Positive, Required, "carbody mass", vehicle.carbody.mass),
    key!("vehicle.carbody.roll_inertia", "I_cx", Inertia, Positive, Required, "carbody roll inertia about its c.g.", vehicle.carbody.roll_inertia),
    key!("vehicle.carbody.pitch_inertia", "I_cy", Inertia, Positive, Required, "carbody pitch inertia about its c.g.", vehicle.carbody.pitch_inertia),
    key!("vehicle.carbody.yaw_inertia", "I_cz", Inertia, Positive, Required, "carbody yaw inertia about its c.g.", vehicle.carbody.yaw_inertia),
    key!("vehicle.carbody.length", "l_c", Length, Positive, Required, "carbody length, over which its flexible modes extend", vehicle.carbody.length),
    key!("vehicle.carbody.half_truck_spacing", "l_s", Length, Positive, Required, "half of the distance between the truck centre pins", vehicle.carbody.half_truck_spacing),
    key!("vehicle.carbody.height_above_secondary", "h_cs", Length, Any, Required, "height of the carbody c.g. above the secondary lateral springs", vehicle.carbody.height_above_secondary),
    key!("vehicle.carbody.bending.frequency", "", Frequency, Positive, Required, "natural frequency of the first vertical bending mode", vehicle.carbody.bending.frequency),
    key!("vehicle.carbody.bending.damping_ratio", "", Dimensionless, Between(0.0, 1.0), Required, "damping ratio of the first vertical bending mode", vehicle.carbody.bending.damping_ratio),
    key!("vehicle.carbody.bending.modal_mass_ratio", "", Dimensionless, Positive, Optional("1"), "modal mass of the bending mode over that of a uniform beam of the carbody's mass", vehicle.carbody.bending.modal_mass_ratio),
    key!("vehicle.carbody.torsion_1.frequency", "", Frequency, Positive, Required, "natural frequency of the first torsion mode", vehicle.carbody.torsion_1.frequency),
    key!("vehicle.carbody.torsion_1.damping_ratio", "", Dimensionless, Between(0.0, 1.0), Required, "damping ratio of the first torsion mode", vehicle.carbody.torsion_1.damping_ratio),
    key!("vehicle.carbody.torsion_1.modal_mass_ratio", "", Dimensionless, Positive, Optional("1"), "modal inertia of the first torsion mode over that of a uniform bar of the carbody's roll inertia", vehicle.carbody.torsion_1.modal_mass_ratio),
    key!("vehicle.carbody.torsion_2.frequency", "", Frequency, Positive, Required, "natural frequency of the second torsion mode", vehicle.carbody.torsion_2.frequency),
    key!("vehicle.carbody.torsion_2.damping_ratio", "", Dimensionless, Between(0.0, 1.0), Required, "damping ratio of the second torsion mode", vehicle.carbody.torsion_2.damping_ratio),
    key!("vehicle.carbody.torsion_2.modal_mass_ratio", "", Dimensionless, Positive, Optional("1"), "modal inertia of the second torsion mode over that of a uniform bar of the carbody's roll inertia", vehicle.carbody.torsion_2.modal_mass_ratio),
];

#[rustfmt::skip]
pub(super) static TRUCK: &[Key<Case>] = &[
    key!("vehicle.truck.mass", "M_t", Mass, Positive, Required, "truck frame mass, without wheelsets", vehicle.truck.mass),
    key!("vehicle.truck.roll_inertia", "I_tx", Inertia, Positive, Required, "truck frame roll inertia", vehicle.truck.roll_inertia),
    key!("vehicle.truck.pitch_inertia", "I_ty", Inertia, Positive, Required, "truck frame pitch inertia", vehicle.truck.pitch_inertia),
    key!("vehicle.truck.yaw_inertia", "I_tz", Inertia, Positive, Required, "truck frame yaw inertia", vehicle.truck.yaw_inertia),
    key!("vehicle.truck.half_wheelbase", "b", Length, Positive, Required, "half of the distance between the axles of a truck", vehicle.truck.half_wheelbase),
    key!("vehicle.truck.half_primary_spacing", "d_p", Length, Positive, Required, "half of the lateral distance between the primary springs", vehicle.truck.half_primary_spacing),
    key!("vehicle.truck.half_secondary_spacing", "d_s", Length, Positive, Required, "half of the lateral distance between the secondary springs", vehicle.truck.half_secondary_spacing),
    key!("vehicle.truck.height_above_primary", "h_tp", Length, Any, Required, "height of the frame's c.g. above the primary lateral springs", vehicle.truck.height_above_primary),
    key!("vehicle.truck.depth_below_secondary", "h_ts", Length, Any, Required, "depth of the frame's c.g. below the secondary lateral springs", vehicle.truck.depth_below_secondary),
];

#[rustfmt::skip]
pub(super) static WHEELSET: &[Key<Case>] = &[
    key!("vehicle.wheelset.mass", "M_w", Mass, Positive, Required, "mass of one wheelset", vehicle.wheelset.mass),
    key!("vehicle.wheelset.yaw_inertia", "I_wz", Inertia, Positive, Required, "wheelset yaw inertia", vehicle.wheelset.yaw_inertia),
    key!("vehicle.wheelset.spin_inertia", "I_wy", Inertia, Positive, Required, "wheelset inertia about its axle", vehicle.wheelset.spin_inertia),
    key!("vehicle.wheelset.roll_inertia", "I_wx", Inertia, Positive, Optional("yaw_inertia"), "wheelset roll inertia; the models prescribe that roll and do not use it", vehicle.wheelset.roll_inertia),
    key!("vehicle.wheelset.rolling_radius", "r_0", Length, Positive, Required, "rolling radius of the centred wheelset", vehicle.wheelset.rolling_radius),
    key!("vehicle.wheelset.half_contact_distance", "a", Length, Positive, Required, "half of the distance between the two contact points", vehicle.wheelset.half_contact_distance),
];

#[rustfmt::skip]
pub(super) static PASSENGER: &[Key<Case>] = &[
    key!("passenger.longitudinal_offset", "p_x", Length, NonNegative, Required, "distance of the end passenger points from the carbody c.g.", vehicle.passenger.longitudinal_offset),
    key!("passenger.lateral_offset", "p_y", Length, Any, Required, "distance of the end passenger points from the centre line, vertical model", vehicle.passenger.lateral_offset),
    key!("passenger.height_above_carbody_cg", "h", Length, Any, Optional("the floor, −height_above_secondary"), "height of the passenger points above the carbody c.g., lateral model", vehicle.passenger.height_above_carbody_cg),
];
