//! Where names stand, and what all readers of the format ask of elements.

use super::frames::{Frames, MODEL};
use crate::element::Element;
use crate::pose::{Pose, V3, v3};
use crate::robot::GROUND;
use crate::source::{Fault, Read};

/// Where names stand.
#[derive(Debug, Clone)]
pub(super) struct Scope {
    /// What stands before full names: `outer::`, or nothing.
    pub(super) prefix: String,
    pub(super) version: [u32; 2],
    pub(super) is_static: bool,
}

impl Scope {
    /// The full name of the frame of its model.
    pub(super) fn model(&self) -> String {
        format!("{}{MODEL}", self.prefix)
    }
}

/// A gearbox is no joint but a relation of two others.
pub(super) fn is_gearbox(element: &Element) -> bool {
    element
        .attributes
        .iter()
        .any(|attribute| attribute.name == "type" && attribute.value.trim() == "gearbox")
}

/// The three numbers in a child.
pub(super) fn vector(element: &Element, name: &str) -> Read<V3> {
    let child = element.child(name).ok_or_else(|| missing(element, name))?;
    Ok(v3(child.content().numbers()?))
}

/// The refusal of an element without a child.
pub(super) fn missing(element: &Element, name: &str) -> Fault {
    element
        .fault(format!("`{}` has no <{name}>", element.name), format!("write <{name}>...</{name}>"))
}

/// The frame that a child names: the link with which it moves, the ground where that is the world, and where it is.
pub(super) fn placed(
    element: &Element,
    word: &str,
    scope: &Scope,
    frames: &Frames,
) -> Read<(usize, Pose)> {
    let child = element.child(word).ok_or_else(|| missing(element, word))?;
    let full = frames.full(&scope.prefix, child.text.trim(), child.at)?;
    Ok((frames.link(&full)?.unwrap_or(GROUND), frames.place(&full)?))
}

/// That link alone.
pub(super) fn link(element: &Element, word: &str, scope: &Scope, frames: &Frames) -> Read<usize> {
    placed(element, word, scope, frames).map(|(link, _)| link)
}
