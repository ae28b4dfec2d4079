//! Writing the result.

use std::{
    io::{ErrorKind, Write},
    path::Path,
};

use bogie::export::file;

use super::Failure;

/// Makes sure that results can be written into a folder, before a long run for them.
pub fn ready(folder: &Path) -> Result<(), Failure> {
    file::ready(folder)
        .map_err(|error| Failure::Failed(format!("cannot write to {}: {error}", folder.display())))
}

/// Writes a result to standard output, or into a folder as `name`.
pub fn write(content: impl AsRef<[u8]>, out: Option<&Path>, name: &str) -> Result<(), Failure> {
    let Some(folder) = out else {
        return print(content);
    };
    let path = folder.join(name);
    file::write(&path, content)
        .map_err(|error| Failure::Failed(format!("cannot write {}: {error}", path.display())))?;
    eprintln!("wrote {}", path.display());
    Ok(())
}

/// Prints to standard output; a reader that has gone away is no error.
pub fn print(content: impl AsRef<[u8]>) -> Result<(), Failure> {
    let content = content.as_ref();
    let mut stdout = std::io::stdout().lock();
    let written = stdout
        .write_all(content)
        .and_then(|()| {
            // A table for data frames is no text, nor is a picture.
            if content.ends_with(b"\n")
                || content.starts_with(b"PAR1")
                || content.starts_with(b"\x89PNG")
            {
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
