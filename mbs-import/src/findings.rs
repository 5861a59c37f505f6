//! Findings: what became of a model's elements.

use crate::source::{Origin, Sources};

/// Way in which an element came into the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FindingKind {
    /// In the form of something that acts nearly the same.
    Approximated,
    /// Not at all, and it could act.
    Ignored,
    /// Not at all, since it is for the eye alone.
    Appearance,
    /// Just as the file has it, where the format or what was asked for leaves a choice.
    Noted,
}

/// Finding that says what became of an element that is not in the scene as the file has it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ModelFinding {
    /// Way in which the element came into the scene.
    pub kind: FindingKind,
    /// Name of the file.
    pub file: String,
    /// Number of the line, from 1.
    pub line: usize,
    /// Number of the column, from 1.
    pub column: usize,
    /// Element with its path: `robot/joint[elbow]/limit`.
    pub element: String,
    /// Sentence that says what was done.
    pub says: String,
}

/// Findings while a model is read.
#[derive(Debug, Default, Clone)]
pub(crate) struct Findings(Vec<(FindingKind, Origin, String, String)>);

impl Findings {
    pub(crate) fn approximated(
        &mut self,
        at: Origin,
        element: impl Into<String>,
        says: impl Into<String>,
    ) {
        self.0.push((FindingKind::Approximated, at, element.into(), says.into()));
    }

    pub(crate) fn ignored(
        &mut self,
        at: Origin,
        element: impl Into<String>,
        says: impl Into<String>,
    ) {
        self.0.push((FindingKind::Ignored, at, element.into(), says.into()));
    }

    /// A choice that was made where the file leaves one.
    pub(crate) fn noted(
        &mut self,
        at: Origin,
        element: impl Into<String>,
        says: impl Into<String>,
    ) {
        self.0.push((FindingKind::Noted, at, element.into(), says.into()));
    }

    pub(crate) fn appearance(&mut self, at: Origin, element: impl Into<String>) {
        self.not_drawn(at, element, "");
    }

    /// Something that is for the eye, and why it is not drawn.
    pub(crate) fn not_drawn(
        &mut self,
        at: Origin,
        element: impl Into<String>,
        says: impl Into<String>,
    ) {
        self.0.push((FindingKind::Appearance, at, element.into(), says.into()));
    }

    /// All of them with their places, in the order of the files.
    pub(crate) fn list(mut self, sources: &Sources) -> Vec<ModelFinding> {
        self.0.sort_by_key(|(kind, at, ..)| (*kind, at.source, at.start));
        let list = self.0.into_iter().map(|(kind, at, element, says)| {
            let [line, column] = sources.line_and_column(at);
            let file = sources.name(at).to_owned();
            ModelFinding { kind, file, line, column, element, says }
        });
        list.collect()
    }
}
