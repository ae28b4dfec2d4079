//! Reading the spec.

use std::{
    io::{IsTerminal, Read},
    path::Path,
};

use bogie::spec::{MAX_BYTES, Spec};

use sha2::{Digest, Sha256};

use super::Failure;

/// A spec with the name that results carry.
pub struct Named {
    pub name: String,
    pub spec: Spec,
    /// SHA-256 of the spec's text.
    pub digest: String,
}

/// Reads a spec from a file, or from standard input for `-`.
pub fn read(path: &Path) -> Result<Named, Failure> {
    let is_stdin = path.as_os_str() == "-";
    let shown = if is_stdin {
        "<standard input>".into()
    } else {
        path.display().to_string()
    };
    let cannot = |error: std::io::Error| {
        let help = if path.is_dir() {
            " (it is a folder)"
        } else {
            ""
        };
        Failure::Invalid(format!("error: cannot read {shown}: {error}{help}"))
    };
    // One byte more than allowed is enough to know that a spec is too large.
    let limit = MAX_BYTES as u64 + 1;
    let mut bytes = Vec::new();
    if is_stdin {
        std::io::stdin()
            .lock()
            .take(limit)
            .read_to_end(&mut bytes)
            .map_err(cannot)?;
    } else {
        let file = std::fs::File::open(path).map_err(cannot)?;
        file.take(limit).read_to_end(&mut bytes).map_err(cannot)?;
    }
    let spec = Spec::read(&bytes).map_err(|diagnostics| {
        let source = String::from_utf8_lossy(&bytes);
        Failure::Invalid(diagnostics.render(&shown, &source, std::io::stderr().is_terminal()))
    })?;
    let name = match path.file_stem() {
        Some(stem) if !is_stdin => stem.to_string_lossy().into_owned(),
        _ => "spec".into(),
    };
    let digest = format!("{:x}", Sha256::digest(&bytes));
    Ok(Named { name, spec, digest })
}
