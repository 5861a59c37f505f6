//! Masses for mechanisms that lack them, so that loops close by a smallest motion: places and Jacobians do not depend on them.

use super::inner::{Inner, Typed, with};
use crate::stop::StopError;
use mbs_core::cluster::scene_length;
use mbs_core::scene::{Body, Dimension, Inertia, Scene};

/// The tree of a scene with masses, in the coordinates of its own one; `None` where it has no such tree.
pub(super) fn tree(scene: &Scene<f64>, own: &Inner) -> Option<Inner> {
    let length = scene_length(scene);
    let mut heavy = scene.clone();
    let moment = length * length;
    heavy.bodies.iter_mut().for_each(|body| *body = with_mass(body, scene.dimension, moment));
    let (tree, _, lack) = Inner::new(&heavy).ok()?;
    let is_same = match (&tree, own) {
        (Inner::Planar(tree), Inner::Planar(own)) => tree.model.has_same_coordinates(&own.model),
        (Inner::Spatial(tree), Inner::Spatial(own)) => tree.model.has_same_coordinates(&own.model),
        _ => false,
    };
    (is_same && lack.is_none()).then_some(tree)
}

/// A body with 1 kg and a moment [kg m^2] about all axes in place of its own; a point has the mass alone.
pub fn with_mass<T: Clone + From<f64>>(
    body: &Body<T>,
    dimension: Dimension,
    moment: f64,
) -> Body<T> {
    let number = |x: f64| T::from(x);
    let inertia = match (&body.inertia, dimension) {
        (Inertia::Point, _) => Inertia::Point,
        (_, Dimension::Planar) => Inertia::Planar(number(moment)),
        (_, Dimension::Spatial) => {
            Inertia::Spatial([moment, moment, moment, 0.0, 0.0, 0.0].map(number))
        }
    };
    Body { mass: number(1.0), inertia, ..body.clone() }
}

/// Moves a state onto the loops by a tree with masses.
pub(super) fn close(inner: &mut Inner) -> Result<(), StopError> {
    with!(inner, tree => {
        let Typed { model, state, workspace, .. } = &mut **tree;
        model.close_loops(state, workspace).map_err(|error| Typed::reason(model, error))
    })
}
