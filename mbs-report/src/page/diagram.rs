//! Diagrams of points, one number over another, as they go into a pack.

use super::section::DiagramFrame;
use serde::Serialize;

/// Look of the lines of one kind: distinguished by mark and dash as well as by colour.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Look {
    pub(crate) name: String,
    /// Number of the colour and mark.
    pub(crate) kind: usize,
    pub(crate) dash: usize,
    /// Are marks filled?
    pub(crate) is_filled: bool,
    pub(crate) is_thin: bool,
    pub(crate) is_shown: bool,
    /// Names of the buttons that show the line.
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
    /// Side of the rail: `top` or `right`; empty: there is none.
    pub(crate) rail: &'static str,
    /// A line through the points without marks: a histogram.
    pub(crate) is_plain: bool,
    /// Marks without a line through them.
    pub(crate) is_scatter: bool,
    /// Are the axes logarithmic, across and up?
    pub(crate) is_log: [bool; 2],
    /// Is the diagram as wide as the page, with the keys of all lines?
    pub(crate) has_keys: bool,
}

/// Points of one look.
#[derive(Debug, Default, Serialize)]
pub(crate) struct DiagramLine {
    /// Index of its look.
    pub(crate) look: usize,
    /// Points of the line: x, y, and what is said of them.
    pub(crate) points: Vec<(f64, f64, String)>,
    /// Runs that stopped: x or y along the rail, and why.
    pub(crate) failed: Vec<(f64, String)>,
    /// Note that the legend adds.
    pub(crate) note: String,
}

impl Diagram {
    /// Returns the frame of the diagram, by its number in the pack.
    pub(crate) fn frame(&self, number: usize) -> DiagramFrame {
        DiagramFrame {
            place: ("diagram", number),
            title: self.title.clone(),
            caption: self.caption.clone(),
            has_keys: self.has_keys,
        }
    }
}
