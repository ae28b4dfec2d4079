//! What may vary, what must be reached, and what must not be exceeded.

use toml::de::DeValue;

use super::diagnostic::{Collect, Diagnostic};
use super::document::{Document, Value};
use super::keys::{self, Range};
use super::value::{interval, list, whole};
use crate::case::Case;
use crate::units::Quantity;
use crate::wheel_rail::CONICITY_MAX;

/// Closed interval, lower < upper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Lower bound.
    pub lower: f64,
    /// Upper bound.
    pub upper: f64,
}

impl From<[f64; 2]> for Interval {
    fn from([lower, upper]: [f64; 2]) -> Self {
        Self { lower, upper }
    }
}

impl From<Interval> for [f64; 2] {
    fn from(interval: Interval) -> Self {
        [interval.lower, interval.upper]
    }
}

/// How the conicity may vary.
#[derive(Debug, Clone, PartialEq)]
pub enum ConicitySpace {
    /// Continuously.
    Interval(Interval),
    /// Among the conicities of given profiles.
    Choices(Vec<f64>),
}

/// What the design may vary; `None` keeps a value as the case has it. SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignSpace {
    /// K_b = d_p² K_px, N m/rad.
    pub primary_bending_stiffness: Option<Interval>,
    /// K_py, N/m.
    pub primary_lateral_stiffness: Option<Interval>,
    /// Vertical natural frequency of the truck frame, Hz, from which K_pz follows (3.5-9).
    pub primary_vertical_frequency: Option<f64>,
    /// f_n of the carbody on its secondary lateral springs, Hz.
    pub secondary_lateral_frequency: Option<Interval>,
    /// ξ of the secondary lateral suspension.
    pub secondary_lateral_damping_ratio: Option<Interval>,
    /// f_n of the carbody on its secondary vertical springs, Hz.
    pub secondary_vertical_frequency: Option<Interval>,
    /// ξ of the secondary vertical suspension.
    pub secondary_vertical_damping_ratio: Option<Interval>,
    /// λ.
    pub conicity: Option<ConicitySpace>,
    /// Seed of the search: the same seed gives the same design.
    pub seed: u64,
}

impl Default for DesignSpace {
    fn default() -> Self {
        Self {
            primary_bending_stiffness: None,
            primary_lateral_stiffness: None,
            primary_vertical_frequency: None,
            secondary_lateral_frequency: None,
            secondary_lateral_damping_ratio: None,
            secondary_vertical_frequency: None,
            secondary_vertical_damping_ratio: None,
            conicity: None,
            seed: 1,
        }
    }
}

/// What must be reached.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Requirements {
    /// Critical speed, at least, m/s.
    pub critical_speed: Option<f64>,
    /// Tightest curve without flanging or slip, at least, in degrees of curve (not radians).
    pub degree_curve: Option<f64>,
    /// Average RMS lateral acceleration, at most, m/s².
    pub lateral_acceleration: Option<f64>,
    /// Average RMS vertical acceleration, at most, m/s².
    pub vertical_acceleration: Option<f64>,
}

/// What three standard deviations must not exceed, m.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    /// Secondary lateral stroke.
    pub secondary_lateral_stroke: Option<f64>,
    /// Secondary vertical stroke.
    pub secondary_vertical_stroke: Option<f64>,
    /// Primary lateral stroke.
    pub primary_lateral_stroke: Option<f64>,
    /// Excursion of a wheelset from the track centre line.
    pub wheelset_excursion: Option<f64>,
}

/// Reads `[design]`; `case` turns bounds of K_px into bounds of K_b.
pub(super) fn read(
    document: &Document,
    case: &Case,
    mistakes: &mut Vec<Diagnostic>,
) -> DesignSpace {
    let mut design = DesignSpace::default();
    document.numbers(keys::RULES.iter(), &mut design, mistakes);
    document.intervals(keys::BOUNDS, &mut design, mistakes);
    if let Some(value) = document.get(keys::LONGITUDINAL_BOUNDS) {
        let name = "primary_longitudinal_stiffness";
        let bounds = interval(value, name, Quantity::Stiffness, Range::Positive);
        if document.get("design.primary_bending_stiffness").is_some() {
            mistakes.push(
                Diagnostic::at(
                    value.span(),
                    format!("`{name}` and `primary_bending_stiffness` are the same variable"),
                    "expected one of the two",
                )
                .help("K_b = d_p² K_px: leave one out".to_owned()),
            );
        } else if let Some(bounds) = mistakes.collect(bounds) {
            let d_p2 = case.vehicle.truck.half_primary_spacing.powi(2);
            design.primary_bending_stiffness = Some(Interval {
                lower: bounds.lower * d_p2,
                upper: bounds.upper * d_p2,
            });
        }
    }
    if let Some(value) = document.get(keys::CONICITY_SPACE) {
        design.conicity = mistakes.collect(conicity(value));
    }
    if let Some(value) = document.get(keys::SEED) {
        design.seed = mistakes.collect(whole(value, "seed")).unwrap_or(1);
    }
    design
}

/// `[0.05, 0.25]` or `{ choices = [0.05, 0.10] }`.
fn conicity(value: &Value) -> Result<ConicitySpace, Diagnostic> {
    let range = Range::PositiveUpTo(CONICITY_MAX);
    let quantity = Quantity::Dimensionless;
    let DeValue::Table(table) = value.get_ref() else {
        return interval(value, "conicity", quantity, range).map(ConicitySpace::Interval);
    };
    let mut choices = None;
    for (name, value) in table {
        if name.get_ref() != "choices" {
            return Err(Diagnostic::at(
                name.span(),
                format!("unknown key `{}`", name.get_ref()),
                "expected choices = [0.05, 0.10]",
            ));
        }
        choices = Some(list(value, "choices", quantity, range, 1)?);
    }
    choices.map(ConicitySpace::Choices).ok_or_else(|| {
        Diagnostic::at(
            value.span(),
            "`conicity` has no choices",
            "expected { choices = [0.05, 0.10] }",
        )
    })
}
