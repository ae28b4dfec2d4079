//! Closed forms beside the full models, as a table and as JSON.

use serde_json::{Value, json};

use super::sheet::Sheet;
use crate::{
    case::Case,
    evaluate::{Evaluation, cross_checks::cross_checks},
    units::number::{both, significant},
};

/// Table of all that apply.
pub(crate) fn table(sheet: &mut Sheet, case: &Case, evaluation: &Evaluation) {
    sheet.heading("Cross-checks: closed forms of the report beside the full models");
    let rows: Vec<Vec<String>> = cross_checks(case, evaluation)
        .iter()
        .map(|c| {
            let [si, us] = both(c.quantity, c.closed_form);
            let [full_si, full_us] = c
                .full_model
                .map_or([String::new(), String::new()], |v| both(c.quantity, v));
            let ratio = c
                .full_model
                .map_or(String::new(), |v| significant(c.closed_form / v, 3));
            vec![
                c.name.clone(),
                c.equation.into(),
                si,
                us,
                full_si,
                full_us,
                ratio,
            ]
        })
        .collect();
    sheet.table(
        &["", "equation", "closed form", "", "full model", "", "ratio"],
        &[1],
        &rows,
    );
}

/// The same as JSON.
pub(super) fn json(case: &Case, evaluation: &Evaluation) -> Value {
    let list: Vec<Value> = cross_checks(case, evaluation)
        .iter()
        .map(|c| {
            json!({
                "name": c.name,
                "equation": c.equation,
                "unit": c.quantity.dimension().to_string(),
                "closed_form_si": c.closed_form,
                "full_model_si": c.full_model,
            })
        })
        .collect();
    json!(list)
}
