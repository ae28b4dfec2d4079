//! Mistakes in a spec, shown where they stand.

use std::fmt;
use std::ops::Range;

use annotate_snippets::{AnnotationKind, Level, Origin, Renderer, Snippet};

/// One mistake in a spec.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// Where it stands, in bytes of the source; `None` if it is something missing altogether.
    pub span: Option<Range<usize>>,
    /// What is wrong.
    pub message: String,
    /// What was expected.
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

/// All mistakes of a spec, in the order of its lines.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostics(Vec<Diagnostic>);

impl Diagnostics {
    pub(super) fn new(mut mistakes: Vec<Diagnostic>) -> Self {
        mistakes.sort_by_key(|d| d.span.as_ref().map_or(usize::MAX, |span| span.start));
        Self(mistakes)
    }

    /// The mistakes.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.0.iter()
    }

    /// The mistakes with the lines where they stand, for a terminal.
    ///
    /// `source` is the text that was parsed, `file_name` how the reader knows it.
    pub fn render(&self, file_name: &str, source: &str, colour: bool) -> String {
        let renderer = if colour {
            Renderer::styled()
        } else {
            Renderer::plain()
        };
        let mut text = String::new();
        for mistake in &self.0 {
            let mut group = match &mistake.span {
                Some(span) => Level::ERROR.primary_title(&*mistake.message).element(
                    Snippet::source(source).path(file_name).annotation(
                        AnnotationKind::Primary
                            .span(within(source, span))
                            .label(&*mistake.expected),
                    ),
                ),
                None => Level::ERROR
                    .primary_title(&*mistake.message)
                    .element(Origin::path(file_name))
                    .element(Level::NOTE.message(&*mistake.expected)),
            };
            if let Some(help) = &mistake.help {
                group = group.element(Level::HELP.message(&**help));
            }
            text.push_str(&renderer.render(&[group]));
            text.push_str("\n\n");
        }
        let count = self.0.len();
        let noun = if count == 1 { "mistake" } else { "mistakes" };
        text + &format!("{count} {noun} in {file_name}\n")
    }
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
