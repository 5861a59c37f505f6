//! The texts of a scene: its file, the included files, and values from a command line.

use super::tree::Span;
use super::{Place, ReadError, ReadFault};
use std::path::PathBuf;

/// The texts of a scene, its file first. Bytes are numbered through all texts, so that a span identifies its text.
#[derive(Debug, Clone, Default)]
pub(crate) struct Texts(Vec<Text>);

/// One of the texts of a scene.
#[derive(Debug, Clone, Default)]
pub(crate) struct Text {
    /// Name of the text in messages.
    pub(crate) name: String,
    pub(crate) text: String,
    /// Number of the first byte of the text, counted through all texts.
    pub(crate) start: usize,
    /// Prefix of all names of this text.
    pub(crate) prefix: String,
    /// Bytes of the table that includes the text.
    pub(crate) by: Option<Span>,
    /// True if the text is a file, not a value from a command line.
    pub(crate) is_file: bool,
    /// True if the text is a CSV file with the rows of a table.
    pub(crate) is_table: bool,
    /// Folder to which relative paths in the text refer. `None` stands for the working directory.
    pub(crate) folder: Option<PathBuf>,
}

impl Texts {
    /// Returns a list of texts that has one text.
    pub(crate) fn new(name: &str, text: &str, folder: Option<PathBuf>) -> Self {
        let mut texts = Self::default();
        texts.add(Text {
            name: name.to_owned(),
            text: text.to_owned(),
            is_file: true,
            folder,
            ..Text::default()
        });
        texts
    }

    /// Adds a text and returns the byte at which it begins.
    pub(crate) fn add(&mut self, text: Text) -> usize {
        // One byte is left between two texts, so that the end of one differs from the beginning of the next.
        let start = self.0.last().map_or(0, |last| last.start + last.text.len() + 1);
        self.0.push(Text { start, ..text });
        start
    }

    /// Replaces some bytes of the file, if the file is the only text.
    pub(crate) fn replace(&mut self, span: Span, new: &str) {
        if let [main] = &mut self.0[..] {
            main.text.replace_range(span, new);
        }
    }

    pub(crate) fn list(&self) -> &[Text] {
        &self.0
    }

    /// Number of bytes of all texts.
    pub(crate) fn len(&self) -> usize {
        self.0.last().map_or(0, |last| last.start + last.text.len())
    }

    /// The text of the scene's file.
    pub(crate) fn main(&self) -> &Text {
        const NONE: &Text = &Text {
            name: String::new(),
            text: String::new(),
            start: 0,
            prefix: String::new(),
            by: None,
            is_file: true,
            is_table: false,
            folder: None,
        };
        self.0.first().unwrap_or(NONE)
    }

    /// The text to which a span belongs.
    pub(crate) fn of(&self, span: &Span) -> &Text {
        let after = self.0.partition_point(|text| text.start <= span.start);
        self.0.get(after.wrapping_sub(1)).unwrap_or_else(|| self.main())
    }

    /// A relative path written at a span, made absolute from the folder of its text. Without a folder it is returned unchanged.
    pub(crate) fn path(&self, span: &Span, written: &str) -> String {
        let Some(folder) = &self.of(span).folder else { return written.to_owned() };
        let joined = folder.join(written);
        std::path::absolute(&joined).unwrap_or(joined).display().to_string()
    }

    /// The text of a span, then the text that includes it, and so on up to the file.
    pub(crate) fn outwards<'a>(&'a self, span: &Span) -> impl Iterator<Item = &'a Text> {
        let outer = |text: &&'a Text| text.by.as_ref().map(|span| self.of(span));
        core::iter::successors(Some(self.of(span)), outer)
    }

    /// The text at a span, exactly as in the file.
    pub(crate) fn written(&self, span: &Span) -> Option<&str> {
        let text = self.of(span);
        text.text.get(span.start.checked_sub(text.start)?..span.end.checked_sub(text.start)?)
    }

    /// The name of the file and the place of a span in it.
    pub(crate) fn place(&self, span: &Span) -> (&str, Place) {
        let text = self.of(span);
        let [start, end] = [span.start, span.end].map(|byte| byte.saturating_sub(text.start));
        (&text.name, Place::of(&text.text, &(start..end)))
    }

    pub(crate) fn error(&self, span: &Span, fault: ReadFault) -> ReadError {
        let (file, place) = self.place(span);
        ReadError::new(file, place, fault).included(self.includes(span))
    }

    /// A line for each file that includes the text of a span, from the inside outwards.
    fn includes(&self, span: &Span) -> Vec<String> {
        let line = |text: &Text| {
            let (file, place) = self.place(text.by.as_ref()?);
            if text.is_table {
                return Some(format!("for the table at {file}:{}", place.line));
            }
            // The prefix of this text begins with the prefixes of the outer includes, which are left out here.
            let outer = text.by.as_ref().map_or("", |by| &self.of(by).prefix);
            let prefix = text.prefix.strip_prefix(outer).unwrap_or(&text.prefix);
            Some(format!("included from {file}:{} as \"{prefix}\"", place.line))
        };
        self.outwards(span).map_while(line).collect()
    }
}
