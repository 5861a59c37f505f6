//! Random mechanisms with any joint between any two bodies. Their text is valid, and their mechanics is arbitrary.

use mbs::FORMULATIONS;
use mbs::core::scene::{Dimension, JointKind, Scene, SolverTable, TableEnds};
use mbs::scene_file::Dice;
use mbs::scene_file::to_toml;
use mbs::{
    Body, BodyId, Effect, GROUND, Guide, InitialCondition, Joint, JointId, Motion, Number, Vector3,
};

/// Source of random places for a mechanism of a dimension and a size [m].
#[derive(Clone, Copy)]
struct Space {
    dimension: Dimension,
    size: f64,
}

impl Space {
    fn vector(self, dice: &mut Dice, size: f64) -> Vector3 {
        // half of the coordinates are on a grid, so that axes are parallel and points coincide
        let mut one = || {
            if dice.once_in(2) {
                size * (0.5 * (dice.between(-2.0, 3.0)).floor())
            } else {
                size * dice.between(-1.0, 1.0)
            }
        };
        match self.dimension {
            Dimension::Planar => [one(), one()].into(),
            Dimension::Spatial => [one(), one(), one()].into(),
        }
    }

    fn place(self, dice: &mut Dice) -> Vector3 {
        self.vector(dice, self.size)
    }
}

/// The text of a random scene.
#[must_use]
pub(crate) fn mechanism(dice: &mut Dice) -> String {
    // the scene contains no user-defined function, so that it has a text
    to_toml(&scene(dice)).unwrap_or_default()
}

/// Makes a mechanism: one to six bodies, joints for a tree and some closed loops, a few effects.
fn scene(dice: &mut Dice) -> Scene<Number> {
    let dimension = [Dimension::Planar, Dimension::Spatial][dice.below(2)];
    let bodies = 1 + dice.below(6);
    let size = if dice.once_in(4) { 10_f64.powf(dice.between(-4.0, 4.0)) } else { 1.0 };
    let space = Space { dimension, size };
    let gravity = Some(space.vector(dice, 9.81).0);
    let step = Some(10_f64.powf(dice.between(-7.0, 0.0)).into());
    let formulation = Some((*dice.one_of(&FORMULATIONS)).to_owned());
    let mut scene = Scene {
        gravity,
        bodies: (0..bodies).map(|k| body(space, dice).named(&format!("b{k}"))).collect(),
        solver: SolverTable { step, formulation, ..SolverTable::default() },
        ..Scene::empty("random", dimension, 1.0.into())
    };
    let joints = bodies + dice.below(3);
    let mut simple = Vec::new();
    for k in 0..joints {
        // the first joints make a tree, the others close loops
        let second = if k < bodies { k } else { dice.below(bodies) };
        let first = if k < bodies { dice.below(k + 1) } else { dice.below(bodies + 1) };
        let joint = joint([id(first), id(second + 1)], space, dice).named(&format!("j{k}"));
        if joint.kind.single(dimension).is_some() {
            simple.push(JointId::new(k));
        }
        scene.joints.push(joint);
    }
    for k in 0..dice.below(3) {
        scene.effects.push(effect(bodies, space, dice).named(&format!("e{k}")));
    }
    // some scenes have guides of several joints, or of all joints of a chain
    if dice.once_in(3) {
        let share = 1 + dice.below(3);
        for joint in simple {
            if dice.once_in(share) {
                scene.guides.push(Guide::new(joint, motion(size, dice)));
            }
        }
    }
    if dice.once_in(2) {
        let (joint, rate) = (JointId::new(dice.below(joints)), dice.between(-5.0, 5.0));
        scene.initials.push(InitialCondition::joint(joint, None, Some(vec![rate.into()])));
    }
    scene
}

/// Body of a number: 0 is the ground, bodies count from 1.
fn id(k: usize) -> BodyId {
    k.checked_sub(1).map_or(GROUND, BodyId::Body)
}

fn body(space: Space, dice: &mut Dice) -> Body {
    let mass = if dice.once_in(12) { 0.0 } else { 10_f64.powf(dice.between(-3.0, 3.0)) };
    if dice.once_in(3) {
        return Body::rod(space.place(dice), space.place(dice), mass);
    }
    let moment = mass * space.size * space.size * 10_f64.powf(dice.between(-3.0, 1.0));
    let center = space.place(dice);
    match space.dimension {
        Dimension::Planar => Body::planar(center, mass, moment),
        Dimension::Spatial => Body::spatial(center, mass, [moment, moment, moment, 0.0, 0.0, 0.0]),
    }
}

fn joint(bodies: [BodyId; 2], space: Space, dice: &mut Dice) -> Joint {
    // links are left out, since they need two points
    let kinds: Vec<JointKind> = JointKind::ALL.into_iter().filter(|k| !k.is_link()).collect();
    let &kind = dice.one_of(&kinds);
    let mut joint = Joint { kind, ..Joint::weld(bodies, space.place(dice)) };
    for (axis, is_needed) in joint.axes.iter_mut().zip(kind.needs_axes(space.dimension)) {
        *axis = is_needed.then(|| space.vector(dice, 1.0).0);
    }
    joint
}

fn effect(bodies: usize, space: Space, dice: &mut Dice) -> Effect {
    let (first, second) = (id(dice.below(bodies + 1)), id(1 + dice.below(bodies)));
    let is_bumper = *dice.one_of(&[false, true]);
    let stiffness = 10_f64.powf(dice.between(0.0, 9.0));
    let ends = [(first, space.place(dice)), (second, space.place(dice))];
    let (damping, length) = (dice.between(0.0, 10.0), space.size * dice.between(0.0, 1.0));
    if is_bumper {
        return Effect::bumper(ends, stiffness, damping, length);
    }
    Effect::spring_damper(ends, stiffness, damping, length)
}

fn motion(size: f64, dice: &mut Dice) -> Motion<f64> {
    match dice.below(3) {
        0 => Motion::Ramp { rate: dice.between(-5.0, 5.0) },
        1 => {
            // a natural spline whose table ends within the run is refused, so it is not used here
            let middle = dice.between(-1.0, 1.0);
            let (last, ends) = match middle {
                x if x < -0.5 => (0.75, TableEnds::Level),
                x if x < -0.4 => (0.75, TableEnds::Natural),
                _ => (1.0, TableEnds::Natural),
            };
            Motion::Table { rows: vec![[0.0, 0.0], [0.5, middle], [last, 0.0]], ends }
        }
        _ => Motion::Sine {
            amplitude: size * dice.between(0.0, 1.0),
            frequency: dice.between(0.0, 5.0),
            phase: dice.between(-4.0, 4.0),
        },
    }
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

    #[test]
    fn random_mechanisms_read_back_as_they_were_written() {
        for seed in 0..500 {
            let scene = scene(&mut Dice::new(seed));
            let text = to_toml(&scene).expect("no code in it");
            let again = SceneFile::parse(&text, "x").and_then(|file| file.numbers());
            assert_eq!(again, Ok(scene), "{seed}");
        }
    }
}
