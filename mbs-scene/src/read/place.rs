//! Places in a file: line, column, and the line itself.

use crate::read::tree::Span;

/// A place in a scene file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// Line, from 1.
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

    /// `file:line:column: message`, the line with carets under the offending text, and the hint.
    #[must_use]
    pub fn render(&self, file: &str, message: &str, hint: &str) -> String {
        let number = self.line.to_string();
        let margin = " ".repeat(number.len());
        // tabs stay tabs, so that the caret stands under its text in any terminal
        let indent: String = self
            .text
            .chars()
            .take(self.column - 1)
            .map(|c| if c == '\t' { '\t' } else { ' ' })
            .collect();
        let mut out = format!("{file}:{number}:{}: {message}\n", self.column);
        out += &format!("{number} | {}\n", self.text);
        out += &format!("{margin} | {indent}{}\n", "^".repeat(self.width));
        if !hint.is_empty() {
            out += &format!("hint: {hint}\n");
        }
        out
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
