//! Primary and secondary suspension, constants per element.

use serde::Serialize;

use super::{Vehicle, end::of_end};
use crate::units::{
    Key,
    Need::{Optional, Required},
    Number, Quantity,
    Range::{NonNegative, Positive},
    Table,
};

/// Ratio of a primary (or yaw) damping to its stiffness where none is given, s (Table 4.1.1).
pub const DAMPING_PER_STIFFNESS: f64 = 1.0 / 250.0;

/// Both stages of the suspension.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Suspension {
    /// Between wheelsets and truck frames.
    pub primary: Primary,
    /// Between truck frames and carbody.
    pub secondary: Secondary,
    /// K_ar, roll stiffness of the anti-roll bar between truck frame and carbody, per truck, N m/rad;
    /// `None`: there is no bar.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub anti_roll_bar: Option<f64>,
}

impl Suspension {
    /// Springs and dampers of both stages, and nothing else.
    pub fn new(primary: Primary, secondary: Secondary) -> Self {
        Self {
            primary,
            secondary,
            anti_roll_bar: None,
        }
    }
}

/// Tables of the suspension's numbers.
pub(super) static TABLES: [&Table<Vehicle>; 4] =
    [&PRIMARY, &SECONDARY, &AIR_SPRING, &ANTI_ROLL_BAR];

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

/// Numbers of `[suspension.primary]`.
#[rustfmt::skip]
static PRIMARY: Table<Vehicle> = Table {
    path: "suspension.primary",
    meaning: "Between wheelsets and truck frame, per corner (4 per truck).",
    numbers: &[
        of_end!("suspension.primary.longitudinal_stiffness", "K_px", Stiffness, Positive, Required, "primary longitudinal stiffness, per corner (4 per truck)", suspension.primary.longitudinal_stiffness),
        of_end!("suspension.primary.lateral_stiffness", "K_py", Stiffness, Positive, Required, "primary lateral stiffness, per corner", suspension.primary.lateral_stiffness),
        of_end!("suspension.primary.vertical_stiffness", "K_pz", Stiffness, Positive, Required, "primary vertical stiffness, per corner", suspension.primary.vertical_stiffness),
        of_end!("suspension.primary.longitudinal_damping", "C_px", Damping, NonNegative, Optional("longitudinal_stiffness / 250 s⁻¹"), "primary longitudinal damping, per corner", suspension.primary.longitudinal_damping, |end| Some(end.suspension.primary.c_px())),
        of_end!("suspension.primary.lateral_damping", "C_py", Damping, NonNegative, Optional("lateral_stiffness / 250 s⁻¹"), "primary lateral damping, per corner", suspension.primary.lateral_damping, |end| Some(end.suspension.primary.c_py())),
        of_end!("suspension.primary.vertical_damping", "C_pz", Damping, NonNegative, Optional("vertical_stiffness / 250 s⁻¹"), "primary vertical damping, per corner", suspension.primary.vertical_damping, |end| Some(end.suspension.primary.c_pz())),
    ],
};

/// Numbers of `[suspension.secondary]`.
#[rustfmt::skip]
static SECONDARY: Table<Vehicle> = Table {
    path: "suspension.secondary",
    meaning: "Between truck frame and carbody, per side (2 per truck); yaw per truck.",
    numbers: &[
        of_end!("suspension.secondary.lateral_stiffness", "K_sy", Stiffness, Positive, Required, "secondary lateral stiffness, per side (2 per truck)", suspension.secondary.lateral_stiffness),
        of_end!("suspension.secondary.lateral_damping", "C_sy", Damping, NonNegative, Required, "secondary lateral damping, per side", suspension.secondary.lateral_damping),
        of_end!("suspension.secondary.vertical_stiffness", "K_sz", Stiffness, Positive, Required, "secondary vertical stiffness, per side", suspension.secondary.vertical_stiffness),
        of_end!("suspension.secondary.vertical_damping", "C_sz", Damping, NonNegative, Required, "secondary vertical damping, per side", suspension.secondary.vertical_damping),
        of_end!("suspension.secondary.yaw_stiffness", "K_sψ", RotationalStiffness, NonNegative, Required, "secondary yaw stiffness, per truck", suspension.secondary.yaw_stiffness),
        of_end!("suspension.secondary.yaw_damping", "C_sψ", RotationalDamping, NonNegative, Optional("yaw_stiffness / 250 s⁻¹"), "secondary yaw damping, per truck", suspension.secondary.yaw_damping, |end| Some(end.suspension.secondary.c_spsi())),
        of_end!("suspension.secondary.yaw_breakaway_torque", "T_sψ", Torque, NonNegative, Required, "yaw breakaway torque, at which the truck begins to slip under the carbody", suspension.secondary.yaw_breakaway_torque),
    ],
};

/// A number of the air spring, which comes into being with the first of them.
macro_rules! air {
    ($path:literal, $quantity:ident, $range:expr, $need:expr, $meaning:literal, $field:ident) => {
        Number {
            key: Key {
                path: $path,
                symbol: "",
                quantity: Quantity::$quantity,
                meaning: $meaning,
                range: $range,
                need: $need,
                get: |vehicle: &Vehicle| Some(vehicle.suspension.secondary.air_spring?.$field),
                set: |vehicle: &mut Vehicle, value| {
                    let spring = &mut vehicle.suspension.secondary.air_spring;
                    spring.get_or_insert(NOTHING).$field = value;
                    if let Some(end) = vehicle.trailing_end_following(concat!("trailing.", $path)) {
                        let spring = &mut end.suspension.secondary.air_spring;
                        spring.get_or_insert(NOTHING).$field = value;
                    }
                },
            },
            trailing: Some(Key {
                path: concat!("trailing.", $path),
                symbol: "",
                quantity: Quantity::$quantity,
                meaning: $meaning,
                range: $range,
                need: Optional("as at the leading end"),
                get: |vehicle: &Vehicle| {
                    let end = vehicle.trailing_end_with_own(concat!("trailing.", $path))?;
                    Some(end.suspension.secondary.air_spring?.$field)
                },
                set: |vehicle: &mut Vehicle, value| {
                    let end = vehicle.trailing_end_of_its_own(concat!("trailing.", $path));
                    let spring = &mut end.suspension.secondary.air_spring;
                    spring.get_or_insert(NOTHING).$field = value;
                },
            }),
            in_force: |vehicle, j| Some(vehicle.end(j).suspension.secondary.air_spring?.$field),
        }
    };
}

const NOTHING: AirSpring = AirSpring {
    direct_stiffness: 0.0,
    series_stiffness: 0.0,
    orifice_damping: 0.0,
    reservoir_stiffness: 0.0,
};

/// Numbers of `[suspension.secondary.air_spring]`: all or none; required ones are required of an air spring.
#[rustfmt::skip]
pub static AIR_SPRING: Table<Vehicle> = Table {
    path: "suspension.secondary.air_spring",
    meaning: "An air spring with orifice damping, per side; it takes the place of K_sz and C_sz in the vertical model (Figure 3.4.5a).",
    numbers: &[
        air!("suspension.secondary.air_spring.direct_stiffness", Stiffness, NonNegative, Required, "direct spring of an air spring (change of effective area), per side", direct_stiffness),
        air!("suspension.secondary.air_spring.series_stiffness", Stiffness, Positive, Required, "air in the bellows, in series with the orifice, per side", series_stiffness),
        air!("suspension.secondary.air_spring.orifice_damping", Damping, NonNegative, Required, "orifice between bellows and reservoir, per side", orifice_damping),
        air!("suspension.secondary.air_spring.reservoir_stiffness", Stiffness, NonNegative, Optional("0"), "air in the reservoir, in parallel with the orifice, per side", reservoir_stiffness),
    ],
};

/// Numbers of `[suspension.anti_roll_bar]`.
#[rustfmt::skip]
static ANTI_ROLL_BAR: Table<Vehicle> = Table {
    path: "suspension.anti_roll_bar",
    meaning: "An anti-roll bar between truck frame and carbody, per truck.",
    numbers: &[
        of_end!("suspension.anti_roll_bar.stiffness", "K_ar", RotationalStiffness, NonNegative, Optional("no bar"), "roll stiffness of the anti-roll bar, per truck", suspension.anti_roll_bar, |end| Some(end.suspension.anti_roll_bar.unwrap_or(0.0))),
    ],
};
