//! Reading a spec.

use toml::de::DeTable;

use super::consistency::{Situation, contradictions, doubts, without_curve};
use super::diagnostic::{Diagnostic, MOST};
use super::document::Document;
use super::{
    Condition, DesignSpace, Diagnostics, Doubts, Front, Goal, case, conditions, demands, design,
    keys, tracks,
};
use crate::case::Case;
use crate::index::Demands;

/// Largest spec that is read, bytes.
pub const MAX_BYTES: usize = 1 << 20;

/// A commented spec to start from.
pub const STARTER: &str = include_str!("starter.toml");

/// A spec in SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Spec {
    /// The vehicle as it stands, its use, and the models' options.
    pub case: Case,
    /// Design space.
    pub design: DesignSpace,
    /// Goals; none: the report's own objectives, one per trade-off.
    pub objective: Vec<Goal>,
    /// Requirements and limits.
    pub demands: Demands,
    /// Further operating conditions in which they hold.
    pub conditions: Vec<Condition>,
    /// Indices that a front trades off.
    pub front: Front,
    /// Doubts: lawful but hardly meant.
    pub doubts: Doubts,
}

impl Spec {
    /// Reads a spec.
    ///
    /// # Errors
    ///
    /// All mistakes found; those of TOML syntax hide the rest.
    pub fn parse(source: &str) -> Result<Self, Diagnostics> {
        let (root, errors) = DeTable::parse_recoverable(source);
        let mut mistakes: Vec<Diagnostic> = errors
            .iter()
            .take(MOST)
            .map(|error| syntax(source, error))
            .collect();
        if !mistakes.is_empty() {
            return Err(Diagnostics::new(mistakes));
        }
        if root.get_ref().is_empty() {
            return Err(refuse(
                "the spec is empty".into(),
                "expected at least a [vehicle]",
                Some("`bogie init` writes a spec to start from"),
            ));
        }
        let document = Document::new(root.get_ref(), &keys::paths(), &mut mistakes);
        let own_tracks = tracks::read(&document, &mut mistakes);
        let case = case::read(&document, &own_tracks, &mut mistakes);
        let design = design::read(&document, &mut mistakes);
        design::absent(&document, &design, &case, &mut mistakes);
        let objective = demands::objective(&document, &mut mistakes);
        let front = demands::front(&document, &mut mistakes);
        let demands = demands::demands(&document, &mut mistakes);
        let conditions = conditions::read(&document, &own_tracks, &mut mistakes);
        let situations = Situation::all(&case, &demands, &document, &conditions, &mistakes);
        contradictions(&situations, &design, &front, &mut mistakes);
        without_curve(&situations, &objective, &front, &mut mistakes);
        if !mistakes.is_empty() {
            return Err(Diagnostics::new(mistakes));
        }
        let mut spec = Self {
            case,
            design,
            objective,
            demands,
            conditions: conditions.iter().map(|(c, _)| c.clone()).collect(),
            front,
            doubts: Doubts::default(),
        };
        spec.doubts = doubts(&spec, &document, &situations);
        Ok(spec)
    }

    /// Reads a spec from a file's bytes.
    ///
    /// # Errors
    ///
    /// More than [`MAX_BYTES`], text that is not UTF-8, or the mistakes of [`Spec::parse`].
    pub fn read(bytes: &[u8]) -> Result<Self, Diagnostics> {
        if bytes.len() > MAX_BYTES {
            let message = "the file is larger than any spec".into();
            return Err(refuse(message, "a spec has at most 1 MiB", None));
        }
        let source = std::str::from_utf8(bytes).map_err(|error| {
            let offset = error.valid_up_to();
            let line = bytes[..offset].split(|&b| b == b'\n').count();
            refuse(
                format!("the file is not UTF-8 text: byte {offset}, in line {line}"),
                "save the spec with UTF-8 encoding",
                None,
            )
        })?;
        Self::parse(source)
    }
}

/// A mistake of a file as a whole.
fn refuse(message: String, expected: &str, help: Option<&str>) -> Diagnostics {
    Diagnostics::new(vec![Diagnostic {
        span: None,
        message,
        expected: expected.into(),
        help: help.map(str::to_owned),
    }])
}

/// A mistake of TOML's syntax.
fn syntax(source: &str, error: &toml::de::Error) -> Diagnostic {
    let message = error.message();
    let at = error.span().map_or(source.len(), |span| span.start);
    let [before, after] = [source.get(..at), source.get(at..)].map(Option::unwrap_or_default);
    let (expected, help) = if message == "duplicate key" {
        let help = "every key and every table stands once; put its keys together";
        ("here a second time", Some(help))
    } else if after.starts_with(['“', '”', '„', '‘', '’', '«', '»']) {
        let help = "quotes are straight in TOML: \"2500 slug\"";
        ("no valid TOML from here on", Some(help))
    } else if after.starts_with(',') && before.ends_with(|c: char| c.is_ascii_digit()) {
        let help = "numbers have a decimal point, and no commas: 0.05";
        ("no valid TOML from here on", Some(help))
    } else if message.contains("quoted") {
        let help = "a value with its unit stands in quotes: mass = \"2500 slug\"";
        ("no valid TOML from here on", Some(help))
    } else {
        ("no valid TOML from here on", None)
    };
    Diagnostic {
        span: error.span(),
        message: message.into(),
        expected: expected.into(),
        help: help.map(str::to_owned),
    }
}

#[cfg(test)]
mod tests;
