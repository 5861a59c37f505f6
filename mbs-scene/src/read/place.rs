//! Places in a file: line, column, and the line itself.

use crate::read::tree::Span;
use core::ops::Range;

/// A place in a scene file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// Number of the line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Characters of the offending text, at least 1 and within the line.
    pub width: usize,
    /// The whole line, without its end.
    pub text: String,
}

impl Place {
    /// The place of some bytes of a text.
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

    /// Renders a message: `file:line:column: message`, the line with carets under the offending text, and the hint.
    #[must_use]
    pub fn render(&self, file: &str, message: &str, hint: &str) -> String {
        let Self { column, width, text, .. } = &self.shortened();
        let number = self.line.to_string();
        let margin = " ".repeat(number.len());
        // tabs stay tabs, so that the caret stands under its text in any terminal
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

    /// Returns the place for a screen: without control characters, and long lines cut to what surrounds the offending text.
    fn shortened(&self) -> Self {
        /// Most letters of a line that is shown: the width of a terminal.
        const MAX_WIDTH: usize = 120;
        /// Letters that are shown before the offending text, of a line that is cut.
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
