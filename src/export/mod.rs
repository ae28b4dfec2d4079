//! Results as text, JSON, CSV and Parquet.

pub(crate) mod certificate;
pub mod check;
pub(crate) mod cross_checks;
pub mod curve;
pub mod design_json;
pub mod design_text;
pub mod evaluation_json;
pub(crate) mod evaluation_text;
pub mod figure;
pub mod file;
pub(crate) mod freedom;
pub mod modes;
pub mod origin;
pub mod pareto;
pub mod psd;
pub mod sensitivity;
pub(crate) mod sheet;
pub mod status;
pub mod sweep;
pub mod table;
pub(crate) mod verdict;

pub use evaluation_text::evaluation;
