//! Findings: differences between the elements of a model and the scene.

use crate::source::{Origin, Sources};

/// Kind of difference between an element and the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FindingKind {
    /// The scene has something that acts nearly like the element.
    Approximated,
    /// The scene does not have the element, which could affect the motion.
    Ignored,
    /// The scene does not have the element, which is for pictures only.
    Appearance,
    /// The scene has the element exactly; the finding reports a choice that the format or the options leave open.
    Noted,
}

/// Finding about an element that the scene does not have exactly as the file does.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ModelFinding {
    /// Kind of the difference.
    pub kind: FindingKind,
    /// Name of the file.
    pub file: String,
    /// Number of the line, from 1.
    pub line: usize,
    /// Number of the column, from 1.
    pub column: usize,
    /// Element with its path: `robot/joint[elbow]/limit`.
    pub element: String,
    /// Sentence that describes what the import did.
    pub says: String,
}

/// List of findings while a model is read.
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

    /// Adds a choice that the import made where the file leaves it open.
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

    /// Adds an element for pictures that is not drawn, with the reason.
    pub(crate) fn not_drawn(
        &mut self,
        at: Origin,
        element: impl Into<String>,
        says: impl Into<String>,
    ) {
        self.0.push((FindingKind::Appearance, at, element.into(), says.into()));
    }

    /// All findings with their places, sorted by kind and then in the order of the files.
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
