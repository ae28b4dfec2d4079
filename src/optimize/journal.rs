//! The journal of a run on disk: a line of JSON per measurement, written as soon as it is made.
//!
//! The first line says which program and spec the measurements belong to. A run that is killed
//! loses at most the line that it was writing.

use std::{
    fs::{File, TryLockError},
    io::{self, BufRead, BufReader, Seek, SeekFrom, Write},
    path::Path,
};

use serde::{Deserialize, Serialize};

use super::{
    archive::Measured,
    problem::{Failure, Key, Piece},
};

/// A journal open for writing.
#[derive(Debug)]
pub struct Journal {
    file: File,
}

/// Program and spec of a journal.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Header {
    /// Program and version.
    pub program: String,
    /// Digest of the spec with all that decides the search.
    pub digest: String,
}

/// A measurement read from a journal.
#[derive(Debug, Clone)]
pub struct Entry {
    /// Key of the measurement.
    pub key: Key,
    /// Its result.
    pub measured: Measured,
}

/// Reason why a journal cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    /// The file system refused.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// It records another run.
    #[error("it belongs to another spec or version of the program")]
    Foreign,
    /// There is no journal to resume.
    #[error("there is no journal of an earlier run")]
    Missing,
    /// Another process is writing it.
    #[error("another run is writing into this folder: wait for it or name another folder")]
    Busy,
}

#[derive(Serialize, Deserialize)]
struct Line {
    #[serde(flatten)]
    key: Key,
    #[serde(skip_serializing_if = "Option::is_none", default)]
    failure: Option<Failure>,
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    pieces: Vec<(usize, f64, f64)>,
    /// Gradients of the pieces, where known.
    #[serde(skip_serializing_if = "Vec::is_empty", default)]
    gradients: Vec<Option<Vec<f64>>>,
}

impl Journal {
    /// Begins a journal, in place of one that may be there. It is locked until dropped.
    ///
    /// # Errors
    ///
    /// Any error of the file system, or that another run is writing it.
    pub fn create(path: &Path, header: &Header) -> Result<Self, JournalError> {
        if let Some(folder) = path.parent().filter(|p| !p.as_os_str().is_empty()) {
            std::fs::create_dir_all(folder)?;
        }
        // The file is truncated only under the lock.
        let mut options = File::options();
        let file = options
            .write(true)
            .create(true)
            .truncate(false)
            .open(path)?;
        lock(&file)?;
        file.set_len(0)?;
        let mut journal = Self { file };
        journal.line(header)?;
        Ok(journal)
    }

    /// Opens a journal to go on with it: the measurements in it, and the journal to add to, locked
    /// until dropped.
    ///
    /// # Errors
    ///
    /// [`JournalError`] if there is none, it belongs to another run, or another run is writing it.
    pub fn resume(path: &Path, header: &Header) -> Result<(Self, Vec<Entry>), JournalError> {
        let file = match File::options().read(true).write(true).open(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Err(JournalError::Missing);
            }
            other => other?,
        };
        lock(&file)?;
        let mut reader = BufReader::new(file);
        let mut text = String::new();
        reader.read_line(&mut text)?;
        if serde_json::from_str::<Header>(&text).ok().as_ref() != Some(header) {
            return Err(JournalError::Foreign);
        }
        let mut entries = Vec::new();
        let mut whole = text.len() as u64;
        loop {
            text.clear();
            // The last line may be cut off, anywhere in a character too.
            let read = match reader.read_line(&mut text) {
                Ok(read) => read,
                Err(error) if error.kind() == io::ErrorKind::InvalidData => break,
                Err(error) => return Err(error.into()),
            };
            let Some(entry) = text.strip_suffix('\n').and_then(parse) else {
                break;
            };
            whole += read as u64;
            entries.push(entry);
        }
        let mut file = reader.into_inner();
        file.set_len(whole)?;
        file.seek(SeekFrom::End(0))?;
        Ok((Self { file }, entries))
    }

    /// Adds a measurement.
    ///
    /// # Errors
    ///
    /// Any error of the file system.
    pub fn write(&mut self, key: &Key, measured: &Measured) -> io::Result<()> {
        let pieces = measured.iter().flatten();
        let graded = pieces.clone().any(|p| p.gradient.is_some());
        let gradients = pieces.clone().filter(|_| graded);
        self.line(&Line {
            key: key.clone(),
            failure: measured.as_ref().err().copied(),
            pieces: pieces.map(|p| (p.index, p.label, p.value)).collect(),
            gradients: gradients.map(|p| p.gradient.clone()).collect(),
        })
    }

    /// One write call a line: a killed process leaves whole lines and perhaps one part of a line.
    fn line(&mut self, content: &impl Serialize) -> io::Result<()> {
        let mut text = serde_json::to_vec(content)?;
        text.push(b'\n');
        self.file.write_all(&text)
    }
}

/// Lock of the file until it is closed or the process ends.
fn lock(file: &File) -> Result<(), JournalError> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(JournalError::Busy),
        // Some file systems know no locks.
        Err(TryLockError::Error(error)) if error.kind() != io::ErrorKind::Unsupported => {
            Err(error.into())
        }
        _ => Ok(()),
    }
}

fn parse(text: &str) -> Option<Entry> {
    let line: Line = serde_json::from_str(text).ok()?;
    let mut gradients = line.gradients;
    gradients.resize(line.pieces.len(), None);
    let pieces = line.pieces.into_iter().zip(gradients);
    let pieces = pieces.map(|((index, label, value), gradient)| Piece {
        value,
        index,
        label,
        gradient,
    });
    Some(Entry {
        measured: match line.failure {
            Some(failure) => Err(failure),
            None => Ok(pieces.collect()),
        },
        key: line.key,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header(digest: &str) -> Header {
        Header {
            program: "bogie".into(),
            digest: digest.into(),
        }
    }

    #[test]
    fn numbers_come_back_bit_for_bit_and_a_cut_line_is_left_out() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.jsonl");
        let key = |i: i32| Key {
            what: "λ".into(),
            at: vec![f64::from(i) / 3.0, 1e-300, -0.1],
        };
        let pieces = vec![Piece {
            value: std::f64::consts::PI / 7.0,
            index: 3,
            label: 0.1 + 0.2,
            gradient: Some(vec![0.1, -1.0 / 3.0]),
        }];
        let mut journal = Journal::create(&path, &header("a")).unwrap();
        journal.write(&key(1), &Ok(pieces.clone())).unwrap();
        journal.write(&key(2), &Err(Failure::Unstable)).unwrap();
        journal.write(&key(3), &Ok(pieces.clone())).unwrap();
        drop(journal);
        let bytes = std::fs::read(&path).unwrap();
        std::fs::write(&path, &bytes[..bytes.len() - 5]).unwrap();

        let (mut journal, entries) = Journal::resume(&path, &header("a")).unwrap();
        assert_eq!(entries.len(), 2);
        assert_eq!(entries[0].key, key(1));
        assert_eq!(entries[0].measured, Ok(pieces.clone()));
        assert_eq!(entries[1].measured, Err(Failure::Unstable));
        journal.write(&key(4), &Ok(pieces)).unwrap();
        for second in [
            Journal::resume(&path, &header("a")).map(|(journal, _)| journal),
            Journal::create(&path, &header("a")),
        ] {
            assert!(matches!(second, Err(JournalError::Busy)));
        }
        drop(journal);
        let (_, entries) = Journal::resume(&path, &header("a")).unwrap();
        assert_eq!(entries.len(), 3);

        let foreign = Journal::resume(&path, &header("b"));
        assert!(matches!(foreign, Err(JournalError::Foreign)));
        let missing = Journal::resume(&folder.path().join("none"), &header("a"));
        assert!(matches!(missing, Err(JournalError::Missing)));
    }
}
