//! The report's closed forms beside the full models' values: a designer's cross-checks.

mod curves;
mod frequencies;
mod hunting;

use super::Evaluation;
use crate::{case::Case, units::Quantity};

/// A closed form beside the full model.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossCheck {
    /// Name.
    pub name: String,
    /// Number of the equation in the report.
    pub equation: &'static str,
    /// Kind of quantity, for units.
    pub quantity: Quantity,
    /// Value of the closed form, SI.
    pub closed_form: f64,
    /// Value of the full model, SI; `None`: it has no value of its own for it.
    pub full_model: Option<f64>,
}

/// All that apply to an evaluated case.
pub fn cross_checks(case: &Case, evaluation: &Evaluation) -> Vec<CrossCheck> {
    let mut list = Vec::new();
    hunting::hunting(&mut list, case, evaluation);
    hunting::corrected(&mut list, case, evaluation);
    frequencies::frequencies(&mut list, case, evaluation);
    curves::curves(&mut list, case, evaluation);
    list
}
