//! Fictitious masses for mechanisms without inertia. A smallest motion that closes loops is measured with masses, but positions and
//! Jacobians do not depend on them.

use super::inner::{Inner, Typed, with};
use crate::stop::StopError;
use mbs_core::cluster::scene_length;
use mbs_core::scene::{Body, Dimension, Inertia, Scene};

/// Returns the tree of a scene with fictitious masses. `None` if its coordinates differ from those of the scene's tree, or if the masses do
/// not determine accelerations.
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

/// Returns a body with a mass of 1 kg and the given moment of inertia about all axes [kg m^2]. A point mass gets no moment of inertia.
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

/// Closes the loops of a tree with masses by a projection of its state.
pub(super) fn close(inner: &mut Inner) -> Result<(), StopError> {
    with!(inner, tree => {
        let Typed { model, state, workspace, .. } = &mut **tree;
        model.close_loops(state, workspace).map_err(|error| Typed::reason(model, error))
    })
}
