//! Gear trains: a row of wheels on one carrier, each on a revolute joint and in mesh with the next.

use mbs_core::scene::{
    Body, BodyId, Coupling, CouplingMeasure, CouplingTerm, Dimension, Inertia, InitialCondition,
    InitialTarget, Joint, JointId, JointKind, Scene,
};

/// Radii of the wheels [m], repeated along the train, so that its wheels have different sizes.
const RADII: [f64; 3] = [0.1, 0.15, 0.2];

/// `n` wheels with a gear between neighbours, or without any.
pub(crate) fn train(n: usize, has_gears: bool) -> Scene<f64> {
    let radius = |i: usize| RADII[i % RADII.len()];
    let mut place = 0.0;
    let centers: Vec<f64> = (0..n)
        .map(|i| {
            let center = place + radius(i);
            place = center + radius(i);
            center
        })
        .collect();
    let bodies = centers.iter().enumerate().map(|(i, &x)| Body {
        name: format!("wheel-{i}"),
        mass: 1.0,
        center: [x, 0.0, 0.0],
        inertia: Inertia::Planar(0.5 * radius(i) * radius(i)),
        gravity_scale: None,
    });
    let joints = centers.iter().enumerate().map(|(i, &x)| Joint {
        name: format!("hinge-{i}"),
        kind: JointKind::Revolute,
        bodies: [BodyId::Ground, BodyId::Body(i)],
        points: [[x, 0.0, 0.0]; 2],
        axes: [None; 2],
        limits: Default::default(),
    });
    let term = |i: usize| CouplingTerm {
        factor: radius(i),
        of: CouplingMeasure::Coordinate { joint: JointId::new(i), number: 0 },
        curve: None,
    };
    let coupling = |i: usize| Coupling {
        name: format!("mesh-{i}"),
        ..Coupling::sum(vec![term(i), term(i + 1)], 0.0)
    };
    let target =
        InitialTarget::Joint { joint: JointId::new(0), value: None, rate: Some(vec![2.0]) };
    Scene {
        gravity: Some([0.0, -9.81, 0.0]),
        bodies: bodies.collect(),
        joints: joints.collect(),
        couplings: if has_gears { (1..n).map(|i| coupling(i - 1)).collect() } else { Vec::new() },
        initials: vec![InitialCondition { target }],
        ..Scene::empty("gear-train", Dimension::Planar, 1.0)
    }
}
