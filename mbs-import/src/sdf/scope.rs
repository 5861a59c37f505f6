//! Scopes of names, and what all readers of the format ask of elements.

use super::frames::{Frames, MODEL, WORLD};
use crate::element::{Attribute, Element};
use crate::pose::{Pose, V3, v3};
use crate::robot::GROUND;
use crate::source::{Fault, Read};

/// The attribute in which a model of another file keeps the version of that file; no file can write such a name.
pub(super) const VERSION: &str = "version of its file";

/// Scope in which names stand.
#[derive(Debug, Clone)]
pub(super) struct Scope {
    /// Prefix of full names: `outer::`, or in the world nothing.
    pub(super) prefix: String,
    pub(super) version: [u32; 2],
    pub(super) is_static: bool,
}

impl Scope {
    /// Is it that of the world, and of no model?
    pub(super) const fn is_world(&self) -> bool {
        self.prefix.is_empty()
    }

    /// The full name of the frame of its model, or of the world.
    pub(super) fn model(&self) -> String {
        if self.is_world() { WORLD.to_owned() } else { format!("{}{MODEL}", self.prefix) }
    }
}

/// The two numbers of a version.
pub(super) fn version(attribute: &Attribute) -> Read<[u32; 2]> {
    let number = |text: Option<&str>| text.and_then(|text| text.trim().parse::<u32>().ok());
    let mut parts = attribute.value.split('.');
    match (number(parts.next()), number(parts.next())) {
        (Some(major), Some(minor)) => Ok([major, minor]),
        _ => Err(attribute
            .fault(format!("`{}` is no version", attribute.value), "write version=\"1.9\"")),
    }
}

/// A gearbox is no joint but a relation of two others.
pub(super) fn is_gearbox(element: &Element) -> bool {
    element
        .attributes
        .iter()
        .any(|attribute| attribute.name == "type" && attribute.value.trim() == "gearbox")
}

/// The number in a child, or what stands for it.
pub(super) fn number(element: &Element, name: &str, default: f64) -> Read<f64> {
    element.child(name).map_or(Ok(default), |child| child.content().number())
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

/// The link of the frame that a child names.
pub(super) fn link(element: &Element, word: &str, scope: &Scope, frames: &Frames) -> Read<usize> {
    placed(element, word, scope, frames).map(|(link, _)| link)
}
