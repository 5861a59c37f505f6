//! Swing and twist of a ball joint: value, rate and gradient compared with rotations, over full turns, and close to swing zero.

use crate::gradient::{evaluate, gradients, scatter};
use mbs_core::algebra::{Vector, cross, rotation};
use mbs_core::model::{Load, Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::Scene;
use mbs_testkit::{Random, model, residual, scene};

type V = Vector<f64, 3>;

/// Step of central differences. The rounding error is 1e-16 of an angle, divided by the step. The truncation error is the square of
/// the step times third derivatives of order ten.
const STEP: f64 = 1e-5;
/// Largest difference of gradients and rates from difference quotients [-].
const DIFFERENCE: f64 = 1e-7;
/// Axis of both angles, which is no unit vector.
const AXIS: [f64; 3] = [0.72, 0.96, 1.6];

/// Scene of two bodies on ball joints, with a spring on one angle of the second joint.
fn chain(angle: &str) -> Scene<f64> {
    let body = |name: &str, x: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 1.0\ncenter = [{x:?}, 0.2, 0.1]\ninertia = [0.1, 0.12, 0.14, 0.0, 0.01, 0.0]\n"
        )
    };
    let ball = |name: &str, bodies: [&str; 2], x: f64| {
        format!(
            "[[joint]]\nname = \"{name}\"\nkind = \"spherical\"\nbodies = {bodies:?}\nat = [{x:?}, 0.0, 0.0]\n"
        )
    };
    scene(&format!(
        "[scene]\nname = \"ball\"\ndimension = 3\nduration = 1.0\n{}{}{}{}[[effect]]\nkind = \"torsion-spring\"\nstiffness = 1.0\njoint = \"b\"\ncoordinate = \"{angle}\"\naxis = {AXIS:?}\n",
        body("one", 0.5),
        body("two", 1.5),
        ball("a", ["ground", "one"], 0.0),
        ball("b", ["one", "two"], 1.0),
    ))
}

/// State of the chain in which each body is rotated by a rotation vector relative to its parent.
fn placed(scene: &Scene<f64>, model: &NaturalModel<f64, 3>, [first, own]: [V; 2]) -> State<f64> {
    let first = rotation(&first);
    let second = first * rotation(&own);
    let mut motions: Vec<_> =
        scene.bodies.iter().map(|_| RigidMotion::at_rest(V::zeros())).collect();
    let hinge = V::new(1.0, 0.0, 0.0);
    (motions[0].rotation, motions[1].rotation) = (first, second);
    motions[1].position = first * hinge - second * hinge;
    let mut state = State::at_rest(model);
    model.write_motions(&motions, &mut state);
    state
}

/// Rotation vector of a rotation about the axis followed by a swing about a perpendicular direction.
fn turned(twist: f64, swing: f64, about: f64) -> (V, [f64; 2]) {
    let axis = V::from(AXIS) / V::from(AXIS).norm();
    let across = rotation(&(axis * about)) * cross(&axis, &V::new(1.0, 0.0, 0.0)).normalize();
    let r = rotation(&(across * swing)) * rotation(&(axis * twist));
    (mbs_core::algebra::rotation_vector(&r), [swing, twist])
}

#[test]
fn swing_and_twist_are_those_of_the_rotation_and_have_the_gradient_of_their_differences() {
    let tau = core::f64::consts::TAU;
    for (number, angle) in ["swing", "twist"].into_iter().enumerate() {
        let scene = chain(angle);
        let model = model::<3>(&scene);
        let mut terms = model.terms();
        let random = &mut Random(23);
        for _ in 0..30 {
            let twist = 3.0 * tau * random.next();
            let swing = 1.3 + 1.1 * random.next();
            let (own, angles) = turned(twist, swing, 3.0 * random.next());
            let first = V::from_fn(|_, _| random.next());
            let mut state = placed(&scene, &model, [first, own]);
            // the last angle, relative to which turns are counted
            if let Some(place) = model.memory_of_effect(0) {
                state.memory[place] = twist + 0.4;
            }
            evaluate(&model, &state, &mut terms);
            let found = terms.measures[0].value;
            assert!((found - angles[number]).abs() < 1e-12, "{angle}: {found} {angles:?}");
            scatter(&model, &mut state, 0.03, random);
            evaluate(&model, &state, &mut terms);
            let at = terms.measures[0];
            let mut rate = 0.0;
            for (i, [gradient, slope]) in gradients(&model, &state, STEP).into_iter().enumerate() {
                let most = DIFFERENCE * (1.0 + slope.abs());
                assert!((gradient - slope).abs() < most, "{angle}, {i}: {gradient} {slope}");
                rate += gradient * state.v[i];
            }
            assert!((rate - at.rate).abs() < 1e-10 * (1.0 + rate.abs()), "{rate} {}", at.rate);
        }
    }
}

#[test]
fn at_no_swing_the_swing_has_no_gradient() {
    let scene = chain("swing");
    let model = model::<3>(&scene);
    let mut terms = model.terms();
    let mut state = State::at_rest(&model);
    state.v.iter_mut().take(9).for_each(|v| *v = 0.3);
    evaluate(&model, &state, &mut terms);
    let at = terms.measures[0];
    assert_eq!((at.value, at.rate, at.tension), (0.0, 0.0, 0.0));
    let force = residual(&model, &terms, &Load { mass: None, multipliers: None, force: 1.0 });
    assert!(force.iter().all(|f| *f == 0.0), "{force:?}");
}
