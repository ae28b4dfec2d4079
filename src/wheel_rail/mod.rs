//! Wheel–rail contact: profile geometry and creep coefficients.

mod numbers;
mod table;

pub use numbers::{CONICITY, WHEEL_RAIL, coefficients};
pub(crate) use table::rows_around;
pub use table::{CONICITY_MAX, PROFILES};

use serde::Serialize;

/// The wheel–rail pair as a spec describes it. `None` takes the coefficient from the report's
/// table for the conicity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct WheelRail {
    /// λ, wheel conicity.
    pub conicity: f64,
    /// μ, coefficient of friction between wheel and rail.
    pub friction: f64,
    /// Factor on all four creep coefficients, explicit ones too; 1 is full Kalker.
    pub creep_factor: f64,
    /// Lateral clearance between a centred wheelset's flange and the rail, m.
    pub flange_clearance: f64,
    /// f11, lateral creep coefficient, N.
    pub lateral_creep: Option<f64>,
    /// f12, lateral–spin creep coefficient, N m.
    pub lateral_spin_creep: Option<f64>,
    /// f22, spin creep coefficient, N m².
    pub spin_creep: Option<f64>,
    /// f33, longitudinal creep coefficient, N.
    pub longitudinal_creep: Option<f64>,
    /// a11, wheelset roll coefficient.
    pub roll_coefficient: Option<f64>,
    /// δ0, contact angle of the centred wheelset, rad.
    pub contact_angle: Option<f64>,
    /// Δ, contact angle difference coefficient.
    pub contact_angle_difference: Option<f64>,
}

impl Default for WheelRail {
    /// Table 4.1.1: λ = 0.05, μ = 0.2, full Kalker; flange clearance 0.5 in (4.5.2).
    fn default() -> Self {
        Self {
            conicity: 0.05,
            friction: 0.2,
            creep_factor: 1.0,
            flange_clearance: 0.0127,
            lateral_creep: None,
            lateral_spin_creep: None,
            spin_creep: None,
            longitudinal_creep: None,
            roll_coefficient: None,
            contact_angle: None,
            contact_angle_difference: None,
        }
    }
}

/// The coefficients that the equations of motion use, per wheel, creep factor applied.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// λ.
    pub conicity: f64,
    /// f11, lateral creep coefficient, N.
    pub f11: f64,
    /// f12, lateral–spin creep coefficient, N m.
    pub f12: f64,
    /// f22, spin creep coefficient, N m².
    pub f22: f64,
    /// f33, longitudinal creep coefficient, N.
    pub f33: f64,
    /// a11, wheelset roll coefficient: φ_w = (a11/a) e.
    pub a11: f64,
    /// δ0, contact angle of the centred wheelset, rad.
    pub delta_0: f64,
    /// Δ, contact angle difference coefficient.
    pub delta: f64,
}

impl WheelRail {
    /// Coefficients in force: explicit values first, the table of the report for the rest.
    pub fn contact(&self) -> Contact {
        self.full_creep().with_creep_factor(self.creep_factor)
    }

    /// The same with full Kalker coefficients, before the creep factor.
    pub fn full_creep(&self) -> Contact {
        let table = Contact::tabulated(self.conicity);
        Contact {
            conicity: self.conicity,
            f11: self.lateral_creep.unwrap_or(table.f11),
            f12: self.lateral_spin_creep.unwrap_or(table.f12),
            f22: self.spin_creep.unwrap_or(table.f22),
            f33: self.longitudinal_creep.unwrap_or(table.f33),
            a11: self.roll_coefficient.unwrap_or(table.a11),
            delta_0: self.contact_angle.unwrap_or(table.delta_0),
            delta: self.contact_angle_difference.unwrap_or(table.delta),
        }
    }
}

impl Contact {
    /// The contact with a factor on all creep coefficients.
    #[must_use]
    pub fn with_creep_factor(self, factor: f64) -> Self {
        Self {
            f11: factor * self.f11,
            f12: factor * self.f12,
            f22: factor * self.f22,
            f33: factor * self.f33,
            ..self
        }
    }

    /// The contact of a wheel whose load is `ratio` times that to which the coefficients belong (3.4.5):
    /// f11, f33 ∝ N^⅔, f12 ∝ N, f22 ∝ N^(4/3).
    #[must_use]
    pub fn at_load(self, ratio: f64) -> Self {
        // A wheel without load has no creep forces; the model of such a vehicle is not solved.
        let ratio = ratio.max(0.0);
        Self {
            f11: self.f11 * ratio.powf(2.0 / 3.0),
            f12: self.f12 * ratio,
            f22: self.f22 * ratio.powf(4.0 / 3.0),
            f33: self.f33 * ratio.powf(2.0 / 3.0),
            ..self
        }
    }
}
