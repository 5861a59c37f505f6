//! Models as scenes, and the initial acceleration of a body on one joint, computed from the scene.

use mbs_core::scene::{Inertia, JointKind, Scene};
use mbs_import::{FindingKind, ImportOptions, Imported, import};
use mbs_scene::SceneFile;

/// Relative rounding error of a dozen products [-].
pub(crate) const TOLERANCE: f64 = 1.0e-11;

pub(crate) fn model(text: &str, name: &str, options: &ImportOptions) -> Imported {
    import(text.as_bytes(), name, options).unwrap_or_else(|e| panic!("{}", e.render()))
}

pub(crate) fn scene_of(model: &Imported) -> Scene<f64> {
    let scene = SceneFile::parse(&model.text, "model").and_then(|scene| scene.scene());
    scene.unwrap_or_else(|e| panic!("{}\n{}", e.render(), model.text))
}

/// The scene of a text. The import may leave out only elements for pictures.
pub(crate) fn whole(text: &str, name: &str) -> Scene<f64> {
    let model = model(text, name, &ImportOptions::default());
    let acts = model.findings.iter().find(|finding| finding.kind != FindingKind::Appearance);
    assert_eq!(acts, None);
    scene_of(&model)
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

/// Mass, centre, and moments xx, yy, zz, xy, yz, zx of a body.
pub(crate) fn ten(scene: &Scene<f64>, name: &str) -> [f64; 10] {
    let body = scene.bodies.iter().find(|body| body.name == name);
    let body = body.unwrap_or_else(|| panic!("no body `{name}`"));
    let Inertia::Spatial(six) = body.inertia else { panic!("a body of space") };
    let all = [&[body.mass][..], &body.center, &six].concat();
    all.try_into().expect("ten numbers")
}

/// The acceleration of a joint between the ground and a body that no other joint moves. With the axis a, gravity g and the vector r from the
/// joint to the centre of mass, it is a·g for a slide. For a hinge it is (r × m g)·a divided by the inertia about the axis.
pub(crate) fn acceleration(scene: &Scene<f64>, joint: &str) -> f64 {
    let found = scene.joints.iter().find(|found| found.name == joint);
    let joint = found.unwrap_or_else(|| panic!("no joint `{joint}`"));
    let [a, b] = joint.bodies;
    assert_eq!(a.index(), None, "its first body is the ground");
    let body = &scene.bodies[b.index().expect("a body")].name;
    let [mass, x, y, z, xx, yy, zz, xy, yz, zx] = ten(scene, body);
    let axis = joint.axes[0].expect("an axis");
    let size = dot(axis, axis).sqrt();
    let axis = axis.map(|x| x / size);
    let gravity = scene.gravity.expect("gravity");
    if joint.kind == JointKind::Prismatic {
        return dot(axis, gravity);
    }
    assert_eq!(joint.kind, JointKind::Revolute);
    let at = joint.points[0];
    let arm = [x - at[0], y - at[1], z - at[2]];
    let rows = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]].map(|row| dot(row, axis));
    let across = cross(axis, arm);
    let inertia = dot(axis, rows) + mass * dot(across, across);
    mass * dot(across, gravity) / inertia
}

/// Compares a number with the expected one, within a tolerance relative to its size or to one.
pub(crate) fn close(found: f64, expected: f64, tolerance: f64, what: &str) {
    let size = expected.abs().max(1.0);
    assert!((found - expected).abs() <= tolerance * size, "{what}: {found} for {expected}");
}
