//! Efforts of couplings, and reactions of the joints that they act on, compared with closed forms.

use crate::small::{GROUND, add_body, add_joint, hold, scene, start};
use mbs_core::outputs::Reactions;
use mbs_core::scene::{
    BodyId, Coupling, CouplingMeasure, CouplingTerm, Curve, Dimension, Effect, Inertia, JointId,
    JointKind, JointTorque, Scene, Signal,
};

const G: f64 = 9.81;
/// Allowed error: forces are of order 1 to 100 N, and assembled accelerations have eleven digits.
const CLOSED: f64 = 1e-9;

fn joint(index: usize) -> JointId {
    JointId::new(index)
}

fn couple(scene: &mut Scene<f64>, terms: Vec<CouplingTerm<f64>>) {
    let name = format!("coupling {}", scene.couplings.len());
    scene.couplings.push(Coupling { name, ..Coupling::sum(terms, 0.0) });
}

fn term(index: usize, number: usize, factor: f64) -> CouplingTerm<f64> {
    let of = CouplingMeasure::Coordinate { joint: joint(index), number };
    CouplingTerm { factor, of, curve: None }
}

fn torque(scene: &mut Scene<f64>, joint: JointId, value: f64) {
    let torque =
        JointTorque { joint, coordinate: None, course: Signal::Constant([value, 0.0, 0.0]) };
    let (name, kind) = (format!("torque {}", scene.effects.len()), torque.into());
    scene.effects.push(Effect { name, kind, enabled: true });
}

/// Reactions at a consistent start, whose forces are balanced, and angular accelerations of the bodies about z.
fn reactions<const D: usize>(scene: &Scene<f64>) -> (Reactions<f64, D>, Vec<f64>) {
    let (model, state) = start::<D>(scene);
    let mut reactions = Reactions::new(scene, &model).expect("reactions");
    reactions.update(&state);
    assert!(reactions.residual() < CLOSED, "{:e} N are left", reactions.residual());
    let turning = |body| model.motion(scene, body, &state).angular_acceleration[2];
    (reactions, (0..scene.bodies.len()).map(turning).collect())
}

fn assert_near(found: f64, expected: f64) {
    assert!((found - expected).abs() < CLOSED, "{found} is not {expected}");
}

/// Scene of a housing on a free hinge with two wheels in mesh, of 40 and 17 teeth. A motor of 0.8 N m acts between housing and
/// first wheel.
fn housing(dimension: Dimension) -> Scene<f64> {
    let mut s = scene(dimension, [0.0; 3]);
    let axis = [(dimension == Dimension::Spatial).then_some([0.0, 0.0, 2.0]), None];
    let wheel = |s: &mut Scene<f64>, x: f64, moment: f64| {
        let inertia = match dimension {
            Dimension::Planar => Inertia::Planar(moment),
            Dimension::Spatial => {
                Inertia::Spatial([0.8 * moment, 0.9 * moment, moment, 0.0, 0.0, 0.0])
            }
        };
        add_body(s, 1.0, [x, 0.0, 0.0], inertia)
    };
    let (frame, first, second) =
        (wheel(&mut s, 0.0, 0.196), wheel(&mut s, 0.2, 0.02), wheel(&mut s, -0.2, 0.004));
    add_joint(&mut s, JointKind::Revolute, [GROUND, frame], [0.0; 3], axis);
    add_joint(&mut s, JointKind::Revolute, [frame, first], [0.2, 0.0, 0.0], axis);
    add_joint(&mut s, JointKind::Revolute, [frame, second], [-0.2, 0.0, 0.0], axis);
    couple(&mut s, vec![term(1, 0, 40.0), term(2, 0, 17.0)]);
    torque(&mut s, joint(1), 0.8);
    s
}

fn housing_is_as_computed_by_hand<const D: usize>(dimension: Dimension) {
    /// Unit of the last digit of the reference.
    const DIGIT: f64 = 1e-9;
    let (r, turning) = reactions::<D>(&housing(dimension));
    let (of_frame, of_first) = (-0.675_944_334, 19.151_756_130);
    for (found, expected) in [(turning[0], of_frame), (turning[1] - turning[0], of_first)] {
        assert!((found - expected).abs() < DIGIT, "{found} {expected}");
    }
    for (teeth, expected) in [(40.0, -0.430_483_764), (17.0, -0.182_955_600)] {
        let found = teeth * r.effort(0);
        assert!((found - expected).abs() < DIGIT, "{found} {expected}");
    }
    assert!(r.is_effort_unique(0));
    let moment = if D == 2 { 2 } else { 5 };
    for joint in 0..3 {
        assert_near(r.reaction(joint)[moment], 0.0);
        assert!(r.is_unique(joint));
    }
}

#[test]
fn a_mesh_in_a_free_housing_turns_its_wheels_as_computed_by_hand() {
    housing_is_as_computed_by_hand::<2>(Dimension::Planar);
    housing_is_as_computed_by_hand::<3>(Dimension::Spatial);
}

#[test]
fn a_mesh_twice_shares_its_effort_and_says_that_it_is_not_unique() {
    let mut s = housing(Dimension::Planar);
    let once = reactions::<2>(&s).0.effort(0);
    couple(&mut s, vec![term(1, 0, 40.0), term(2, 0, 17.0)]);
    let (r, _) = reactions::<2>(&s);
    for coupling in 0..2 {
        assert_near(r.effort(coupling), 0.5 * once);
        assert!(!r.is_effort_unique(coupling));
    }
    assert!((0..3).all(|joint| r.is_unique(joint)));
}

#[test]
fn a_rope_over_two_points_pulls_as_in_the_machine_of_atwood() {
    let mut s = scene(Dimension::Planar, [0.0, -G, 0.0]);
    let up = [Some([0.0, 1.0, 0.0]), None];
    for (x, mass) in [(-0.5, 3.0), (0.5, 2.0)] {
        let body = add_body(&mut s, mass, [x, 0.0, 0.0], Inertia::Planar(0.1));
        add_joint(&mut s, JointKind::Prismatic, [GROUND, body], [x, 0.0, 0.0], up);
    }
    let points = vec![
        (BodyId::Body(0), [-0.5, 0.0, 0.0]),
        (GROUND, [-0.5, 1.0, 0.0]),
        (GROUND, [0.5, 1.0, 0.0]),
        (BodyId::Body(1), [0.5, 0.0, 0.0]),
    ];
    let rope = CouplingTerm { factor: 1.0, of: CouplingMeasure::Length { points }, curve: None };
    couple(&mut s, vec![rope]);
    let (r, _) = reactions::<2>(&s);
    // tension 2 m1 m2 g / (m1 + m2), with the sign against growth
    assert_near(r.effort(0), -2.0 * 3.0 * 2.0 * G / 5.0);
    assert!(r.is_effort_unique(0));
}

#[test]
fn a_screw_turns_what_its_thread_pushes() {
    let mut s = scene(Dimension::Spatial, [0.0, 0.0, -G]);
    let body = add_body(&mut s, 2.0, [0.0; 3], Inertia::Spatial([0.1, 0.1, 0.05, 0.0, 0.0, 0.0]));
    let axis = [Some([0.0, 0.0, 1.0]), None];
    add_joint(&mut s, JointKind::Cylindrical, [GROUND, body], [0.0; 3], axis);
    // coupling: slide = p angle
    let p = 0.3;
    couple(&mut s, vec![term(0, 0, 1.0), term(0, 1, -p)]);
    let (r, turning) = reactions::<3>(&s);
    // equations: m p alpha = -m g + f,   I alpha = -p f
    let alpha = -2.0 * p * G / (0.05 + 2.0 * p * p);
    assert_near(turning[0], alpha);
    assert_near(r.effort(0), -0.05 * alpha / p);
    assert_near(r.reaction(0)[2], 0.0);
    assert_near(r.reaction(0)[5], 0.0);
}

#[test]
fn a_cam_pushes_by_its_slope_and_turns_by_it() {
    let mut s = scene(Dimension::Planar, [0.0, -G, 0.0]);
    let shaft = add_body(&mut s, 1.0, [0.0; 3], Inertia::Planar(0.02));
    let follower = add_body(&mut s, 0.5, [0.0, 1.0, 0.0], Inertia::Planar(0.1));
    add_joint(&mut s, JointKind::Revolute, [GROUND, shaft], [0.0; 3], [None; 2]);
    let up = [Some([0.0, 1.0, 0.0]), None];
    add_joint(&mut s, JointKind::Prismatic, [GROUND, follower], [0.0, 1.0, 0.0], up);
    // coupling: follower = 0.01 x^2, at almost two turns
    let curve = Some(Curve::Polynomial(vec![0.0, 0.0, 0.01]));
    couple(&mut s, vec![term(1, 0, 1.0), CouplingTerm { curve, ..term(0, 0, -1.0) }]);
    let (angle, rate) = (12.0, 3.0);
    hold(&mut s, 0, &[angle], &[rate]);
    let (r, turning) = reactions::<2>(&s);
    // equations: m y'' = -m g + f,   I alpha = -f y',   y'' = y' alpha + 0.02 rate^2
    let (slope, bias) = (0.02 * angle, 0.02 * rate * rate);
    let alpha = -0.5 * slope * (G + bias) / (0.02 + 0.5 * slope * slope);
    assert_near(turning[0], alpha);
    assert_near(r.effort(0), -0.02 * alpha / slope);
}

#[test]
fn coupled_angles_of_a_universal_joint_with_skew_axes_leave_nothing_unbalanced() {
    let mut s = scene(Dimension::Spatial, [0.0, 0.0, -G]);
    let inertia = Inertia::Spatial([0.3, 0.4, 0.5, 0.02, 0.01, -0.03]);
    let body = add_body(&mut s, 1.0, [0.2, 0.5, 0.1], inertia);
    let axes = [Some([0.0, 0.6, 0.8]), Some([0.6, 0.0, 0.8])];
    add_joint(&mut s, JointKind::Universal, [GROUND, body], [0.1, -0.2, 0.3], axes);
    couple(&mut s, vec![term(0, 0, 2.0), term(0, 1, -1.0)]);
    hold(&mut s, 0, &[0.4, 0.8], &[0.7, 1.4]);
    let (r, _) = reactions::<3>(&s);
    assert!(r.is_effort_unique(0) && r.effort(0).abs() > 0.1);
}
