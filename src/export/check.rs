//! Answer of `bogie check`.

use serde_json::{Value, json};

use super::origin::{PROGRAM, SCHEMA_VERSION};
use crate::spec::{Diagnostic, Diagnostics, Spec};

/// The verdict on a spec without mistakes.
pub fn text(name: &str, spec: &Spec) -> String {
    match spec.doubts.iter().count() {
        0 => format!("{name}: the spec is in order"),
        1 => format!("{name}: the spec has no mistakes, but see the warning"),
        n => format!("{name}: the spec has no mistakes, but see the {n} warnings"),
    }
}

/// The verdict with every mistake and warning and where it stands, for editors.
pub fn json(name: &str, source: &str, read: &Result<Spec, Diagnostics>) -> Value {
    let entry = |d: &Diagnostic| {
        let [line, column] = d.position(source).map_or([None; 2], |p| p.map(Some));
        json!({
            "line": line,
            "column": column,
            "message": d.message,
            "expected": d.expected,
            "help": d.help,
        })
    };
    let (mistakes, warnings): (Vec<Value>, Vec<Value>) = match read {
        Ok(spec) => (Vec::new(), spec.doubts.iter().map(entry).collect()),
        Err(mistakes) => (mistakes.iter().map(entry).collect(), Vec::new()),
    };
    json!({
        "program": PROGRAM,
        "schema_version": SCHEMA_VERSION,
        "name": name,
        "valid": read.is_ok(),
        "mistakes": mistakes,
        "warnings": warnings,
    })
}
