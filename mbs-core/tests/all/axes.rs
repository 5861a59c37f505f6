//! Outputs in the axes of a body, compared with closed forms.

use crate::small::{GROUND, add_body, add_joint, hold, scene, start};
use mbs_core::outputs::{Forces, Measures, RelativePoint};
use mbs_core::scene::{BodyId, Dimension, Inertia, JointId, JointKind, Output, Quantity, Scene};

/// Allowed error: rounding of products of numbers of order ten, and the error of the assembly.
const CLOSED: f64 = 1e-11;
const GRAVITY: f64 = 9.81;

/// Components of outputs at the start of a scene, in their order.
fn measured<const D: usize>(
    scene: &Scene<f64>,
    outputs: Vec<(Quantity<f64>, Option<BodyId>)>,
) -> Vec<f64> {
    let mut scene = scene.clone();
    let named = |(i, (quantity, frame)): (usize, (_, _))| Output {
        frame,
        ..Output::new(quantity).named(&i.to_string())
    };
    scene.outputs = outputs.into_iter().enumerate().map(named).collect();
    let (model, state) = start::<D>(&scene);
    let mut measures = Measures::new(&scene, &model).expect("channels");
    let mut forces = Forces::new(&scene, &model).expect("they are determined");
    forces.update(&state);
    let mut out = vec![f64::NAN; measures.n_components()];
    measures.write(&state, Some(&forces), &mut out).expect("turns are known");
    out
}

fn assert_near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() < CLOSED, "{found:?} is not {expected:?}");
    }
}

/// Scene of a box that rotates about an axis through its centre of mass, with prescribed angle and rate.
fn spun(dimension: Dimension, axis: [f64; 3], (angle, rate): (f64, f64)) -> (Scene<f64>, BodyId) {
    let gravity = [0.0, 0.0, if dimension == Dimension::Planar { 0.0 } else { -GRAVITY }];
    let mut s = scene(dimension, gravity);
    let inertia = match dimension {
        Dimension::Planar => Inertia::Planar(0.3),
        Dimension::Spatial => Inertia::Spatial([0.1, 0.2, 0.25, 0.0, 0.0, 0.0]),
    };
    let body = add_body(&mut s, 2.0, [0.0; 3], inertia);
    let axis = (dimension == Dimension::Spatial).then_some(axis);
    add_joint(&mut s, JointKind::Revolute, [GROUND, body], [0.0; 3], [axis, None]);
    hold(&mut s, 0, &[angle], &[rate]);
    (s, body)
}

#[test]
fn the_acceleration_of_a_point_of_a_spinning_box_is_the_same_in_its_axes_at_every_angle() {
    let w = 1.3_f64;
    for angle in [0.0, 0.7, 2.0, -3.0] {
        let (s, body) = spun(Dimension::Spatial, [0.0, 0.0, 1.0], (angle, w));
        let acceleration = Quantity::Acceleration { body, at: [1.0, 0.5, 0.2] };
        let velocity = Quantity::Velocity { body, at: [1.0, 0.5, 0.2] };
        let found = measured::<3>(&s, vec![(acceleration, Some(body)), (velocity, Some(body))]);
        assert_near(&found, &[-w * w, -0.5 * w * w, 0.0, -0.5 * w, w, 0.0]);
        let (s, body) = spun(Dimension::Planar, [0.0, 0.0, 1.0], (angle, w));
        let acceleration = Quantity::Acceleration { body, at: [1.0, 0.5, 0.0] };
        assert_near(&measured::<2>(&s, vec![(acceleration, Some(body))]), &[-w * w, -0.5 * w * w]);
    }
}

#[test]
fn a_tilted_accelerometer_at_rest_and_a_bearing_show_gravity_in_the_axes_of_their_box() {
    let angle = 0.4_f64;
    let (s, body) = spun(Dimension::Spatial, [0.0, 1.0, 0.0], (angle, 0.0));
    let (sin, cos) = angle.sin_cos();
    let accelerometer = Quantity::ProperAcceleration { body, at: [0.3, 0.2, 0.1] };
    let reaction = Quantity::Reaction { joint: JointId::new(0) };
    let outputs = vec![
        (accelerometer.clone(), None),
        (accelerometer.clone(), Some(GROUND)),
        (accelerometer, Some(body)),
        (reaction, Some(body)),
    ];
    let g = [0.0, 0.0, GRAVITY];
    let [x, z] = [-GRAVITY * sin, GRAVITY * cos];
    let expected = [&g[..], &g, &[x, 0.0, z], &[2.0 * x, 0.0, 2.0 * z, 0.0, 0.0, 0.0]].concat();
    assert_near(&measured::<3>(&s, outputs), &expected);
}

#[test]
fn what_is_seen_from_a_body_has_the_axes_of_any_body() {
    let (phi, w) = (0.7_f64, 1.3);
    let (mut s, table) = spun(Dimension::Spatial, [0.0, 0.0, 1.0], (phi, w));
    let ball = Inertia::Spatial([0.2, 0.2, 0.2, 0.0, 0.0, 0.0]);
    let wheel = add_body(&mut s, 1.0, [0.0, 2.0, 0.0], ball);
    let axes = [Some([1.0, 0.0, 0.0]), None];
    add_joint(&mut s, JointKind::Revolute, [GROUND, wheel], [0.0, 2.0, 0.0], axes);
    hold(&mut s, 1, &[0.5], &[0.6]);
    let seen = RelativePoint {
        body: wheel,
        at: [0.0, 2.0, 0.0],
        relative_to: table,
        origin: [1.0, 0.0, 0.0],
    };
    let position = Quantity::RelativePosition(seen);
    let turning = Quantity::RelativeAngularVelocity { body: wheel, relative_to: table };
    let outputs = vec![
        (position.clone(), None),
        (position.clone(), Some(table)),
        (position.clone(), Some(GROUND)),
        (position, Some(wheel)),
        (turning, Some(GROUND)),
        (Quantity::Position { body: table, at: [1.0, 0.0, 0.0] }, Some(wheel)),
    ];
    let found = measured::<3>(&s, outputs);
    // vector from the origin at (cos, sin, 0) to the wheel at (0, 2, 0)
    let (sin, cos) = phi.sin_cos();
    let gap = [-cos, 2.0 - sin, 0.0];
    assert_near(&found[..3], &found[3..6]);
    assert_near(&found[6..9], &gap);
    let (sine, cosine) = 0.5_f64.sin_cos();
    assert_near(&found[9..12], &[gap[0], cosine * gap[1], -sine * gap[1]]);
    assert_near(&found[12..15], &[0.6, 0.0, -w]);
    assert_near(&found[15..], &[cos, cosine * sin, -sine * sin]);
}
