//! Carbody: a rigid body with its first bending and two torsion modes (3.4.3).

use serde::Serialize;

use super::Vehicle;
use crate::units::{
    Need::{Optional, Required},
    Range::{Any, Between, Positive},
    Table, number,
};

/// Tables of the carbody's numbers.
pub(super) static TABLES: [&Table<Vehicle>; 4] = [&CARBODY, &BENDING, &TORSION_1, &TORSION_2];

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

/// Numbers of `[vehicle.carbody]`.
#[rustfmt::skip]
static CARBODY: Table<Vehicle> = Table {
    path: "vehicle.carbody",
    meaning: "One carbody.",
    numbers: &[
        number!("vehicle.carbody.mass", "M_c", Mass, Positive, Required, "carbody mass", carbody.mass),
        number!("vehicle.carbody.roll_inertia", "I_cx", Inertia, Positive, Required, "carbody roll inertia about its c.g.", carbody.roll_inertia),
        number!("vehicle.carbody.pitch_inertia", "I_cy", Inertia, Positive, Required, "carbody pitch inertia about its c.g.", carbody.pitch_inertia),
        number!("vehicle.carbody.yaw_inertia", "I_cz", Inertia, Positive, Required, "carbody yaw inertia about its c.g.", carbody.yaw_inertia),
        number!("vehicle.carbody.length", "l_c", Length, Positive, Required, "carbody length, over which its flexible modes extend", carbody.length),
        number!("vehicle.carbody.half_truck_spacing", "l_s", Length, Positive, Required, "half of the distance between the truck centre pins", carbody.half_truck_spacing),
        number!("vehicle.carbody.height_above_secondary", "h_cs", Length, Any, Required, "height of the carbody c.g. above the secondary lateral springs", carbody.height_above_secondary),
    ],
};

/// Numbers of `[vehicle.carbody.bending]`.
#[rustfmt::skip]
static BENDING: Table<Vehicle> = Table {
    path: "vehicle.carbody.bending",
    meaning: "First vertical bending mode of the carbody.",
    numbers: &[
        number!("vehicle.carbody.bending.frequency", "", Frequency, Positive, Required, "natural frequency of the first vertical bending mode", carbody.bending.frequency),
        number!("vehicle.carbody.bending.damping_ratio", "", Dimensionless, Between(0.0, 1.0), Required, "damping ratio of the first vertical bending mode", carbody.bending.damping_ratio),
        number!("vehicle.carbody.bending.modal_mass_ratio", "", Dimensionless, Positive, Optional("1"), "modal mass of the bending mode over that of a uniform beam of the carbody's mass", carbody.bending.modal_mass_ratio),
    ],
};

/// Numbers of `[vehicle.carbody.torsion_1]`.
#[rustfmt::skip]
static TORSION_1: Table<Vehicle> = Table {
    path: "vehicle.carbody.torsion_1",
    meaning: "First torsion mode of the carbody.",
    numbers: &[
        number!("vehicle.carbody.torsion_1.frequency", "", Frequency, Positive, Required, "natural frequency of the first torsion mode", carbody.torsion_1.frequency),
        number!("vehicle.carbody.torsion_1.damping_ratio", "", Dimensionless, Between(0.0, 1.0), Required, "damping ratio of the first torsion mode", carbody.torsion_1.damping_ratio),
        number!("vehicle.carbody.torsion_1.modal_mass_ratio", "", Dimensionless, Positive, Optional("1"), "modal inertia of the first torsion mode over that of a uniform bar of the carbody's roll inertia", carbody.torsion_1.modal_mass_ratio),
    ],
};

/// Numbers of `[vehicle.carbody.torsion_2]`.
#[rustfmt::skip]
static TORSION_2: Table<Vehicle> = Table {
    path: "vehicle.carbody.torsion_2",
    meaning: "Second torsion mode of the carbody.",
    numbers: &[
        number!("vehicle.carbody.torsion_2.frequency", "", Frequency, Positive, Required, "natural frequency of the second torsion mode", carbody.torsion_2.frequency),
        number!("vehicle.carbody.torsion_2.damping_ratio", "", Dimensionless, Between(0.0, 1.0), Required, "damping ratio of the second torsion mode", carbody.torsion_2.damping_ratio),
        number!("vehicle.carbody.torsion_2.modal_mass_ratio", "", Dimensionless, Positive, Optional("1"), "modal inertia of the second torsion mode over that of a uniform bar of the carbody's roll inertia", carbody.torsion_2.modal_mass_ratio),
    ],
};
