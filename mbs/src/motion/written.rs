//! Shapes that the scene writes.

use super::drawing::Drawing;
use super::pose::frame;
use crate::record::{DrawnShape, ShapeForm};
use mbs_core::Real;
use mbs_core::scene::{BodyShape, ShapeKind};

/// Width of a disc of the plane, relative to its radius [-].
const DISC_WIDTH: f64 = 0.05;

impl<T: Real> Drawing<'_, T> {
    /// A shape of the scene as it is drawn.
    pub(super) fn shape(&self, shape: &BodyShape<T>) -> DrawnShape {
        let place = |at: [T; 3]| self.place(shape.body, at).at;
        let form = match &shape.form {
            ShapeKind::Box { center, size, axes } => ShapeForm::Box {
                at: place(*center),
                half: size.map(|length| 0.5 * length.to_f64()),
                axes: axes.map_or(GLOBAL, |axes| frame(axes.map(|axis| axis.map(Real::to_f64)))),
                is_clear: false,
            },
            ShapeKind::Sphere { center, radius } => {
                ShapeForm::Ball { at: place(*center), radius: radius.to_f64(), turns: false }
            }
            ShapeKind::Capsule { from, to, radius } => ShapeForm::Capsule {
                from: place(*from),
                to: place(*to),
                radius: radius.to_f64(),
                is_clear: false,
            },
            ShapeKind::Cylinder { from, to, radius } => {
                ShapeForm::Rod { from: place(*from), to: place(*to), radius: radius.to_f64() }
            }
            ShapeKind::Disc { center, radius } => {
                let radius = radius.to_f64();
                let (at, axis, width) = (place(*center), [0.0, 0.0, 1.0], DISC_WIDTH * radius);
                ShapeForm::Wheel { at, axis, radius, width, turns: false }
            }
            ShapeKind::Polygon { points } => {
                ShapeForm::Polygon { points: points.iter().map(|point| place(*point)).collect() }
            }
        };
        DrawnShape {
            colour: shape.colour_code(),
            opacity: shape.opacity.to_f64(),
            ..DrawnShape::new(shape.body.index(), form)
        }
    }
}

/// Axes of a box that writes none: x, y and z [-].
const GLOBAL: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
