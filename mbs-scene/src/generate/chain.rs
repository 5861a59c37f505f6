//! The spatial chain: `scenes/spatial-chain-20.toml` of any length, coiled, with universal and spherical joints in it.

use super::text::{Text, bar, vector};

/// Mass of a link [kg].
const MASS: f64 = 1.0;
/// Links by turns, from joint to joint [m]: four make a turn of the coil.
const LINKS: [[f64; 3]; 4] =
    [[0.12, 0.0, 0.16], [0.12, 0.16, 0.0], [0.12, 0.0, -0.16], [0.12, -0.16, 0.0]];

/// Kinds of joint by turns, with their axes.
const JOINTS: [(&str, &[[f64; 3]]); 4] = [
    ("revolute", &[[0.0, 1.0, 0.0]]),
    ("universal", &[[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
    ("revolute", &[[0.0, 0.0, 1.0]]),
    ("spherical", &[]),
];

const COMMENT: &str = "\
Spatial chain of equal links: revolute joints about y, universal joints, revolute joints about z and spherical joints, in turn, hung
at one end and let go from the horizontal.

Each link is a uniform square bar of 1 kg, 0.2 m long and 0.04 m wide. Four links make a turn of a coil along x: a straight
chain would pull at all its links at once, a coil gives way, so that its length is no matter. It starts at rest but for the
second joint, which turns with 0.5 rad/s about z; the others follow with the least kinetic energy. No loops; the energy is
kept. After half a second the first turns are pulled straight and whip: that takes shorter steps.";

pub(super) fn text(bodies: usize, command: &str) -> String {
    let mut text = Text::new(COMMENT, command);
    text.scene(&format!("spatial chain of {bodies}"), 3, 0.5);
    let link = |k: usize| if k == 0 { "ground".to_owned() } else { format!("link-{k}") };
    for k in 1..=bodies {
        let (from, to) = (place(k - 1), place(k));
        let center = core::array::from_fn(|i| (from[i] + to[i]) / 2.0);
        text.body(&link(k), MASS, center, bar(MASS, LINKS[(k - 1) % LINKS.len()]));
    }
    for k in 1..=bodies {
        let (kind, axes) = JOINTS[(k - 1) % JOINTS.len()];
        text.joint(&format!("joint-{k}"), kind, [&link(k - 1), &link(k)], &place(k - 1));
        match axes {
            [axis] => text.key("axis", &vector(axis)),
            [one, two] => text.key("axes", &format!("[{}, {}]", vector(one), vector(two))),
            _ => {}
        }
    }
    for (joint, rate) in [("joint-1", "0.0"), ("joint-2", "[0.0, 0.5]")].into_iter().take(bodies) {
        text.table("[[initial]]");
        text.key("joint", &format!("\"{joint}\""));
        text.key("rate", rate);
    }
    text.step(1e-3);
    text.position("first-end", &link(1), &place(1));
    text.position("end", &link(bodies), &place(bodies));
    text.0
}

/// Where a link ends [m]; the chain begins at the origin.
fn place(k: usize) -> [f64; 3] {
    let part = LINKS[..k % LINKS.len()].iter();
    let offset = part.fold([0.0; 2], |at, link| [at[0] + link[1], at[1] + link[2]]);
    [LINKS[0][0] * k as f64, offset[0], offset[1]]
}
