//! A TOML document as entries by path, its names checked against the keys of a spec.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::diagnostic::{Diagnostic, MOST, printable, word};
use crate::parameter::Parameter;

/// A value of the document.
pub(super) type Value<'a> = Spanned<DeValue<'a>>;

/// The known entries of a document.
#[derive(Default)]
pub(super) struct Document<'a> {
    entries: BTreeMap<String, &'a Value<'a>>,
    tables: BTreeMap<String, Range<usize>>,
    /// Paths of tables in whose place something else stands.
    no_tables: Vec<String>,
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

    /// Whether something that is no table stands where `path` and all in it would.
    pub fn is_no_table(&self, path: &str) -> bool {
        self.no_tables.iter().any(|table| table == path)
    }

    fn collect(
        &mut self,
        table: &'a DeTable<'a>,
        parent: &str,
        paths: &[&str],
        mistakes: &mut Vec<Diagnostic>,
    ) {
        for (name, value) in table {
            if mistakes.len() >= MOST {
                return;
            }
            let path = join(parent, name.get_ref());
            let inside = format!("{path}.");
            if paths.contains(&path.as_str()) {
                self.entries.insert(path, value);
            } else if paths.iter().any(|known| known.starts_with(&inside)) {
                if let DeValue::Table(table) = value.get_ref() {
                    self.collect(table, &path, paths, mistakes);
                    self.tables.insert(path, name.span());
                } else {
                    let is_list = matches!(value.get_ref(), DeValue::Array(_));
                    let help = "every table stands once, in single brackets";
                    mistakes.push(
                        Diagnostic::at(
                            value.span(),
                            format!("`{path}` is a table"),
                            format!("expected a table: write [{path}] and its keys below"),
                        )
                        .help(is_list.then(|| help.to_owned())),
                    );
                    self.no_tables.push(path);
                }
            } else {
                mistakes.push(unknown(name, value, parent, paths));
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

fn unknown(
    name: &Spanned<std::borrow::Cow<'_, str>>,
    value: &Value,
    parent: &str,
    paths: &[&str],
) -> Diagnostic {
    let written = name.get_ref();
    let inside = join(parent, "");
    let mut siblings: Vec<&str> = Vec::new();
    for path in paths {
        let inside = path.strip_prefix(&inside);
        if let Some(sibling) = inside.and_then(|rest| rest.split('.').next())
            && !siblings.contains(&sibling)
        {
            siblings.push(sibling);
        }
    }
    let elsewhere: Vec<String> = paths
        .iter()
        .filter_map(|path| path.rsplit_once('.'))
        .filter(|(table, leaf)| {
            leaf == written && !table.starts_with("trailing.") && !table.starts_with("design.")
        })
        .map(|(table, _)| format!("[{table}]"))
        .collect();
    let help = if let Some(near) = nearest(written, siblings.iter().copied()) {
        format!("did you mean `{near}`?")
    } else if !elsewhere.is_empty() {
        format!("`{written}` is a key of {}", elsewhere.join(" and "))
    } else if let Some(name) = variable(written, parent, paths) {
        format!("did you mean `{name}`?")
    } else {
        format!("known here: {}", siblings.join(", "))
    };
    let written = word(written);
    let is_table = matches!(value.get_ref(), DeValue::Table(_));
    let what = if is_table { "table" } else { "key" };
    let message = format!("unknown {what} `{written}`");
    let elsewhere_a_table = super::keys::paths()
        .iter()
        .any(|path| path.starts_with(&format!("{written}.")));
    let expected = match (parent, is_table) {
        ("", true) if elsewhere_a_table => "not a table of a condition".to_owned(),
        ("", true) => "not a table of a spec".to_owned(),
        ("", false) => "every key stands in a table".to_owned(),
        _ => format!("not a {what} of [{parent}]"),
    };
    Diagnostic::at(name.span(), message, expected).help(help)
}

/// The variable in `[design]` that `written` most likely stands for: `carbody_mass` for `vehicle.carbody.mass`, or
/// the short name of a number that is written there by its path.
fn variable(written: &str, parent: &str, paths: &[&str]) -> Option<String> {
    if !format!("{parent}.").starts_with("design.") {
        return None;
    }
    let path = join(parent, written);
    let path = path.strip_prefix("design.")?;
    let by_path = Parameter::plain().find(|parameter| {
        let rest = parameter.key_of_constant().path.strip_prefix(path);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    });
    if let Some(parameter) = by_path {
        return Some(parameter.name().to_owned());
    }
    let names = paths.iter().filter_map(|path| path.strip_prefix("design."));
    let plain: Vec<(String, &str)> = names.map(|name| (name.replace('.', "_"), name)).collect();
    let near = nearest(written, plain.iter().map(|(plain, _)| plain.as_str()))?;
    let (_, name) = plain.iter().find(|(plain, _)| plain == near)?;
    Some((*name).to_owned())
}

/// A name of the author's that results could not carry.
pub(super) fn bad_name(name: &Spanned<std::borrow::Cow<'_, str>>) -> Option<Diagnostic> {
    const LONGEST: usize = 60;
    let text = name.get_ref();
    let is_plain = printable(text) == **text && !text.trim().is_empty();
    (!is_plain || text.chars().count() > LONGEST).then(|| {
        let message = format!("`{}` cannot be a name", word(text));
        let expected =
            format!("expected a name of at most {LONGEST} characters, none of them invisible");
        Diagnostic::at(name.span(), message, expected)
    })
}

/// The candidate that `written` most likely stands for.
pub(super) fn nearest<'n>(
    written: &str,
    candidates: impl Iterator<Item = &'n str>,
) -> Option<&'n str> {
    // No name is that long, and likeness takes the product of the lengths.
    if written.len() > 80 {
        return None;
    }
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
