//! Diagrams of points, one quantity over another, in the form in which a pack contains them.

use super::section::DiagramFrame;
use serde::Serialize;

/// Look of the lines of one kind. Lines differ by mark and dash as well as by colour.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Look {
    pub(crate) name: String,
    /// Index of the colour and of the mark.
    pub(crate) kind: usize,
    pub(crate) dash: usize,
    /// True if the marks of the line are filled.
    pub(crate) is_filled: bool,
    pub(crate) is_thin: bool,
    pub(crate) is_shown: bool,
    /// Names of the buttons that show or hide the line.
    pub(crate) groups: Vec<&'static str>,
}

/// Diagram of points and lines over two axes.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Diagram {
    pub(crate) title: String,
    /// Names of the axes with their units.
    pub(crate) axes: [String; 2],
    #[serde(skip)]
    pub(crate) caption: String,
    pub(crate) lines: Vec<DiagramLine>,
    /// Horizontal lines of the diagram: value and name.
    pub(crate) across: Vec<(f64, &'static str)>,
    /// Vertical lines of the diagram: value and name.
    pub(crate) upright: Vec<(f64, &'static str)>,
    /// Side of the diagram with a strip for failed runs: `top` or `right`; empty without a strip.
    pub(crate) rail: &'static str,
    /// True if the line is drawn without marks, as in a histogram.
    pub(crate) is_plain: bool,
    /// True if marks are drawn without a line.
    pub(crate) is_scatter: bool,
    /// True for each axis that is logarithmic: the horizontal, then the vertical axis.
    pub(crate) is_log: [bool; 2],
    /// True if the diagram is as wide as the page and has the keys of all lines.
    pub(crate) has_keys: bool,
}

/// Points of a line with one look.
#[derive(Debug, Default, Serialize)]
pub(crate) struct DiagramLine {
    /// Index of the line's look.
    pub(crate) look: usize,
    /// Points of the line: x, y, and the text of the tooltip.
    pub(crate) points: Vec<(f64, f64, String)>,
    /// Failed runs: the x or y value along the strip, and the reason.
    pub(crate) failed: Vec<(f64, String)>,
    /// Note for the line in the legend.
    pub(crate) note: String,
}

impl Diagram {
    /// Returns the frame of the diagram with its index in the pack.
    pub(crate) fn frame(&self, number: usize) -> DiagramFrame {
        DiagramFrame {
            place: ("diagram", number),
            title: self.title.clone(),
            caption: self.caption.clone(),
            has_keys: self.has_keys,
        }
    }
}
