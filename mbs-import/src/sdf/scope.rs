//! Scopes of names, and functions that all parts of the SDF reader use.

use super::frames::{Frames, MODEL, WORLD};
use crate::element::{Attribute, Element};
use crate::pose::{Pose, V3, v3};
use crate::robot::GROUND;
use crate::source::{Fault, Read};

/// Name of the attribute with the version of an included model's file. No XML file can have such a name.
pub(super) const VERSION: &str = "version of its file";

/// Scope of names: the world or a model.
#[derive(Debug, Clone)]
pub(super) struct Scope {
    /// Prefix of full names, such as `outer::`; empty in the world.
    pub(super) prefix: String,
    pub(super) version: [u32; 2],
    pub(super) is_static: bool,
}

impl Scope {
    /// True if the scope is that of the world.
    pub(super) const fn is_world(&self) -> bool {
        self.prefix.is_empty()
    }

    /// The full name of the frame of the model, or of the world.
    pub(super) fn model(&self) -> String {
        if self.is_world() { WORLD.to_owned() } else { format!("{}{MODEL}", self.prefix) }
    }
}

/// The major and minor number of a version.
pub(super) fn version(attribute: &Attribute) -> Read<[u32; 2]> {
    let number = |text: Option<&str>| text.and_then(|text| text.trim().parse::<u32>().ok());
    let mut parts = attribute.value.split('.');
    match (number(parts.next()), number(parts.next())) {
        (Some(major), Some(minor)) => Ok([major, minor]),
        _ => Err(attribute
            .fault(format!("`{}` is no version", attribute.value), "write version=\"1.9\"")),
    }
}

/// True if the joint is a gearbox. A gearbox is a relation between two joints.
pub(super) fn is_gearbox(element: &Element) -> bool {
    element
        .attributes
        .iter()
        .any(|attribute| attribute.name == "type" && attribute.value.trim() == "gearbox")
}

/// The number in a child element, or `default` when there is no such child.
pub(super) fn number(element: &Element, name: &str, default: f64) -> Read<f64> {
    element.child(name).map_or(Ok(default), |child| child.content().number())
}

/// The three numbers in a child element.
pub(super) fn vector(element: &Element, name: &str) -> Read<V3> {
    let child = element.child(name).ok_or_else(|| missing(element, name))?;
    Ok(v3(child.content().numbers()?))
}

/// The error of an element that lacks a required child.
pub(super) fn missing(element: &Element, name: &str) -> Fault {
    element
        .fault(format!("`{}` has no <{name}>", element.name), format!("write <{name}>...</{name}>"))
}

/// The link to which the frame named in a child element is attached, and the frame's pose. For the world the link is the ground.
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

/// The link to which the frame named in a child element is attached.
pub(super) fn link(element: &Element, word: &str, scope: &Scope, frames: &Frames) -> Read<usize> {
    placed(element, word, scope, frames).map(|(link, _)| link)
}
