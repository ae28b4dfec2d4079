//! An answer in each of its forms.

use serde::{Serialize, Serializer};
use serde_json::{Value, json};

use super::{Designed, Input};
use crate::{
    design::{pareto::Front, sensitivity::Sensitivity},
    evaluate::Evaluation,
    export::{
        self, curve::Curving, design_json, design_text, evaluation_json, modes::Modes,
        origin::sign, psd::Spectra, table::Table,
    },
};

/// A result with the input that it comes from.
#[derive(Debug, Clone)]
pub struct Answer<'a, T> {
    /// Subject of the question.
    pub input: &'a Input,
    /// The result.
    pub result: T,
    /// Doubts about the result, a sentence each; those about the spec are in [`Input::doubts`].
    pub warnings: Vec<String>,
}

impl<T> Answer<'_, T> {
    /// Doubts about the spec and about the result; a sentence that both have stands once.
    pub fn doubts(&self) -> Vec<String> {
        let doubts = &self.input.doubts;
        let more = self.warnings.iter().filter(|text| !doubts.contains(text));
        doubts.iter().chain(more).cloned().collect()
    }
}

impl<T: Written> Answer<'_, T> {
    /// Aligned tables in SI and US customary units.
    pub fn text(&self) -> String {
        self.result.text(self.input, &self.warnings)
    }

    /// SI, the unit in every key, with all doubts and what the result comes from.
    pub fn json(&self) -> Value {
        let doubts = self.doubts();
        let mut result = self.result.json(self.input, &doubts);
        if let Value::Object(object) = &mut result {
            sign(object);
            object.insert("spec_sha256".into(), json!(self.input.digest));
            object.insert("warnings".into(), json!(doubts));
        }
        result
    }

    /// SI, the unit in every column's name; `None`: the result is no table.
    pub fn table(&self) -> Option<Table> {
        self.result.table(self.input)
    }
}

impl<T: Written> Serialize for Answer<'_, T> {
    /// As [`Answer::json`].
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.json().serialize(serializer)
    }
}

/// A result that can be written.
pub trait Written {
    /// As text, with doubts about the result.
    fn text(&self, input: &Input, warnings: &[String]) -> String;

    /// As a JSON object, with doubts about the spec and the result.
    fn json(&self, input: &Input, doubts: &[String]) -> Value;

    /// As a table, where it is one.
    fn table(&self, _: &Input) -> Option<Table> {
        None
    }
}

impl Written for Evaluation {
    fn text(&self, input: &Input, warnings: &[String]) -> String {
        export::evaluation(&input.name, &input.spec.case, self, warnings)
    }

    fn json(&self, input: &Input, doubts: &[String]) -> Value {
        evaluation_json::evaluation(&input.name, &input.spec.case, self, doubts)
    }
}

impl Written for Designed {
    fn text(&self, Input { name, spec, .. }: &Input, warnings: &[String]) -> String {
        design_text::design(name, &self.design, spec, Some(&self.matters), warnings)
    }

    fn json(&self, input: &Input, doubts: &[String]) -> Value {
        let Input {
            name, spec, digest, ..
        } = input;
        let matters = Some(&self.matters);
        design_json::design(name, &self.design, spec, digest, matters, doubts)
    }
}

impl Written for Front {
    fn text(&self, input: &Input, _: &[String]) -> String {
        export::pareto::text(&input.name, self)
    }

    fn json(&self, input: &Input, _: &[String]) -> Value {
        export::pareto::json(&input.name, self, &input.spec, &input.digest)
    }

    fn table(&self, input: &Input) -> Option<Table> {
        Some(export::pareto::table(&input.name, self, &input.digest))
    }
}

impl Written for Sensitivity {
    fn text(&self, input: &Input, _: &[String]) -> String {
        export::sensitivity::text(&input.name, self)
    }

    fn json(&self, input: &Input, _: &[String]) -> Value {
        export::sensitivity::json(&input.name, self)
    }

    fn table(&self, _: &Input) -> Option<Table> {
        Some(export::sensitivity::table(self))
    }
}

impl Written for Modes {
    fn text(&self, input: &Input, _: &[String]) -> String {
        Self::text(self, &input.name, &input.spec.case)
    }

    fn json(&self, input: &Input, _: &[String]) -> Value {
        Self::json(self, &input.name, &input.spec.case)
    }
}

impl Written for Curving {
    fn text(&self, input: &Input, _: &[String]) -> String {
        Self::text(self, &input.name, &input.spec.case)
    }

    fn json(&self, input: &Input, _: &[String]) -> Value {
        Self::json(self, &input.name, &input.spec.case)
    }
}

impl Written for Spectra {
    fn text(&self, input: &Input, _: &[String]) -> String {
        Self::text(self, &input.name, &input.spec.case)
    }

    fn json(&self, input: &Input, _: &[String]) -> Value {
        Self::json(self, &input.name, &input.spec.case)
    }

    fn table(&self, _: &Input) -> Option<Table> {
        Some(Self::table(self))
    }
}
