//! Natural frequencies and damping ratios of truck frame and carbody, each without the other
//! (3.5-7…26), and the secondary constants for wanted ones (4.6-8, 9, 14, 15).

use std::f64::consts::{PI, TAU};

use crate::vehicle::{GRAVITY, Vehicle};

/// One motion with all others held still.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Oscillator {
    /// Undamped natural frequency, Hz.
    pub frequency: f64,
    /// Damping ratio ξ.
    pub damping_ratio: f64,
}

impl Oscillator {
    /// ```math
    /// f_n = √(k/m)/2π,   ξ = c/(2 √(k m))
    /// ```
    fn new(k: f64, c: f64, m: f64) -> Self {
        Self {
            frequency: (k / m).sqrt() / TAU,
            damping_ratio: c / (2.0 * (k * m).sqrt()),
        }
    }
}

/// Truck frame lateral (3.5-7, 8): k = 4K_py + 2K_sy over M_t.
pub fn truck_lateral(vehicle: &Vehicle) -> Oscillator {
    let (p, s) = (&vehicle.suspension.primary, &vehicle.suspension.secondary);
    Oscillator::new(
        4.0 * p.lateral_stiffness + 2.0 * s.lateral_stiffness,
        4.0 * p.c_py() + 2.0 * s.lateral_damping,
        vehicle.truck.mass,
    )
}

/// Truck frame vertical (3.5-9, 10): k = 4K_pz + 2K_sz over M_t; with air springs their static
/// stiffness in place of K_sz.
pub fn truck_vertical(vehicle: &Vehicle) -> Oscillator {
    let (p, s) = (&vehicle.suspension.primary, &vehicle.suspension.secondary);
    Oscillator::new(
        4.0 * p.vertical_stiffness + 2.0 * s.static_vertical_stiffness(),
        4.0 * p.c_pz() + 2.0 * s.vertical_damping,
        vehicle.truck.mass,
    )
}

/// Truck frame roll (3.5-11, 12): k = 4d_p²K_pz + 2d_s²K_sz + K_ar over I_tx; the report has no anti-roll bar.
pub fn truck_roll(vehicle: &Vehicle) -> Oscillator {
    let (p, s) = (&vehicle.suspension.primary, &vehicle.suspension.secondary);
    let d_p2 = vehicle.truck.half_primary_spacing.powi(2);
    let d_s2 = vehicle.truck.half_secondary_spacing.powi(2);
    Oscillator::new(
        4.0 * d_p2 * p.vertical_stiffness + 2.0 * d_s2 * s.vertical_stiffness + anti_roll(vehicle),
        4.0 * d_p2 * p.c_pz() + 2.0 * d_s2 * s.vertical_damping,
        vehicle.truck.roll_inertia,
    )
}

/// Truck frame yaw (3.5-13, 14): k = K_sψ + 4d_p²K_px + 4b²K_py over I_tz.
pub fn truck_yaw(vehicle: &Vehicle) -> Oscillator {
    let (p, s) = (&vehicle.suspension.primary, &vehicle.suspension.secondary);
    let d_p2 = vehicle.truck.half_primary_spacing.powi(2);
    let b2 = vehicle.truck.half_wheelbase.powi(2);
    Oscillator::new(
        s.yaw_stiffness + 4.0 * d_p2 * p.longitudinal_stiffness + 4.0 * b2 * p.lateral_stiffness,
        s.c_spsi() + 4.0 * d_p2 * p.c_px() + 4.0 * b2 * p.c_py(),
        vehicle.truck.yaw_inertia,
    )
}

/// Truck frame pitch (3.5-15, 16): k = 4b²K_pz over I_ty.
pub fn truck_pitch(vehicle: &Vehicle) -> Oscillator {
    let p = &vehicle.suspension.primary;
    let b2 = vehicle.truck.half_wheelbase.powi(2);
    Oscillator::new(
        4.0 * b2 * p.vertical_stiffness,
        4.0 * b2 * p.c_pz(),
        vehicle.truck.pitch_inertia,
    )
}

/// Carbody lateral (3.5-17, 18): k = 4K_sy over M_c.
pub fn carbody_lateral(vehicle: &Vehicle) -> Oscillator {
    let s = &vehicle.suspension.secondary;
    Oscillator::new(
        4.0 * s.lateral_stiffness,
        4.0 * s.lateral_damping,
        vehicle.carbody.mass,
    )
}

/// Carbody vertical (3.5-19, 20): k = 4K_sz over M_c; with air springs their static stiffness in
/// place of K_sz.
pub fn carbody_vertical(vehicle: &Vehicle) -> Oscillator {
    let s = &vehicle.suspension.secondary;
    Oscillator::new(
        4.0 * s.static_vertical_stiffness(),
        4.0 * s.vertical_damping,
        vehicle.carbody.mass,
    )
}

/// K_ar of the leading truck, N m/rad.
fn anti_roll(vehicle: &Vehicle) -> f64 {
    vehicle.suspension.anti_roll_bar.unwrap_or(0.0)
}

/// Carbody roll about its c.g. (3.5-21, 22): k = 4d_s²K_sz + 2K_ar + 4h_cs²K_sy − h_cs W over I_cx, W the
/// carbody's weight; the report has no anti-roll bar. `None`: the carbody overturns.
pub fn carbody_roll(vehicle: &Vehicle) -> Option<Oscillator> {
    let s = &vehicle.suspension.secondary;
    let c = &vehicle.carbody;
    let d_s2 = vehicle.truck.half_secondary_spacing.powi(2);
    let h_cs = c.height_above_secondary;
    let k = 4.0 * d_s2 * s.vertical_stiffness
        + 2.0 * anti_roll(vehicle)
        + 4.0 * h_cs * h_cs * s.lateral_stiffness
        - h_cs * c.mass * GRAVITY;
    let damping = 4.0 * d_s2 * s.vertical_damping + 4.0 * h_cs * h_cs * s.lateral_damping;
    (k > 0.0).then(|| Oscillator::new(k, damping, c.roll_inertia))
}

/// Carbody yaw (3.5-23, 24): k = 2K_sψ + 4l_s²K_sy over I_cz.
pub fn carbody_yaw(vehicle: &Vehicle) -> Oscillator {
    let s = &vehicle.suspension.secondary;
    let l_s2 = vehicle.carbody.half_truck_spacing.powi(2);
    Oscillator::new(
        2.0 * s.yaw_stiffness + 4.0 * l_s2 * s.lateral_stiffness,
        2.0 * s.c_spsi() + 4.0 * l_s2 * s.lateral_damping,
        vehicle.carbody.yaw_inertia,
    )
}

/// Carbody pitch (3.5-25, 26): k = 4l_s²K_sz over I_cy; with air springs their static stiffness in
/// place of K_sz.
pub fn carbody_pitch(vehicle: &Vehicle) -> Oscillator {
    let s = &vehicle.suspension.secondary;
    let l_s2 = vehicle.carbody.half_truck_spacing.powi(2);
    Oscillator::new(
        4.0 * l_s2 * s.static_vertical_stiffness(),
        4.0 * l_s2 * s.vertical_damping,
        vehicle.carbody.pitch_inertia,
    )
}

/// f_n in Hz of a carbody of `mass` on four springs of stiffness k (4.6-8, 4.6-14).
pub fn secondary_frequency(mass: f64, k: f64) -> f64 {
    (4.0 * k / mass).sqrt() / TAU
}

/// Spring constant for a wanted f_n (steps 12, 20): K = π² f_n² M_c, N/m.
pub fn secondary_stiffness(mass: f64, frequency: f64) -> f64 {
    (PI * frequency).powi(2) * mass
}

/// ξ of a carbody of `mass` on four springs k and dampers c (4.6-9, 4.6-15).
pub fn secondary_damping_ratio(mass: f64, k: f64, c: f64) -> f64 {
    c / (k * mass).sqrt()
}

/// Damping constant for a wanted ξ (steps 13, 21): C = ξ √(K M_c), N s/m.
pub fn secondary_damping(mass: f64, k: f64, damping_ratio: f64) -> f64 {
    damping_ratio * (k * mass).sqrt()
}

/// K_pz for a wanted truck bounce frequency, N/m: (3.5-9) solved for it. 4.3 recommends 10 Hz. Not
/// positive where the secondary springs alone give more.
pub fn primary_vertical_stiffness(truck_mass: f64, k_sz: f64, frequency: f64) -> f64 {
    ((TAU * frequency).powi(2) * truck_mass - 2.0 * k_sz) / 4.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::us::{FOOT, LBF, SLUG};

    #[test]
    fn constants_and_ratios_are_inverse() {
        let (mass, k) = (41_000.0, 3.2e5);
        let f = secondary_frequency(mass, k);
        assert!((secondary_stiffness(mass, f) / k - 1.0).abs() < 1e-14);
        let c = secondary_damping(mass, k, 0.25);
        assert!((secondary_damping_ratio(mass, k, c) - 0.25).abs() < 1e-14);
        let k_pz = primary_vertical_stiffness(3600.0, k, 10.0);
        let mut v = Vehicle::prototype();
        v.truck.mass = 3600.0;
        v.suspension.primary.vertical_stiffness = k_pz;
        v.suspension.secondary.vertical_stiffness = k;
        assert!((truck_vertical(&v).frequency - 10.0).abs() < 1e-12);
    }

    /// 4.6: f_n = 0.7 Hz takes a total lateral stiffness of about 60,000 lb/ft on the baseline
    /// carbody (55,300; the report rounds), and Table 4.7.3 gives K_sy = 12,000 lb/ft and
    /// C_sy = 1370 lb-s/ft for f_n = 0.7 Hz, ξ = 0.25 on 2500 slugs (rounded to 1 %).
    #[test]
    fn numbers_of_the_report() {
        let total = 4.0 * secondary_stiffness(2860.0 * SLUG, 0.7) / LBF * FOOT;
        assert!((total / 60_000.0 - 1.0).abs() < 0.08, "{total}");
        let k = secondary_stiffness(2500.0 * SLUG, 0.7) / LBF * FOOT;
        assert!((k / 12_000.0 - 1.0).abs() < 0.01, "{k}");
        let c = secondary_damping(2500.0 * SLUG, 12_000.0 * LBF / FOOT, 0.25) / LBF * FOOT;
        assert!((c / 1370.0 - 1.0).abs() < 0.01, "{c}");
    }

    #[test]
    fn an_overturning_carbody_is_said_to() {
        let mut v = Vehicle::prototype();
        v.suspension.secondary.vertical_stiffness /= 100.0;
        v.suspension.secondary.lateral_stiffness /= 100.0;
        assert!(carbody_roll(&v).is_none() && carbody_roll(&Vehicle::prototype()).is_some());
    }
}
