//! Inverse kinematics of a tree: poses that its joints can reach, ranges, closed loops, and poses out of reach.

use crate::tree::{mechanisms, tree, wandering};
use mbs::core::scene::{BodyId, JointId, Scene};
use mbs::{Error as _, FrameTarget, InverseKinematicsEnd as End, Mechanism, Method, Tree};
use mbs_testkit::random::Random;
use mbs_testkit::{close, file};

/// Error of a reached pose, relative to the scene's length, and in radians.
const REACHED: f64 = 1e-11;

fn pose(tree: &mut Tree, body: BodyId, at: [f64; 3]) -> FrameTarget {
    let (position, rotation) = (tree.point(body, at).position, tree.pose(body).rotation);
    FrameTarget { position: Some(position), rotation: Some(rotation) }
}

#[test]
fn a_place_that_the_joints_have_taken_a_body_to_is_found_again_from_nearby() {
    for scene in mechanisms() {
        let mut tree = wandering(&scene, 2);
        let (body, n) = (BodyId::Body(scene.bodies.len() - 1), tree.velocities().len());
        let at = [0.3, 0.2, 0.0];
        let target = pose(&mut tree, body, at);
        let (q, mut start) = (tree.coordinates().to_vec(), tree.coordinates().to_vec());
        let step = Random::new(4).vector(n, n, 0.2);
        tree.integrate(&q, &step, &mut start).expect("a step");
        tree.set(&start, &vec![0.0; n]).expect("a state");
        let found = tree.inverse_kinematics(body, at, &target).expect("no loops");
        assert_eq!(found.end, End::Reached, "{}: {found:?}", scene.name);
        assert!(found.steps < 20, "{}: {found:?}", scene.name);
        let now = tree.point(body, at).position;
        close(&scene.name, &now, &target.position.expect("a place"), REACHED * 10.0);
    }
}

/// Scene of two planar rods of a metre, from the origin along x.
fn rods(ranges: [Option<[f64; 2]>; 2]) -> Scene<f64> {
    let mut scene = file("double-pendulum");
    for (joint, range) in scene.joints.iter_mut().zip(ranges) {
        joint.limits.range = range;
    }
    scene
}

#[test]
fn joints_keep_their_range_and_are_named_where_it_keeps_the_body_from_its_place() {
    let tip = (BodyId::Body(1), [2.0, 0.0, 0.0]);
    let place = |x: f64, y: f64| FrameTarget { position: Some([x, y, 0.0]), rotation: None };
    // the elbow stays above the line: only one of the two solutions has an angle within the range
    let mut up = tree(&rods([None, Some([-3.0, 0.0])]));
    up.set(&[0.3, -0.1], &[0.0; 2]).expect("a state");
    let found = up.inverse_kinematics(tip.0, tip.1, &place(1.0, 1.0)).expect("open");
    assert_eq!(found.end, End::Reached);
    close(
        "elbow",
        up.coordinates(),
        &[std::f64::consts::FRAC_PI_2, -std::f64::consts::FRAC_PI_2],
        1e-9,
    );
    // the range of the shoulder does not allow the solution
    let mut held = tree(&rods([Some([-0.5, 0.5]), Some([-0.2, 0.2])]));
    held.set(&[0.3, 0.1], &[0.0; 2]).expect("a state");
    let found = held.inverse_kinematics(tip.0, tip.1, &place(0.0, 1.9)).expect("open");
    assert_eq!(found.end, End::AtRange(vec![JointId::new(0), JointId::new(1)]));
    close("ends", held.coordinates(), &[0.5, 0.2], 1e-12);
    // out of reach: the rods point to the target, which is the nearest position
    let mut far = tree(&rods([None; 2]));
    far.set(&[0.3, 0.3], &[0.0; 2]).expect("a state");
    let found = far.inverse_kinematics(tip.0, tip.1, &place(0.0, 3.0)).expect("open");
    assert_eq!(found.end, End::Nearest);
    assert!((found.distance - 1.0).abs() < 1e-9, "{found:?}");
    let skew = FrameTarget {
        position: None,
        rotation: Some([[1.0, 0.1, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
    };
    let skew = far.inverse_kinematics(tip.0, tip.1, &skew).expect_err("no rotation");
    assert_eq!(skew.code(), "no-rotation");
    let nan = far.inverse_kinematics(tip.0, tip.1, &place(f64::NAN, 0.0)).expect_err("no number");
    assert_eq!(nan.code(), "not-finite");
}

#[test]
fn a_mechanism_with_loops_is_moved_to_where_a_simulation_had_its_body() {
    for name in ["four-bar", "rssr", "slider-crank"] {
        let path = format!("{}/../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let m = Mechanism::read(path).expect("a scene");
        let mut simulation = m.simulate(&Method::default()).expect("a model");
        let mut tree = m.tree().expect("a tree");
        tree.follow(&simulation).expect("its own simulation");
        let start = tree.coordinates().to_vec();
        for _ in 0..50 {
            simulation.step(1e-3).expect("a step");
        }
        tree.follow(&simulation).expect("its own simulation");
        let wanted = tree.coordinates().to_vec();
        let body = BodyId::Body(1);
        let target = pose(&mut tree, body, [0.3, 0.1, 0.0]);
        tree.set(&start, &vec![0.0; tree.velocities().len()]).expect("a state");
        let found = tree.inverse_kinematics(body, [0.3, 0.1, 0.0], &target).expect("closed loops");
        // steps leave a violation of 1e-9 in the loops, and the pose has the same error
        assert!(found.distance < 1e-7 && found.angle < 1e-7, "{name}: {found:?}");
        close(name, tree.coordinates(), &wanted, 1e-6);
    }
}

#[test]
fn a_position_that_is_far_from_closing_its_loops_is_refused_and_kept() {
    let mut bars = tree(&file("four-bar"));
    let n = bars.velocities().len();
    // this state is far from closing the loop: the rods point away from each other
    let apart = [2.5, -2.0, 1.9];
    bars.set(&apart, &vec![0.0; n]).expect("a state");
    let target = FrameTarget::default();
    match bars.inverse_kinematics(BodyId::Body(0), [0.0; 3], &target) {
        Ok(found) => assert_eq!(found.end, End::Reached, "with closed loops and nothing asked"),
        Err(error) => {
            assert_eq!(error.code(), "open-loops");
            close("position", bars.coordinates(), &apart, 0.0);
        }
    }
}
