//! Indices from closed forms and from the modes of the vertical model.

use super::{Measured, Vertical, pieces};
use crate::{
    case::Case,
    dynamics::VerticalModel,
    evaluate::{
        checks::separations,
        gradients::five_point,
        modes::{Separation, flexible_separations, vertical_modes},
    },
    index::Index,
    numerics::Poles,
    optimize::{
        follow,
        problem::{Failure, Piece},
    },
    parameter::Parameter,
    vehicle::GRAVITY,
};

/// Step of a constant, relative, in the derivative of the polynomial through five values: it leaves
/// 1e-11 of a closed form's, whose fifth derivative and rounding are of order one and 1e-16.
const STEP: f64 = 1e-3;

impl Vertical<'_> {
    pub(super) fn statics(&mut self, index: Index) -> Measured {
        let mut found = if index == Index::FlexibleModeSeparation {
            let (model, poles, _) = self.model()?;
            flexible_modes(model, poles)?
        } else {
            closed_form(index, self.case)
        };
        let Some(constants) = self.constants else {
            return Ok(found);
        };
        let of_model = index == Index::FlexibleModeSeparation;
        let moves: Vec<bool> = match self.model {
            Some((_, _, ref tangents)) if of_model => tangents
                .iter()
                .map(|t| !t.system.entries.is_empty())
                .collect(),
            _ => vec![true; constants.len()],
        };
        let by: Vec<Option<Vec<f64>>> = constants
            .parameters()
            .zip(moves)
            .map(|(constant, moves)| {
                if moves {
                    derivative(index, self.case, &found, constant)
                } else {
                    Some(vec![0.0; found.len()])
                }
            })
            .collect();
        for (k, piece) in found.iter_mut().enumerate() {
            piece.gradient = by.iter().map(|slopes| Some(slopes.as_ref()?[k])).collect();
        }
        Ok(found)
    }
}

fn closed_form(index: Index, case: &Case) -> Vec<Piece> {
    let vehicle = &case.vehicle;
    match index {
        Index::FrequencySeparation => {
            let ratios = separations(vehicle);
            let ratios = ratios.iter().enumerate();
            ratios
                .filter_map(|(i, (_, ratio))| Some(Piece::single(i, (*ratio)?)))
                .collect()
        }
        Index::SecondaryStaticDeflection => pieces(&[vehicle.secondary_static_deflection()], None),
        _ => {
            let k = 8.0 * vehicle.suspension.primary.vertical_stiffness;
            let weight = (vehicle.carbody.mass + 2.0 * vehicle.truck.mass) * GRAVITY;
            pieces(&[weight / k], None)
        }
    }
}

fn flexible_modes(model: &VerticalModel, poles: &Poles) -> Result<Vec<Piece>, Failure> {
    let modes = vertical_modes(model, poles).map_err(|_| Failure::Eigenvalues)?;
    let separations = flexible_separations(&modes);
    if separations.is_empty() {
        return Err(Failure::NoMode);
    }
    let piece = |s: &Separation| Piece {
        label: s.flexible.ln() + s.truck.ln(),
        ..Piece::single(0, s.ratio)
    };
    Ok(separations.iter().map(piece).collect())
}

/// Derivatives of pieces found by a constant. `None` where they cannot be followed.
fn derivative(index: Index, case: &Case, found: &[Piece], constant: Parameter) -> Option<Vec<f64>> {
    let value = constant.get(case);
    let step = STEP * if value == 0.0 { 1.0 } else { value };
    let at = |k: f64| {
        let mut case = case.clone();
        constant.set(&mut case, value + k * step);
        if index != Index::FlexibleModeSeparation {
            return Some(closed_form(index, &case));
        }
        let model = VerticalModel::new(&case);
        let poles = Poles::at(&model.forced, case.service.speed).ok()?;
        flexible_modes(&model, &poles).ok()
    };
    let around = [at(-2.0)?, at(-1.0)?, at(1.0)?, at(2.0)?];
    let slope = |k: usize| {
        let [a, b, c, d] = around.each_ref().map(|pieces| follow(found, k, pieces));
        Some(five_point([a?, b?, c?, d?], step))
    };
    (0..found.len()).map(slope).collect()
}
