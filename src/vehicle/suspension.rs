//! Primary and secondary suspension, constants per element.

use serde::Serialize;

/// Ratio of a primary (or yaw) damping to its stiffness where none is given, s (Table 4.1.1).
pub const DAMPING_PER_STIFFNESS: f64 = 1.0 / 250.0;

/// Both stages of the suspension.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Suspension {
    /// Between wheelsets and truck frames.
    pub primary: Primary,
    /// Between truck frames and carbody.
    pub secondary: Secondary,
}

/// Primary suspension, per corner (4 per truck).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Primary {
    /// K_px, N/m.
    pub longitudinal_stiffness: f64,
    /// K_py, N/m.
    pub lateral_stiffness: f64,
    /// K_pz, N/m.
    pub vertical_stiffness: f64,
    /// C_px, N s/m; `None`: K_px / 250 s⁻¹.
    pub longitudinal_damping: Option<f64>,
    /// C_py, N s/m; `None`: K_py / 250 s⁻¹.
    pub lateral_damping: Option<f64>,
    /// C_pz, N s/m; `None`: K_pz / 250 s⁻¹.
    pub vertical_damping: Option<f64>,
}

impl Primary {
    /// C_px in force, N s/m.
    pub fn c_px(&self) -> f64 {
        dependent(self.longitudinal_damping, self.longitudinal_stiffness)
    }

    /// C_py in force, N s/m.
    pub fn c_py(&self) -> f64 {
        dependent(self.lateral_damping, self.lateral_stiffness)
    }

    /// C_pz in force, N s/m.
    pub fn c_pz(&self) -> f64 {
        dependent(self.vertical_damping, self.vertical_stiffness)
    }
}

/// Secondary suspension: per side (2 per truck), yaw per truck.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Secondary {
    /// K_sy, N/m.
    pub lateral_stiffness: f64,
    /// C_sy, N s/m.
    pub lateral_damping: f64,
    /// K_sz, N/m.
    pub vertical_stiffness: f64,
    /// C_sz, N s/m.
    pub vertical_damping: f64,
    /// K_sψ, N m/rad.
    pub yaw_stiffness: f64,
    /// C_sψ, N m s/rad; `None`: K_sψ / 250 s⁻¹.
    pub yaw_damping: Option<f64>,
    /// T_sψ, Coulomb breakaway torque between truck and carbody, N m.
    pub yaw_breakaway_torque: f64,
    /// Where present, replaces K_sz and C_sz in the vertical model (Figure 3.4.5a).
    pub air_spring: Option<AirSpring>,
}

impl Secondary {
    /// Stiffness under slow vertical motion, per side, N/m: K_sz, or that of the air spring in its
    /// place.
    pub fn static_vertical_stiffness(&self) -> f64 {
        match &self.air_spring {
            Some(air) => air.static_stiffness(),
            None => self.vertical_stiffness,
        }
    }

    /// C_sψ in force, N m s/rad.
    pub fn c_spsi(&self) -> f64 {
        dependent(self.yaw_damping, self.yaw_stiffness)
    }
}

/// Orifice-damped air suspension per side (Figure 3.4.5a): a direct spring in parallel with a
/// series branch of a spring and an orifice that meet in the inner point p.
///
/// ```text
///           carbody
///        ┌─────┴─────┐
///   direct spring   series spring (bellows)
///        │           p
///        │        ┌──┴───┐
///        │     orifice  reservoir spring
///        └────────┴──────┘
///            truck frame
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct AirSpring {
    /// Direct spring (change of effective area, or a parallel coil), N/m.
    pub direct_stiffness: f64,
    /// Series spring between carbody and p (air in the bellows), N/m.
    pub series_stiffness: f64,
    /// Orifice between p and the truck frame, N s/m.
    pub orifice_damping: f64,
    /// Spring in parallel with the orifice (air in the reservoir), N/m; 0 for a plain series
    /// branch.
    pub reservoir_stiffness: f64,
}

impl AirSpring {
    /// Stiffness under a load that does not change, N/m: the orifice passes air and carries nothing,
    /// so that bellows and reservoir are in series.
    ///
    /// ```math
    /// K_direct + K_series K_reservoir / (K_series + K_reservoir)
    /// ```
    pub fn static_stiffness(&self) -> f64 {
        let (series, reservoir) = (self.series_stiffness, self.reservoir_stiffness);
        self.direct_stiffness + series * reservoir / (series + reservoir)
    }
}

fn dependent(given: Option<f64>, stiffness: f64) -> f64 {
    given.unwrap_or(stiffness * DAMPING_PER_STIFFNESS)
}
