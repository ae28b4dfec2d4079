//! The program and the form of its results, at the top level of each.

use serde_json::{Map, Value, json};

/// Program and version.
pub const PROGRAM: &str = concat!("bogie ", env!("CARGO_PKG_VERSION"));

/// Version of the keys in results. It is raised when a key changes its meaning or is removed; new keys
/// leave it as it is.
pub const SCHEMA_VERSION: u32 = 1;

/// Puts `program` and `schema_version` into the top level of a result.
pub fn sign(object: &mut Map<String, Value>) {
    object.insert("program".into(), json!(PROGRAM));
    object.insert("schema_version".into(), json!(SCHEMA_VERSION));
}
