//! Places in a text: line, column, and the text of the line.

use crate::read::tree::Span;
use core::ops::Range;

/// A place in a scene file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// Number of the line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Length of the faulty text in characters, at least 1 and within the line.
    pub width: usize,
    /// Text of the line, without its line feed.
    pub text: String,
}

impl Place {
    /// The place of a range of bytes in a text.
    #[must_use]
    pub fn at(text: &str, bytes: Range<usize>) -> Self {
        Self::of(text, &bytes)
    }

    pub(crate) fn of(text: &str, span: &Span) -> Self {
        let start = boundary(text, span.start);
        let end = boundary(text, span.end.max(start));
        let before = &text[..start];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |i| start + i);
        Self {
            line: before.matches('\n').count() + 1,
            column: text[line_start..start].chars().count() + 1,
            width: text[start..end.min(line_end)].trim_end().chars().count().max(1),
            text: text[line_start..line_end].trim_end_matches('\r').to_owned(),
        }
    }

    /// Formats a message: `file:line:column: message`, the line with carets below the faulty text, and the hint.
    #[must_use]
    pub fn render(&self, file: &str, message: &str, hint: &str) -> String {
        let Self { column, width, text, .. } = &self.shortened();
        let number = self.line.to_string();
        let margin = " ".repeat(number.len());
        // Tabs remain tabs, so that the carets are below their text in any terminal.
        let indent: String =
            text.chars().take(column - 1).map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
        let mut out = format!("{file}:{number}:{}: {message}\n", self.column);
        out += &format!("{number} | {text}\n");
        out += &format!("{margin} | {indent}{}\n", "^".repeat(*width));
        if !hint.is_empty() {
            out += &format!("hint: {hint}\n");
        }
        out
    }

    /// Returns the place for display, without control characters. A long line is cut to the surroundings of the faulty text.
    fn shortened(&self) -> Self {
        /// Largest length of a line that is shown [characters]: the width of a terminal.
        const MAX_WIDTH: usize = 120;
        /// Length of the text before the faulty text, in a line that is cut [characters].
        const BEFORE: usize = 40;
        let plain = |c: char| if c.is_control() && c != '\t' { '\u{fffd}' } else { c };
        let n = self.text.chars().count();
        if n <= MAX_WIDTH {
            return Self { text: self.text.chars().map(plain).collect(), ..self.clone() };
        }
        let first = (self.column - 1).saturating_sub(BEFORE);
        let (head, tail) =
            (if first > 0 { "..." } else { "" }, if first + MAX_WIDTH < n { "..." } else { "" });
        let cut: String = self.text.chars().skip(first).take(MAX_WIDTH).map(plain).collect();
        let column = self.column - first + head.len();
        let width = self.width.min(MAX_WIDTH + head.len() + 1 - column.min(MAX_WIDTH)).max(1);
        Self { line: self.line, column, width, text: format!("{head}{cut}{tail}") }
    }
}

/// The nearest character boundary at or before a byte.
fn boundary(text: &str, byte: usize) -> usize {
    let mut byte = byte.min(text.len());
    while !text.is_char_boundary(byte) {
        byte -= 1;
    }
    byte
}
