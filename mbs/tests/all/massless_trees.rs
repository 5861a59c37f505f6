//! Trees with joints that move no inertia. Positions, Jacobians and inverse kinematics do not need inertia. Frames have the names of their
//! bodies.

use crate::tree::tree;
use mbs::scene_file::SceneFile;
use mbs::{BodyId, Error as _, FrameTarget, InverseKinematicsEnd, Tree};
use mbs_testkit::{close, file};

/// Relative rounding error through trees of some bodies [-].
const ROUNDING: f64 = 1e-12;

fn massless(name: &str) -> Tree {
    let mut scene = file(name);
    for body in &mut scene.bodies {
        (body.mass, body.inertia) = (0.0, mbs::core::scene::Inertia::Planar(0.0));
    }
    tree(&scene)
}

#[test]
fn places_jacobians_and_inverse_kinematics_do_not_depend_on_masses() {
    let (mut light, mut heavy) = (massless("double-pendulum"), tree(&file("double-pendulum")));
    let tip = (BodyId::new(1), [2.0, 0.0, 0.0]);
    for tree in [&mut light, &mut heavy] {
        tree.set(&[0.4, -1.1], &[1.3, -0.7]).expect("a state");
    }
    let [one, other] = [&mut light, &mut heavy].map(|tree| {
        let mut all = tree.jacobian_at(tip.0, tip.1).data.clone();
        all.extend(tree.jacobian_rate_at(tip.0, tip.1).data.iter());
        let point = tree.point(tip.0, tip.1);
        all.extend([point.position, point.velocity, point.acceleration].concat());
        all.extend(tree.bias_forces().iter().map(|x| x * 0.0));
        all
    });
    close("places", &one, &other, ROUNDING);
    let target = FrameTarget { position: Some([1.0, 1.0, 0.0]), ..FrameTarget::default() };
    let found = light.inverse_kinematics(tip.0, tip.1, &target).expect("finite");
    assert_eq!(found.end, InverseKinematicsEnd::Reached);
    close("g", light.gravity_forces(), &[0.0; 2], ROUNDING);
    close("effort", light.inverse_dynamics(&[1.0, 2.0]).expect("open"), &[0.0; 2], ROUNDING);
}

#[test]
fn loops_without_masses_are_closed_by_inverse_kinematics() {
    let mut tree = massless("four-bar");
    let start = tree.point(BodyId::new(1), [1.0, 1.5, 0.0]).position;
    let target = [start[0] + 0.05, start[1], 0.0];
    let crank = tree.coordinates()[0];
    tree.inverse_kinematics(
        BodyId::new(1),
        [1.0, 1.5, 0.0],
        &FrameTarget { position: Some(target), ..FrameTarget::default() },
    )
    .expect("loops close");
    assert!((tree.coordinates()[0] - crank).abs() > 1e-3);
    let (mut same, mut q) = (file("four-bar"), tree.coordinates().to_vec());
    same.effects.clear();
    let mut heavy = self::tree(&same);
    heavy.set(&q, &vec![0.0; q.len()]).expect("a state");
    heavy.make_consistent().expect("it closes");
    q.iter_mut().zip(heavy.coordinates()).for_each(|(q, x)| *q -= x);
    close("closed", &q, &vec![0.0; q.len()], 1e-9);
}

#[test]
fn what_needs_inertia_is_refused_by_the_name_of_the_body() {
    let mut tree = massless("double-pendulum");
    let mut errors = vec![tree.inertia_fault().expect("it lacks some").clone()];
    errors.extend(tree.forward_dynamics(&[0.0, 0.0]).err());
    errors.extend(tree.accelerations().err());
    errors.extend(tree.forward_dynamics_derivatives(&[0.0, 0.0]).err());
    errors.extend(tree.mobility_at(BodyId::new(1), [2.0, 0.0, 0.0]).err());
    errors.extend(tree.make_consistent().err());
    assert_eq!(errors.len(), 6);
    for error in errors {
        assert_eq!((error.code(), error.body()), ("no-inertia", Some("upper")));
        assert!(error.hint().expect("a hint").contains("mass"));
    }
}

/// Scene of a pendulum with two frames: one with the body's name, rotated by a right angle, and another one.
const FRAMED: &str = r#"
[scene]
name = "framed"
dimension = 3
duration = 1.0

[[body]]
name = "arm"
mass = 2.0
center = [0.5, 0.0, 0.0]
inertia = [0.1, 0.1, 0.1, 0.0, 0.0, 0.0]

[[joint]]
name = "pivot"
kind = "revolute"
bodies = ["ground", "arm"]
at = [0.0, 0.0, 0.0]
axis = [0.0, 0.0, 1.0]

[[frame]]
name = "arm"
body = "arm"
at = [0.2, 0.0, 0.0]
axes = [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]

[[output]]
name = "place"
body = "arm"
quantity = "position"
"#;

#[test]
fn a_frame_of_its_bodys_name_stands_for_the_body_in_places_and_jacobians() {
    let scene = SceneFile::parse(FRAMED, "framed.toml").and_then(|file| file.scene());
    let scene = scene.unwrap_or_else(|error| panic!("{}", error.render()));
    let mut tree = tree(&scene);
    tree.set(&[std::f64::consts::FRAC_PI_2], &[1.0]).expect("a state");
    let frame = tree.frame("arm").expect("it is there");
    close("place", &frame.position, &[0.0, 0.2, 0.0], ROUNDING);
    close(
        "axes",
        &frame.rotation.concat(),
        &[-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0],
        ROUNDING,
    );
    let names: Vec<String> = tree.frames().map(|(name, _)| name.to_owned()).collect();
    assert_eq!(names, ["arm"]);
    let centers: Vec<[f64; 3]> = tree.centers().map(|(_, center)| center.position).collect();
    close("centre", &centers.concat(), &[0.0, 0.5, 0.0], ROUNDING);
    let (body, at) = tree.frame_place("arm").expect("it is there");
    close("jacobian", tree.jacobian_at(body, at).row(0), &[-0.2], ROUNDING);
    tree.set(&[0.3], &[0.0]).expect("a state");
    let target = FrameTarget { rotation: Some(frame.rotation), ..FrameTarget::default() };
    let found = tree.inverse_kinematics_of("arm", &target).expect("a target");
    assert_eq!(found.end, InverseKinematicsEnd::Reached);
    close("turned", tree.coordinates(), &[std::f64::consts::FRAC_PI_2], 1e-9);
    let error = tree.inverse_kinematics_of("amr", &target).expect_err("no such frame");
    assert_eq!(
        (error.code(), error.hint().as_deref()),
        ("unknown-name", Some("did you mean `arm`?"))
    );
}
