//! A row of planar four-bar linkages, side by side.

use super::text::{self, vector};
use mbs_core::scene::{Body, BodyId, Dimension, GROUND, InitialCondition, Joint, JointId, Number};

const COMMENT: &str = "\
Four-bar linkages side by side: uniform rods of 1 m and 1 kg, cranks up, tips moving at 1 m/s in x.

The scene four-bar many times over; with forty, n-four-bar-40. One freedom, and one more for each linkage at every
passage through the horizontal. With parallel cranks the motion is the pendulum I a'' = -g ((N + 1) / 2 + N) cos a,
I = ((N + 1) / 3 + N) 1 kg m^2, a from +x, a(0) = pi / 2, |a'(0)| = 1 rad/s.";

pub(super) fn text(loops: usize, command: &str) -> String {
    let mut scene = text::scene(&format!("n-four-bar {loops}"), Dimension::Planar, 10.0);
    let place = |k: usize, up: f64| vector([k as f64, up]);
    // A crank and a coupler alternate in the list of bodies.
    let (crank, coupler) = (|k: usize| BodyId::Body(2 * k), |k: usize| BodyId::Body(2 * k + 1));
    for k in 0..=loops {
        let rod = Body::rod(place(k, 0.0), place(k, 1.0), 1.0);
        scene.bodies.push(rod.named(&format!("crank-{k}")));
        if k < loops {
            let rod = Body::rod(place(k, 1.0), place(k + 1, 1.0), 1.0);
            scene.bodies.push(rod.named(&format!("coupler-{k}")));
        }
    }
    let mut revolute = |name: String, bodies, at: [Number; 2]| {
        scene.joints.push(Joint::revolute(bodies, at).named(&name));
    };
    for k in 0..=loops {
        revolute(format!("pivot-{k}"), [GROUND, crank(k)], place(k, 0.0));
    }
    for k in 0..loops {
        revolute(format!("start-{k}"), [crank(k), coupler(k)], place(k, 1.0));
        revolute(format!("end-{k}"), [coupler(k), crank(k + 1)], place(k + 1, 1.0));
    }
    let (value, rate) = (Some(vec![Number::ZERO]), Some(vec![(-1.0).into()]));
    scene.initials.push(InitialCondition::joint(JointId::new(0), value, rate));
    scene.outputs.push(text::position("crank-end", 0, place(0, 1.0)));
    scene.outputs.push(text::position("last-crank-end", 2 * loops, place(loops, 1.0)));
    text::text(COMMENT, command, &scene)
}
