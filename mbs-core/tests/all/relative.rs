//! Motion relative to a body that moves and rotates, compared with derivatives by hand.

use crate::small::{GROUND, add_body, add_joint, hold, output, scene, start};
use mbs_core::outputs::{Measures, RelativePoint};
use mbs_core::scene::{BodyId, Dimension, Inertia, JointKind, Quantity, Scene};

/// Allowed error: rounding of products of numbers of order ten, and the error of the assembly.
const CLOSED: f64 = 1e-10;

fn measured<const D: usize>(scene: &Scene<f64>, quantities: &[Quantity<f64>]) -> Vec<f64> {
    let mut scene = scene.clone();
    quantities.iter().for_each(|quantity| output(&mut scene, quantity.clone()));
    let (model, state) = start::<D>(&scene);
    let mut measures = Measures::new(&scene, &model).expect("channels");
    let mut out = vec![f64::NAN; measures.n_components()];
    measures.write(&state, None, &mut out).expect("turns are known");
    out
}

fn assert_near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() < CLOSED, "{found:?} is not {expected:?}");
    }
}

#[test]
fn a_slide_seen_from_a_falling_arm_has_the_derivatives_of_its_coordinates() {
    let (phi, w, x, v) = (0.7_f64, 1.3, 0.4, -0.9);
    let mut s = scene(Dimension::Planar, [0.0, -9.81, 0.0]);
    // an arm of 2 kg with its centre half a metre from its hinge: 0.3 + 2 0.25 kg m^2 about the hinge
    let arm = add_body(&mut s, 2.0, [0.5, 0.0, 0.0], Inertia::Planar(0.3));
    let block = add_body(&mut s, 1.0, [1.0, 0.2, 0.0], Inertia::Planar(0.1));
    add_joint(&mut s, JointKind::Revolute, [GROUND, arm], [0.0; 3], [None; 2]);
    let along = [Some([1.0, 0.0, 0.0]), None];
    add_joint(&mut s, JointKind::Prismatic, [GROUND, block], [1.0, 0.2, 0.0], along);
    hold(&mut s, 0, &[phi], &[w]);
    hold(&mut s, 1, &[x], &[v]);
    let (sin, cos) = phi.sin_cos();
    let alpha = -2.0 * 9.81 * 0.5 * cos / 0.8;
    let seen =
        |origin| RelativePoint { body: block, at: [1.0, 0.2, 0.0], relative_to: arm, origin };
    let quantities = [
        Quantity::RelativePosition(seen([0.0; 3])),
        Quantity::RelativeVelocity(seen([0.0; 3])),
        Quantity::RelativeAcceleration(seen([0.0; 3])),
        Quantity::RelativePosition(seen([0.5, 0.1, 0.0])),
        Quantity::RelativeVelocity(seen([0.5, 0.1, 0.0])),
        Quantity::RelativeAngularVelocity { body: block, relative_to: arm },
    ];
    // components along and across the arm, of the point (1 + x, 0.2)
    let (px, py) = (1.0 + x, 0.2);
    let (a, b) = (px * cos + py * sin, -px * sin + py * cos);
    let (a_t, b_t) = (v * cos + w * b, -v * sin - w * a);
    let a_tt = -v * sin * w + alpha * b + w * b_t;
    let b_tt = -v * cos * w - alpha * a - w * a_t;
    let expected = [a, b, a_t, b_t, a_tt, b_tt, a - 0.5, b - 0.1, a_t, b_t, -w];
    assert_near(&measured::<2>(&s, &quantities), &expected);
}

#[test]
fn angular_velocities_are_turned_into_the_axes_of_the_other_body() {
    let (phi, w, u) = (0.7_f64, 1.3, 0.6);
    let mut s = scene(Dimension::Spatial, [0.0; 3]);
    let ball = Inertia::Spatial([0.2, 0.2, 0.2, 0.0, 0.0, 0.0]);
    let [table, wheel] = [0.0, 1.0].map(|y| add_body(&mut s, 1.0, [0.0, y, 0.0], ball));
    let about = |axis| [Some(axis), None];
    add_joint(&mut s, JointKind::Revolute, [GROUND, table], [0.0; 3], about([0.0, 0.0, 1.0]));
    let at = [0.0, 1.0, 0.0];
    add_joint(&mut s, JointKind::Revolute, [GROUND, wheel], at, about([1.0, 0.0, 0.0]));
    hold(&mut s, 0, &[phi], &[w]);
    hold(&mut s, 1, &[0.3], &[u]);
    let (sin, cos) = phi.sin_cos();
    let turning = |body, relative_to| Quantity::RelativeAngularVelocity { body, relative_to };
    let seen = RelativePoint { body: wheel, at, relative_to: table, origin: [0.0; 3] };
    let quantities = [
        turning(wheel, table),
        turning(wheel, GROUND),
        // a fixed point moves on a circle relative to a rotating table
        Quantity::RelativePosition(seen),
        Quantity::RelativeVelocity(seen),
        Quantity::RelativeAcceleration(seen),
    ];
    let expected = [
        [u * cos, -u * sin, -w],
        [u, 0.0, 0.0],
        [sin, cos, 0.0],
        [w * cos, -w * sin, 0.0],
        [-w * w * sin, -w * w * cos, 0.0],
    ];
    assert_near(&measured::<3>(&s, &quantities), expected.as_flattened());
    assert_eq!(wheel, BodyId::Body(1));
}
