//! Indices measured on the full models, piece by piece, with their gradients where asked for.

mod curving;
mod ride;
mod stability;
mod statics;

use crate::{
    case::Case,
    dynamics::{ForcedTangent, LateralModel, Poles, VerticalModel, curving::CurvingModel},
    evaluate::{
        curving::{CurvingLimits, Limit},
        gradients::Constants,
        lateral_modes::LateralModes,
        ride::NoRide,
    },
    index::{Behaviour, Index},
    optimize::problem::{Failure, Piece},
    parameter::Parameter,
};
use curving::Curve;
use ride::{Lateral, Vertical};

/// Something to measure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Wanted {
    /// An index as it is.
    Index(Index),
    /// Damping ratios, wherever a mode is least damped over the speeds from the start of the
    /// range searched up to `speed`, m/s; of interest where `below` a value.
    DampingTo {
        /// m/s.
        speed: f64,
        /// ζ.
        below: f64,
    },
}

impl std::fmt::Display for Wanted {
    /// Distinguishes measurements in the archive.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Index(index) => f.write_str(index.name()),
            Self::DampingTo { speed, below } => write!(f, "damping<{below}@{speed}"),
        }
    }
}

/// Measures what is wanted of a case. The index of a [`Piece`] is that of the wheelset, limit or
/// band it comes from, see [`piece_name`].
///
/// # Errors
///
/// [`Failure`] where the case has no such performance.
pub fn measure(case: &Case, wanted: &[Wanted]) -> Result<Vec<Vec<Piece>>, Failure> {
    let mut models = Models::new(case, None);
    wanted.iter().map(|w| models.measure(*w)).collect()
}

/// As [`measure`], with the gradient of every piece over some constants of Table 4.1.1; for
/// [`Wanted::DampingTo`] the slope over its speed comes behind these.
///
/// # Errors
///
/// As [`measure`].
pub fn measure_graded(
    case: &Case,
    wanted: &[Wanted],
    constants: &[Parameter],
) -> Result<Vec<Vec<Piece>>, Failure> {
    let mut models = Models::new(case, Some(Constants::new(case, constants)));
    wanted.iter().map(|w| models.measure(*w)).collect()
}

/// As [`measure`], with a result for each of what is wanted: a case that is unstable at its speed
/// has no lateral ride, but it has a critical speed.
pub fn measure_each(case: &Case, wanted: &[Wanted]) -> Vec<Result<Vec<Piece>, Failure>> {
    let mut models = Models::new(case, None);
    wanted.iter().map(|w| models.measure(*w)).collect()
}

/// The models of a case, built when first asked for.
struct Models<'a> {
    case: &'a Case,
    /// By which gradients are taken, if they are.
    constants: Option<Constants<'a>>,
    lateral: Option<(LateralModel, Vec<ForcedTangent>)>,
    poles: Option<Poles>,
    vertical: Option<(VerticalModel, Poles, Vec<ForcedTangent>)>,
    lateral_ride: Option<Lateral>,
    vertical_ride: Option<Vertical>,
    modes: Option<LateralModes>,
    curving: Option<(CurvingModel, CurvingLimits)>,
    curve: Option<Curve>,
}

impl<'a> Models<'a> {
    fn new(case: &'a Case, constants: Option<Constants<'a>>) -> Self {
        Self {
            case,
            constants,
            lateral: None,
            poles: None,
            vertical: None,
            lateral_ride: None,
            vertical_ride: None,
            modes: None,
            curving: None,
            curve: None,
        }
    }

    fn measure(&mut self, wanted: Wanted) -> Result<Vec<Piece>, Failure> {
        match wanted {
            Wanted::DampingTo { speed, below } => self.damping_to(speed, below),
            Wanted::Index(index) => match index.behaviour() {
                Behaviour::Stability => self.stability(index),
                Behaviour::Curving => self.curving(index),
                Behaviour::LateralRide => self.lateral_ride(index),
                Behaviour::VerticalRide => self.vertical_ride(index),
                Behaviour::Statics => self.statics(index),
            },
        }
    }

    /// The lateral model and its poles at the operating speed.
    fn with_poles(&mut self) -> Result<(&LateralModel, &Poles), Failure> {
        let (model, _, poles) = self.with_tangents()?;
        Ok((model, poles))
    }

    /// As [`Models::with_poles`], with the model's derivatives if gradients are asked for.
    fn with_tangents(&mut self) -> Result<(&LateralModel, &[ForcedTangent], &Poles), Failure> {
        let (case, constants) = (self.case, &self.constants);
        let (model, tangents) = &*self.lateral.get_or_insert_with(|| {
            let model = LateralModel::new(case);
            let tangents = constants
                .as_ref()
                .map(|constants| constants.lateral(&model));
            (model, tangents.unwrap_or_default())
        });
        if self.poles.is_none() {
            let poles = Poles::at(&model.forced.system, case.service.speed);
            self.poles = Some(poles.map_err(|_| Failure::Eigenvalues)?);
        }
        let poles = self.poles.as_ref().ok_or(Failure::Eigenvalues)?;
        Ok((model, tangents, poles))
    }

    /// The vertical model, its poles, and its derivatives if gradients are asked for.
    fn vertical(&mut self) -> Result<&(VerticalModel, Poles, Vec<ForcedTangent>), Failure> {
        if self.vertical.is_none() {
            let model = VerticalModel::new(self.case);
            let poles = Poles::at(&model.forced.system, self.case.service.speed)
                .map_err(|_| Failure::Eigenvalues)?;
            let constants = self.constants.as_ref();
            let tangents = constants.map(|constants| constants.vertical(&model));
            self.vertical = Some((model, poles, tangents.unwrap_or_default()));
        }
        self.vertical.as_ref().ok_or(Failure::Eigenvalues)
    }
}

/// `unstable` says what a model without a stationary response does.
fn no_ride(reason: NoRide, unstable: Failure) -> Failure {
    match reason {
        NoRide::Unstable => unstable,
        NoRide::NotConverged => Failure::Integration,
        NoRide::Poles(_) => Failure::Eigenvalues,
    }
}

/// Pieces of one value each, with their gradients if these are asked for: `gradients` has the
/// derivatives of all values by each constant.
fn pieces(values: &[f64], gradients: Option<&[Vec<f64>]>) -> Vec<Piece> {
    let values = values.iter().enumerate();
    values
        .map(|(i, value)| Piece {
            gradient: gradients.map(|by| by.iter().map(|derivatives| derivatives[i]).collect()),
            ..Piece::single(i, *value)
        })
        .collect()
}

/// Bands kept apart by point.
const BANDS: usize = 64;

/// Name of a piece of what was wanted, to go behind the name of the index; empty if it is alone.
pub fn piece_name(wanted: Wanted, piece: usize) -> String {
    let index = match wanted {
        Wanted::DampingTo { .. } => {
            return ["", "at a lower speed", "at the lowest speed"][piece.min(2)].into();
        }
        Wanted::Index(index) => index,
    };
    let wheel = || {
        let side = ["outer", "inner"][piece % 2];
        format!("wheelset {} {side} wheel", piece / 2 + 1)
    };
    match index {
        Index::DegreeCurve | Index::FlangeLimitedCurve | Index::SlipLimitedCurve => Limit::ALL
            .get(piece)
            .map(ToString::to_string)
            .unwrap_or_default(),
        Index::LeastDampingRatioToSpeed => {
            ["", "at a lower speed", "at the lowest speed"][piece.min(2)].into()
        }
        Index::SecondaryLateralStroke | Index::SecondaryVerticalStroke => {
            ["leading truck", "trailing truck"][piece.min(1)].into()
        }
        Index::PrimaryLateralStroke
        | Index::PrimaryLongitudinalStroke
        | Index::PrimaryVerticalStroke
        | Index::WheelsetExcursion
        | Index::WheelLoadVariation
        | Index::NetAxleLOverV => format!("wheelset {}", piece + 1),
        Index::WheelLOverV | Index::AdhesionUsed => wheel(),
        Index::TruckSideLOverV => {
            let side = ["outer", "inner"][piece % 2];
            format!("truck {} {side} side", piece / 2 + 1)
        }
        Index::FrequencySeparation => ["lateral", "vertical", "roll", "yaw", "pitch"]
            .get(piece)
            .map_or_else(String::new, ToString::to_string),
        Index::LateralIsoRatio | Index::VerticalIsoRatio => {
            let point = ["c.g.", "front", "rear"][(piece / BANDS).min(2)];
            format!("{point}, band {}", piece % BANDS + 1)
        }
        _ => String::new(),
    }
}
