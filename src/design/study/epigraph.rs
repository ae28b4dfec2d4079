//! The critical speed as an epigraph variable of a study.

use super::Study;
use crate::{
    design::measure::{Wanted, measure},
    index::Index,
    optimize::problem::{Failure, Scale, Variable},
    units::Quantity,
};

impl Study {
    /// The same study with the critical speed as an epigraph variable.
    ///
    /// ```math
    /// maximise V_cr(x)   ⟺   maximise v   subject to   ζ(x, V) ≥ 0 for all V ≤ v
    /// ```
    ///
    /// The critical speed jumps where an instability is born within the range; the damping over
    /// the range does not. `None` if the critical speed is no objective.
    pub fn with_epigraph(&self) -> Option<Self> {
        self.terms.iter().find(|t| t.is_speed_objective())?;
        let mut study = self.clone();
        study.has_epigraph = true;
        study.variables.push(Variable {
            name: "critical speed",
            symbol: "V_cr",
            quantity: Quantity::Speed,
            bounds: self.base.model.speed_range,
            scale: Scale::Logarithmic,
        });
        Some(study)
    }

    /// Whether the index of a term is the epigraph speed.
    pub fn is_epigraph_term(&self, term: usize) -> bool {
        self.has_epigraph && self.terms[term].is_speed_objective()
    }

    /// The study without the epigraph variable of [`Study::with_epigraph`].
    #[must_use]
    pub fn without_epigraph(&self) -> Self {
        let mut study = self.clone();
        study.has_epigraph = false;
        study.variables.truncate(study.parameters.len());
        study
    }

    /// Scaled coordinates of the epigraph study for a design of this one: a critical speed a little
    /// below what it has.
    ///
    /// # Errors
    ///
    /// [`Failure`] as of any measurement.
    pub fn epigraph_start(&self, x: &[f64]) -> Result<Vec<f64>, Failure> {
        const BELOW: f64 = 1.0 - 1e-4;
        let case = self.design(x);
        let mut least = self.base.model.speed_range[1];
        for term in self.terms.iter().filter(|t| t.is_speed_objective()) {
            let case = self.in_condition(&case, term.condition);
            let pieces = measure(&case, &[Wanted::Index(Index::CriticalSpeed)])?.remove(0);
            least = pieces.iter().map(|p| p.value).fold(least, f64::min);
        }
        let [low, high] = self.base.model.speed_range;
        let mut start = x[..self.parameters.len()].to_vec();
        start.push(((BELOW * least / low).ln() / (high / low).ln()).clamp(0.0, 1.0));
        Ok(start)
    }

    /// The epigraph speed at scaled coordinates `x`, m/s.
    pub(super) fn speed(&self, x: &[f64]) -> Option<f64> {
        let at = self.parameters.len();
        self.has_epigraph.then(|| self.variables[at].value(x[at]))
    }
}
