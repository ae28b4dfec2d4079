//! Writing the result.

use std::{
    fmt::Display,
    io::{self, ErrorKind, Write},
    path::Path,
};

use bogie::{
    export::{file, table::Table},
    run::{Answer, Written},
};
use serde_json::Value;

use super::{Failure, arguments::TableFormat};

/// Says something on standard error. That nobody hears it changes nothing of the work.
pub fn say(text: impl Display) {
    let _ = writeln!(io::stderr(), "{text}");
}

/// Makes sure that results can be written into a folder, before the work for them.
pub fn ready(folder: &Path) -> Result<(), Failure> {
    file::ready(folder).map_err(|error| cannot_write(folder, &error))
}

/// A failure to write to a place, and what is in the way.
pub fn cannot_write(place: &Path, error: &io::Error) -> Failure {
    let in_the_way = matches!(
        error.kind(),
        ErrorKind::AlreadyExists | ErrorKind::NotADirectory
    );
    let file = place
        .ancestors()
        .find(|part| in_the_way && part.is_file())
        .map(|file| format!("{} is a file; name a folder", file.display()));
    let why = file.unwrap_or_else(|| error.to_string());
    Failure::Failed(format!("cannot write {}: {why}", place.display()))
}

/// Writes an answer to standard output, or into a folder as the command's file.
pub fn deliver<T: Written>(
    answer: &Answer<T>,
    command: &str,
    format: impl Into<TableFormat>,
    out: Option<&Path>,
) -> Result<(), Failure> {
    let table = || answer.table().unwrap_or_default();
    let (content, ending) = match format.into() {
        TableFormat::Text => (answer.text().into_bytes(), "txt"),
        TableFormat::Json => (json(&answer.json())?.into_bytes(), "json"),
        TableFormat::Csv => (table().csv().into_bytes(), "csv"),
        TableFormat::Parquet => (parquet(&table())?, "parquet"),
    };
    write(content, out, &format!("{command}.{ending}"))
}

/// JSON as it is written: indented, with a line's end.
pub fn json(value: &Value) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(value).map_err(Failure::failed)?;
    Ok(text + "\n")
}

#[cfg(feature = "parquet")]
fn parquet(table: &Table) -> Result<Vec<u8>, Failure> {
    table.parquet().map_err(Failure::failed)
}

#[cfg(not(feature = "parquet"))]
fn parquet(_: &Table) -> Result<Vec<u8>, Failure> {
    Err(Failure::needs("tables as Parquet", "parquet"))
}

/// Makes sure that this build can write a form, before the work for it.
pub fn can_write(format: TableFormat) -> Result<(), Failure> {
    if format == TableFormat::Parquet && !cfg!(feature = "parquet") {
        return Err(Failure::needs("tables as Parquet", "parquet"));
    }
    Ok(())
}

/// Writes a result to standard output, or into a folder as `name`.
pub fn write(content: impl AsRef<[u8]>, out: Option<&Path>, name: &str) -> Result<(), Failure> {
    let Some(folder) = out else {
        return print(content);
    };
    let path = folder.join(name);
    file::write(&path, content).map_err(|error| cannot_write(&path, &error))?;
    say(format_args!("wrote {}", path.display()));
    Ok(())
}

/// Prints to standard output. A reader that has gone away has had what it wanted.
pub fn print(content: impl AsRef<[u8]>) -> Result<(), Failure> {
    match part(content) {
        Err(Failure::Closed) => Ok(()),
        other => other,
    }
}

/// Prints a part of a result to standard output; [`Failure::Closed`]: nobody wants the others.
pub fn part(content: impl AsRef<[u8]>) -> Result<(), Failure> {
    let content = content.as_ref();
    let mut stdout = io::stdout().lock();
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
