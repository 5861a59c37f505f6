//! Effects on sums of joint coordinates and lengths: sum, rate and gradient over several turns.

use crate::gradient::{evaluate, gradients, scatter};
use mbs_core::algebra::{Vector, rotation};
use mbs_core::model::{Model, State};
use mbs_core::natural::NaturalModel;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::Scene;
use mbs_testkit::{Random, model, scene};

type V = Vector<f64, 3>;

/// Step of central differences. The rounding error is 1e-16 of a sum of ten, divided by the step. The truncation error is the
/// square of the step times third derivatives of order one.
const STEP: f64 = 1e-5;
/// Largest difference of gradients and rates from difference quotients [-].
const DIFFERENCE: f64 = 1e-8;
/// Factors of two rotations, a slide and a line.
const FACTORS: [f64; 4] = [1.3, -2.0, 0.7, 0.4];

/// Axes of the rotations and of the slide.
const AXES: [[f64; 3]; 3] = [[0.36, 0.48, 0.8], [0.6, -0.8, 0.2], [-0.2, 0.9, 0.4]];

fn chain() -> Scene<f64> {
    let mut text = "[scene]\nname = \"sum\"\ndimension = 3\nduration = 1.0\n".to_owned();
    let kinds = ["revolute", "revolute", "prismatic"];
    for (i, (axis, kind)) in AXES.iter().zip(kinds).enumerate() {
        let x = i as f64;
        let before = if i == 0 { "ground".to_owned() } else { format!("b{}", i - 1) };
        text += &format!(
            "[[body]]\nname = \"b{i}\"\nmass = 1.0\ncenter = [{:?}, 0.2, 0.1]\ninertia = [0.1, 0.1, 0.1, 0.0, 0.0, 0.0]\n\
             [[joint]]\nname = \"j{i}\"\nkind = \"{kind}\"\nbodies = [\"{before}\", \"b{i}\"]\nat = [{x:?}, 0.0, 0.0]\naxis = {axis:?}\n",
            x + 0.5
        );
    }
    let [a, b, c, d] = FACTORS;
    text += &format!(
        "[[effect]]\nkind = \"torsion-spring\"\nstiffness = 1.0\n\
         terms = [{{ joint = \"j0\", factor = {a:?} }}, {{ joint = \"j1\", factor = {b:?} }}, {{ joint = \"j2\", factor = {c:?} }}, \
         {{ points = [{{ body = \"ground\", at = [0.0, 1.0, 0.0] }}, {{ body = \"b1\", at = [1.5, 0.3, 0.2] }}, {{ body = \"b2\", at = [2.5, 0.0, 0.4] }}], factor = {d:?} }}]\n"
    );
    scene(&text)
}

/// State of the chain at given angles of its hinges and displacement of its slide.
fn placed(scene: &Scene<f64>, model: &NaturalModel<f64, 3>, [a, b, slide]: [f64; 3]) -> State<f64> {
    let unit = |axis: [f64; 3]| V::from(axis) / V::from(axis).norm();
    let first = rotation(&(unit(AXES[0]) * a));
    let second = first * rotation(&(unit(AXES[1]) * b));
    let mut motions =
        scene.bodies.iter().map(|_| RigidMotion::at_rest(V::zeros())).collect::<Vec<_>>();
    for (motion, rotation) in motions.iter_mut().zip([first, second, second]) {
        motion.rotation = rotation;
    }
    let hinge = V::new(1.0, 0.0, 0.0);
    motions[1].position = first * hinge - second * hinge;
    motions[2].position = motions[1].position + second * unit(AXES[2]) * slide;
    let mut state = State::at_rest(model);
    model.write_motions(&motions, &mut state);
    for ((joint, _), sign, place) in model.coupled_angles() {
        state.memory[place] = sign * [a, b][joint];
    }
    state
}

/// Length of the line, less its length in the reference configuration.
fn line(scene: &Scene<f64>, model: &NaturalModel<f64, 3>, state: &State<f64>) -> f64 {
    let [p, q, r] = [[0.0, 1.0, 0.0], [1.5, 0.3, 0.2], [2.5, 0.0, 0.4]].map(V::from);
    let at = |body: usize, x: &V| model.motion(scene, body, state).point(x)[0];
    let length = |p: V, q: V, r: V| (q - p).norm() + (r - q).norm();
    length(p, at(1, &q), at(2, &r)) - length(p, q, r)
}

#[test]
fn sums_count_turns_and_have_the_gradient_of_their_differences() {
    let scene = chain();
    let model = model::<3>(&scene);
    let mut terms = model.terms();
    let random = &mut Random(17);
    for _ in 0..30 {
        let [a, b] = [0; 2].map(|_| 6.0 * core::f64::consts::PI * random.next());
        let mut state = placed(&scene, &model, [a, b, 0.3]);
        evaluate(&model, &state, &mut terms);
        let parts = [a, b, 0.3, line(&scene, &model, &state)];
        let sum: f64 = FACTORS.iter().zip(parts).map(|(c, m)| c * m).sum();
        let found = terms.measures[0].value;
        assert!((found - sum).abs() < 1e-13 * (1.0 + sum.abs()), "{parts:?}: {found} {sum}");
        scatter(&model, &mut state, 0.05, random);
        evaluate(&model, &state, &mut terms);
        let at = terms.measures[0];
        let mut rate = 0.0;
        for (i, [gradient, slope]) in gradients(&model, &state, STEP).into_iter().enumerate() {
            assert!((gradient - slope).abs() < DIFFERENCE, "{a}, {b}, {i}: {gradient} {slope}");
            rate += gradient * state.v[i];
        }
        assert!((rate - at.rate).abs() < 1e-12 * (1.0 + rate.abs()), "{rate} {}", at.rate);
    }
}
