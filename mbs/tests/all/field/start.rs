//! Starts that were wrong, or that were refused without a reason.

use super::{field, read, text};
use mbs::Method;
use mbs::core::Real;
use mbs::core::model::State;
use mbs::core::natural::NaturalModel;
use mbs::core::scene::{InitialCondition, InitialTarget, JointId, Scene};
use mbs::core::start::AssemblyError;
use mbs::scene_file::SceneFile;
use mbs_testkit::{invariant, start, start_in};

/// Precision of the reference values, by their number of digits [m or rad].
const PRINTED: f64 = 1e-6;
/// Largest error of prescribed initial values [rad].
const HELD: f64 = 1e-12;

/// Angles and rates of planar bodies relative to each other.
fn turns<T: Real>(scene: &Scene<T>, model: &NaturalModel<T, 2>, state: &State<T>) -> Vec<[f64; 2]> {
    let all = (0..scene.bodies.len()).map(|body| {
        let motion = model.motion(scene, body, state);
        let (sine, cosine) = (motion.rotation[(1, 0)], motion.rotation[(0, 0)]);
        [sine.atan2(cosine).to_f64(), motion.omega[2].to_f64()]
    });
    let mut last = [0.0; 2];
    all.map(|now| {
        let turn = std::array::from_fn(|i| now[i] - last[i]);
        last = now;
        turn
    })
    .collect()
}

/// The scene with all lengths multiplied.
fn sized(scene: &Scene<f64>, size: f64) -> Scene<f64> {
    let mut scene = scene.clone();
    for body in &mut scene.bodies {
        body.center = body.center.map(|x| x * size);
        if let mbs::core::scene::Inertia::Planar(inertia) = &mut body.inertia {
            *inertia *= size * size;
        }
    }
    for joint in &mut scene.joints {
        joint.points = joint.points.map(|p| p.map(|x| x * size));
    }
    scene
}

fn hold(scene: &mut Scene<f64>, joint: &str, value: f64) {
    let joint = scene.joints.iter().position(|j| j.name == joint).expect("a joint of the scene");
    let target =
        InitialTarget::Joint { joint: JointId::new(joint), value: Some(vec![value]), rate: None };
    scene.initials.push(InitialCondition { target });
}

#[test]
fn rates_that_are_not_held_do_not_depend_on_the_size() {
    let scene = field("18-start-of-a-millimetre-pendulum");
    for size in [1e-2, 0.1, 1.0, 30.0, 1e3, 1e5] {
        let scene = sized(&scene, size);
        let (model, state) = start::<2>(&scene);
        let [p, q] = turns(&scene, &model, &state)[..] else { panic!("two bodies") };
        assert!((p[1] + 2.678_571).abs() < PRINTED, "{} at {size}", p[1]);
        assert!((q[1] - 10.0).abs() < HELD * 10.0, "{} at {size}", q[1]);
    }
}

#[test]
fn positions_that_are_not_held_change_least_from_the_reference() {
    for (value, expected) in [(0.5, -0.141_780_5), (1.5, -0.436_178_6)] {
        let mut scene = field("18-start-of-a-millimetre-pendulum");
        scene.initials.clear();
        hold(&mut scene, "q", value);
        for size in [1.0, 1e3, 1e5] {
            let scene = sized(&scene, size);
            let (model, state) = start::<2>(&scene);
            let p = turns(&scene, &model, &state)[0][0];
            assert!((p - expected).abs() < PRINTED, "{p} with {value} held at {size}");
        }
    }
}

#[test]
fn single_precision_starts_where_double_does() {
    let document = SceneFile::parse(&text("18-start-in-f32"), "start").expect("a scene file");
    let scene = document.scene::<f32>().expect("a scene");
    let (model, state) = start_in::<f32, 2>(&scene);
    let found = turns(&scene, &model, &state);
    for (found, expected) in found.iter().zip([-0.825_236, 2.093_675]) {
        assert!((found[1] - expected).abs() < 1e-4, "{found:?} for {expected}");
    }
    assert!((invariant(&model, &state) + 1.21).abs() < 0.01, "{}", invariant(&model, &state));
}

#[test]
fn a_tree_with_all_values_starts_whatever_its_inertias_are() {
    for inertia in ["1e-7, 1e-7, 1e-7", "0.0, 0.0, 0.0"] {
        let text = text("06-tree-tiny-pieces").replace("1e-7, 1e-7, 1e-7", inertia);
        let scene = read(&text, "tree");
        let (model, state) = start::<3>(&scene);
        let arm = model.motion(&scene, 2, &state);
        // the arm has the rotation Ry(0.8) Rx(-0.9) Rz(0.3)
        let about = |axis: usize, angle: f64| {
            let w: [f64; 3] = std::array::from_fn(|i| if i == axis { angle } else { 0.0 });
            mbs::core::algebra::rotation(&w.into())
        };
        let expected = about(1, 0.8) * about(0, -0.9) * about(2, 0.3);
        assert!((arm.rotation - expected).iter().all(|x| x.abs() < HELD), "{}", arm.rotation);
    }
}

#[test]
fn an_open_chain_starts_at_every_held_angle() {
    let mut scene = field("19-open-chain-refused");
    let (model, state) = start::<2>(&scene);
    let found = turns(&scene, &model, &state);
    let slide = {
        let (b, c) = (model.motion(&scene, 1, &state), model.motion(&scene, 2, &state));
        let at = mbs::core::algebra::vector([-1.3, 0.0, 0.0]);
        let along = b.direction(&mbs::core::algebra::vector([0.73, 0.68, 0.0]))[0];
        (c.point(&at)[0] - b.point(&at)[0]).dot(&along) / along.dot(&along).sqrt()
    };
    assert!((found[1][0] - 0.628_562_8).abs() < PRINTED, "{found:?}");
    assert!((slide + 0.087_098_3).abs() < PRINTED, "{slide}");
    for i in -60..=60 {
        scene.initials.clear();
        let angle = f64::from(i) * 0.05;
        hold(&mut scene, "p", angle);
        let (model, state) = start::<2>(&scene);
        let p = turns(&scene, &model, &state)[0][0];
        assert!((p - angle).abs() < HELD, "{p} for {angle}");
    }
}

#[test]
fn loops_and_massless_pieces_of_published_models_start() {
    for name in ["15-massless-slides", "15-knee", "15-rigid-motion-of-a-loop", "15-four-loops"] {
        let _ = start::<3>(&field(name));
    }
    let scene = field("15-massless-slides");
    let run = crate::common::run(&scene, &Method::default());
    assert!(run.error.is_none(), "{:?}", run.error);
    let last = &run.rows().last().expect("rows").1;
    let expected = [0.02, -0.03 - 9.81 * 0.01 / 2.0, 0.5];
    for (found, expected) in last.iter().zip(expected) {
        assert!((found - expected).abs() < PRINTED, "{last:?}");
    }
}

#[test]
fn knees_and_feet_of_four_loops_start_at_values_within_reach() {
    let scene = field("15-four-loops");
    let groups: [&[&str]; 5] = [
        &["left-knee-op"],
        &["right-knee-op"],
        &["left-knee-op", "right-knee-op"],
        &["left-foot-op", "right-foot-op"],
        &["left-foot-op", "right-knee-op"],
    ];
    for group in groups {
        for value in [-0.6, -0.2, 0.3, 0.6] {
            let mut scene = scene.clone();
            scene.initials.clear();
            group.iter().for_each(|joint| hold(&mut scene, joint, value));
            let _ = start::<3>(&scene);
        }
    }
}

#[test]
fn a_value_out_of_reach_is_named_with_the_value_that_was_reached() {
    // the rocker of a four-bar linkage with a crank of 0.3 m and sides of 0.7, 0.76 and 0.6 m swings within limits
    let mut scene = crate::common::scene("guided-four-bar");
    scene.guides.clear();
    scene.initials.clear();
    let rocker = scene.joints[3].name.clone();
    hold(&mut scene, &rocker, 3.0);
    let run = crate::common::run(&scene, &Method::default());
    match run.error {
        Some(mbs::StopError::Start(AssemblyError::Position {
            reached: Some([reached, value]),
            initial: Some(0),
            residual,
            ..
        })) => {
            assert!(
                (value.abs() - 3.0).abs() < 1e-12 && reached.abs() < 2.9,
                "{reached} of {value}"
            );
            assert!(residual > 0.1 && residual < 4.0, "{residual}");
        }
        other => panic!("{other:?}"),
    }
}
