//! Results as text, JSON, CSV and Parquet.

mod certificate;
pub mod check;
mod cross_checks;
pub mod curve;
pub mod design_json;
pub mod design_text;
pub mod evaluation_json;
mod evaluation_text;
pub mod file;
pub mod modes;
pub mod number;
pub mod pareto;
pub mod psd;
pub mod sensitivity;
mod sheet;
pub mod table;

pub use evaluation_text::evaluation;
