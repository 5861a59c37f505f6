//! A four-bar mechanism in the plane and one in space, and parts that can be added to them.

use crate::effects;
use mbs_core::scene::{
    Body, BodyId, Dimension, Effect, Guide, Inertia, InitialCondition, InitialTarget, Joint,
    JointId, JointKind, Motion, Scene,
};

/// The four-bar with the named effect: `out` (without the effect), `off` or `on`. With the name of a guide it has a guide of its crank.
pub(crate) fn with(dimension: Dimension, effect: &str, switch: &str) -> Scene<f64> {
    let mut scene = four_bar(dimension);
    let enabled = switch == "on";
    let effects = effects::all(dimension).into_iter();
    let effects = effects.filter(|(name, _)| *name == effect && switch != "out");
    scene.effects.extend(effects.map(|(name, kind)| Effect { name, enabled, kind }));
    if effect == "guide" {
        let law = Motion::Sine { amplitude: 0.5, frequency: 1.0, phase: 0.0 };
        scene.initials.clear();
        scene.guides.push(Guide { joint: JointId::new(0), number: 0, law });
    }
    scene
}

/// Crank, coupler and rocker. In space the coupler has a spherical joint at one end and a universal joint at the other.
fn four_bar(dimension: Dimension) -> Scene<f64> {
    let is_planar = dimension == Dimension::Planar;
    let depth = if is_planar { 0.0 } else { 0.5 };
    let [a, b, c, d] = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 2.0, depth], [2.0, 0.0, depth]];
    let body = |name: &str, [p, q]: [[f64; 3]; 2]| Body {
        name: name.into(),
        mass: 2.0,
        center: [0, 1, 2].map(|i| (p[i] + q[i]) / 2.0),
        inertia: if is_planar {
            Inertia::Planar(0.4)
        } else {
            Inertia::Spatial([0.4, 0.3, 0.5, 0.0, 0.0, 0.0])
        },
        gravity_scale: None,
    };
    let joint = |name: &str, kind: JointKind, bodies: [BodyId; 2], at: [f64; 3], axes| Joint {
        name: name.into(),
        kind: if is_planar { JointKind::Revolute } else { kind },
        bodies,
        points: [at; 2],
        axes: if is_planar { [None; 2] } else { axes },
        limits: Default::default(),
    };
    let [crank, coupler, rocker] = [0, 1, 2].map(BodyId::Body);
    let (x, y, z) = (Some([1.0, 0.0, 0.0]), Some([0.0, 1.0, 0.0]), Some([0.0, 0.0, 1.0]));
    let joints = vec![
        joint("a", JointKind::Revolute, [BodyId::Ground, crank], a, [z, None]),
        joint("b", JointKind::Spherical, [crank, coupler], b, [None; 2]),
        joint("c", JointKind::Universal, [coupler, rocker], c, [x, y]),
        joint("d", JointKind::Revolute, [BodyId::Ground, rocker], d, [z, None]),
    ];
    let joint = JointId::new(0);
    let target = InitialTarget::Joint { joint, value: None, rate: Some(vec![2.0]) };
    Scene {
        gravity: Some([0.0, -9.81, 0.0]),
        bodies: vec![body("crank", [a, b]), body("coupler", [b, c]), body("rocker", [c, d])],
        joints,
        initials: vec![InitialCondition { target }],
        ..Scene::empty("four-bar", dimension, 1.0)
    }
}
