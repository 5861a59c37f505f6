//! The spatial chain: `scenes/spatial-chain-20.toml` with any number of links. The links form a coil with revolute, universal and spherical
//! joints.

use super::text::{self, bar, vector};
use mbs_core::scene::{Body, BodyId, Dimension, GROUND, InitialCondition, Joint, JointId, Number};

/// Mass of a link [kg].
const MASS: f64 = 1.0;
/// Vectors of four consecutive links, from joint to joint [m]. Four links make a turn of the coil.
const LINKS: [[f64; 3]; 4] =
    [[0.12, 0.0, 0.16], [0.12, 0.16, 0.0], [0.12, 0.0, -0.16], [0.12, -0.16, 0.0]];

/// First axis of the joints.
const Y: [f64; 3] = [0.0, 1.0, 0.0];
/// Second axis of the joints.
const Z: [f64; 3] = [0.0, 0.0, 1.0];

const COMMENT: &str = "\
Spatial chain of equal links: revolute joints about y, universal joints, revolute joints about z and spherical joints, in turn, hung
at one end and let go from the horizontal.

Each link is a uniform square bar of 1 kg, 0.2 m long and 0.04 m wide. Four links make a turn of a coil along x: a straight
chain would pull at all its links at once, a coil gives way, so that its length is no matter. It starts at rest but for the
second joint, which turns with 0.5 rad/s about z; the others follow with the least kinetic energy. No loops; the energy is
kept. After half a second the first turns are pulled straight and whip: that takes shorter steps.";

pub(super) fn text(bodies: usize, command: &str) -> String {
    let mut scene = text::scene(&format!("spatial chain of {bodies}"), Dimension::Spatial, 0.5);
    let link = |k: usize| k.checked_sub(1).map_or(GROUND, BodyId::Body);
    for k in 1..=bodies {
        let (from, to) = (place(k - 1), place(k));
        let center = vector::<3>(core::array::from_fn(|i| (from[i] + to[i]) / 2.0));
        let inertia = bar(MASS, LINKS[(k - 1) % LINKS.len()]);
        scene.bodies.push(Body::spatial(center, MASS, inertia).named(&format!("link-{k}")));
        let (pair, at) = ([link(k - 1), link(k)], vector(from));
        let joint = match k % 4 {
            1 => Joint::revolute(pair, at).about(Y),
            2 => Joint::universal(pair, at).about(Y).about(Z),
            3 => Joint::revolute(pair, at).about(Z),
            _ => Joint::spherical(pair, at),
        };
        scene.joints.push(joint.named(&format!("joint-{k}")));
    }
    for (j, rate) in [vec![0.0], vec![0.0, 0.5]].into_iter().enumerate().take(bodies) {
        let rate = Some(rate.into_iter().map(Number::from).collect());
        scene.initials.push(InitialCondition::joint(JointId::new(j), None, rate));
    }
    scene.outputs.push(text::position("first-end", 0, vector(place(1))));
    scene.outputs.push(text::position("end", bodies - 1, vector(place(bodies))));
    text::text(COMMENT, command, &scene)
}

/// Position of joint k [m]; the chain begins at the origin.
fn place(k: usize) -> [f64; 3] {
    let part = LINKS[..k % LINKS.len()].iter();
    let offset = part.fold([0.0; 2], |at, link| [at[0] + link[1], at[1] + link[2]]);
    [LINKS[0][0] * k as f64, offset[0], offset[1]]
}
