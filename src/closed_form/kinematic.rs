//! Kinematic (hunting) models of wheelset, rigid truck and carbody (3.5.2, 4.5.3).

use std::f64::consts::TAU;

use crate::{vehicle::Vehicle, wheel_rail::Contact};

/// Wavelength of the unrestrained massless wheelset, m (3.5-1; Klingel).
///
/// ```math
/// L = 2π √(a r0/λ)
/// ```
pub fn wheelset_wavelength(vehicle: &Vehicle, conicity: f64) -> f64 {
    let w = &vehicle.wheelset;
    TAU * (w.half_contact_distance * w.rolling_radius / conicity).sqrt()
}

/// Frequency of the unrestrained massless wheelset, Hz (3.5-2, 4.5-10), at `speed` in m/s.
///
/// ```math
/// f = V/L
/// ```
pub fn wheelset_frequency(vehicle: &Vehicle, conicity: f64, speed: f64) -> f64 {
    speed / wheelset_wavelength(vehicle, conicity)
}

/// Wavelength of the unrestrained massless rigid truck, m (3.5-4).
///
/// ```math
/// L = 2π √[(a r0/λ)(a² + b²)/a²]
/// ```
pub fn truck_wavelength(vehicle: &Vehicle, conicity: f64) -> f64 {
    wheelset_wavelength(vehicle, conicity) * truck_factor(vehicle).sqrt()
}

/// Frequency of the unrestrained massless rigid truck, Hz (3.5-5, 4.5-11), at `speed` in m/s.
pub fn truck_frequency(vehicle: &Vehicle, conicity: f64, speed: f64) -> f64 {
    speed / truck_wavelength(vehicle, conicity)
}

/// Kinematic frequency of the carbody on trucks that follow it in yaw, Hz (4.5-12), at `speed` in
/// m/s.
///
/// ```math
/// ω = V √{ (λ/(a r0)) / [(1 + b²/a²)(1 + l²/(a² (1 + b²/a²)²))] },   l = l_s
/// ```
pub fn carbody_frequency(vehicle: &Vehicle, conicity: f64, speed: f64) -> f64 {
    let a = vehicle.wheelset.half_contact_distance;
    let factor = truck_factor(vehicle);
    let body = 1.0 + (vehicle.carbody.half_truck_spacing / (a * factor)).powi(2);
    truck_frequency(vehicle, conicity, speed) / body.sqrt()
}

/// (a² + b²)/a².
fn truck_factor(vehicle: &Vehicle) -> f64 {
    let a = vehicle.wheelset.half_contact_distance;
    1.0 + (vehicle.truck.half_wheelbase / a).powi(2)
}

/// Approximate critical speed of a wheelset with inertia, held by the primary springs to a frame
/// at rest, m/s (3.5-3). Good where K_px and K_py are very low (below some 20,000 lb/ft).
///
/// ```math
/// V_c² = 2 a r0 [d_p² f11 K_px + a² f33 (K_py + N a11/(2a))] / ((a² f11 M_w + f33 I_wz) λ)
/// ```
///
/// N is the axle load. The report prints d_p11² F11: the 11 belongs to F alone.
pub fn wheelset_critical_speed(vehicle: &Vehicle, contact: &Contact) -> f64 {
    let w = &vehicle.wheelset;
    let primary = &vehicle.suspension.primary;
    let (a, r0) = (w.half_contact_distance, w.rolling_radius);
    let d_p2 = vehicle.truck.half_primary_spacing.powi(2);
    let gravitational = vehicle.axle_load() * contact.a11 / (2.0 * a);
    let stiffness = d_p2 * contact.f11 * primary.longitudinal_stiffness
        + a * a * contact.f33 * (primary.lateral_stiffness + gravitational);
    let inertia = a * a * contact.f11 * w.mass + contact.f33 * w.yaw_inertia;
    (2.0 * a * r0 * stiffness / (inertia * contact.conicity)).sqrt()
}

/// Approximate critical speed of a rigid truck under a carbody at rest, m/s (3.5-6). Good where
/// K_px and K_py are very high (above some 4e6 lb/ft).
///
/// ```math
/// V_c² = [K_sψ + 2 N a11 b²/a + 2 (a² + b²)(K_sy + N a11/a)] (a² + b²) r0
///      / ([(a² + b²)(M_t + 2 M_w) + I_tz + 2 I_wz + 2 M_w b²] a λ)
/// ```
pub fn truck_critical_speed(vehicle: &Vehicle, contact: &Contact) -> f64 {
    let (w, t) = (&vehicle.wheelset, &vehicle.truck);
    let secondary = &vehicle.suspension.secondary;
    let (a, b) = (w.half_contact_distance, t.half_wheelbase);
    let ab2 = a * a + b * b;
    let gravitational = vehicle.axle_load() * contact.a11 / a;
    let stiffness = secondary.yaw_stiffness
        + 2.0 * gravitational * b * b
        + 2.0 * ab2 * (secondary.lateral_stiffness + gravitational);
    let inertia =
        ab2 * (t.mass + 2.0 * w.mass) + t.yaw_inertia + 2.0 * w.yaw_inertia + 2.0 * w.mass * b * b;
    (stiffness * ab2 * w.rolling_radius / (inertia * a * contact.conicity)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::us::{FOOT, LBF};
    use crate::wheel_rail::WheelRail;

    #[test]
    fn prototype_wavelengths() {
        let v = Vehicle::prototype();
        // 2π √(2.35 × 1.5/0.05) = 52.76 ft; the rigid truck's is √(2.35² + 4.25²)/2.35 longer.
        assert!((wheelset_wavelength(&v, 0.05) / FOOT - 52.756).abs() < 1e-3);
        assert!((truck_wavelength(&v, 0.05) / FOOT - 52.756 * 2.066_58).abs() < 1e-2);
        let speed = 49.17;
        let [body, truck, wheelset] =
            [carbody_frequency, truck_frequency, wheelset_frequency].map(|f| f(&v, 0.05, speed));
        assert!(body < truck && truck < wheelset);
    }

    /// V_c grows with the root of all stiffnesses (gravitation aside) and falls with that of all
    /// inertias.
    #[test]
    fn critical_speeds_scale() {
        let contact = Contact {
            a11: 0.0,
            ..WheelRail::default().contact()
        };
        let base = Vehicle::prototype();
        let mut stiff = base.clone();
        for k in [
            &mut stiff.suspension.primary.longitudinal_stiffness,
            &mut stiff.suspension.primary.lateral_stiffness,
            &mut stiff.suspension.secondary.lateral_stiffness,
            &mut stiff.suspension.secondary.yaw_stiffness,
        ] {
            *k *= 4.0;
        }
        let mut heavy = base.clone();
        for m in [
            &mut heavy.wheelset.mass,
            &mut heavy.wheelset.yaw_inertia,
            &mut heavy.truck.mass,
            &mut heavy.truck.yaw_inertia,
        ] {
            *m *= 4.0;
        }
        for speed in [wheelset_critical_speed, truck_critical_speed] {
            let v = speed(&base, &contact);
            assert!((speed(&stiff, &contact) / v - 2.0).abs() < 1e-12);
            assert!((speed(&heavy, &contact) / v - 0.5).abs() < 1e-12);
        }
    }

    /// (3.5-3) is exact for creep much stiffer than the springs: at this speed the restrained
    /// wheelset's characteristic equation has a pair of roots on the imaginary axis.
    #[test]
    fn restrained_wheelset_is_marginal_at_its_critical_speed() {
        let mut v = Vehicle::prototype();
        v.suspension.primary.longitudinal_stiffness = 2e4 * LBF / FOOT;
        v.suspension.primary.lateral_stiffness = 1e4 * LBF / FOOT;
        let contact = Contact {
            a11: 0.0,
            ..WheelRail::default().contact()
        };
        let speed = wheelset_critical_speed(&v, &contact);
        let (w, p) = (&v.wheelset, &v.suspension.primary);
        let (a, r0) = (w.half_contact_distance, w.rolling_radius);
        // (M s² + 2 f11 s/V + 2 K_py) y − 2 f11 ψ = 0
        // (I s² + 2 a² f33 s/V + 2 d_p² K_px) ψ + 2 a f33 λ/r0 y = 0
        let k_psi = 2.0 * v.truck.half_primary_spacing.powi(2) * p.longitudinal_stiffness;
        let k_y = 2.0 * p.lateral_stiffness;
        let (c_y, c_psi) = (2.0 * contact.f11 / speed, 2.0 * a * a * contact.f33 / speed);
        let coupling = 4.0 * contact.f11 * a * contact.f33 * contact.conicity / r0;
        let (m, i) = (w.mass, w.yaw_inertia);
        let [a4, a3, a2, a1, a0] = [
            m * i,
            m * c_psi + i * c_y,
            m * k_psi + i * k_y + c_y * c_psi,
            c_y * k_psi + c_psi * k_y,
            k_y * k_psi + coupling,
        ];
        // Routh: a3 a2 a1 = a4 a1² + a3² a0; what (3.5-3) leaves out is of order K r0/(f λ) ≈ 2 %.
        let routh = (a3 * a2 * a1) / (a4 * a1 * a1 + a3 * a3 * a0);
        assert!((routh - 1.0).abs() < 0.03, "{routh}");
    }
}
