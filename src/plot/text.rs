//! Text with subscripts and superscripts.
//!
//! Written as symbols stand elsewhere in this program: `K_py`, `10^5`, `m/s^2`. What follows `_`
//! or `^` is lowered or raised to the end of the word, or of braces.

use super::font;

/// Height of a piece of text on its line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// On the line.
    Base,
    /// Subscript.
    Lowered,
    /// Superscript.
    Raised,
}

/// Size of lowered and raised text, over that of the line.
pub(super) const SMALL: f64 = 0.72;

/// Pieces of text with their levels.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Text(pub Vec<(String, Level)>);

impl Text {
    /// Reads marked-up text.
    pub fn new(marked: &str) -> Self {
        let mut pieces: Vec<(String, Level)> = Vec::new();
        let mut push = |c: char, level: Level| match pieces.last_mut() {
            Some((text, last)) if *last == level => text.push(c),
            _ => pieces.push((c.into(), level)),
        };
        let mut characters = marked.chars().peekable();
        while let Some(c) = characters.next() {
            let (level, in_word): (Level, fn(char) -> bool) = match c {
                '_' => (Level::Lowered, |c| c.is_alphanumeric()),
                '^' => (Level::Raised, |c| {
                    c.is_ascii_digit() || c == '-' || c == '−'
                }),
                _ => {
                    push(c, Level::Base);
                    continue;
                }
            };
            if characters.peek() == Some(&'{') {
                characters.next();
                for c in characters.by_ref().take_while(|c| *c != '}') {
                    push(c, level);
                }
            } else {
                while let Some(c) = characters.next_if(|c| in_word(*c)) {
                    push(if c == '-' { '−' } else { c }, level);
                }
            }
        }
        Self(pieces)
    }

    /// Width at a font size, in the unit of the size.
    pub fn width(&self, size: f64) -> f64 {
        self.0
            .iter()
            .map(|(text, level)| {
                let size = match level {
                    Level::Base => size,
                    _ => SMALL * size,
                };
                font::width(text, size)
            })
            .sum()
    }

    /// Without levels.
    pub fn plain(&self) -> String {
        self.0.iter().map(|(text, _)| text.as_str()).collect()
    }
}

/// Width of marked-up text.
pub(super) fn width(marked: &str, size: f64) -> f64 {
    Text::new(marked).width(size)
}

/// Breaks marked-up text into lines no wider than `room`.
pub(super) fn wrap(marked: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in marked.split(' ') {
        match lines.last_mut() {
            Some(line) if width(&format!("{line} {word}"), size) <= room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.into()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_read() {
        let piece = |text: &str, level| (text.to_owned(), level);
        assert_eq!(
            Text::new("K_sψ = 10^-6 N m_{a b}").0,
            [
                piece("K", Level::Base),
                piece("sψ", Level::Lowered),
                piece(" = 10", Level::Base),
                piece("−6", Level::Raised),
                piece(" N m", Level::Base),
                piece("a b", Level::Lowered),
            ]
        );
        assert_eq!(Text::new("K_py").plain(), "Kpy");
    }

    #[test]
    fn lines_keep_to_their_room() {
        let text = "one two three four five six seven eight";
        let lines = wrap(text, 10.0, 60.0);
        assert!(lines.len() > 2 && lines.iter().all(|line| width(line, 10.0) <= 60.0));
        assert_eq!(lines.join(" "), text);
    }
}
