//! Scenes in which single formulations stopped: sizes, light bodies, friction, almost parallel axes.

use super::{field, read, text, tilted};
use crate::common::random::tree;
use crate::common::{Bench, run_in};
use mbs::core::scene::{
    BodyId, Dimension, Effect, EffectKind, Friction, Inertia, JointId, Scene, Signal,
};
use mbs::core::step::StepError;
use mbs::{Method, ResolvedMethod, StopError};

/// Formulations in natural coordinates with steps of fixed length.
const NATURAL: [&str; 4] = ["index-3", "index-1", "classical", "state-space"];
/// Difference of formulations with the same steps [m or rad]: the tolerance of their iterations, summed over a run.
const AGREED: f64 = 1e-9;
/// Relative error that the rule's first steps from rest cause in a creep of ten seconds [-].
const CREEP: f64 = 1e-2;
/// Relative error that the rule's first steps from rest cause in a creep of a hundred steps [-].
const RINGING: f64 = 1e-4;
/// Difference of motions from rest [lengths]: the tolerance of the iterations, 1e-10 a step, summed over the steps.
const ALIKE: f64 = 1e-7;

/// Positions of the bodies' centres after `n` steps of `dt` [s].
fn centres<const D: usize>(
    scene: &Scene<f64>,
    formulation: &str,
    (dt, n): (f64, u32),
) -> Result<Vec<[f64; D]>, StopError> {
    let mut bench = Bench::<D>::of_scene(scene, formulation, dt);
    for _ in 0..n {
        bench.step()?;
    }
    let model = bench.simulation.model();
    let place = |b: usize| {
        let point = model.point(BodyId::Body(b), scene.bodies[b].center);
        point.value(&bench.simulation.state().q).into()
    };
    Ok((0..scene.bodies.len()).map(place).collect())
}

/// The scene at rest with all lengths multiplied.
fn sized(scene: &Scene<f64>, size: f64) -> Scene<f64> {
    let mut scene = scene.clone();
    scene.initials.clear();
    for body in &mut scene.bodies {
        body.center = body.center.map(|x| x * size);
        match &mut body.inertia {
            Inertia::Planar(inertia) => *inertia *= size * size,
            Inertia::Spatial(all) => all.iter_mut().for_each(|x| *x *= size * size),
            _ => {}
        }
    }
    for joint in &mut scene.joints {
        joint.points = joint.points.map(|p| p.map(|x| x * size));
    }
    scene
}

#[test]
fn index_1_runs_a_sprung_leg_as_the_others_do() {
    let scene = field("13-leg-index-1");
    let run = |formulation| {
        let outcome = run_in(&scene, formulation, None);
        assert_eq!(outcome.error, None, "{formulation}");
        outcome.rows().last().expect("a row").1[..4].to_vec()
    };
    let expected = run("index-3");
    for formulation in ["index-1", "classical", "state-space", "recursive"] {
        let values = run(formulation);
        let apart = values.iter().zip(&expected).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        assert!(apart < AGREED, "{formulation}: {apart:e}");
    }
}

#[test]
fn a_motion_from_rest_does_not_depend_on_the_size() {
    fn check<const D: usize>(seed: u64, dimension: Dimension) {
        let scene = tree(seed, dimension, 4);
        for formulation in NATURAL {
            let run = |size: f64| {
                let step = (1e-3 * size.sqrt(), 100);
                centres::<D>(&sized(&scene, size), formulation, step)
                    .unwrap_or_else(|e| panic!("{formulation}, {seed}, size {size}: {e}"))
            };
            let expected = run(1.0);
            for size in [1e-3, 1e2] {
                for (x, y) in run(size).iter().zip(&expected) {
                    for k in 0..D {
                        let off = (x[k] / size - y[k]).abs();
                        assert!(off < ALIKE, "{formulation}, {seed}, size {size}: {off:e}");
                    }
                }
            }
        }
    }
    for seed in 1..=4 {
        check::<2>(seed, Dimension::Planar);
        check::<3>(seed, Dimension::Spatial);
    }
}

#[test]
fn classical_does_not_take_thin_legs_for_dependent_constraints() {
    let scene = field("10-hexapod-thin-legs");
    let outcome = run_in(&scene, "classical", None);
    let is_true = match outcome.error {
        None => true,
        Some(StopError::Step(error, _)) => matches!(error, StepError::Singular(_)),
        Some(_) => false,
    };
    assert!(is_true, "{:?}", outcome.error);
}

#[test]
fn an_arm_held_by_friction_creeps_as_the_law_says() {
    let scene = field("08-friction-holds");
    for formulation in NATURAL.into_iter().chain(["recursive", "multi-index"]) {
        let mut bench = Bench::<2>::of_scene(&scene, formulation, 1e-3);
        bench.run(10.0, |_| {}).unwrap_or_else(|(t, e)| panic!("{formulation} at {t} s: {e}"));
        let tip = bench.position(&bench.point(0, [1.0, 0.0, 0.0]));
        let angle = tip[1].atan2(tip[0]);
        let right = -7.761_090e-3;
        assert!((angle - right).abs() < -CREEP * right, "{formulation}: {angle:e}");
    }
}

#[test]
fn several_frictions_are_followed_in_natural_coordinates() {
    for seed in 1..=6 {
        let mut scene = tree(seed, Dimension::Planar, 4);
        for joint in 0..scene.joints.len() {
            let coulomb = 10.0 / (1 + joint) as f64;
            let r#static = coulomb * (1.0 + 0.5 * (joint % 2) as f64);
            let kind = EffectKind::Friction(Friction {
                joint: JointId::new(joint),
                coordinate: None,
                coulomb,
                r#static,
                stribeck: 1e-2,
                viscous: 0.0,
                regularisation: 1e-3,
                factor: Signal::Constant([1.0, 0.0, 0.0]),
            });
            scene.effects.push(Effect { name: format!("f{joint}"), enabled: true, kind });
        }
        for formulation in NATURAL {
            let centres = centres::<2>(&scene, formulation, (1e-3, 200));
            assert!(centres.is_ok(), "{formulation}, {seed}: {centres:?}");
        }
    }
}

#[test]
fn explicit_steps_that_pass_over_a_friction_stop_and_name_it() {
    let scene = field("08-friction-holds");
    let [formulation, integrator] = ["recursive", "rk4"].map(|x| Some(x.to_owned()));
    let overrides = Method { formulation, integrator, ..Method::default() };
    let outcome = crate::common::run(&scene, &overrides);
    assert!(matches!(outcome.error, Some(StopError::Friction { effect: 0, .. })));
    let error = outcome.summary.error.expect("an error in the summary");
    assert_eq!(error.code, "friction-not-resolved");
    assert!(error.message.starts_with("`brake`"), "{}", error.message);
}

#[test]
fn an_axis_that_is_off_by_a_millionth_runs_as_the_parallel_one_with_a_note() {
    let straight = centres::<3>(&tilted(0.0), "index-3", (1e-3, 200)).expect("it runs");
    for angle in [1e-9, 1e-7, 9e-7] {
        let scene = tilted(angle);
        for formulation in ["index-3", "recursive"] {
            let outcome = run_in(&scene, formulation, None);
            assert_eq!(outcome.error, None, "{formulation}, {angle:e}");
            let is_named = outcome.notes().iter().any(|note| note.contains("`C`"));
            assert!(is_named, "{angle:e}: {:?}", outcome.notes());
        }
        let centres = centres::<3>(&scene, "index-3", (1e-3, 200)).expect("it runs");
        assert_eq!(centres, straight, "{angle:e}");
    }
}

#[test]
fn an_axis_that_is_off_by_more_is_refused_with_the_axis_that_mends_it() {
    for angle in [1e-5, 1e-4, 9e-4] {
        let scene = tilted(angle);
        let outcome = run_in(&scene, "index-3", None);
        let Some(StopError::AlmostDependent(tilt)) = outcome.error else {
            panic!("{angle:e}: {:?}", outcome.error)
        };
        assert_eq!((tilt.joints[0], tilt.axis), (2, [0.0, 0.0, 1.0]));
        assert!((tilt.angle - angle).abs() < 1e-9);
        let error = outcome.summary.error.expect("an error in the summary");
        assert_eq!((error.code.as_str(), error.joint.as_deref()), ("almost-dependent", Some("C")));
    }
    // an intended angle, or an axis that constrains nothing, is not changed
    let outcome = ResolvedMethod::new(&tilted(1e-2), &Method::default())
        .map(|settings| mbs::typed::run::<f64, 3>(&tilted(1e-2), &settings, &mut ()).error);
    assert!(!matches!(outcome, Ok(Some(StopError::AlmostDependent(_)))));
    let mut open = tilted(1e-4);
    open.joints.retain(|joint| joint.name != "D");
    assert!(centres::<3>(&open, "index-3", (1e-3, 5)).is_ok());
}

/// Last axis of the arm in its scene file.
const LEANING: &str = "axis = [1.0, 0.0, -7e-6]";

#[test]
fn a_tilt_of_the_fifth_digit_that_takes_a_freedom_of_what_moves_runs_as_none_with_a_note() {
    let text = text("45-hand-held");
    let centres = |axis: &str| {
        assert!(text.contains(LEANING));
        let scene = read(&text.replace(LEANING, axis), "arm");
        let outcome = run_in(&scene, "index-1", None);
        assert_eq!(outcome.error, None, "{axis}");
        let is_named = outcome.notes().iter().any(|note| note.contains("`j6`"));
        (centres::<3>(&scene, "index-1", (1e-3, 200)).expect("it runs"), is_named)
    };
    let (straight, is_named) = centres("axis = [1.0, 0.0, 0.0]");
    assert!(!is_named);
    for axis in [LEANING, "axis = [1.0, 0.0, 2e-6]", "axis = [-1.0, 0.0, 9e-6]"] {
        let (centres, is_named) = centres(axis);
        assert!(is_named, "{axis}");
        for (own, right) in centres.iter().zip(&straight) {
            assert!(own.iter().zip(right).all(|(x, y)| (x - y).abs() < ALIKE), "{axis}");
        }
    }
}

#[test]
fn an_arm_of_links_without_mass_creeps_as_its_friction_lets_it() {
    let scene = field("58-held-hand");
    // regularised friction: the creep rate is e s / sqrt(1 - s^2) with s = m g / C and e = 1 mm/s
    let s: f64 = 0.73 * 9.81 / 10.0;
    let right = 1e-3 * s / (1.0 - s * s).sqrt();
    for formulation in ["index-3", "index-1"] {
        for step in [1e-2, 1e-3, 1e-4] {
            let mut bench = Bench::<3>::of_scene(&scene, formulation, step);
            for _ in 0..100 {
                bench.step().expect("it creeps");
            }
            let simulation = &bench.simulation;
            let hand = simulation.model().point(BodyId::Body(0), [0.0; 3]);
            let rate = -hand.rate(&simulation.state().v)[2];
            assert!((rate - right).abs() < RINGING * right, "{formulation}, {step}: {rate}");
        }
    }
}
