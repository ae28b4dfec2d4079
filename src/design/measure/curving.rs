//! Limits of curving, and forces in a curve.

use super::{Measured, pieces};
use crate::{
    case::Case,
    dynamics::curving::{CurvingError, CurvingModel},
    evaluate::{
        curving::{CurveStatus, CurvingLimits, CurvingState, Limit, ServiceCurve, level_curves},
        gradients::{
            Constants,
            curving::{CurveChange, CurvingTangents, WheelChange},
        },
    },
    index::Index,
    optimize::problem::{Failure, Piece},
    track::MAX_DEGREE,
};

/// The vehicle in the curve of the service, or the tightest that it runs without flange contact or
/// slip. Where the model does not cover it, its extrapolation: smooth, as a search needs it.
pub(super) struct Curve {
    state: CurvingState,
    /// Its change by each constant.
    changes: Option<Vec<CurveChange>>,
    /// Flange clearance, m, and its change by each constant.
    clearance: f64,
    clearances: Vec<f64>,
}

/// Change of the flange clearance by each constant.
fn clearances(case: &Case, constants: &Constants) -> Vec<f64> {
    let of = |case: &Case| case.wheel_rail.flange_clearance;
    constants.slopes(of(case), of)
}

/// The curving models of a case, built when first asked for.
pub(super) struct Curves<'a> {
    case: &'a Case,
    constants: Option<&'a Constants>,
    limits: Option<(CurvingModel, CurvingLimits)>,
    curve: Option<Curve>,
}

fn no_curve(error: CurvingError) -> Failure {
    match error {
        CurvingError::WheelLifted(_) => Failure::WheelLifted,
        CurvingError::Singular | CurvingError::NoConsistentState => Failure::NoCurve,
    }
}

/// Why a verdict on forces and strokes in the service curve of a case cannot be had; `None` if it can.
pub(super) fn not_covered(case: &Case) -> Option<Failure> {
    match ServiceCurve::of(case).map(|curve| curve.status) {
        Ok(CurveStatus::WithinModel) => None,
        Ok(CurveStatus::OutsideModel { .. }) => Some(Failure::OutsideModel),
        Ok(CurveStatus::WheelLifted(_)) => Some(Failure::WheelLifted),
        Err(error) => Some(no_curve(error)),
    }
}

impl<'a> Curves<'a> {
    pub fn new(case: &'a Case, constants: Option<&'a Constants>) -> Self {
        Self {
            case,
            constants,
            limits: None,
            curve: None,
        }
    }

    fn limits(&mut self) -> Result<&(CurvingModel, CurvingLimits), Failure> {
        if self.limits.is_none() {
            self.limits = Some(level_curves(self.case).map_err(no_curve)?);
        }
        self.limits.as_ref().ok_or(Failure::NoCurve)
    }

    /// Derivatives of the curves at which limits are met, degrees; none for a limit that is not met.
    fn limit_gradients(&mut self, limits: &[(Limit, Option<f64>)]) -> Option<Vec<Vec<f64>>> {
        self.limits().ok()?;
        let (constants, (model, _)) = (self.constants?, self.limits.as_ref()?);
        let tangents = CurvingTangents::new(model, constants, 0.0);
        let clearances = clearances(self.case, constants);
        let of = |(limit, degree): &(Limit, Option<f64>)| match degree.filter(|d| *d > 0.0) {
            Some(degree) => tangents.limit(*limit, degree, &clearances),
            None => Some(vec![0.0; constants.len()]),
        };
        limits.iter().map(of).collect()
    }

    fn curve(&mut self) -> Result<&Curve, Failure> {
        if self.curve.is_none() {
            let (degree, degrees) = if let Some(angle) = self.case.service.curve {
                let zero = self.constants.map(|constants| vec![0.0; constants.len()]);
                (angle.to_degrees(), zero)
            } else {
                let governing = self.limits()?.1.governing();
                let met = governing.map(|limited| (limited.limit, Some(limited.degree)));
                let met = met.unwrap_or((Limit::Flange(0), None));
                let gradients = self.limit_gradients(&[met]);
                let degree = met.1.unwrap_or(MAX_DEGREE);
                (degree, gradients.and_then(|mut list| list.pop()))
            };
            let curve = Curve::new(self.case, degree, self.constants.zip(degrees))?;
            self.curve = Some(curve);
        }
        self.curve.as_ref().ok_or(Failure::NoCurve)
    }

    pub fn measure(&mut self, index: Index) -> Measured {
        match index {
            Index::DegreeCurve | Index::FlangeLimitedCurve | Index::SlipLimitedCurve => {
                self.limited_curves(index)
            }
            _ => Ok(self.curve()?.pieces(index)),
        }
    }

    fn limited_curves(&mut self, index: Index) -> Measured {
        let of_index = |limit: &Limit| match limit {
            Limit::Flange(_) => index != Index::SlipLimitedCurve,
            Limit::Slip(..) => index != Index::FlangeLimitedCurve,
        };
        let degrees = self.limits()?.1.pieces;
        let met: Vec<(usize, (Limit, Option<f64>))> = Limit::ALL
            .into_iter()
            .zip(degrees)
            .enumerate()
            .filter(|(_, (limit, _))| of_index(limit))
            .collect();
        let limits: Vec<(Limit, Option<f64>)> = met.iter().map(|(_, limit)| *limit).collect();
        let gradients = self.limit_gradients(&limits);
        let pieces = met.iter().enumerate().map(|(k, (i, (_, degree)))| {
            let degree = degree.unwrap_or(MAX_DEGREE).max(1e-9);
            let gradient = gradients.as_ref().map(|all| &all[k]);
            Piece {
                gradient: gradient.map(|slopes| slopes.iter().map(|s| s.to_radians()).collect()),
                ..Piece::single(*i, degree.to_radians())
            }
        });
        Ok(pieces.collect())
    }
}

impl Curve {
    /// A case in a curve of `degree` degrees; with the constants by which it is differentiated, and
    /// the derivatives of the curve itself by these.
    ///
    /// # Errors
    ///
    /// [`Failure`] if there is no steady-state solution.
    pub(super) fn new(
        case: &Case,
        degree: f64,
        by: Option<(&Constants, Vec<f64>)>,
    ) -> Result<Self, Failure> {
        let cant_deficiency = case.service.cant_deficiency();
        let model = CurvingModel::new(case, cant_deficiency).map_err(no_curve)?;
        let clearance = case.wheel_rail.flange_clearance;
        let clearances = by
            .as_ref()
            .map_or_else(Vec::new, |(constants, _)| clearances(case, constants));
        let changes = by.and_then(|(constants, degrees)| {
            CurvingTangents::new(&model, constants, cant_deficiency).state(degree, &degrees)
        });
        Ok(Self {
            state: CurvingState::of(&model, clearance, degree, cant_deficiency),
            changes,
            clearance,
            clearances,
        })
    }

    /// Quasi-static secondary lateral stroke of truck `j`, m.
    pub(super) fn secondary_stroke(&self, j: usize) -> f64 {
        self.state.secondary_lateral_stroke[j]
    }

    /// Its derivatives by each constant, where these can be had.
    pub(super) fn secondary_stroke_changes(&self, j: usize) -> Option<Vec<f64>> {
        let of = |change: &CurveChange| change.secondary_lateral_stroke[j];
        Some(self.changes.as_ref()?.iter().map(of).collect())
    }

    fn pieces(&self, index: Index) -> Vec<Piece> {
        let state = &self.state;
        match index {
            Index::CurveLimitRatio => {
                return self.graded(&state.limit_ratios, |p, by| {
                    let change = |limit| match limit {
                        Limit::Flange(i) => {
                            let y = state.wheelset_lateral[i];
                            let narrower = y.abs() / self.clearance * self.clearances[p];
                            (y.signum() * by.wheelset_lateral[i] - narrower) / self.clearance
                        }
                        Limit::Slip(i, side) => by.wheels[i][side as usize].adhesion_used,
                    };
                    Limit::ALL.map(change).to_vec()
                });
            }
            Index::AdhesionUsed => {
                let wheels = state.wheels.iter().flatten();
                let values: Vec<f64> = wheels.map(|wheel| wheel.adhesion_used).collect();
                return self.graded(&values, |_, by| {
                    let wheels = by.wheels.iter().flatten();
                    wheels.map(|wheel| wheel.adhesion_used).collect()
                });
            }
            _ => {}
        }
        let wheels = wheels_of(index);
        let sums: Vec<[f64; 2]> = wheels.iter().map(|w| state.sums(w)).collect();
        let ratios = sums
            .iter()
            .map(|[lateral, vertical]| lateral.abs() / vertical);
        self.graded(&ratios.collect::<Vec<f64>>(), |_, by| {
            let pairs = wheels.iter().zip(&sums);
            let change = |(wheels, [lateral, vertical]): (&Vec<(usize, usize)>, &[f64; 2])| {
                let of = |change: fn(&WheelChange) -> f64| -> f64 {
                    let wheels = wheels.iter();
                    wheels.map(|&(i, side)| change(&by.wheels[i][side])).sum()
                };
                let heavier = lateral.abs() / vertical * of(|wheel| wheel.vertical);
                (of(|wheel| wheel.lateral) * lateral.signum() - heavier) / vertical
            };
            pairs.map(change).collect()
        })
    }

    /// Pieces of values, with their derivatives by the change of the vehicle in the curve with each
    /// constant, whose number comes first.
    fn graded(
        &self,
        values: &[f64],
        change: impl Fn(usize, &CurveChange) -> Vec<f64>,
    ) -> Vec<Piece> {
        let changes = self.changes.as_ref().map(|all| all.iter().enumerate());
        let by: Option<Vec<Vec<f64>>> =
            changes.map(|all| all.map(|(p, by)| change(p, by)).collect());
        pieces(values, by.as_deref())
    }
}

/// Wheels (wheelset, side) over which the pieces of an index sum: each wheel alone, the wheels on one side
/// of a truck, or the two of an axle.
fn wheels_of(index: Index) -> Vec<Vec<(usize, usize)>> {
    match index {
        Index::WheelLOverV => (0..8).map(|n| vec![(n / 2, n % 2)]).collect(),
        Index::TruckSideLOverV => (0..4)
            .map(|n| vec![(n / 2 * 2, n % 2), (n / 2 * 2 + 1, n % 2)])
            .collect(),
        _ => (0..4).map(|i| vec![(i, 0), (i, 1)]).collect(),
    }
}
