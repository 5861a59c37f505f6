//! Small scenes built in code, and their consistent states.

use mbs_core::model::State;
use mbs_core::natural::NaturalModel;
use mbs_core::scene::{
    Body, BodyId, Dimension, Guide, Inertia, InitialCondition, InitialTarget, Joint, JointId,
    JointKind, JointLimits, Motion, Output, Quantity, Scene,
};
use mbs_testkit::scenes::empty;

/// Fixed frame, to which scenes connect bodies.
pub(crate) const GROUND: BodyId = BodyId::Ground;

/// Scene without bodies, with this gravity [m/s^2].
pub(crate) fn scene(dimension: Dimension, gravity: [f64; 3]) -> Scene<f64> {
    empty("test", dimension, Some(gravity))
}

/// Adds a body, and returns its handle.
pub(crate) fn add_body(
    scene: &mut Scene<f64>,
    mass: f64,
    center: [f64; 3],
    inertia: Inertia<f64>,
) -> BodyId {
    let name = format!("body {}", scene.bodies.len());
    scene.bodies.push(Body { name, mass, center, inertia, gravity_scale: None });
    BodyId::Body(scene.bodies.len() - 1)
}

/// Adds a uniform rod, and returns its handle.
pub(crate) fn add_rod(scene: &mut Scene<f64>, mass: f64, from: [f64; 3], to: [f64; 3]) -> BodyId {
    let center = core::array::from_fn(|i| 0.5 * (from[i] + to[i]));
    add_body(scene, mass, center, Inertia::Rod { from, to })
}

/// Adds a joint at one place, and returns its index.
pub(crate) fn add_joint(
    scene: &mut Scene<f64>,
    kind: JointKind,
    bodies: [BodyId; 2],
    at: [f64; 3],
    axes: [Option<[f64; 3]>; 2],
) -> usize {
    let name = format!("joint {}", scene.joints.len());
    let limits = JointLimits::NONE;
    scene.joints.push(Joint { name, kind, bodies, points: [at, at], axes, limits });
    scene.joints.len() - 1
}

/// Prescribes a joint's coordinates and rates at the start.
pub(crate) fn hold(scene: &mut Scene<f64>, joint: usize, value: &[f64], rate: &[f64]) {
    let numbers = |x: &[f64]| (!x.is_empty()).then(|| x.to_vec());
    let (value, rate) = (numbers(value), numbers(rate));
    scene.initials.push(InitialCondition {
        target: InitialTarget::Joint { joint: JointId::new(joint), value, rate },
    });
}

/// Prescribes the motion of the first coordinate of a joint.
pub(crate) fn guide(scene: &mut Scene<f64>, joint: usize, law: Motion<f64>) {
    scene.guides.push(Guide { joint: JointId::new(joint), number: 0, law });
}

/// Adds an output channel for a quantity.
pub(crate) fn output(scene: &mut Scene<f64>, quantity: Quantity<f64>) {
    let name = format!("output {}", scene.outputs.len());
    scene.outputs.push(Output::new(quantity).named(&name));
}

/// Model of a checked scene, and its consistent start.
pub(crate) fn start<const D: usize>(scene: &Scene<f64>) -> (NaturalModel<f64, D>, State<f64>) {
    scene.check().expect("the scene of a test can be meant");
    mbs_testkit::start(scene)
}
