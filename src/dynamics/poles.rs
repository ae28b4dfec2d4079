//! Full spectra of a model.

use super::ForcedModel;
use crate::numerics::{EigenError, Poles};

impl Poles {
    /// Eigenvalues of a model without input at `speed`, m/s, by the fast path ([`Poles::fast`]).
    ///
    /// # Errors
    ///
    /// As [`eigenvalues`](crate::numerics::eigenvalues).
    pub fn at(model: &ForcedModel, speed: f64) -> Result<Self, EigenError> {
        Self::fast(&model.system, || model.stiffness(), speed)
    }
}
