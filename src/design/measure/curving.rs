//! Limits of curving, and forces in a curve.

use super::{Measured, pieces};
use crate::{
    case::Case,
    dynamics::curving::CurvingModel,
    evaluate::{
        curving::{CurvingLimits, CurvingState, Limit},
        gradients::{
            Constants,
            curving::{CurvingTangents, WheelChange},
        },
    },
    index::Index,
    optimize::problem::{Failure, Piece},
    track::MAX_DEGREE,
};

/// The vehicle in the curve of the service, or the tightest that it runs without flange contact or
/// slip.
pub(super) struct Curve {
    state: CurvingState,
    /// Change of the forces on its wheels by each constant.
    wheels: Option<Vec<[[WheelChange; 2]; 4]>>,
}

/// The curving models of a case, built when first asked for.
pub(super) struct Curves<'a> {
    case: &'a Case,
    constants: Option<&'a Constants>,
    limits: Option<(CurvingModel, CurvingLimits)>,
    curve: Option<Curve>,
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
            let model = CurvingModel::new(self.case, 0.0).map_err(|_| Failure::NoCurve)?;
            let limits = CurvingLimits::of(&model, self.case.wheel_rail.flange_clearance, 0.0);
            self.limits = Some((model, limits));
        }
        self.limits.as_ref().ok_or(Failure::NoCurve)
    }

    /// Derivatives of the curves at which limits are met, degrees; none for one that is not met.
    fn limit_gradients(&mut self, limits: &[(Limit, Option<f64>)]) -> Option<Vec<Vec<f64>>> {
        self.limits().ok()?;
        let (constants, (model, _)) = (self.constants?, self.limits.as_ref()?);
        let tangents = CurvingTangents::new(model, constants, 0.0);
        let of = |(limit, degree): &(Limit, Option<f64>)| match degree.filter(|d| *d > 0.0) {
            Some(degree) => tangents.limit(*limit, degree),
            None => Some(vec![0.0; constants.len()]),
        };
        limits.iter().map(of).collect()
    }

    fn curve(&mut self) -> Result<&Curve, Failure> {
        if self.curve.is_none() {
            let service = &self.case.service;
            let (given, cant_deficiency) = (service.curve, service.cant_deficiency);
            let (degree, degrees) = if let Some(angle) = given {
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
            let state = CurvingState::new(self.case, degree, cant_deficiency)
                .map_err(|_| Failure::NoCurve)?;
            let wheels = self
                .constants
                .zip(degrees)
                .and_then(|(constants, degrees)| {
                    let model = CurvingModel::new(self.case, cant_deficiency).ok()?;
                    let tangents = CurvingTangents::new(&model, constants, cant_deficiency);
                    tangents.wheels(degree, &degrees)
                });
            self.curve = Some(Curve { state, wheels });
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
    fn pieces(&self, index: Index) -> Vec<Piece> {
        if index == Index::AdhesionUsed {
            let wheels = self.state.wheels.iter().flatten();
            let values: Vec<f64> = wheels.map(|wheel| wheel.adhesion_used).collect();
            return self.graded(&values, |by| {
                by.iter()
                    .flatten()
                    .map(|wheel| wheel.adhesion_used)
                    .collect()
            });
        }
        let wheels = wheels_of(index);
        let sums: Vec<[f64; 2]> = wheels.iter().map(|w| self.state.sums(w)).collect();
        let ratios = sums
            .iter()
            .map(|[lateral, vertical]| lateral.abs() / vertical);
        self.graded(&ratios.collect::<Vec<f64>>(), |by| {
            let pairs = wheels.iter().zip(&sums);
            // The loads do not depend on the suspension.
            let change = |(wheels, [lateral, vertical]): (&Vec<(usize, usize)>, &[f64; 2])| {
                let sum: f64 = wheels.iter().map(|&(i, side)| by[i][side].lateral).sum();
                sum / vertical * lateral.signum()
            };
            pairs.map(change).collect()
        })
    }

    /// Pieces of values, and of what the change of the wheels' forces by each constant makes of them.
    fn graded(
        &self,
        values: &[f64],
        change: impl Fn(&[[WheelChange; 2]; 4]) -> Vec<f64>,
    ) -> Vec<Piece> {
        let wheels = self.wheels.as_ref();
        let by: Option<Vec<Vec<f64>>> = wheels.map(|all| all.iter().map(change).collect());
        pieces(values, by.as_deref())
    }
}

/// Wheels (wheelset, side) that the pieces of an index sum over: each alone, those on one side of a
/// truck, or those of an axle.
fn wheels_of(index: Index) -> Vec<Vec<(usize, usize)>> {
    match index {
        Index::WheelLOverV => (0..8).map(|n| vec![(n / 2, n % 2)]).collect(),
        Index::TruckSideLOverV => (0..4)
            .map(|n| vec![(n / 2 * 2, n % 2), (n / 2 * 2 + 1, n % 2)])
            .collect(),
        _ => (0..4).map(|i| vec![(i, 0), (i, 1)]).collect(),
    }
}
