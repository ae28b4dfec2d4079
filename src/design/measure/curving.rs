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
    constants: Option<&'a Constants<'a>>,
    limits: Option<(CurvingModel, CurvingLimits)>,
    curve: Option<Curve>,
}

impl<'a> Curves<'a> {
    pub fn new(case: &'a Case, constants: Option<&'a Constants<'a>>) -> Self {
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

/// Forces that an index is made of, each a weighted sum over the wheels, [outer, inner] of wheelsets
/// 1–4.
type Weights = [[f64; 2]; 4];

impl Curve {
    fn pieces(&self, index: Index) -> Vec<Piece> {
        if index == Index::AdhesionUsed {
            let wheels = self.state.wheels.iter().flatten();
            let values: Vec<f64> = wheels.map(|wheel| wheel.adhesion_used).collect();
            let change = |by: &[[WheelChange; 2]; 4]| -> Vec<f64> {
                by.iter()
                    .flatten()
                    .map(|wheel| wheel.adhesion_used)
                    .collect()
            };
            let gradients: Option<Vec<Vec<f64>>> = self
                .wheels
                .as_ref()
                .map(|all| all.iter().map(change).collect());
            return pieces(&values, gradients.as_deref());
        }
        let ratios: Vec<(f64, Weights)> = wheels_of(index)
            .iter()
            .map(|wheels| self.ratio(wheels))
            .collect();
        let values: Vec<f64> = ratios.iter().map(|(ratio, _)| ratio.abs()).collect();
        let change = |by: &[[WheelChange; 2]; 4]| -> Vec<f64> {
            let of = |(ratio, weights): &(f64, Weights)| {
                let terms = (0..4).flat_map(|i| [(i, 0), (i, 1)]);
                let sum: f64 = terms.map(|(i, k)| weights[i][k] * by[i][k].lateral).sum();
                sum * ratio.signum()
            };
            ratios.iter().map(of).collect()
        };
        let gradients: Option<Vec<Vec<f64>>> = self
            .wheels
            .as_ref()
            .map(|all| all.iter().map(change).collect());
        pieces(&values, gradients.as_deref())
    }

    /// ΣL/ΣV over some wheels, and the weight in it of the lateral force on each. The loads do not
    /// depend on the suspension.
    fn ratio(&self, wheels: &[(usize, usize)]) -> (f64, Weights) {
        let forces = wheels.iter().map(|&(i, k)| &self.state.wheels[i][k]);
        let vertical: f64 = forces.clone().map(|wheel| wheel.vertical).sum();
        let lateral: f64 = forces.map(|wheel| wheel.lateral).sum();
        let mut weights = [[0.0; 2]; 4];
        for &(i, k) in wheels {
            weights[i][k] = 1.0 / vertical;
        }
        (lateral / vertical, weights)
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
