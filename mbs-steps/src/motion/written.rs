//! Shapes that the scene file defines.

use super::drawing::Drawing;
use super::pose::frame;
use crate::record::{DrawnShape, ShapeForm};
use mbs_core::Real;
use mbs_core::scene::{BodyShape, ShapeKind};

/// Width of a planar disc, relative to its radius [-].
const DISC_WIDTH: f64 = 0.05;

impl<T: Real> Drawing<'_, T> {
    /// Converts a shape of the scene to its drawn form.
    pub(super) fn shape(&self, shape: &BodyShape<T>) -> DrawnShape {
        let place = |at: [T; 3]| self.place(shape.body, at).at;
        let form = match &shape.form {
            ShapeKind::Box { center, size, axes } => ShapeForm::Box {
                at: place(*center),
                half: size.map(|length| 0.5 * length.to_f64()),
                axes: axes_of(axes.as_ref()),
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
            ShapeKind::Mesh { file, at, axes, scale } => {
                let axes = axes_of(axes.as_ref());
                let scaled = |i: usize| axes[i].map(|x| x * scale[i].to_f64());
                ShapeForm::Mesh {
                    file: file.clone(),
                    at: place(*at),
                    axes: [scaled(0), scaled(1), scaled(2)],
                }
            }
        };
        DrawnShape {
            colour: shape.colour_code(),
            opacity: shape.opacity.to_f64(),
            ..DrawnShape::new(shape.body.index(), form)
        }
    }
}

/// Orthonormal axes from the given first and second axis; the global axes if none are given.
fn axes_of<T: Real>(axes: Option<&[[T; 3]; 2]>) -> [[f64; 3]; 3] {
    axes.map_or(GLOBAL, |axes| frame(axes.map(|axis| axis.map(Real::to_f64))))
}

/// Default axes of a box: the global axes x, y and z [-].
const GLOBAL: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
