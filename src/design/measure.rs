//! Indices measured on the full models, piece by piece.

use crate::{
    case::Case,
    dynamics::{LateralModel, Poles, VerticalModel},
    evaluate::{
        checks::separations,
        critical_speed::Stability,
        curving::{CurvingLimits, CurvingState, Limit},
        damping_range::{DampingRange, Place},
        lateral_modes::{LateralModes, LateralShape},
        limits::PEAK,
        passenger_ride::PassengerRide,
        ride::{LateralRide, NoRide, VerticalRide},
        vertical_modes::{flexible_separations, vertical_modes},
    },
    index::{Behaviour, Index},
    optimize::problem::{Failure, Piece},
    track::MAX_DEGREE,
    vehicle::GRAVITY,
};

/// Multiple of the lowest critical speed up to which others may become the lowest.
const NEARBY: f64 = 1.5;

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
    let mut models = Models::new(case);
    wanted.iter().map(|w| models.measure(*w)).collect()
}

/// As [`measure`], with a result for each of what is wanted: a case that is unstable at its speed
/// has no lateral ride, but it has a critical speed.
pub fn measure_each(case: &Case, wanted: &[Wanted]) -> Vec<Result<Vec<Piece>, Failure>> {
    let mut models = Models::new(case);
    wanted.iter().map(|w| models.measure(*w)).collect()
}

/// The models of a case, built when first asked for.
struct Models<'a> {
    case: &'a Case,
    lateral: Option<LateralModel>,
    poles: Option<Poles>,
    vertical: Option<(VerticalModel, Poles)>,
    lateral_ride: Option<LateralRide>,
    vertical_ride: Option<VerticalRide>,
    modes: Option<LateralModes>,
    limits: Option<CurvingLimits>,
    curve: Option<CurvingState>,
}

impl<'a> Models<'a> {
    fn new(case: &'a Case) -> Self {
        Self {
            case,
            lateral: None,
            poles: None,
            vertical: None,
            lateral_ride: None,
            vertical_ride: None,
            modes: None,
            limits: None,
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
        let case = self.case;
        let model = &*self.lateral.get_or_insert_with(|| LateralModel::new(case));
        if self.poles.is_none() {
            let poles = Poles::at(&model.forced.system, case.service.speed);
            self.poles = Some(poles.map_err(|_| Failure::Eigenvalues)?);
        }
        let poles = self.poles.as_ref().ok_or(Failure::Eigenvalues)?;
        Ok((model, poles))
    }

    /// The vertical model and its poles.
    fn vertical(&mut self) -> Result<&(VerticalModel, Poles), Failure> {
        if self.vertical.is_none() {
            let model = VerticalModel::new(self.case);
            let poles = Poles::at(&model.forced.system, self.case.service.speed)
                .map_err(|_| Failure::Eigenvalues)?;
            self.vertical = Some((model, poles));
        }
        self.vertical.as_ref().ok_or(Failure::Eigenvalues)
    }

    fn damping_to(&mut self, speed: f64, below: f64) -> Result<Vec<Piece>, Failure> {
        let start = self.case.model.speed_range[0].min(0.5 * speed);
        let (model, poles) = self.with_poles()?;
        let range = DampingRange::new(model, poles, [start, speed], below)
            .map_err(|_| Failure::Eigenvalues)?;
        if range.diverges {
            return Err(Failure::Diverging);
        }
        if range.minima.is_empty() {
            return Err(Failure::NoMode);
        }
        let pieces = range.minima.iter().map(|minimum| Piece {
            value: minimum.damping_ratio,
            index: match minimum.place {
                Place::Top => 0,
                Place::Inside => 1,
                Place::Bottom => 2,
            },
            label: minimum.frequency.ln(),
        });
        Ok(pieces.collect())
    }

    fn stability(&mut self, index: Index) -> Result<Vec<Piece>, Failure> {
        let speed = self.case.service.speed;
        match index {
            Index::CriticalSpeed => self.onsets(),
            Index::LeastDampingRatioToSpeed => self.damping_to(speed, f64::INFINITY),
            _ => {
                let kinematic_only = index == Index::KinematicDampingRatio;
                let modes = self.modes()?.oscillatory.iter();
                let pieces: Vec<Piece> = modes
                    .filter(|m| !kinematic_only || m.shape == LateralShape::Kinematic)
                    .map(|m| Piece {
                        value: m.damping_ratio,
                        index: 0,
                        label: m.frequency.ln(),
                    })
                    .collect();
                if pieces.is_empty() {
                    return Err(Failure::NoMode);
                }
                Ok(pieces)
            }
        }
    }

    fn modes(&mut self) -> Result<&LateralModes, Failure> {
        if self.modes.is_none() {
            let case = self.case;
            let (model, poles) = self.with_poles()?;
            let modes = LateralModes::new(model, case, poles).map_err(|_| Failure::Eigenvalues)?;
            self.modes = Some(modes);
        }
        self.modes.as_ref().ok_or(Failure::Eigenvalues)
    }

    /// Speeds at which modes lose their damping; the end of the range where none does.
    fn onsets(&mut self) -> Result<Vec<Piece>, Failure> {
        let range = self.case.model.speed_range;
        let (model, poles) = self.with_poles()?;
        // Onsets far above the lowest cannot matter near this design.
        let stability = Stability::new(model, poles, range, NEARBY);
        let stability = stability.map_err(|_| Failure::Eigenvalues)?;
        if stability.divergence.is_some() {
            return Err(Failure::Diverging);
        }
        if stability.unstable_at_start || stability.onsets.is_empty() {
            let bound = stability.critical_speed().unwrap_or(range[1]);
            return Ok(vec![Piece::single(0, bound)]);
        }
        let lowest = stability.onsets[0].speed;
        let near = stability
            .onsets
            .iter()
            .filter(|onset| onset.speed < NEARBY * lowest);
        Ok(near
            .map(|onset| Piece {
                value: onset.speed,
                index: 1,
                label: onset.frequency.ln(),
            })
            .collect())
    }

    fn limits(&mut self) -> Result<&CurvingLimits, Failure> {
        if self.limits.is_none() {
            let limits = CurvingLimits::new(self.case, 0.0).map_err(|_| Failure::NoCurve)?;
            self.limits = Some(limits);
        }
        self.limits.as_ref().ok_or(Failure::NoCurve)
    }

    /// The curve of the service, or the tightest run without flange contact or slip.
    fn curve(&mut self) -> Result<&CurvingState, Failure> {
        if self.curve.is_none() {
            let service = &self.case.service;
            let (given, cant_deficiency) = (service.curve, service.cant_deficiency);
            let degree = match given {
                Some(angle) => angle.to_degrees(),
                None => self.limits()?.degree(),
            };
            let state = CurvingState::new(self.case, degree, cant_deficiency)
                .map_err(|_| Failure::NoCurve)?;
            self.curve = Some(state);
        }
        self.curve.as_ref().ok_or(Failure::NoCurve)
    }

    fn curving(&mut self, index: Index) -> Result<Vec<Piece>, Failure> {
        let wheels = |state: &CurvingState, of: &dyn Fn(usize, usize) -> f64| -> Vec<f64> {
            (0..state.wheels.len())
                .flat_map(|i| [of(i, 0), of(i, 1)])
                .collect()
        };
        let values: Vec<f64> = match index {
            Index::DegreeCurve | Index::FlangeLimitedCurve | Index::SlipLimitedCurve => {
                let limits = self.limits()?;
                let of_index = |limit: &Limit| match limit {
                    Limit::Flange(_) => index != Index::SlipLimitedCurve,
                    Limit::Slip(..) => index != Index::FlangeLimitedCurve,
                };
                let pieces = Limit::ALL.iter().zip(limits.pieces).enumerate();
                return Ok(pieces
                    .filter(|(_, (limit, _))| of_index(limit))
                    .map(|(i, (_, degree))| {
                        let degree = degree.unwrap_or(MAX_DEGREE).max(1e-9);
                        Piece::single(i, degree.to_radians())
                    })
                    .collect());
            }
            Index::WheelLOverV => {
                let state = self.curve()?;
                wheels(state, &|i, side| {
                    state.wheels[i][side].lateral_to_vertical()
                })
            }
            Index::AdhesionUsed => {
                let state = self.curve()?;
                wheels(state, &|i, side| state.wheels[i][side].adhesion_used)
            }
            Index::TruckSideLOverV => self.curve()?.truck_sides().map(f64::abs).to_vec(),
            _ => {
                let state = self.curve()?;
                (0..4).map(|i| state.net_axle(i)).collect()
            }
        };
        Ok(pieces(&values))
    }

    fn lateral_ride(&mut self, index: Index) -> Result<Vec<Piece>, Failure> {
        let case = self.case;
        let failed = |reason| no_ride(reason, Failure::Unstable);
        if index == Index::LateralIsoRatio {
            let (model, poles) = self.with_poles()?;
            let passengers = PassengerRide::lateral(model, case, poles);
            return passengers.map(|p| iso_ratios(&p)).map_err(failed);
        }
        if self.lateral_ride.is_none() {
            let (model, poles) = self.with_poles()?;
            let ride = LateralRide::from_poles(model, case, poles);
            self.lateral_ride = Some(ride.map_err(failed)?);
        }
        let ride = self.lateral_ride.as_ref().ok_or(Failure::Integration)?;
        Ok(match index {
            Index::LateralAcceleration => pieces(&[ride.average_acceleration()]),
            Index::SecondaryLateralStroke => peaks(&ride.secondary_stroke),
            Index::PrimaryLateralStroke => peaks(&ride.primary_stroke),
            Index::PrimaryLongitudinalStroke => peaks(&ride.longitudinal_stroke),
            _ => peaks(&ride.excursion),
        })
    }

    fn vertical_ride(&mut self, index: Index) -> Result<Vec<Piece>, Failure> {
        let case = self.case;
        let failed = |reason| no_ride(reason, Failure::Diverging);
        if index == Index::VerticalIsoRatio {
            let (model, poles) = self.vertical()?;
            let passengers = PassengerRide::vertical(model, case, poles);
            return passengers.map(|p| iso_ratios(&p)).map_err(failed);
        }
        if self.vertical_ride.is_none() {
            let (model, poles) = self.vertical()?;
            let ride = VerticalRide::from_poles(model, case, poles);
            self.vertical_ride = Some(ride.map_err(failed)?);
        }
        let ride = self.vertical_ride.as_ref().ok_or(Failure::Integration)?;
        Ok(match index {
            Index::VerticalAcceleration => pieces(&[ride.average_acceleration()]),
            Index::SecondaryVerticalStroke => peaks(&ride.secondary_stroke),
            Index::PrimaryVerticalStroke => peaks(&ride.primary_stroke),
            _ => {
                let load = case.vehicle.wheel_load();
                peaks(&ride.wheel_load.map(|rms| rms / load))
            }
        })
    }

    fn statics(&mut self, index: Index) -> Result<Vec<Piece>, Failure> {
        let vehicle = &self.case.vehicle;
        let suspension = &vehicle.suspension;
        let (carbody, frame) = (vehicle.carbody.mass, vehicle.truck.mass);
        match index {
            Index::FrequencySeparation => {
                let ratios = separations(vehicle);
                let ratios = ratios.iter().enumerate();
                Ok(ratios
                    .filter_map(|(i, (_, ratio))| Some(Piece::single(i, (*ratio)?)))
                    .collect())
            }
            Index::FlexibleModeSeparation => {
                let (model, poles) = self.vertical()?;
                let modes = vertical_modes(model, poles).map_err(|_| Failure::Eigenvalues)?;
                let separations = flexible_separations(&modes);
                if separations.is_empty() {
                    return Err(Failure::NoMode);
                }
                Ok(separations
                    .iter()
                    .map(|s| Piece {
                        value: s.ratio,
                        index: 0,
                        label: s.flexible.ln() + s.truck.ln(),
                    })
                    .collect())
            }
            Index::SecondaryStaticDeflection => {
                Ok(pieces(&[vehicle.secondary_static_deflection()]))
            }
            _ => {
                let k = 8.0 * suspension.primary.vertical_stiffness;
                Ok(pieces(&[(carbody + 2.0 * frame) * GRAVITY / k]))
            }
        }
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

fn pieces(values: &[f64]) -> Vec<Piece> {
    let values = values.iter().enumerate();
    values.map(|(i, v)| Piece::single(i, *v)).collect()
}

fn peaks(rms: &[f64]) -> Vec<Piece> {
    let rms = rms.iter().enumerate();
    rms.map(|(i, v)| Piece::single(i, PEAK * v)).collect()
}

/// Bands kept apart by point.
const BANDS: usize = 64;

fn iso_ratios(passengers: &[PassengerRide; 3]) -> Vec<Piece> {
    let mut ratios = Vec::new();
    for (point, passenger) in passengers.iter().enumerate() {
        for (band, ride) in passenger.bands.iter().enumerate() {
            if let Some(boundary) = ride.boundary {
                let piece = Piece::single(BANDS * point + band, ride.acceleration / boundary);
                ratios.push(piece);
            }
        }
    }
    ratios
}

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
