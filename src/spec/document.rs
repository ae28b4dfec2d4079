//! A TOML document as entries by path, its names checked against the keys of a spec.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::Diagnostic;

/// A value of the document.
pub(super) type Value<'a> = Spanned<DeValue<'a>>;

/// The known entries of a document.
#[derive(Default)]
pub(super) struct Document<'a> {
    entries: BTreeMap<String, &'a Value<'a>>,
    tables: BTreeMap<String, Range<usize>>,
}

impl<'a> Document<'a> {
    /// Sorts the entries of `root` by path; `paths` are those that a spec may contain.
    pub fn new(root: &'a DeTable<'a>, paths: &[&str], mistakes: &mut Vec<Diagnostic>) -> Self {
        let mut document = Self::default();
        document.collect(root, "", paths, mistakes);
        document
    }

    /// The value at `path`.
    pub fn get(&self, path: &str) -> Option<&'a Value<'a>> {
        self.entries.get(path).copied()
    }

    /// Where the name of the table `path` stands.
    pub fn table(&self, path: &str) -> Option<Range<usize>> {
        self.tables.get(path).cloned()
    }

    fn collect(
        &mut self,
        table: &'a DeTable<'a>,
        parent: &str,
        paths: &[&str],
        mistakes: &mut Vec<Diagnostic>,
    ) {
        for (name, value) in table {
            let path = join(parent, name.get_ref());
            let inside = format!("{path}.");
            if paths.contains(&path.as_str()) {
                self.entries.insert(path, value);
            } else if paths.iter().any(|known| known.starts_with(&inside)) {
                if let DeValue::Table(table) = value.get_ref() {
                    self.collect(table, &path, paths, mistakes);
                    self.tables.insert(path, name.span());
                } else {
                    mistakes.push(Diagnostic::at(
                        value.span(),
                        format!("`{path}` is a table"),
                        format!("expected a table: write [{path}] and its keys below"),
                    ));
                }
            } else {
                mistakes.push(unknown(name, parent, paths));
            }
        }
    }
}

fn join(parent: &str, name: &str) -> String {
    if parent.is_empty() {
        name.to_owned()
    } else {
        format!("{parent}.{name}")
    }
}

fn unknown(name: &Spanned<std::borrow::Cow<'_, str>>, parent: &str, paths: &[&str]) -> Diagnostic {
    let written = name.get_ref();
    let inside = join(parent, "");
    let mut siblings: Vec<&str> = paths
        .iter()
        .filter_map(|path| path.strip_prefix(&inside)?.split('.').next())
        .collect();
    siblings.dedup();
    let elsewhere: Vec<String> = paths
        .iter()
        .filter_map(|path| path.rsplit_once('.'))
        .filter(|(_, leaf)| leaf == written)
        .map(|(table, _)| format!("[{table}]"))
        .collect();
    let help = if let Some(near) = nearest(written, siblings.iter().copied()) {
        format!("did you mean `{near}`?")
    } else if elsewhere.is_empty() {
        format!("known here: {}", siblings.join(", "))
    } else {
        format!("`{written}` is a key of {}", elsewhere.join(" and "))
    };
    let (message, expected) = if parent.is_empty() {
        (
            format!("unknown table `{written}`"),
            "not a table of a spec".to_owned(),
        )
    } else {
        (
            format!("unknown key `{written}`"),
            format!("not a key of [{parent}]"),
        )
    };
    Diagnostic::at(name.span(), message, expected).help(help)
}

/// The candidate that `written` most likely stands for.
pub(super) fn nearest<'n>(
    written: &str,
    candidates: impl Iterator<Item = &'n str>,
) -> Option<&'n str> {
    let written = written.to_lowercase().replace('-', "_");
    candidates
        .map(|name| {
            let plain = name.replace('-', "_");
            let contained = written.len() > 3
                && (plain.contains(&written) || (plain.len() > 3 && written.contains(&plain)));
            let likeness = strsim::normalized_damerau_levenshtein(&plain, &written);
            (
                if contained {
                    likeness.max(0.7)
                } else {
                    likeness
                },
                name,
            )
        })
        .filter(|(likeness, _)| *likeness >= 0.6)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}
