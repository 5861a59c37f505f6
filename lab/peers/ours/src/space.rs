//! Conversion of a planar scene to a spatial one with the same motion. It shows the cost of mbs where a scene is not declared as planar.

use crate::line::Failure;
use mbs_core::scene::{Dimension, Inertia, JointKind, Scene};
use mbs_recursive::{Planar, TreeModel};

/// Converts the scene to space. Cut joints of the tree become spherical joints. These have as many equations as are necessary and one more,
/// as the closures of the peers do.
pub(crate) fn in_space(scene: &Scene<f64>) -> Result<Scene<f64>, Failure> {
    let mut scene = scene.clone();
    let cuts: Vec<usize> = TreeModel::<f64, Planar>::new(&scene)?.cut_joints().collect();
    scene.dimension = Dimension::Spatial;
    for body in &mut scene.bodies {
        if let Inertia::Planar(i) = body.inertia {
            // for rotation about z only Izz matters
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
    // output channels of a joint that is now spherical have no meaning
    scene.outputs.clear();
    Ok(scene)
}
