//! Alignment of axes that are intended to be parallel, and of axes that are not.

use mbs_core::scene::align::*;
use mbs_core::scene::{BodyId, Dimension, Joint, JointKind, JointLimits, Scene};
use std::borrow::Cow;

/// Scene of hinges in a closed row of bodies (ground, 0, 1, ..., ground) with these axes. One more hinge is on the last body.
fn ring(axes: &[[f64; 3]]) -> Scene<f64> {
    let n = axes.len();
    let body = |i: usize| if i == 0 || i == n { BodyId::Ground } else { BodyId::Body(i - 1) };
    let hinge = |bodies, axis| Joint {
        name: String::new(),
        kind: JointKind::Revolute,
        bodies,
        points: [[0.0; 3]; 2],
        axes: [Some(axis), None],
        limits: JointLimits::NONE,
    };
    let mut joints: Vec<_> = (0..n).map(|i| hinge([body(i), body(i + 1)], axes[i])).collect();
    let last = BodyId::Body(n - 2);
    joints.push(hinge([last, BodyId::Body(n - 1)], [1e-8, 0.0, 1.0]));
    let bodies = (0..n).map(|_| mbs_core::scene::Body {
        name: String::new(),
        mass: 1.0,
        center: [0.0; 3],
        inertia: mbs_core::scene::Inertia::Spatial([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]),
        gravity_scale: None,
    });
    Scene { bodies: bodies.collect(), joints, ..Scene::empty("", Dimension::Spatial, 1.0) }
}

/// Unit vector along the axis z.
const Z: [f64; 3] = [0.0, 0.0, 1.0];

#[test]
fn an_axis_that_is_off_takes_the_direction_of_most_with_its_own_sense() {
    let scene = ring(&[[2e-7, 0.0, -1.0], Z, Z, Z]);
    let tilts = tilts(&scene, MEANT);
    assert_eq!(tilts.len(), 1, "the hinge outside of the loop stays");
    assert_eq!((tilts[0].joint, tilts[0].axis, tilts[0].other), (0, 0, 1));
    assert!((tilts[0].angle - 2e-7).abs() < 1e-15);
    assert!(tilts[0].to.iter().zip([0.0, 0.0, -1.0]).all(|(x, right)| (x - right).abs() < 1e-15));
    assert_eq!(aligned(&scene).joints[0].axes[0], Some(tilts[0].to));
}

#[test]
fn an_axis_across_the_common_one_is_put_across_it() {
    let scene = ring(&[Z, Z, [1.0, 0.0, 5e-7], Z]);
    let tilts = tilts(&scene, MEANT);
    assert_eq!(tilts.len(), 1);
    assert_eq!((tilts[0].joint, tilts[0].to), (2, [1.0, 0.0, 0.0]));
}

#[test]
fn rounding_and_true_angles_are_left_alone() {
    let scene = ring(&[Z, [1e-15, 0.0, 1.0], [2e-6, 0.0, 1.0], [0.6, 0.0, 0.8]]);
    assert_eq!(tilts(&scene, MEANT), []);
    assert!(matches!(aligned(&scene), Cow::Borrowed(_)));
    assert_eq!(tilts(&scene, DOUBTFUL).len(), 1);
}
