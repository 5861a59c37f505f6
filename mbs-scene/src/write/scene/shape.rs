//! Writes the table `[[shape]]`.

use super::{Keys, Writer, list};
use crate::read::tree::Node;
use crate::write::WriteError;
use mbs_core::scene::{BodyShape, Number, ShapeKind};

impl Writer<'_> {
    pub(super) fn shape(self, shape: &BodyShape<Number>) -> Result<Keys, WriteError> {
        let mut keys = Keys::default();
        keys.push("name", shape.name.as_str());
        keys.push("body", self.body_name(shape.body)?);
        let mut form = Keys::default();
        match &shape.form {
            ShapeKind::Box { center, size, axes } => {
                form.push("center", self.vector(center));
                form.push("size", size);
                form.push_some("axes", axes.as_ref().map(|axes| self.two(axes)));
            }
            ShapeKind::Sphere { center, radius } | ShapeKind::Disc { center, radius } => {
                form.push("center", self.vector(center));
                form.push("radius", radius);
            }
            ShapeKind::Capsule { from, to, radius } | ShapeKind::Cylinder { from, to, radius } => {
                form.push("from", self.vector(from));
                form.push("to", self.vector(to));
                form.push("radius", radius);
            }
            ShapeKind::Mesh { file, at, axes, scale } => {
                form.push("file", file.as_str());
                form.push("at", self.vector(at));
                form.push_some("axes", axes.as_ref().map(|axes| self.two(axes)));
                form.push("scale", scale);
            }
            ShapeKind::Polygon { points } => {
                form.push("points", list(points.iter().map(|point| self.vector(point))));
            }
        }
        keys.push(shape.form.key(), form);
        keys.push_some("colour", shape.colour_code().as_deref());
        keys.push("opacity", &shape.opacity);
        if !shape.is_visual {
            keys.push("visual", Node::Bool(false));
        }
        Ok(keys)
    }
}
