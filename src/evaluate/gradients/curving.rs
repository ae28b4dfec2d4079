//! Derivatives of the limits of curving and of the forces in a curve.

use nalgebra::DVector;

use super::Constants;
use crate::{
    dynamics::{
        curving::{CurvingModel, Place, Side},
        element::Name,
        suspension::SECONDARY_LATERAL,
    },
    evaluate::curving::Limit,
    track::{curvature_of_degree, curvature_per_degree},
};

/// The equations of a curving model, and their derivatives by some constants.
pub struct CurvingTangents<'a> {
    model: &'a CurvingModel,
    /// Weight of the model and of other models, for each constant.
    others: Vec<(f64, Vec<(f64, CurvingModel)>)>,
}

/// Change of the forces on a wheel, N, and of the share of μN that it uses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WheelChange {
    /// Of the lateral force.
    pub lateral: f64,
    /// Of the vertical load.
    pub vertical: f64,
    /// Of the creep force over μN.
    pub adhesion_used: f64,
}

/// Change of the vehicle in a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveChange {
    /// Of y_w, wheelsets 1–4, m.
    pub wheelset_lateral: [f64; 4],
    /// Of the secondary lateral strokes, trucks 1, 2, m.
    pub secondary_lateral_stroke: [f64; 2],
    /// Of the forces on the wheels, [outer, inner] of wheelsets 1–4.
    pub wheels: [[WheelChange; 2]; 4],
}

impl<'a> CurvingTangents<'a> {
    /// Of a model of the constants' case at a cant deficiency, rad.
    pub fn new(model: &'a CurvingModel, constants: &Constants, cant_deficiency: f64) -> Self {
        let unsolved = |case: &_| CurvingModel::unsolved(case, cant_deficiency);
        let stencils = constants.stencils.iter();
        Self {
            model,
            others: stencils
                .map(|(_, stencil)| (stencil.own(), stencil.others(unsolved)))
                .collect(),
        }
    }

    /// Derivatives of the coordinates at a curvature, 1/m, by each constant. `None` if the equations
    /// are singular.
    fn coordinates(&self, curvature: f64) -> Option<Vec<DVector<f64>>> {
        let segment = self.model.segment_at(curvature);
        let state = segment.breakaway;
        let x = segment.displacements(curvature);
        // Load less stiffness times place: zero in equilibrium.
        let unbalance = |model: &CurvingModel| {
            let [load, slope] = model.loads_in(state);
            load + slope * curvature - model.stiffness_in(state) * &x
        };
        let lu = self.model.stiffness_in(state).lu();
        let own = unbalance(self.model);
        let solve = |(weight, others): &(f64, Vec<(f64, CurvingModel)>)| {
            let mut force = &own * *weight;
            for (weight, other) in others {
                force += unbalance(other) * *weight;
            }
            lu.solve(&force)
        };
        self.others.iter().map(solve).collect()
    }

    /// Sum over the models of one constant of what is made of each, at the place where it is.
    fn explicit<const N: usize>(
        &self,
        p: usize,
        of: impl Fn(&CurvingModel) -> [f64; N],
    ) -> [f64; N] {
        let (own, others) = &self.others[p];
        let mut sum = of(self.model).map(|value| own * value);
        for (weight, other) in others {
            for (sum, value) in sum.iter_mut().zip(of(other)) {
                *sum += weight * value;
            }
        }
        sum
    }

    /// Derivatives by each constant of the curve at which a limit is met, degrees. `None` if the
    /// equations are singular.
    /// `clearances` has those of the flange clearance, m.
    pub fn limit(&self, limit: Limit, degree: f64, clearances: &[f64]) -> Option<Vec<f64>> {
        let curvature = curvature_of_degree(degree);
        let segment = self.model.segment_at(curvature);
        let x = segment.displacements(curvature);
        let coordinates = self.coordinates(curvature)?;
        // |f| stays at its bound c: f·(∂f + ∂κ f′) = |f| ∂c.
        let along = |change: [f64; 2], slope: [f64; 2], f: [f64; 2], bound: f64| {
            let dot = |a: [f64; 2]| f[0] * a[0] + f[1] * a[1];
            (f[0].hypot(f[1]) * bound - dot(change)) / dot(slope) / curvature_per_degree(degree)
        };
        let changes = coordinates.iter().enumerate().map(|(p, dx)| match limit {
            Limit::Flange(i) => {
                let of = |x: &DVector<f64>| [self.model.place(x, i).y, 0.0];
                along(of(dx), of(&segment.per_curvature), of(&x), clearances[p])
            }
            Limit::Slip(i, side) => {
                let place = |x| self.model.place(x, i);
                let at = place(&x);
                let creep = |model: &CurvingModel| model.creep(i, at, curvature, 1.0, side);
                let slope = place(&segment.per_curvature);
                let slope = self.model.creep(i, slope, 1.0, 0.0, side);
                let moved = self.model.creep(i, place(dx), 0.0, 0.0, side);
                let own = self.explicit(p, creep);
                let [bound] = self.explicit(p, |model| [model.adhesion_limit(i, side)]);
                along(
                    [moved[0] + own[0], moved[1] + own[1]],
                    slope,
                    creep(self.model),
                    bound,
                )
            }
        });
        Some(changes.collect())
    }

    /// Derivatives by each constant of the vehicle in a curve that itself changes by `degrees`. `None`
    /// if the equations are singular.
    pub fn state(&self, degree: f64, degrees: &[f64]) -> Option<Vec<CurveChange>> {
        let curvature = curvature_of_degree(degree);
        let segment = self.model.segment_at(curvature);
        let x = segment.displacements(curvature);
        let coordinates = self.coordinates(curvature)?;
        let all = coordinates.iter().zip(degrees).enumerate();
        let changes = all.map(|(p, (dx, degrees))| {
            let further = curvature_per_degree(degree) * degrees;
            let dx = dx + &segment.per_curvature * further;
            CurveChange {
                wheelset_lateral: std::array::from_fn(|i| self.model.place(&dx, i).y),
                secondary_lateral_stroke: std::array::from_fn(|j| {
                    let name = Name::of_truck(SECONDARY_LATERAL, j);
                    let [own] = self.explicit(p, |model| [model.stretch(name, &x, curvature)]);
                    self.model.stretch(name, &dx, further) + own
                }),
                wheels: std::array::from_fn(|i| {
                    Side::BOTH.map(|side| {
                        let [place, moved] = [&x, &dx].map(|x| self.model.place(x, i));
                        self.wheel(p, (i, side), curvature, place, (moved, further))
                    })
                }),
            }
        });
        Some(changes.collect())
    }

    /// Change of the forces on a wheel by constant `p`, its wheelset at a place in a curvature, 1/m,
    /// both of which change.
    fn wheel(
        &self,
        p: usize,
        (i, side): (usize, Side),
        curvature: f64,
        place: Place,
        (moved, further): (Place, f64),
    ) -> WheelChange {
        let forces = |model: &CurvingModel| {
            let [f_x, f_y] = model.creep(i, place, curvature, 1.0, side);
            [f_x, f_y, model.normal(i, place, 1.0, side)]
        };
        let [f_x, f_y, _] = forces(self.model);
        let [own_x, own_y, own_normal] = self.explicit(p, forces);
        let [d_x, d_y] = self.model.creep(i, moved, further, 0.0, side);
        let (d_x, d_y) = (d_x + own_x, d_y + own_y);
        let normal = self.model.normal(i, moved, 0.0, side) + own_normal;
        let along = (f_x * d_x + f_y * d_y) / f_x.hypot(f_y).max(f64::MIN_POSITIVE);
        let limits =
            |model: &CurvingModel| [model.vertical(i, side), model.adhesion_limit(i, side)];
        let ([_, limit], [vertical, more]) = (limits(self.model), self.explicit(p, limits));
        WheelChange {
            lateral: d_y + normal,
            vertical,
            adhesion_used: (along - f_x.hypot(f_y) / limit * more) / limit,
        }
    }
}
