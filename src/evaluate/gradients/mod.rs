//! Exact derivatives of the performance indices by the numbers of a case.
//!
//! | index | derivative |
//! |---|---|
//! | RMS values | the response's own, frequency by frequency: D ∂q = −∂D q − ∂(iωC_u + K_u) u ([`ForcedTangent`]) |
//! | eigenvalues, damping ratios | ∂s = −wᴴ(∂K + s ∂C + s² ∂M)v / wᴴD′v ([`modes`]) |
//! | critical speed | ∂V = −Re ∂s / Re ∂s/∂V, on which Re s stays zero ([`modes`]) |
//! | curves, forces in them | of the equilibrium and of the limit that is met ([`curving`]) |
//!
//! The derivatives of the matrices come from models built with other constants; nothing is solved
//! twice but with the factors that are there.

pub mod curving;
pub mod modes;
mod stencil;

use crate::{
    case::Case,
    dynamics::{ForcedModel, ForcedTangent, LateralModel, VerticalModel},
    parameter::Parameter,
};
use stencil::Stencil;

/// Slope in the middle of the polynomial through five values, from those at −2, −1, 1 and 2 steps.
pub fn five_point([a, b, c, d]: [f64; 4], step: f64) -> f64 {
    ((a - d) + 8.0 * (c - b)) / (12.0 * step)
}

/// Steps of the derivative of the polynomial through five values, and their weights.
fn five_point_weights(step: f64) -> [(f64, f64); 4] {
    [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)].map(|(k, w)| (k, w / (12.0 * step)))
}

/// Constants by which indices are differentiated, at a case.
#[derive(Debug, Clone)]
pub struct Constants {
    stencils: Vec<(Parameter, Stencil)>,
}

impl Constants {
    /// Some of [`Parameter::plain`].
    pub fn new(case: &Case, constants: &[Parameter]) -> Self {
        let stencil = |constant: &Parameter| (*constant, Stencil::new(case, *constant));
        Self {
            stencils: constants.iter().map(stencil).collect(),
        }
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.stencils.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.stencils.is_empty()
    }

    /// Which.
    pub fn parameters(&self) -> impl Iterator<Item = Parameter> + '_ {
        self.stencils.iter().map(|(constant, _)| *constant)
    }

    /// Derivatives, by each constant, of a value that depends on it as the models' matrices do
    /// ([`crate::parameter::Dependence`]).
    pub fn slopes(&self, own: f64, of: impl Fn(&Case) -> f64) -> Vec<f64> {
        let slope = |(_, stencil): &(Parameter, Stencil)| {
            let others = stencil.others(&of);
            let same = others
                .iter()
                .all(|(_, other)| other.to_bits() == own.to_bits());
            if same {
                return 0.0;
            }
            let others: f64 = others.iter().map(|(weight, other)| weight * other).sum();
            stencil.own() * own + others
        };
        self.stencils.iter().map(slope).collect()
    }

    /// Derivatives of the lateral model; `None` if it has other coordinates with another value of a constant,
    /// as where a damper in series with a spring is zero.
    pub fn lateral(&self, model: &LateralModel) -> Option<Vec<ForcedTangent>> {
        self.of(&model.forced, |case| LateralModel::new(case).forced)
    }

    /// Derivatives of the vertical model; `None` as with the lateral one.
    pub fn vertical(&self, model: &VerticalModel) -> Option<Vec<ForcedTangent>> {
        self.of(&model.forced, |case| VerticalModel::new(case).forced)
    }

    fn of(
        &self,
        own: &ForcedModel,
        model: impl Fn(&Case) -> ForcedModel,
    ) -> Option<Vec<ForcedTangent>> {
        let tangent = |(_, stencil): &(Parameter, Stencil)| {
            let others = stencil.others(&model);
            let mut models = vec![(stencil.own(), own)];
            models.extend(others.iter().map(|(weight, model)| (*weight, model)));
            ForcedTangent::of(&models)
        };
        self.stencils.iter().map(tangent).collect()
    }
}
