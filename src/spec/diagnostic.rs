//! Mistakes and doubts in a spec, shown where they stand.

use std::fmt;
use std::ops::Range;

use annotate_snippets::{AnnotationKind, Level, Origin, Renderer, Snippet};

/// One mistake or doubt in a spec.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// Where it stands, in bytes of the source; `None` if it is something missing altogether.
    pub span: Option<Range<usize>>,
    /// The mistake.
    pub message: String,
    /// The expectation.
    pub expected: String,
    /// How to put it right, where that is known.
    pub help: Option<String>,
}

impl Diagnostic {
    pub(super) fn at(
        span: Range<usize>,
        message: impl Into<String>,
        expected: impl Into<String>,
    ) -> Self {
        Self {
            span: Some(span),
            message: message.into(),
            expected: expected.into(),
            help: None,
        }
    }

    /// Line and column in the source where it begins, both from 1, columns in characters.
    pub fn position(&self, source: &str) -> Option<[usize; 2]> {
        let start = within(source, self.span.as_ref()?).start;
        let before = &source[..start];
        let line = before.matches('\n').count() + 1;
        let column = before.chars().rev().take_while(|c| *c != '\n').count() + 1;
        Some([line, column])
    }

    pub(super) fn help(self, help: impl Into<Option<String>>) -> Self {
        Self {
            help: help.into(),
            ..self
        }
    }
}

/// Puts mistakes aside, so that reading goes on and finds all of them.
pub(super) trait Collect {
    fn collect<T>(&mut self, read: Result<T, Diagnostic>) -> Option<T>;
}

impl Collect for Vec<Diagnostic> {
    fn collect<T>(&mut self, read: Result<T, Diagnostic>) -> Option<T> {
        read.map_err(|mistake| self.push(mistake)).ok()
    }
}

/// Mistakes that are shown; the rest are counted.
const SHOWN: usize = 20;
/// Mistakes that are looked for: a file with so many is no spec.
pub(super) const MOST: usize = 100;
/// Longest message, characters: the longest that a right spec can lead to has some 500.
const LONGEST: usize = 1000;

/// All mistakes of a spec, in the order of its lines.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostics(Vec<Diagnostic>);

impl Diagnostics {
    pub(super) fn new(mistakes: Vec<Diagnostic>) -> Self {
        Self(in_order(mistakes))
    }

    /// The mistakes.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.0.iter()
    }

    /// The mistakes with the lines where they stand, for a terminal; the first few, if they are
    /// many.
    ///
    /// `source` is the text that was parsed, `file_name` how the reader knows it. Control
    /// characters of either are shown as symbols.
    pub fn render(&self, file_name: &str, source: &str, colour: bool) -> String {
        let text = render(&self.0, &Level::ERROR, file_name, source, colour);
        let count = match self.0.len() {
            1 => "1 mistake".to_owned(),
            n if n >= MOST => format!("{n} mistakes or more"),
            n => format!("{n} mistakes"),
        };
        text + &format!("{count} in {}\n", printable(file_name))
    }
}

/// Doubts: lawful in a spec but hardly meant, in the order of its lines.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Doubts(Vec<Diagnostic>);

impl Doubts {
    pub(super) fn new(doubts: Vec<Diagnostic>) -> Self {
        Self(in_order(doubts))
    }

    /// The doubts.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.0.iter()
    }

    /// The doubts with the lines where they stand, see [`Diagnostics::render`]. Empty if there are
    /// none.
    pub fn render(&self, file_name: &str, source: &str, colour: bool) -> String {
        render(&self.0, &Level::WARNING, file_name, source, colour)
    }

    /// One sentence each, for results.
    pub fn sentences(&self) -> impl Iterator<Item = String> {
        self.0.iter().map(|doubt| match &doubt.help {
            Some(help) => format!("{}: {}; {help}", doubt.message, doubt.expected),
            None => format!("{}: {}", doubt.message, doubt.expected),
        })
    }
}

/// Sorted by place, each text short and free of control characters.
fn in_order(mut list: Vec<Diagnostic>) -> Vec<Diagnostic> {
    list.sort_by_key(|d| d.span.as_ref().map_or(usize::MAX, |span| span.start));
    for diagnostic in &mut list {
        let texts = [&mut diagnostic.message, &mut diagnostic.expected];
        for text in texts.into_iter().chain(&mut diagnostic.help) {
            *text = shortened(&printable(text), LONGEST);
        }
    }
    list
}

fn render(
    list: &[Diagnostic],
    level: &Level,
    file_name: &str,
    source: &str,
    colour: bool,
) -> String {
    let renderer = if colour {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    let (source, file_name) = (&*masked(source), &*printable(file_name));
    let mut text = String::new();
    for diagnostic in list.iter().take(SHOWN) {
        let title = level.clone().primary_title(&*diagnostic.message);
        let mut group = match &diagnostic.span {
            Some(span) => title.element(
                Snippet::source(source).path(file_name).annotation(
                    AnnotationKind::Primary
                        .span(within(source, span))
                        .label(&*diagnostic.expected),
                ),
            ),
            None => title
                .element(Origin::path(file_name))
                .element(Level::NOTE.message(&*diagnostic.expected)),
        };
        if let Some(help) = &diagnostic.help {
            group = group.element(Level::HELP.message(&**help));
        }
        text.push_str(&renderer.render(&[group]));
        text.push_str("\n\n");
    }
    text
}

/// `text` with its control characters, and those that change the direction of writing, as escapes:
/// a terminal would obey them.
pub fn printable(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() || directs(c) {
            plain.extend(c.escape_default());
        } else {
            plain.push(c);
        }
    }
    plain
}

/// Characters that cannot be seen or that change the direction of writing.
fn directs(c: char) -> bool {
    matches!(
        c,
        '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}'
    )
}

/// `source` with such characters, and the control characters that TOML allows (U+0080 to U+009F,
/// among them one that begins a command to a terminal), replaced by others of the same length, so
/// that places stay what they are. The renderer sees to the rest.
fn masked(source: &str) -> String {
    let mask = |c: char| match c.len_utf8() {
        2 if c.is_control() => '·',
        3 if directs(c) => char::REPLACEMENT_CHARACTER,
        _ => c,
    };
    source.chars().map(mask).collect()
}

/// The beginning of `text`, with an ellipsis if that is not all of it.
pub(super) fn shortened(text: &str, longest: usize) -> String {
    match text.char_indices().nth(longest) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// A word of the author's, short enough for a message.
pub(super) fn word(text: &str) -> String {
    shortened(text, 60)
}

/// `span` in `source`, or the end of `source` if it is that of another text.
fn within(source: &str, span: &Range<usize>) -> Range<usize> {
    match source.get(span.clone()) {
        Some(_) => span.clone(),
        None => source.len()..source.len(),
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, mistake) in self.0.iter().enumerate() {
            let separator = if i == 0 { "" } else { "; " };
            write!(f, "{separator}{}: {}", mistake.message, mistake.expected)?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}
