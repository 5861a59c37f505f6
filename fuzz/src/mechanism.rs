//! Random mechanisms as scene text: any joint between any two bodies, as if at random by someone who knows the format and no mechanics.

use crate::Dice;
use mbs::FORMULATIONS;
use mbs::core::scene::{Dimension, JointKind};
use std::fmt::Write;

/// Numbers of a mechanism of so many dimensions.
struct Space {
    n: usize,
}

impl Space {
    fn dimension(&self) -> Dimension {
        if self.n == 2 { Dimension::Planar } else { Dimension::Spatial }
    }

    fn vector(&self, dice: &mut Dice, size: f64) -> String {
        // half of the coordinates lie on a grid, where axes are parallel and places coincide
        let mut one = || {
            if dice.once_in(2) {
                0.5 * (dice.between(-2.0, 3.0)).floor()
            } else {
                dice.between(-1.0, 1.0)
            }
        };
        let parts: Vec<String> = (0..self.n).map(|_| format!("{:?}", size * one())).collect();
        format!("[{}]", parts.join(", "))
    }
}

/// A mechanism: one to six bodies, about as many joints as make a tree or some loops, a few effects.
#[must_use]
pub fn mechanism(dice: &mut Dice) -> String {
    let space = Space { n: 2 + dice.below(2) };
    let bodies = 1 + dice.below(6);
    let size = if dice.once_in(4) { 10_f64.powf(dice.between(-4.0, 4.0)) } else { 1.0 };
    let mut text = format!(
        "[scene]\nname = \"random\"\ndimension = {}\ngravity = {}\nduration = 1.0\n\n[solver]\nstep = {:e}\nformulation = \"{}\"\n",
        space.n,
        space.vector(dice, 9.81),
        10_f64.powf(dice.between(-7.0, 0.0)),
        dice.one_of(&FORMULATIONS),
    );
    for k in 0..bodies {
        body(&mut text, k, (&space, size), dice);
    }
    let joints = bodies + dice.below(3);
    let mut simple = Vec::new();
    for k in 0..joints {
        // a tree first, then loops
        let second = if k < bodies { k } else { dice.below(bodies) };
        let first = if k < bodies { dice.below(k + 1) } else { dice.below(bodies + 1) };
        let kind = joint(&mut text, (k, [name(first), name(second + 1)]), (&space, size), dice);
        if kind.single(space.dimension()).is_some() {
            simple.push(k);
        }
    }
    for k in 0..dice.below(3) {
        effect(&mut text, (k, bodies), (&space, size), dice);
    }
    // sometimes several, or all of a chain
    if dice.once_in(3) {
        let share = 1 + dice.below(3);
        for k in simple {
            if dice.once_in(share) {
                guide(&mut text, k, size, dice);
            }
        }
    }
    if dice.once_in(2) {
        let (joint, rate) = (dice.below(joints), dice.between(-5.0, 5.0));
        // writing to a string cannot fail
        let _ = writeln!(text, "[[initial]]\njoint = \"j{joint}\"\nrate = {rate:?}\n");
    }
    text
}

/// The ground is 0, bodies count from 1.
fn name(k: usize) -> String {
    if k == 0 { "ground".to_owned() } else { format!("b{}", k - 1) }
}

fn body(text: &mut String, k: usize, (space, size): (&Space, f64), dice: &mut Dice) {
    let mass = if dice.once_in(12) { 0.0 } else { 10_f64.powf(dice.between(-3.0, 3.0)) };
    let _ = writeln!(text, "[[body]]\nname = \"b{k}\"\nmass = {mass:e}");
    let _ = if dice.once_in(3) {
        let (from, to) = (space.vector(dice, size), space.vector(dice, size));
        writeln!(text, "rod = {{ from = {from}, to = {to} }}\n")
    } else {
        let moment = mass * size * size * 10_f64.powf(dice.between(-3.0, 1.0));
        let inertia = match space.n {
            2 => format!("{moment:e}"),
            _ => format!("[{moment:e}, {moment:e}, {moment:e}, 0.0, 0.0, 0.0]"),
        };
        writeln!(text, "center = {}\ninertia = {inertia}\n", space.vector(dice, size))
    };
}

fn joint(
    text: &mut String,
    (k, bodies): (usize, [String; 2]),
    (space, size): (&Space, f64),
    dice: &mut Dice,
) -> JointKind {
    // a link has two places
    let kinds: Vec<JointKind> = JointKind::ALL.into_iter().filter(|k| !k.is_link()).collect();
    let &kind = dice.one_of(&kinds);
    let [first, second] = bodies;
    let _ = writeln!(
        text,
        "[[joint]]\nname = \"j{k}\"\nkind = \"{}\"\nbodies = [\"{first}\", \"{second}\"]\nat = {}",
        kind.name(),
        space.vector(dice, size)
    );
    let keys = kind.axis_keys(space.dimension());
    if keys == ["axes"; 2] {
        let _ = writeln!(text, "axes = [{}, {}]", space.vector(dice, 1.0), space.vector(dice, 1.0));
    } else {
        for (key, is_needed) in keys.into_iter().zip(kind.needs_axes(space.dimension())) {
            if is_needed {
                let _ = writeln!(text, "{key} = {}", space.vector(dice, 1.0));
            }
        }
    }
    text.push('\n');
    kind
}

fn effect(
    text: &mut String,
    (k, bodies): (usize, usize),
    (space, size): (&Space, f64),
    dice: &mut Dice,
) {
    let (first, second) = (name(dice.below(bodies + 1)), name(1 + dice.below(bodies)));
    let kind = *dice.one_of(&["spring-damper", "bumper"]);
    let stiffness = 10_f64.powf(dice.between(0.0, 9.0));
    let length = if kind == "bumper" { "clearance" } else { "free_length" };
    let _ = writeln!(
        text,
        "[[effect]]\nname = \"e{k}\"\nkind = \"{kind}\"\nbodies = [\"{first}\", \"{second}\"]\npoints = [{}, {}]\n\
         stiffness = {stiffness:e}\ndamping = {:?}\n{length} = {:?}\n",
        space.vector(dice, size),
        space.vector(dice, size),
        dice.between(0.0, 10.0),
        size * dice.between(0.0, 1.0)
    );
}

fn guide(text: &mut String, joint: usize, size: f64, dice: &mut Dice) {
    let law = match dice.below(3) {
        0 => format!("ramp = {{ rate = {:?} }}", dice.between(-5.0, 5.0)),
        1 => {
            // a natural one that ends within the run is refused
            let middle = dice.between(-1.0, 1.0);
            let (last, ends) = match middle {
                x if x < -0.5 => (0.75, "level"),
                x if x < -0.4 => (0.75, "natural"),
                _ => (1.0, "natural"),
            };
            format!("table = [[0.0, 0.0], [0.5, {middle:?}], [{last:?}, 0.0]]\nends = \"{ends}\"")
        }
        _ => format!(
            "sine = {{ amplitude = {:?}, frequency = {:?}, phase = {:?} }}",
            size * dice.between(0.0, 1.0),
            dice.between(0.0, 5.0),
            dice.between(-4.0, 4.0)
        ),
    };
    let _ = writeln!(text, "[[guide]]\njoint = \"j{joint}\"\n{law}\n");
}

#[cfg(test)]
mod tests {
    use super::*;
    use mbs::scene_file::SceneFile;

    #[test]
    fn many_random_mechanisms_are_scenes() {
        let is_scene = |seed: u64| {
            let text = mechanism(&mut Dice::new(seed));
            SceneFile::from_bytes(text.as_bytes(), "x").is_ok_and(|d| d.scene::<f64>().is_ok())
        };
        let scenes = (0..500).filter(|&seed| is_scene(seed)).count();
        assert!(scenes > 100, "{scenes} of 500 are scenes");
    }
}
