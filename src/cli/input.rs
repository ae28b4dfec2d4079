//! Reading the spec.

use std::{
    borrow::Cow,
    io::{ErrorKind, IsTerminal, Read},
    path::Path,
};

use bogie::{
    run::Input,
    spec::{Diagnostics, Doubts, MAX_BYTES, printable},
};

use super::{Failure, output};

/// A file before it is read as a spec.
pub struct File {
    /// As messages name it.
    pub shown: String,
    /// As results name it.
    pub name: String,
    pub bytes: Vec<u8>,
}

/// Reads a spec from a file, or from standard input for `-`. Doubts go to standard error.
pub fn read(path: &Path) -> Result<Input, Failure> {
    let file = open(path)?;
    let input = Input::read(&file.name, &file.bytes).map_err(|mistakes| file.refuse(&mistakes))?;
    file.show(&input.spec.doubts);
    Ok(input)
}

impl File {
    /// The text, as far as it is one.
    pub fn text(&self) -> Cow<'_, str> {
        String::from_utf8_lossy(&self.bytes)
    }

    /// Mistakes as the reason why there is no result.
    pub fn refuse(&self, mistakes: &Diagnostics) -> Failure {
        let colour = std::io::stderr().is_terminal();
        Failure::Invalid(mistakes.render(&self.shown, &self.text(), colour))
    }

    /// Doubts on standard error.
    pub fn show(&self, doubts: &Doubts) {
        let colour = std::io::stderr().is_terminal();
        let text = doubts.render(&self.shown, &self.text(), colour);
        if !text.is_empty() {
            output::say(text.trim_end_matches('\n'));
        }
    }
}

/// Reads a file or standard input, but no more than a spec may have.
pub fn open(path: &Path) -> Result<File, Failure> {
    let is_stdin = path.as_os_str() == "-";
    // A file's name may hold what a terminal would obey.
    let shown = if is_stdin {
        "<standard input>".into()
    } else {
        printable(&path.to_string_lossy())
    };
    let cannot = |error: std::io::Error| {
        let why = if path.is_dir() {
            "it is a folder; name a spec file".into()
        } else if error.kind() == ErrorKind::NotFound {
            "there is no such file; `bogie init` writes a spec to start from".into()
        } else {
            error.to_string()
        };
        Failure::Invalid(format!("error: cannot read {shown}: {why}"))
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
    let name = match path.file_stem() {
        Some(stem) if !is_stdin => printable(&stem.to_string_lossy()),
        _ => "spec".into(),
    };
    Ok(File { shown, name, bytes })
}
