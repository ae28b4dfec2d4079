//! Reading a spec.

use toml::de::DeTable;

use super::diagnostic::Diagnostic;
use super::document::Document;
use super::{
    Condition, DesignSpace, Diagnostics, Front, Goal, case, conditions, demands, design, keys,
    tracks,
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
    /// What may vary.
    pub design: DesignSpace,
    /// What is to be as good as can be; none: the report's own objectives, one per trade-off.
    pub objective: Vec<Goal>,
    /// Requirements and limits.
    pub demands: Demands,
    /// Further operating conditions in which they hold.
    pub conditions: Vec<Condition>,
    /// What a front trades off.
    pub front: Front,
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
            .map(|error| Diagnostic {
                span: error.span(),
                message: error.message().into(),
                expected: "no valid TOML from here on".into(),
                help: error
                    .message()
                    .contains("quoted")
                    .then(|| "a value with its unit stands in quotes: mass = \"2500 slug\"".into()),
            })
            .collect();
        if !mistakes.is_empty() {
            return Err(Diagnostics::new(mistakes));
        }
        let document = Document::new(root.get_ref(), &keys::paths(), &mut mistakes);
        let own_tracks = tracks::read(&document, &mut mistakes);
        let case = case::read(&document, &own_tracks, &mut mistakes);
        let design = design::read(&document, &mut mistakes);
        let objective = demands::objective(&document, &mut mistakes);
        let front = demands::front(&document, &mut mistakes);
        let demands = demands::demands(&document, &mut mistakes);
        let conditions = conditions::read(&document, &own_tracks, &mut mistakes);
        if mistakes.is_empty() {
            Ok(Self {
                case,
                design,
                objective,
                demands,
                conditions,
                front,
            })
        } else {
            Err(Diagnostics::new(mistakes))
        }
    }

    /// Reads a spec from a file's bytes.
    ///
    /// # Errors
    ///
    /// More than [`MAX_BYTES`], text that is not UTF-8, or the mistakes of [`Spec::parse`].
    pub fn read(bytes: &[u8]) -> Result<Self, Diagnostics> {
        let refuse = |message: String, expected: &str| {
            Diagnostics::new(vec![Diagnostic {
                span: None,
                message,
                expected: expected.into(),
                help: None,
            }])
        };
        if bytes.len() > MAX_BYTES {
            return Err(refuse(
                format!("the file has {} bytes", bytes.len()),
                "a spec has at most 1 MiB",
            ));
        }
        let source = std::str::from_utf8(bytes).map_err(|error| {
            let offset = error.valid_up_to();
            let line = bytes[..offset].split(|&b| b == b'\n').count();
            refuse(
                format!("the file is not UTF-8 text: byte {offset}, in line {line}"),
                "save the spec with UTF-8 encoding",
            )
        })?;
        Self::parse(source)
    }
}

#[cfg(test)]
mod tests;
