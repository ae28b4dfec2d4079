//! Corrections of critical speeds read off charts (4.6).

use crate::{
    units::us::{FOOT, LBF},
    vehicle::Vehicle,
};

/// Critical speed after a change of the running gear's mass, in the unit of `speed` (4.6-2).
///
/// ```math
/// V' = V √[(2 M_w + M_t)_baseline / (2 M_w + M_t)_used]
/// ```
pub fn for_mass(speed: f64, baseline: &Vehicle, used: &Vehicle) -> f64 {
    let mass = |v: &Vehicle| 2.0 * v.wheelset.mass + v.truck.mass;
    speed * (mass(baseline) / mass(used)).sqrt()
}

/// Whether (4.6-2) applies: a relatively stiff truck, K_py > 150,000 lb/ft and K_b > 1e6 ft-lb/rad.
pub fn mass_correction_applies(vehicle: &Vehicle) -> bool {
    vehicle.suspension.primary.lateral_stiffness > 150_000.0 * LBF / FOOT
        && vehicle.bending_stiffness() > 1.0e6 * LBF * FOOT
}

/// Critical speed at another secondary yaw stiffness, in the unit of `speed` (4.6-3): the ratio is
/// that of the baseline vehicle at the two stiffnesses.
pub fn for_yaw_stiffness(speed: f64, baseline_at_used: f64, baseline_at_reference: f64) -> f64 {
    speed * baseline_at_used / baseline_at_reference
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Design example 2's variations as the report estimates them, to its printed figures.
    #[test]
    fn variations_of_example_2() {
        let base = Vehicle::prototype();
        let mut light_wheelsets = base.clone();
        light_wheelsets.wheelset.mass *= 0.7;
        let mut light = light_wheelsets.clone();
        light.truck.mass *= 0.7;
        // The report prints 150.5 for √(490/418) × 139 = 150.497.
        assert!((for_mass(139.0, &base, &light_wheelsets) - 150.5).abs() < 0.05);
        assert!((for_mass(139.0, &base, &light) - 166.0).abs() < 0.5);
        // 139 × 270/220 = 170.6, printed 171.
        assert!((for_yaw_stiffness(139.0, 270.0, 220.0) - 171.0).abs() < 0.5);
        assert!(mass_correction_applies(&base));
    }
}
