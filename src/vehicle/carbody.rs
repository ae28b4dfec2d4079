//! Carbody: a rigid body with its first bending and two torsion modes (3.4.3).

use serde::Serialize;

/// Carbody, SI units; subscript c in the report.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Carbody {
    /// M_c, kg.
    pub mass: f64,
    /// I_cx, kg m².
    pub roll_inertia: f64,
    /// I_cy, kg m².
    pub pitch_inertia: f64,
    /// I_cz, kg m².
    pub yaw_inertia: f64,
    /// l_c, m.
    pub length: f64,
    /// l_s, half of the truck centre pin spacing, m.
    pub half_truck_spacing: f64,
    /// h_cs, height of the c.g. above the secondary lateral springs, m.
    pub height_above_secondary: f64,
    /// First vertical bending mode.
    pub bending: FlexibleMode,
    /// First torsion mode.
    pub torsion_1: FlexibleMode,
    /// Second torsion mode.
    pub torsion_2: FlexibleMode,
}

/// A flexible mode of the carbody, seen only by the vertical model.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct FlexibleMode {
    /// Natural frequency, Hz.
    pub frequency: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Modal mass (or inertia) over that of a uniform body of the same mass; 1 for a uniform beam.
    pub modal_mass_ratio: f64,
}

impl FlexibleMode {
    /// Undamped angular frequency, rad/s.
    pub fn angular_frequency(&self) -> f64 {
        std::f64::consts::TAU * self.frequency
    }
}
