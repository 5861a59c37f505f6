//! The frames of models and of those in them, and their links.

use super::frames::{Frames, MODEL, Node, WORLD};
use super::pose::pose;
use super::scope::{Scope, VERSION, version};
use crate::context::Named;
use crate::element::Element;
use crate::pose::Pose;
use crate::robot::{Link, Robot};
use crate::source::{Read, Sources};

/// A model of the file with its scope.
pub(super) type Model<'a> = (&'a Element, Scope);

/// What is found so far.
pub(super) struct Collector<'a, 'r> {
    /// Inner models stand before those that they are in.
    pub(super) models: Vec<Model<'a>>,
    pub(super) frames: Frames,
    names: Named,
    robot: &'r mut Robot,
    sources: &'r Sources,
}

/// The full name of a name in a scope.
fn scoped(prefix: &str, name: &str) -> String {
    if name == WORLD { name.to_owned() } else { format!("{prefix}{name}") }
}

/// The value of an attribute that is not empty.
fn filled<'a>(element: &'a Element, name: &str) -> Option<&'a str> {
    element.value(name).filter(|value| !value.is_empty())
}

impl<'a, 'r> Collector<'a, 'r> {
    pub(super) fn new(robot: &'r mut Robot, sources: &'r Sources) -> Self {
        let names = Named::new("link", 1);
        Self { models: Vec::new(), frames: Frames::default(), names, robot, sources }
    }

    /// A model, which stands in the frame `outer`, with all that is in it.
    pub(super) fn model(&mut self, model: &'a Element, mut scope: Scope, outer: &str) -> Read<()> {
        if let Some(number) = model.attribute(VERSION) {
            scope.version = version(number)?;
        }
        if let Some(flag) = model.child("static") {
            scope.is_static |= flag.content().flag()?;
        }
        let prefix = scope.prefix.clone();
        let (own, in_frame) = pose(model)?;
        let around = outer.strip_suffix(MODEL).unwrap_or("");
        let relative_to = in_frame.map_or_else(|| outer.to_owned(), |name| scoped(around, name));
        let mut first = self.links(model, &prefix)?;
        self.named_frames(model, &prefix)?;
        self.joints(model, &prefix)?;
        for inner in model.each("model") {
            let inside = format!("{prefix}{}::", inner.need("name")?.value);
            first.get_or_insert(format!("{inside}{MODEL}"));
            self.model(inner, Scope { prefix: inside, ..scope.clone() }, &scope.model())?;
        }
        let canonical = filled(model, "canonical_link").map(|name| format!("{prefix}{name}"));
        let attached_to = canonical.or(first);
        let mut node = Node { at: model.at, relative_to, pose: own, attached_to, link: None };
        if let Some(placement) = filled(model, "placement_frame") {
            // the pose is that of this frame: the model's follows from where the frame is in the model
            let alone = Node { relative_to: WORLD.into(), pose: Pose::identity(), ..node.clone() };
            self.frames.add(scope.model(), alone);
            let inner =
                self.frames.alone(&format!("{prefix}{placement}"), &scope.model(), model.at)?;
            node.pose = own.then(&inner.inverse());
        }
        self.frames.add(scope.model(), node);
        self.models.push((model, scope));
        Ok(())
    }

    /// The name of the first link.
    fn links(&mut self, model: &Element, prefix: &str) -> Read<Option<String>> {
        let mut first = None;
        for element in model.each("link") {
            let name = format!("{prefix}{}", element.need("name")?.value);
            let number = self.names.add(&name, element.at, self.sources)?;
            first.get_or_insert_with(|| name.clone());
            let (pose, in_frame) = pose(element)?;
            let relative_to = scoped(prefix, in_frame.unwrap_or(MODEL));
            let node =
                Node { at: element.at, relative_to, pose, attached_to: None, link: Some(number) };
            self.frames.add(name.clone(), node);
            self.robot.links.push(Link {
                name,
                at: element.at,
                pose: Pose::identity(),
                mass: None,
            });
        }
        Ok(first)
    }

    fn named_frames(&mut self, model: &Element, prefix: &str) -> Read<()> {
        for element in model.each("frame") {
            let attached = filled(element, "attached_to").unwrap_or(MODEL);
            self.hung(element, prefix, scoped(prefix, attached))?;
        }
        Ok(())
    }

    fn joints(&mut self, model: &Element, prefix: &str) -> Read<()> {
        for element in model.each("joint") {
            let child = element.children.iter().find(|child| child.name == "child");
            let child = child.map_or("", |child| child.text.trim());
            self.hung(element, prefix, scoped(prefix, child))?;
        }
        Ok(())
    }

    /// A frame that moves with another one, and stands in it unless its pose says otherwise.
    fn hung(&mut self, element: &Element, prefix: &str, on: String) -> Read<()> {
        let name = format!("{prefix}{}", element.need("name")?.value);
        let (pose, in_frame) = pose(element)?;
        let relative_to = in_frame.map_or_else(|| on.clone(), |name| scoped(prefix, name));
        let node = Node { at: element.at, relative_to, pose, attached_to: Some(on), link: None };
        self.frames.add(name, node);
        Ok(())
    }
}
