//! URDF files that an SDF includes in place of a model.

use super::frames::Frames;
use crate::context::Context;
use crate::element::{Attribute, Element};
use crate::robot::Robot;
use crate::source::{Origin, Read};
use crate::unread::unread;
use crate::urdf::{self, Tree};

/// Name of the element that contains a URDF in a model. No XML file can have such a name.
const URDF: &str = "model of a URDF";

/// A model element that contains a URDF, given by its root element.
pub(super) fn model(root: Element) -> Element {
    let name = root.attribute("name").cloned();
    let unnamed = Attribute::new("name".to_owned(), "robot".to_owned(), root.at);
    let mut model = Element::new("model".to_owned(), root.at, vec![name.unwrap_or(unnamed)]);
    let mut around = Element::new(URDF.to_owned(), root.at, Vec::new());
    around.children.push(root);
    model.children.push(around);
    model
}

/// The root element of the URDF in a model, if it contains one.
pub(super) fn root(model: &Element) -> Option<&Element> {
    model.child(URDF)?.child("robot")
}

/// True if a model contains a URDF.
pub(super) fn is_part(model: &Element) -> bool {
    model.children.iter().any(|child| child.name == URDF)
}

/// A URDF in place of a model.
pub(super) struct Part<'a> {
    root: &'a Element,
    tree: Tree,
    /// The full name of the model's frame.
    model: String,
}

impl<'a> Part<'a> {
    /// Reads links and joints. `model` is the full name of the model's frame, and `prefix` precedes the names in the scene.
    pub(super) fn read(
        root: &'a Element,
        (model, prefix): (String, String),
        robot: &mut Robot,
        context: &Context<'_>,
    ) -> Read<Self> {
        let tree = Tree::read(root, &prefix, robot, context)?;
        Ok(Self { root, tree, model })
    }

    /// Names of its links in the URDF, with their indices.
    pub(super) fn links(&self) -> Vec<(String, usize)> {
        self.tree.links()
    }

    /// The joints: name and place in the URDF, and the name of the child link.
    pub(super) fn joints(&self) -> Vec<(String, Origin, String)> {
        self.tree.joints()
    }

    /// Name of its root link in the URDF.
    pub(super) fn trunk(&self) -> &str {
        self.tree.name(self.tree.trunk)
    }

    /// Index of its root link.
    pub(super) const fn trunk_link(&self) -> usize {
        self.tree.trunk
    }

    /// Adds its joints, shapes and laws to the robot, at the place of its model.
    pub(super) fn add(
        self,
        frames: &Frames,
        robot: &mut Robot,
        context: &mut Context<'_>,
    ) -> Read<()> {
        let place = frames.place(&self.model)?;
        if frames.is_still(self.tree.trunk) {
            self.tree.add_still(self.root, &place, robot, context)?;
        } else {
            self.tree.add(self.root, &place, robot, context)?;
        }
        unread(self.root, urdf::TABLE, &mut context.findings);
        self.root.read_whole();
        Ok(())
    }
}
