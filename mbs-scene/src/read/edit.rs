//! Reading and replacing numbers of a scene file by their paths. A replacement keeps the rest of the text.

use super::sweep::path;
use super::tree::{Node, Span};
use super::values::Values;
use super::{Place, ReadError, ReadFault, SceneFile, SweepFault};
use mbs_core::scene::Number;
use std::path::Path;

impl SceneFile {
    /// Reads a scene file.
    ///
    /// # Errors
    /// [`ReadFault::Unreadable`], and the errors of [`Self::from_bytes`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        let (path, file) = (path.as_ref(), path.as_ref().display().to_string());
        match std::fs::read(path) {
            Ok(bytes) => Self::from_bytes_in(&bytes, &file, folder_of(path)),
            Err(error) => {
                let fault = ReadFault::Unreadable { problem: error.to_string() };
                Err(ReadError::new(&file, Place::of("", &(0..0)), fault))
            }
        }
    }

    /// The number at a path. Paths are those of sweeps: `body.upper.mass`, `joint."tie rod".points[0][2]` or `...points.0.2`.
    ///
    /// # Errors
    /// [`SweepFault`] for a path that leads to no value, or to a value that is not a number.
    pub fn number(&self, path: &str) -> Result<Number, SweepFault> {
        let address = path::address(self, path)?;
        self.number_at(&address).ok_or(SweepFault::PathSyntax("it names no finite number"))
    }

    /// The number at an address. If an expression is written there, the result is the value of the expression.
    pub(super) fn number_at(&self, address: &[usize]) -> Option<Number> {
        let item = path::item(self.root(), address)?;
        match &item.node {
            Node::Number(text) => Number::from_decimal(text),
            Node::Text(text) => {
                Some(Values::new(&self.texts, &self.root).ok()?.number(text, &item.span).ok()?.0)
            }
            _ => None,
        }
    }

    /// The file with another number at a path. The rest of its text remains, with its comments. When the file includes others, only the
    /// tree changes, and the texts do not.
    ///
    /// Cost: a copy of the text and the tree; nothing is parsed again.
    ///
    /// # Errors
    /// The errors of [`Self::number`], and an error for a number that is not finite.
    pub fn with_number(&self, path: &str, number: &Number) -> Result<Self, SweepFault> {
        if !number.to_f64().is_finite() {
            return Err(SweepFault::PathSyntax("the number is not finite"));
        }
        let address = path::address(self, path)?;
        if self.texts.list().len() > 1 {
            let mut file = self.clone();
            path::replace(file.root_mut(), &address, literal(&number.text()));
            file.note(&format!("{path} = {number}"));
            return Ok(file);
        }
        let span = path::span(self.root(), &address);
        let span = span.ok_or(SweepFault::PathSyntax("it names no number"))?;
        Ok(self.respelled(&address, &span, literal(&number.text())))
    }

    /// Returns the file with another number at an address. When the file is the only text of the scene, `old` has the bytes of the old number
    /// in it.
    fn respelled(&self, address: &[usize], old: &Span, new: String) -> Self {
        let mut file = self.clone();
        file.texts.replace(old.clone(), &new);
        let end = old.start + new.len();
        let moved = |byte: usize| if byte < old.end { byte } else { byte - old.end + end };
        file.root_mut().iter_mut().for_each(|member| member.move_spans(&moved));
        path::replace(file.root_mut(), address, new);
        file
    }
}

/// Text of a finite number as TOML and JSON require it: without a plus sign and leading zeros.
fn literal(text: &str) -> String {
    let (sign, digits) = match text.strip_prefix('-') {
        Some(digits) => ("-", digits),
        None => ("", text.strip_prefix('+').unwrap_or(text)),
    };
    let plain = digits.trim_start_matches('0');
    let is_whole = plain.starts_with(|c: char| c.is_ascii_digit());
    format!("{sign}{}{plain}", if is_whole { "" } else { "0" })
}

/// The folder of a file, empty for a file in the working directory.
fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// The text with the given parts replaced.
pub(crate) fn spliced(text: &str, mut edits: Vec<(Span, String)>) -> String {
    edits.sort_by_key(|(span, _)| span.start);
    let mut text = text.to_owned();
    for (span, new) in edits.into_iter().rev() {
        text.replace_range(span, &new);
    }
    text
}
