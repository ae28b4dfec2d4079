//! Answers that are had at once: the design as it stands.

use super::{Answer, Run};
use crate::{
    design::doubts::warnings,
    dynamics::curving::CurvingError,
    evaluate::Evaluation,
    export::{curve::Curving, modes::Modes, psd::Spectra},
    numerics::EigenError,
};

impl<'a> Run<'a> {
    /// Every performance index of the design as it stands.
    ///
    /// # Errors
    ///
    /// [`EigenError`] if the models have no eigenvalues.
    pub fn evaluate(&self) -> Result<Answer<'a, Evaluation>, EigenError> {
        let spec = &self.input.spec;
        let result = Evaluation::new(&spec.case)?;
        Ok(Answer {
            input: self.input,
            warnings: warnings(&spec.case, &result, &spec.demands),
            result,
        })
    }

    /// Modes of vibration, and the damping at some speeds, m/s; none: every 10 % of twice the
    /// operating speed.
    ///
    /// # Errors
    ///
    /// As [`Run::evaluate`].
    pub fn modes(&self, speeds: &[f64]) -> Result<Answer<'a, Modes>, EigenError> {
        let case = &self.input.spec.case;
        let result = if speeds.is_empty() {
            let speeds = (1..=10).map(|i| 0.2 * f64::from(i) * case.service.speed);
            Modes::new(case, &speeds.collect::<Vec<_>>())
        } else {
            Modes::new(case, speeds)
        };
        Ok(self.answer(result?))
    }

    /// The vehicle in a curve of some degree, degrees, at a cant deficiency, rad; `None`: those of
    /// [`Curving::new`].
    ///
    /// # Errors
    ///
    /// [`CurvingError`] if there is no steady state.
    pub fn curve(
        &self,
        degree: Option<f64>,
        cant_deficiency: Option<f64>,
    ) -> Result<Answer<'a, Curving>, CurvingError> {
        Curving::new(&self.input.spec.case, degree, cant_deficiency)
            .map(|result| self.answer(result))
    }

    /// Power spectra of accelerations and strokes at so many frequencies.
    ///
    /// # Errors
    ///
    /// As [`Run::evaluate`].
    pub fn spectra(&self, points: usize) -> Result<Answer<'a, Spectra>, EigenError> {
        Spectra::new(&self.input.spec.case, points).map(|result| self.answer(result))
    }

    /// An answer without doubts of its own.
    pub(super) fn answer<T>(&self, result: T) -> Answer<'a, T> {
        Answer {
            input: self.input,
            result,
            warnings: Vec::new(),
        }
    }
}
