//! Mistakes in a value and its unit.

use super::Quantity;

/// A value that cannot be read as the quantity asked for.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum UnitError {
    /// No number at the beginning.
    #[error("no number at the beginning of `{0}`")]
    NoNumber(String),
    /// More text than any value needs, bytes.
    #[error("a value has at most {0} characters")]
    TooLong(usize),
    /// A number too large for `f64`.
    #[error("`{0}` is not a finite number")]
    NotFinite(String),
    /// A number only.
    #[error("`{0}` has no unit")]
    NoUnit(String),
    /// A symbol that is not a unit.
    #[error("unknown unit `{symbol}`")]
    Unknown {
        /// As written.
        symbol: String,
        /// Unit that may have been meant.
        nearest: Option<&'static str>,
    },
    /// A pound that may be a force or a mass.
    #[error("`{0}` may be a force or a mass")]
    Pound(String),
    /// Not a unit expression.
    #[error("cannot read the unit from `{0}` on")]
    Syntax(String),
    /// A unit of something else.
    #[error("`{unit}` is {found}, not {}", .expected.with_article())]
    Dimension {
        /// The unit as written.
        unit: String,
        /// Quantity that the unit measures.
        found: String,
        /// Quantity asked for.
        expected: Quantity,
    },
    /// A dimensionless value in quotes.
    #[error("a dimensionless value is a plain number, without quotes")]
    Quoted,
}

impl UnitError {
    /// How to put it right, where that is more than the expected form.
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Unknown { nearest, .. } => nearest.map(|name| format!("did you mean `{name}`?")),
            Self::Pound(_) => Some("write `lbf` for a force, `lbm` or `slug` for a mass".into()),
            Self::Syntax(rest) if rest.starts_with(',') => {
                Some("write the number without thousands separators".into())
            }
            Self::Syntax(_) => {
                Some("write units like `lbf s/ft`, `kg m^2` or `m^2/(rad/m)`".into())
            }
            Self::Dimension {
                expected: Quantity::Wavenumber | Quantity::SpectralDensity | Quantity::Roughness,
                ..
            } => Some("wavenumbers are in radians: 1 cycle/m is 6.2832 rad/m".into()),
            _ => None,
        }
    }
}
