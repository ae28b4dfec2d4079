//! Writing the result.

use std::{
    io::{ErrorKind, Write},
    path::Path,
};

use bogie::export::file;

use super::Failure;

/// Writes a result to standard output, or into a folder as `name`.
pub fn write(text: &str, out: Option<&Path>, name: &str) -> Result<(), Failure> {
    let Some(folder) = out else {
        return print(text);
    };
    let path = folder.join(name);
    file::write(&path, text)
        .map_err(|error| Failure::Failed(format!("cannot write {}: {error}", path.display())))?;
    eprintln!("wrote {}", path.display());
    Ok(())
}

/// Prints to standard output; a reader that has gone away is no error.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = std::io::stdout().lock();
    let written = stdout
        .write_all(text.as_bytes())
        .and_then(|()| {
            if text.ends_with('\n') {
                Ok(())
            } else {
                stdout.write_all(b"\n")
            }
        })
        .and_then(|()| stdout.flush());
    written.map_err(|error| match error.kind() {
        ErrorKind::BrokenPipe => Failure::Closed,
        _ => Failure::Failed(format!("cannot write to standard output: {error}")),
    })
}
