//! Texts of a model, and places in these texts.

use mbs_scene::{Place, ReadError};
use std::path::{Path, PathBuf};

/// Largest total length of a file and its includes [bytes]. An element takes a few hundred bytes of memory.
pub(crate) const MOST_BYTES: usize = 64 << 20;

/// A range of bytes in one of the texts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Origin {
    /// Index of the text.
    pub(crate) source: u16,
    /// First byte of the range.
    pub(crate) start: u32,
    /// Byte after the last byte of the range.
    pub(crate) end: u32,
}

impl Origin {
    /// The beginning of a text, as an empty range.
    pub(crate) const fn start_of(source: u16) -> Self {
        Self { source, start: 0, end: 0 }
    }
}

/// Error of a model: a place, a message, and a hint.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Fault {
    pub(crate) at: Origin,
    pub(crate) message: String,
    pub(crate) hint: String,
}

/// Result of a reader: a part of the model, or an error.
pub(crate) type Read<T> = Result<T, Fault>;

impl Fault {
    pub(crate) fn new(at: Origin, message: impl Into<String>, hint: impl Into<String>) -> Self {
        Self { at, message: message.into(), hint: hint.into() }
    }
}

/// A text with the name of its file.
#[derive(Debug, Clone)]
struct Source {
    name: String,
    text: String,
    /// Place of the include in another text; `None` for the model's file.
    by: Option<Origin>,
    /// First byte of each line.
    lines: Vec<usize>,
}

/// The texts of a model: its file, then the included files.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sources(Vec<Source>);

impl Sources {
    /// Adds a text and returns its number.
    pub(crate) fn add(&mut self, name: &str, text: &str, by: Option<Origin>) -> u16 {
        let lines =
            core::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        self.0.push(Source { name: name.to_owned(), text: text.to_owned(), by, lines });
        u16::try_from(self.0.len() - 1).unwrap_or(u16::MAX)
    }

    /// Name of the file with a place.
    pub(crate) fn name(&self, at: Origin) -> &str {
        &self.source(at).name
    }

    /// The path of a file in the folder of the text with place `at`. `None` for the model's file, whose folder is in the options.
    pub(crate) fn beside(&self, at: Origin, file: &Path) -> Option<PathBuf> {
        (at.source > 0).then(|| Path::new(self.name(at)).with_file_name(file))
    }

    /// Line and column of a place, both from 1.
    pub(crate) fn line_and_column(&self, at: Origin) -> [usize; 2] {
        let Source { text, lines, .. } = self.source(at);
        let byte = (at.start as usize).min(text.len());
        let line = lines.partition_point(|start| *start <= byte);
        let start = lines[line - 1];
        [line, text.get(start..byte).map_or(1, |before| before.chars().count() + 1)]
    }

    /// Line, column and text of the line of a place.
    pub(crate) fn place(&self, at: Origin) -> Place {
        Place::at(&self.source(at).text, at.start as usize..at.end as usize)
    }

    /// The error in the form that the reader of scenes returns.
    pub(crate) fn error(&self, fault: Fault) -> ReadError {
        let mut by = Vec::new();
        let mut outer = self.source(fault.at).by;
        while let Some(at) = outer {
            by.push(format!("included from {}:{}", self.name(at), self.place(at).line));
            outer = self.source(at).by;
        }
        let place = self.place(fault.at);
        ReadError::of_model(self.name(fault.at), place, fault.message, fault.hint, by)
    }

    fn source(&self, at: Origin) -> &Source {
        &self.0[usize::from(at.source)]
    }
}
