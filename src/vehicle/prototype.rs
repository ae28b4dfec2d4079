//! The prototype passenger vehicle of Table 4.1.1.

use super::{
    Carbody, FlexibleMode, Passenger, Primary, Secondary, Suspension, Truck, Vehicle, Wheelset,
};
use crate::units::us::{FOOT, LBF, SLUG};

impl Vehicle {
    /// The prototype of Table 4.1.1 in its US units, with one baseline suspension.
    ///
    /// The table's columns for the three parametric studies differ in places; the baseline here
    /// has K_px = 1e6 and K_py = 5e5 lb/ft with K_sψ = 1e6 ft-lb/rad. h_ts = 1.68 ft and
    /// d_s = 3.75 ft are right where their printed metric equivalents are not. The passenger
    /// points' height, which the report does not give, is that of the floor, −h_cs.
    pub fn prototype() -> Self {
        let slug_ft2 = SLUG * FOOT * FOOT;
        let mode = |frequency| FlexibleMode {
            frequency,
            damping_ratio: 0.05,
            modal_mass_ratio: 1.0,
        };
        Self {
            carbody: Carbody {
                mass: 2860.0 * SLUG,
                roll_inertia: 76_340.0 * slug_ft2,
                pitch_inertia: 1.764e6 * slug_ft2,
                yaw_inertia: 1.764e6 * slug_ft2,
                length: 85.0 * FOOT,
                half_truck_spacing: 29.75 * FOOT,
                height_above_secondary: 2.94 * FOOT,
                bending: mode(7.1),
                torsion_1: mode(12.0),
                torsion_2: mode(24.0),
            },
            truck: Truck {
                mass: 250.0 * SLUG,
                roll_inertia: 2058.0 * slug_ft2,
                pitch_inertia: 434.0 * slug_ft2,
                yaw_inertia: 2486.0 * slug_ft2,
                half_wheelbase: 4.25 * FOOT,
                half_primary_spacing: 2.0 * FOOT,
                half_secondary_spacing: 3.75 * FOOT,
                height_above_primary: 0.35 * FOOT,
                depth_below_secondary: 1.68 * FOOT,
            },
            wheelset: Wheelset {
                mass: 120.0 * SLUG,
                yaw_inertia: 561.0 * slug_ft2,
                spin_inertia: 112.0 * slug_ft2,
                roll_inertia: 561.0 * slug_ft2,
                rolling_radius: 1.5 * FOOT,
                half_contact_distance: 2.35 * FOOT,
            },
            suspension: Suspension::new(
                Primary {
                    longitudinal_stiffness: 1.0e6 * LBF / FOOT,
                    lateral_stiffness: 5.0e5 * LBF / FOOT,
                    vertical_stiffness: 1.935e6 * LBF / FOOT,
                    longitudinal_damping: None,
                    lateral_damping: None,
                    vertical_damping: None,
                },
                Secondary {
                    lateral_stiffness: 24_000.0 * LBF / FOOT,
                    lateral_damping: 1_200.0 * LBF / FOOT,
                    vertical_stiffness: 22_200.0 * LBF / FOOT,
                    vertical_damping: 2_000.0 * LBF / FOOT,
                    yaw_stiffness: 1.0e6 * LBF * FOOT,
                    yaw_damping: None,
                    yaw_breakaway_torque: 7_500.0 * LBF * FOOT,
                    air_spring: None,
                },
            ),
            passenger: Passenger {
                longitudinal_offset: 29.75 * FOOT,
                lateral_offset: 3.75 * FOOT,
                height_above_carbody_cg: -2.94 * FOOT,
            },
            trailing: None,
        }
    }
}
