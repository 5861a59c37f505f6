//! Collects the frames of the world and of all models, with their links.

use super::frames::{Frames, MODEL, Node, WORLD};
use super::part::{self, Part};
use super::pose::pose;
use super::scope::{Scope, VERSION, version};
use crate::context::{Context, Named};
use crate::element::Element;
use crate::pose::Pose;
use crate::robot::{Link, Robot};
use crate::source::Read;
use std::collections::HashSet;

/// The world or a model of the file, with its scope.
pub(super) type Model<'a> = (&'a Element, Scope);

/// Collector of models, frames, links and joints.
pub(super) struct Collector<'a, 'r, 'c> {
    /// Models found so far; inner models come before the models that contain them.
    pub(super) models: Vec<Model<'a>>,
    /// Models that are URDF files.
    pub(super) parts: Vec<Part<'a>>,
    pub(super) frames: Frames,
    link_names: Named,
    joint_names: Named,
    /// Names of joints in the scene.
    shown: HashSet<String>,
    robot: &'r mut Robot,
    context: &'r Context<'c>,
}

/// The full name of a name in the scope with this prefix.
fn scoped(prefix: &str, name: &str) -> String {
    if name == WORLD { name.to_owned() } else { format!("{prefix}{name}") }
}

/// The value of an attribute, if it exists and is not empty.
fn filled<'a>(element: &'a Element, name: &str) -> Option<&'a str> {
    element.value(name).filter(|value| !value.is_empty())
}

impl<'a, 'r, 'c> Collector<'a, 'r, 'c> {
    /// A collector without frames. `hidden` is the prefix that names in the scene leave out.
    pub(super) fn new(hidden: String, robot: &'r mut Robot, context: &'r Context<'c>) -> Self {
        Self {
            models: Vec::new(),
            parts: Vec::new(),
            frames: Frames::new(hidden),
            link_names: Named::new("link", 1),
            joint_names: Named::new("joint", 0),
            shown: HashSet::new(),
            robot,
            context,
        }
    }

    /// Adds the frames and joints of the world, after all models.
    pub(super) fn world(&mut self, world: &'a Element, scope: Scope) -> Read<()> {
        self.named_frames(world, &scope)?;
        self.joints(world, &scope)?;
        self.models.push((world, scope));
        Ok(())
    }

    /// Adds a model with everything in it; its pose is relative to the frame `outer`.
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
        let mut first = self.links(model, &scope)?;
        self.named_frames(model, &scope)?;
        self.joints(model, &scope)?;
        if let Some(root) = part::root(model) {
            first = Some(self.part(root, &scope)?);
        }
        for inner in model.each("model") {
            let inside = format!("{prefix}{}::", inner.need("name")?.value);
            first.get_or_insert(format!("{inside}{MODEL}"));
            self.model(inner, Scope { prefix: inside, ..scope.clone() }, &scope.model())?;
        }
        let canonical = filled(model, "canonical_link").map(|name| format!("{prefix}{name}"));
        let attached_to = canonical.or(first);
        let mut node = Node { at: model.at, relative_to, pose: own, attached_to, link: None };
        if let Some(placement) = filled(model, "placement_frame") {
            // The `pose` in the file is that of the placement frame. The pose of the model follows from it and from the pose of that frame
            // within the model.
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

    /// Adds the links of a model, and returns the name of the first one.
    fn links(&mut self, model: &Element, scope: &Scope) -> Read<Option<String>> {
        let mut first = None;
        for element in model.each("link") {
            let name = format!("{}{}", scope.prefix, element.need("name")?.value);
            let (pose, in_frame) = pose(element)?;
            let relative_to = scoped(&scope.prefix, in_frame.unwrap_or(MODEL));
            let number = self.robot.links.len();
            let link = Link::new(self.frames.plain(&name), element.at);
            self.robot.links.push(link);
            let node =
                Node { at: element.at, relative_to, pose, attached_to: None, link: Some(number) };
            self.link(&name, node, scope)?;
            first.get_or_insert(name);
        }
        Ok(first)
    }

    /// Adds the frame of a link, and marks the links of static models.
    fn link(&mut self, name: &str, node: Node, scope: &Scope) -> Read<()> {
        self.link_names.add(self.frames.plain(name), node.at, &self.context.sources)?;
        if let (true, Some(number)) = (scope.is_static, node.link) {
            self.frames.add_still(number);
        }
        self.frames.add(name.to_owned(), node);
        Ok(())
    }

    fn named_frames(&mut self, model: &Element, scope: &Scope) -> Read<()> {
        let own = if scope.is_world() { WORLD } else { MODEL };
        for element in model.each("frame") {
            let attached = filled(element, "attached_to").unwrap_or(own);
            let name = format!("{}{}", scope.prefix, element.need("name")?.value);
            let node = self.hung(element, scope, scoped(&scope.prefix, attached))?;
            self.frames.add(name, node);
        }
        Ok(())
    }

    fn joints(&mut self, model: &Element, scope: &Scope) -> Read<()> {
        for element in model.each("joint") {
            let child = element.children.iter().find(|child| child.name == "child");
            let child = child.map_or("", |child| child.text.trim());
            let name = format!("{}{}", scope.prefix, element.need("name")?.value);
            let node = self.hung(element, scope, scoped(&scope.prefix, child))?;
            self.joint(name, node)?;
        }
        Ok(())
    }

    /// Adds the frame of a joint, and finds the joint's name in the scene.
    fn joint(&mut self, name: String, node: Node) -> Read<()> {
        let plain = self.frames.plain(&name);
        // A joint of the world and a joint of the only model may have the same name.
        let is_taken = !self.shown.insert(plain.to_owned());
        let shown = if is_taken { format!("{WORLD}::{plain}") } else { plain.to_owned() };
        self.joint_names.add(&name, node.at, &self.context.sources)?;
        self.frames.add_joint(name, shown, node);
        Ok(())
    }

    /// A frame that is attached to the frame `on`. Its pose is relative to `on`, unless the element names another frame.
    fn hung(&self, element: &Element, scope: &Scope, on: String) -> Read<Node> {
        let (pose, in_frame) = pose(element)?;
        let relative_to = in_frame.map_or_else(|| on.clone(), |name| scoped(&scope.prefix, name));
        Ok(Node { at: element.at, relative_to, pose, attached_to: Some(on), link: None })
    }

    /// Adds a URDF in place of a model, and returns the full name of its root link.
    fn part(&mut self, root: &'a Element, scope: &Scope) -> Read<String> {
        let (model, shown) = (scope.model(), self.frames.plain(&scope.prefix).to_owned());
        let part = Part::read(root, (model.clone(), shown), self.robot, self.context)?;
        for (name, number) in part.links() {
            let Link { at, pose, .. } = self.robot.links[number];
            let (relative_to, link) = (model.clone(), Some(number));
            let node = Node { at, relative_to, pose, attached_to: None, link };
            self.link(&format!("{}{name}", scope.prefix), node, scope)?;
        }
        for (name, at, child) in part.joints() {
            let on = format!("{}{child}", scope.prefix);
            let attached_to = Some(on.clone());
            let node =
                Node { at, relative_to: on, pose: Pose::identity(), attached_to, link: None };
            self.joint(format!("{}{name}", scope.prefix), node)?;
        }
        let trunk = format!("{}{}", scope.prefix, part.trunk());
        self.parts.push(part);
        Ok(trunk)
    }
}
