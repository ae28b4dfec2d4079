//! Performance indices by name: what can be required, limited, optimised and traded off.

pub use crate::evaluate::limits::MET;
use crate::{
    track::MAX_DEGREE,
    units::{Quantity, Range},
};

/// A performance index.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Index {
    /// Lowest speed at which a mode loses its damping (3.4.4.2).
    CriticalSpeed,
    /// Tightest curve without flange contact or slip, at zero cant deficiency (4.5.2).
    DegreeCurve,
    /// Tightest curve without flange contact.
    FlangeLimitedCurve,
    /// Tightest curve without slip.
    SlipLimitedCurve,
    /// Damping ratio of the kinematic (truck hunting) mode at the operating speed.
    KinematicDampingRatio,
    /// Damping ratio of the least-damped lateral mode at the operating speed.
    LeastDampingRatio,
    /// The same, least over all speeds up to the operating speed.
    LeastDampingRatioToSpeed,
    /// RMS lateral acceleration, average over the passenger points (3.2.1).
    LateralAcceleration,
    /// RMS vertical acceleration, average over the passenger points (3.2.1).
    VerticalAcceleration,
    /// Largest ratio of lateral one-third-octave acceleration to the ISO boundary (3.2.1).
    LateralIsoRatio,
    /// Largest ratio of vertical one-third-octave acceleration to the ISO boundary (3.2.1).
    VerticalIsoRatio,
    /// Least ratio of truck to carbody natural frequency (3.5.3).
    FrequencySeparation,
    /// Least ratio between natural frequencies of truck and flexible carbody modes (4.3).
    FlexibleModeSeparation,
    /// Secondary lateral stroke, three standard deviations (3.3.4).
    SecondaryLateralStroke,
    /// Secondary lateral stroke in the service curve: quasi-static, and three standard deviations of
    /// random motion.
    SecondaryLateralStrokeInCurve,
    /// Secondary vertical stroke, three standard deviations (3.3.4).
    SecondaryVerticalStroke,
    /// Primary lateral stroke, three standard deviations (3.3.4).
    PrimaryLateralStroke,
    /// Primary longitudinal stroke, three standard deviations (3.3.4).
    PrimaryLongitudinalStroke,
    /// Primary vertical stroke, three standard deviations (3.3.4).
    PrimaryVerticalStroke,
    /// Excursion of a wheelset from the track centre line, three standard deviations (3.3.5).
    WheelsetExcursion,
    /// Change of wheel load, three standard deviations, over the static load.
    WheelLoadVariation,
    /// Largest L/V of a wheel in the service curve (3.3.3).
    WheelLOverV,
    /// Largest L/V of a truck side in the service curve (3.3.3).
    TruckSideLOverV,
    /// Largest net lateral over vertical axle load in the service curve (3.3.3).
    NetAxleLOverV,
    /// Largest share of μN that a wheel uses in the service curve.
    AdhesionUsed,
    /// Largest ratio to flange contact (|y_w| over the clearance) or slip (share of μN) in the service
    /// curve: above 1 the linear model does not cover it.
    CurveLimitRatio,
    /// Static deflection of the secondary springs under the carbody.
    SecondaryStaticDeflection,
    /// Static deflection of the primary springs under carbody and frames.
    PrimaryStaticDeflection,
}

/// Which way an index is better.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sense {
    /// Larger is better: a bound is a least value.
    AtLeast,
    /// Smaller is better: a bound is a greatest value.
    AtMost,
}

/// Part of the vehicle's behaviour that an index belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Behaviour {
    /// Modes of the lateral model.
    Stability,
    /// Steady-state curving.
    Curving,
    /// Response to lateral irregularities.
    LateralRide,
    /// Response to vertical irregularities.
    VerticalRide,
    /// Natural frequencies and deflections by formulas.
    Statics,
}

/// Scale on which an index is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// By ratios.
    Logarithmic,
    /// By differences: damping ratios, which may be negative.
    Linear,
}

struct Row {
    path: &'static str,
    words: &'static str,
    quantity: Quantity,
    /// Suffix of exported columns, and their unit in SI base units.
    column: (&'static str, f64),
    sense: Sense,
    behaviour: Behaviour,
}

const DEGREE: f64 = std::f64::consts::PI / 180.0;

impl Index {
    /// All indices.
    pub const ALL: [Self; 28] = [
        Self::CriticalSpeed,
        Self::DegreeCurve,
        Self::FlangeLimitedCurve,
        Self::SlipLimitedCurve,
        Self::KinematicDampingRatio,
        Self::LeastDampingRatio,
        Self::LeastDampingRatioToSpeed,
        Self::LateralAcceleration,
        Self::VerticalAcceleration,
        Self::LateralIsoRatio,
        Self::VerticalIsoRatio,
        Self::FrequencySeparation,
        Self::FlexibleModeSeparation,
        Self::SecondaryLateralStroke,
        Self::SecondaryLateralStrokeInCurve,
        Self::SecondaryVerticalStroke,
        Self::PrimaryLateralStroke,
        Self::PrimaryLongitudinalStroke,
        Self::PrimaryVerticalStroke,
        Self::WheelsetExcursion,
        Self::WheelLoadVariation,
        Self::WheelLOverV,
        Self::TruckSideLOverV,
        Self::NetAxleLOverV,
        Self::AdhesionUsed,
        Self::CurveLimitRatio,
        Self::SecondaryStaticDeflection,
        Self::PrimaryStaticDeflection,
    ];

    #[rustfmt::skip]
    const fn row(self) -> Row {
        use Behaviour::{Curving, LateralRide, Stability, Statics, VerticalRide};
        use Quantity::{Acceleration, DegreeOfCurve, Dimensionless, Speed, Stroke};
        use Sense::{AtLeast, AtMost};
        const fn row(
            path: &'static str,
            words: &'static str,
            quantity: Quantity,
            sense: Sense,
            behaviour: Behaviour,
        ) -> Row {
            let column = match quantity {
                Speed => ("_m_per_s", 1.0),
                DegreeOfCurve => ("_deg", DEGREE),
                Acceleration => ("_m_per_s2", 1.0),
                Stroke => ("_m", 1.0),
                _ => ("", 1.0),
            };
            Row { path, words, quantity, column, sense, behaviour }
        }
        match self {
            Self::CriticalSpeed => row("requirements.critical_speed", "critical speed", Speed, AtLeast, Stability),
            Self::DegreeCurve => row("requirements.degree_curve", "degree curve", DegreeOfCurve, AtLeast, Curving),
            Self::FlangeLimitedCurve => row("requirements.flange_limited_curve", "flange-limited curve", DegreeOfCurve, AtLeast, Curving),
            Self::SlipLimitedCurve => row("requirements.slip_limited_curve", "slip-limited curve", DegreeOfCurve, AtLeast, Curving),
            Self::KinematicDampingRatio => row("requirements.kinematic_damping_ratio", "damping ratio of the kinematic mode", Dimensionless, AtLeast, Stability),
            Self::LeastDampingRatio => row("requirements.least_damping_ratio", "least damping ratio at speed", Dimensionless, AtLeast, Stability),
            Self::LeastDampingRatioToSpeed => row("requirements.least_damping_ratio_to_speed", "least damping ratio up to speed", Dimensionless, AtLeast, Stability),
            Self::LateralAcceleration => row("requirements.lateral_acceleration", "average RMS lateral acceleration", Acceleration, AtMost, LateralRide),
            Self::VerticalAcceleration => row("requirements.vertical_acceleration", "average RMS vertical acceleration", Acceleration, AtMost, VerticalRide),
            Self::LateralIsoRatio => row("requirements.lateral_iso_ratio", "lateral acceleration over ISO boundary", Dimensionless, AtMost, LateralRide),
            Self::VerticalIsoRatio => row("requirements.vertical_iso_ratio", "vertical acceleration over ISO boundary", Dimensionless, AtMost, VerticalRide),
            Self::FrequencySeparation => row("requirements.frequency_separation", "truck over carbody frequency", Dimensionless, AtLeast, Statics),
            Self::FlexibleModeSeparation => row("requirements.flexible_mode_separation", "separation of truck and flexible modes", Dimensionless, AtLeast, Statics),
            Self::SecondaryLateralStroke => row("limits.secondary_lateral_stroke", "secondary lateral stroke, 3σ", Stroke, AtMost, LateralRide),
            Self::SecondaryLateralStrokeInCurve => row("limits.secondary_lateral_stroke_in_curve", "secondary lateral stroke in curve, with 3σ", Stroke, AtMost, LateralRide),
            Self::SecondaryVerticalStroke => row("limits.secondary_vertical_stroke", "secondary vertical stroke, 3σ", Stroke, AtMost, VerticalRide),
            Self::PrimaryLateralStroke => row("limits.primary_lateral_stroke", "primary lateral stroke, 3σ", Stroke, AtMost, LateralRide),
            Self::PrimaryLongitudinalStroke => row("limits.primary_longitudinal_stroke", "primary longitudinal stroke, 3σ", Stroke, AtMost, LateralRide),
            Self::PrimaryVerticalStroke => row("limits.primary_vertical_stroke", "primary vertical stroke, 3σ", Stroke, AtMost, VerticalRide),
            Self::WheelsetExcursion => row("limits.wheelset_excursion", "wheelset excursion, 3σ", Stroke, AtMost, LateralRide),
            Self::WheelLoadVariation => row("limits.wheel_load_variation", "wheel load variation, 3σ", Dimensionless, AtMost, VerticalRide),
            Self::WheelLOverV => row("limits.wheel_l_over_v", "L/V of a wheel", Dimensionless, AtMost, Curving),
            Self::TruckSideLOverV => row("limits.truck_side_l_over_v", "L/V of a truck side", Dimensionless, AtMost, Curving),
            Self::NetAxleLOverV => row("limits.net_axle_l_over_v", "net axle L/V", Dimensionless, AtMost, Curving),
            Self::AdhesionUsed => row("limits.adhesion_used", "adhesion used", Dimensionless, AtMost, Curving),
            Self::CurveLimitRatio => row("limits.curve_limit_ratio", "ratio to flange contact or slip", Dimensionless, AtMost, Curving),
            Self::SecondaryStaticDeflection => row("limits.secondary_static_deflection", "secondary static deflection", Stroke, AtMost, Statics),
            Self::PrimaryStaticDeflection => row("limits.primary_static_deflection", "primary static deflection", Stroke, AtMost, Statics),
        }
    }

    /// Path of its bound in specs: what the vehicle must reach stands in `[requirements]`, what it
    /// must not exceed in `[limits]`.
    pub const fn path(self) -> &'static str {
        self.row().path
    }

    /// Name in specs and files.
    pub fn name(self) -> &'static str {
        let path = self.path();
        path.rsplit_once('.').map_or(path, |(_, name)| name)
    }

    /// Bounds that make sense, SI.
    pub const fn range(self) -> Range {
        match self {
            Self::DegreeCurve | Self::FlangeLimitedCurve | Self::SlipLimitedCurve => {
                Range::PositiveUpTo(MAX_DEGREE * DEGREE)
            }
            Self::KinematicDampingRatio
            | Self::LeastDampingRatio
            | Self::LeastDampingRatioToSpeed => Range::Between(0.0, 1.0),
            _ => Range::Positive,
        }
    }

    /// Name in tables.
    pub const fn words(self) -> &'static str {
        self.row().words
    }

    /// Kind of quantity, for units.
    pub const fn quantity(self) -> Quantity {
        self.row().quantity
    }

    /// Which way it is better.
    pub const fn sense(self) -> Sense {
        self.row().sense
    }

    /// The worst of some values; `None` if there is none.
    pub fn worst(self, values: impl Iterator<Item = f64>) -> Option<f64> {
        match self.sense() {
            Sense::AtLeast => values.min_by(f64::total_cmp),
            Sense::AtMost => values.max_by(f64::total_cmp),
        }
    }

    /// Part of the behaviour that it belongs to.
    pub const fn behaviour(self) -> Behaviour {
        self.row().behaviour
    }

    /// Whether it exists only where the service gives a curve.
    pub const fn needs_service_curve(self) -> bool {
        matches!(self, Self::SecondaryLateralStrokeInCurve)
    }

    /// Whether it is a force or stroke in the service curve, which has no verdict where the model does
    /// not cover that curve.
    pub const fn is_in_service_curve(self) -> bool {
        matches!(
            self,
            Self::WheelLOverV
                | Self::TruckSideLOverV
                | Self::NetAxleLOverV
                | Self::AdhesionUsed
                | Self::SecondaryLateralStrokeInCurve
        )
    }

    /// Scale on which it is compared.
    pub const fn scale(self) -> Scale {
        match self {
            Self::KinematicDampingRatio
            | Self::LeastDampingRatio
            | Self::LeastDampingRatioToSpeed => Scale::Linear,
            _ => Scale::Logarithmic,
        }
    }

    /// Name of an exported column, unit included.
    pub fn column(self) -> String {
        format!("{}{}", self.name(), self.row().column.0)
    }

    /// A value in the unit of its column.
    pub fn in_column(self, si: f64) -> f64 {
        si / self.row().column.1
    }

    /// The index with that name in specs.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|index| index.name() == name)
    }
}

/// A demand on an index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Demand {
    /// Of what.
    pub index: Index,
    /// Least or greatest value, SI base units.
    pub bound: f64,
}

impl Demand {
    /// How far a value, SI, falls short of the bound: relative to it, or as it is for damping
    /// ratios; negative with room to spare.
    pub fn shortfall(&self, reached: f64) -> f64 {
        let short = match self.index.sense() {
            Sense::AtLeast => self.bound - reached,
            Sense::AtMost => reached - self.bound,
        };
        match self.index.scale() {
            Scale::Logarithmic => short / self.bound,
            Scale::Linear => short,
        }
    }

    /// Whether a value, SI, keeps the bound within [`MET`].
    pub fn met_by(&self, reached: f64) -> bool {
        self.shortfall(reached) <= MET
    }
}

/// Requirements and limits: a bound for every index of which something is asked.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Demands(Vec<Demand>);

impl Demands {
    /// The bound on an index, SI.
    pub fn get(&self, index: Index) -> Option<f64> {
        self.0.iter().find(|d| d.index == index).map(|d| d.bound)
    }

    /// Sets or replaces the bound on an index, SI.
    pub fn set(&mut self, index: Index, bound: f64) {
        self.0.retain(|d| d.index != index);
        let at = self.0.partition_point(|d| d.index < index);
        self.0.insert(at, Demand { index, bound });
    }

    /// Takes the bound on an index away.
    pub fn remove(&mut self, index: Index) {
        self.0.retain(|d| d.index != index);
    }

    /// All demands, in the order of [`Index::ALL`].
    pub fn iter(&self) -> impl Iterator<Item = Demand> + '_ {
        self.0.iter().copied()
    }

    /// These demands, with those of `over` in place of their own.
    #[must_use]
    pub fn overridden(&self, over: &Self) -> Self {
        let mut demands = self.clone();
        for demand in over.iter() {
            demands.set(demand.index, demand.bound);
        }
        demands
    }
}
