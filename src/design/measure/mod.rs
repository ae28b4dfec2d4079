//! Indices measured on the full models, piece by piece, with their gradients where asked for.

mod curving;
mod ride;
mod shared;
mod stability;
mod statics;

use std::cell::OnceCell;

use crate::{
    case::Case,
    dynamics::{ForcedTangent, LateralModel, VerticalModel},
    evaluate::{
        curving::Limit,
        gradients::Constants,
        ride::{NoRide, VerticalRide},
    },
    index::{Behaviour, Index},
    numerics::{EigenError, Poles},
    optimize::problem::{Failure, Piece},
    parameter::Parameter,
    track::MAX_DEGREE,
};
use curving::{Curves, not_covered};
pub use shared::Shared;

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

/// Measures the wanted indices of a case. The index of a [`Piece`] is that of its wheelset, limit or
/// band, see [`piece_name`].
///
/// # Errors
///
/// [`Failure`] where the case has no such performance.
pub fn measure(case: &Case, wanted: &[Wanted]) -> Result<Vec<Vec<Piece>>, Failure> {
    Measurement::new(case, wanted, None, Purpose::Search)
        .run()
        .into_iter()
        .collect()
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
    let constants = Constants::new(case, constants);
    let measurement = Measurement::new(case, wanted, Some(&constants), Purpose::Search);
    measurement.run().into_iter().collect()
}

/// As [`measure`], for a verdict: each index has a result of its own, because a case that is unstable at
/// its speed has no lateral ride but a critical speed. Indices of a service curve that the model does not
/// cover have no result.
pub fn measure_each(case: &Case, wanted: &[Wanted]) -> Vec<Result<Vec<Piece>, Failure>> {
    Measurement::new(case, wanted, None, Purpose::Verdict).run()
}

/// True if a value is only an end of the range searched: of speeds for the critical speed, of curves for
/// the limits of curving.
pub fn is_only_bounded(case: &Case, index: Index, value: f64) -> bool {
    let [low, high] = case.model.speed_range;
    match index {
        Index::CriticalSpeed => value <= low || value >= high,
        Index::DegreeCurve | Index::FlangeLimitedCurve | Index::SlipLimitedCurve => {
            value >= MAX_DEGREE.to_radians()
        }
        _ => false,
    }
}

/// Reason why a successful measurement of an index has no pieces.
pub fn absence(index: Index) -> Failure {
    if index.needs_service_curve() {
        Failure::NoServiceCurve
    } else {
        Failure::NoMode
    }
}

/// Purpose of a measurement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Purpose {
    /// A search: all indices or none; beyond the models' limits their smooth extrapolation.
    Search,
    /// A verdict: every index by itself, only within the models' limits.
    Verdict,
}

type Measured = Result<Vec<Piece>, Failure>;

/// Measurement of the wanted indices of a case.
struct Measurement<'a> {
    case: &'a Case,
    wanted: &'a [Wanted],
    /// Constants of the gradients; `None`: values only.
    constants: Option<&'a Constants>,
    purpose: Purpose,
}

impl<'a> Measurement<'a> {
    fn new(
        case: &'a Case,
        wanted: &'a [Wanted],
        constants: Option<&'a Constants>,
        purpose: Purpose,
    ) -> Self {
        Self {
            case,
            wanted,
            constants,
            purpose,
        }
    }

    /// Indices of the lateral model, and indices of the other models.
    fn run(&self) -> Vec<Measured> {
        let numbered = self.wanted.iter().copied().enumerate();
        let status = OnceCell::new();
        let (mut known, mut open) = (Vec::new(), Vec::new());
        for (i, wanted) in numbered {
            match self.known(wanted, &status) {
                Some(measured) => known.push((i, measured)),
                None => open.push((i, wanted)),
            }
        }
        let (lateral, others): (Vec<_>, Vec<_>) = open
            .into_iter()
            .partition(|(_, wanted)| wanted.is_of_lateral_model());
        let (lateral, others) = rayon::join(|| self.lateral(&lateral), || self.others(&others));
        let mut all: Vec<(usize, Measured)> =
            known.into_iter().chain(lateral).chain(others).collect();
        all.sort_by_key(|(i, _)| *i);
        all.into_iter().map(|(_, measured)| measured).collect()
    }

    /// A result that is known without the models: no pieces where the service gives no curve, and in a
    /// verdict none where the model does not cover it. `status` keeps why, once it is known.
    fn known(&self, wanted: Wanted, status: &OnceCell<Option<Failure>>) -> Option<Measured> {
        let Wanted::Index(index) = wanted else {
            return None;
        };
        if index.needs_service_curve() && self.case.service.curve.is_none() {
            return Some(Ok(Vec::new()));
        }
        if index.is_in_service_curve() && self.purpose == Purpose::Verdict {
            return status.get_or_init(|| not_covered(self.case)).map(Err);
        }
        None
    }

    fn lateral(&self, wanted: &[(usize, Wanted)]) -> Vec<(usize, Measured)> {
        if wanted.is_empty() {
            return Vec::new();
        }
        let failed = |failure: Failure| wanted.iter().map(|(i, _)| (*i, Err(failure))).collect();
        let Ok(mut lateral) = Lateral::new(self.case) else {
            return failed(Failure::Eigenvalues);
        };
        let (rides, stability): (Vec<_>, Vec<_>) =
            wanted.iter().partition(|(_, wanted)| wanted.is_ride());
        if self.purpose == Purpose::Search && !rides.is_empty() && !lateral.poles.stable() {
            let diverges = lateral.poles.diverge();
            return failed(if diverges {
                Failure::Diverges
            } else {
                Failure::Unstable
            });
        }
        if let Some(constants) = self.constants
            && let Some(tangents) = constants.lateral(&lateral.model)
        {
            lateral.constants = Some(constants);
            lateral.tangents = tangents;
            lateral.graded = true;
        }
        let (stability, rides) = rayon::join(
            || {
                let all = stability.iter();
                all.map(|(i, wanted)| (*i, lateral.stability(*wanted)))
                    .collect::<Vec<_>>()
            },
            || {
                let mut ride = None;
                let mut of = |index| lateral.ride(index, &mut ride);
                let all = rides.iter().filter_map(|(i, wanted)| match wanted {
                    Wanted::Index(index) => Some((*i, of(*index))),
                    Wanted::DampingTo { .. } => None,
                });
                all.collect::<Vec<_>>()
            },
        );
        stability.into_iter().chain(rides).collect()
    }

    fn others(&self, wanted: &[(usize, Wanted)]) -> Vec<(usize, Measured)> {
        let mut curves = Curves::new(self.case, self.constants);
        let mut vertical = Vertical::new(self.case, self.constants);
        let mut of = |index: Index| match index.behaviour() {
            Behaviour::Curving => curves.measure(index),
            Behaviour::VerticalRide => vertical.ride(index),
            _ => vertical.statics(index),
        };
        let all = wanted.iter().filter_map(|(i, wanted)| match wanted {
            Wanted::Index(index) => Some((*i, of(*index))),
            Wanted::DampingTo { .. } => None,
        });
        all.collect()
    }
}

impl Wanted {
    fn is_of_lateral_model(self) -> bool {
        match self {
            Self::DampingTo { .. } => true,
            Self::Index(index) => {
                matches!(
                    index.behaviour(),
                    Behaviour::Stability | Behaviour::LateralRide
                )
            }
        }
    }

    fn is_ride(self) -> bool {
        matches!(self, Self::Index(index) if index.behaviour() == Behaviour::LateralRide)
    }
}

/// The lateral model of a case, its poles at the operating speed, and its derivatives if gradients
/// are asked for.
struct Lateral<'a> {
    case: &'a Case,
    model: LateralModel,
    poles: Poles,
    constants: Option<&'a Constants>,
    tangents: Vec<ForcedTangent>,
    graded: bool,
}

impl<'a> Lateral<'a> {
    fn new(case: &'a Case) -> Result<Self, EigenError> {
        let model = LateralModel::new(case);
        Ok(Self {
            case,
            poles: Poles::at(&model.forced, case.service.speed)?,
            model,
            constants: None,
            tangents: Vec::new(),
            graded: false,
        })
    }
}

/// The vertical model of a case, built when first asked for, likewise.
struct Vertical<'a> {
    case: &'a Case,
    constants: Option<&'a Constants>,
    model: Option<(VerticalModel, Poles, Vec<ForcedTangent>)>,
    ride: Option<ride::Graded<VerticalRide>>,
}

impl<'a> Vertical<'a> {
    fn new(case: &'a Case, constants: Option<&'a Constants>) -> Self {
        Self {
            case,
            constants,
            model: None,
            ride: None,
        }
    }

    fn model(&mut self) -> Result<&(VerticalModel, Poles, Vec<ForcedTangent>), Failure> {
        if self.model.is_none() {
            let model = VerticalModel::new(self.case);
            let poles = Poles::at(&model.forced, self.case.service.speed)
                .map_err(|_| Failure::Eigenvalues)?;
            let tangents = self
                .constants
                .and_then(|constants| constants.vertical(&model));
            if tangents.is_none() {
                self.constants = None;
            }
            self.model = Some((model, poles, tangents.unwrap_or_default()));
        }
        self.model.as_ref().ok_or(Failure::Eigenvalues)
    }
}

fn no_ride(reason: NoRide) -> Failure {
    match reason {
        NoRide::Unstable => Failure::Unstable,
        NoRide::Diverges => Failure::Diverges,
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

/// The worst value of an index among its pieces.
pub fn worst(index: Index, pieces: &[Piece]) -> Option<f64> {
    index.worst(pieces.iter().map(|p| p.value))
}

/// Bands kept apart by point.
const BANDS: usize = 64;

/// Name of a piece, to follow the name of its index; empty for a single piece.
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
        Index::DegreeCurve
        | Index::FlangeLimitedCurve
        | Index::SlipLimitedCurve
        | Index::CurveLimitRatio => Limit::ALL
            .get(piece)
            .map(ToString::to_string)
            .unwrap_or_default(),
        Index::LeastDampingRatioToSpeed => {
            ["", "at a lower speed", "at the lowest speed"][piece.min(2)].into()
        }
        Index::SecondaryLateralStroke
        | Index::SecondaryLateralStrokeInCurve
        | Index::SecondaryVerticalStroke => {
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
