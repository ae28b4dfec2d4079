//! tmp
pub mod kinematic {
    //! tmp
    use crate::vehicle::Vehicle;
    use std::f64::consts::TAU;
    /// tmp
    pub fn wheelset_frequency(v: &Vehicle, conicity: f64, speed: f64) -> f64 {
        speed / TAU
            * (conicity / (v.wheelset.half_contact_distance * v.wheelset.rolling_radius)).sqrt()
    }
    /// tmp
    pub fn truck_frequency(v: &Vehicle, conicity: f64, speed: f64) -> f64 {
        let a = v.wheelset.half_contact_distance;
        wheelset_frequency(v, conicity, speed) * a / a.hypot(v.truck.half_wheelbase)
    }
}
