//! The binary tree of bars, hung at its trunk.

use super::text::{self, bar, number, vector};
use mbs_core::scene::{Body, BodyId, Dimension, GROUND, InitialCondition, Joint, JointId};

/// Mass of the trunk [kg], and the ratio of the masses of consecutive generations [-].
const MASS: [f64; 2] = [2.0, 0.7];
/// Length of the trunk [m], and the ratio of the lengths of consecutive generations [-].
const LENGTH: [f64; 2] = [0.6, 0.8];
/// Sideways and downward components of the unit vector along a branch [-].
const SLOPE: [f64; 2] = [0.6, 0.8];

const COMMENT: &str = "\
Binary tree of bars with spatial revolute joints, hung on the ground by its trunk.

A bar with the number k >= 2 hangs on the end of bar k / 2 (rounded down) and points down and to one side, to the other
one for the next number; generations alternate between x and y. Its joint turns about the horizontal across it. The
trunk is a square bar of 2 kg and 0.6 m; each generation is lighter by the factor 0.7 and shorter by 0.8. The trunk
starts with 0.5 rad/s; the rest follows with the least kinetic energy. No loops, one freedom for each bar; the energy is
kept.";

/// A bar of the tree: its upper end, its lower end, and the axis of its joint.
struct Bar {
    from: [f64; 3],
    to: [f64; 3],
    axis: [f64; 3],
    mass: f64,
}

pub(super) fn text(bodies: usize, command: &str) -> String {
    let mut scene = text::scene(&format!("binary tree of {bodies}"), Dimension::Spatial, 2.0);
    let bars = bars(bodies);
    for (k, Bar { from, to, axis, mass }) in (1_usize..).zip(&bars) {
        let center = vector::<3>(core::array::from_fn(|i| (from[i] + to[i]) / 2.0));
        let inertia = bar(*mass, core::array::from_fn(|i| to[i] - from[i]));
        let body = Body::spatial(center, number(*mass), inertia);
        scene.bodies.push(body.named(&format!("bar-{k}")));
        let parent = (k / 2).checked_sub(1).map_or(GROUND, BodyId::Body);
        let joint = Joint::revolute([parent, BodyId::Body(k - 1)], vector(*from)).about(*axis);
        scene.joints.push(joint.named(&format!("joint-{k}")));
    }
    let rate = Some(vec![0.5.into()]);
    scene.initials.push(InitialCondition::joint(JointId::new(0), None, rate));
    if let (Some(first), Some(last)) = (bars.first(), bars.last()) {
        scene.outputs.push(text::position("trunk-end", 0, vector(first.to)));
        scene.outputs.push(text::position("last-end", bodies - 1, vector(last.to)));
    }
    text::text(COMMENT, command, &scene)
}

/// All bars of the tree, with the trunk first.
fn bars(n: usize) -> Vec<Bar> {
    let mut bars: Vec<Bar> = Vec::with_capacity(n);
    for k in 1..=n {
        let generation = k.ilog2();
        let grown = |[first, factor]: [f64; 2]| first * factor.powf(f64::from(generation));
        let (mass, length) = (grown(MASS), grown(LENGTH));
        let bar = match bars.get((k / 2).wrapping_sub(1)) {
            None => {
                let (from, to) = ([0.0; 3], [0.0, 0.0, -length]);
                Bar { from, to, axis: [0.0, 1.0, 0.0], mass }
            }
            Some(parent) => {
                let (along, across) = if generation % 2 == 1 { (0, 1) } else { (1, 0) };
                let side = if k % 2 == 0 { -length } else { length };
                let (mut to, mut axis) = (parent.to, [0.0; 3]);
                to[along] += side * SLOPE[0];
                to[2] -= length * SLOPE[1];
                axis[across] = 1.0;
                Bar { from: parent.to, to, axis, mass }
            }
        };
        bars.push(bar);
    }
    bars
}
