//! `bogie sensitivity`: what matters and what does not, as text, JSON and a flat table.

mod json;
mod table;
mod text;

pub use json::json;
pub use table::table;
pub use text::{summary, text};
