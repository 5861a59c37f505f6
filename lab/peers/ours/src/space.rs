//! A planar scene as a spatial one, which moves in the same way: what mbs takes where it does not know that a scene is planar.

use crate::line::Failure;
use mbs_core::scene::{Dimension, Inertia, JointKind, Scene};
use mbs_recursive::{Planar, TreeModel};

/// The scene in space. Joints that a tree would cut become balls: as many equations as there must be and one more, as in the
/// peers' closures.
pub(crate) fn in_space(scene: &Scene<f64>) -> Result<Scene<f64>, Failure> {
    let mut scene = scene.clone();
    let cuts: Vec<usize> = TreeModel::<f64, Planar>::new(&scene)?.cut_joints().collect();
    scene.dimension = Dimension::Spatial;
    for body in &mut scene.bodies {
        if let Inertia::Planar(i) = body.inertia {
            // What turns about z alone feels Izz alone.
            body.inertia = Inertia::Spatial([i, i, i, 0.0, 0.0, 0.0]);
        }
    }
    for (j, joint) in scene.joints.iter_mut().enumerate() {
        if cuts.contains(&j) {
            joint.kind = JointKind::Spherical;
        } else {
            joint.axes = [Some([0.0, 0.0, 1.0]), None];
        }
    }
    // Channels of what is now a ball have no meaning.
    scene.outputs.clear();
    Ok(scene)
}
