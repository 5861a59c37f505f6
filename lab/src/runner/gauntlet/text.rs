//! A draft as scene text.

use crate::gauntlet::draft::{Body, Draft, Effect, Joint, Shape};
use crate::gauntlet::vector::Point;
use mbs::core::scene::{Dimension, JointKind, PolynomialPiece, Scene};
use mbs::scene_file::to_toml;
use mbs::{BodyId, GROUND, Guide, InitialCondition, JointId, Motion, Number, Output, Vector3};

/// The scene: outputs are the positions of the points that are watched.
#[must_use]
pub fn text(draft: &Draft, name: &str, duration: f64) -> String {
    let n = draft.dimension;
    let names = |list: &str, k: usize| format!("{list}{k}");
    let number = |x: Option<f64>| x.map(|x| vec![Number::from(x)]);
    let initial = |(joint, value, rate): &(usize, _, _)| {
        InitialCondition::joint(JointId::new(*joint), number(*value), number(*rate))
    };
    let guide = |(joint, [amplitude, frequency, phase]): &(usize, [f64; 3])| {
        let [amplitude, frequency, phase] = [*amplitude, *frequency, *phase];
        Guide::new(JointId::new(*joint), Motion::Sine { amplitude, frequency, phase })
    };
    let output = |(body, at): &(usize, Point)| Output::position(id(*body), vector(*at, n));
    let dimension = if n == 2 { Dimension::Planar } else { Dimension::Spatial };
    let scene = Scene {
        gravity: Some(vector(draft.gravity, n).0),
        bodies: (1..).zip(&draft.bodies).map(|(k, b)| body(b, n).named(&names("b", k))).collect(),
        joints: (0..).zip(&draft.joints).map(|(k, j)| joint(j, n).named(&names("j", k))).collect(),
        initials: draft.starts.iter().map(initial).collect(),
        guides: draft.guides.iter().map(guide).collect(),
        effects: (0..)
            .zip(&draft.effects)
            .map(|(k, e)| effect(e, n).named(&names("e", k)))
            .collect(),
        outputs: (0..).zip(&draft.outputs).map(|(k, o)| output(o).named(&names("p", k))).collect(),
        ..Scene::empty(name, dimension, duration.into())
    };
    // there is no code in it
    to_toml(&scene).unwrap_or_default()
}

fn vector(x: Point, n: usize) -> Vector3 {
    if n == 2 { [x[0], x[1]].into() } else { x.into() }
}

/// The ground is 0, bodies count from 1.
fn id(k: usize) -> BodyId {
    k.checked_sub(1).map_or(GROUND, BodyId::Body)
}

fn body(body: &Body, n: usize) -> mbs::Body {
    match &body.shape {
        Shape::Rod([from, to]) => mbs::Body::rod(vector(*from, n), vector(*to, n), body.mass),
        Shape::Solid(center, j) if n == 2 => mbs::Body::planar(vector(*center, n), body.mass, j[2]),
        Shape::Solid(center, j) => mbs::Body::spatial(vector(*center, n), body.mass, *j),
    }
}

fn joint(joint: &Joint, n: usize) -> mbs::Joint {
    let bodies = joint.bodies.map(id);
    let kind = JointKind::ALL.into_iter().find(|kind| kind.name() == joint.kind);
    let kind = kind.unwrap_or(JointKind::Weld);
    let mut of_scene = match joint.at.as_slice() {
        [a, b] => mbs::Joint::distance(bodies, [vector(*a, n), vector(*b, n)]),
        places => {
            let at = places.first().copied().unwrap_or_default();
            mbs::Joint { kind, ..mbs::Joint::weld(bodies, vector(at, n)) }
        }
    };
    let second = if kind.axis_keys(Dimension::Spatial) == ["axes"; 2] { 2 } else { 1 };
    for (to, axis) in of_scene.axes.iter_mut().zip(&joint.axes).take(second) {
        *to = Some(vector(*axis, n).0);
    }
    of_scene
}

fn effect(effect: &Effect, n: usize) -> mbs::Effect {
    let ends = |bodies: &[usize; 2], points: &[Point; 2]| {
        [0, 1].map(|i| (id(bodies[i]), vector(points[i], n)))
    };
    match effect {
        Effect::Spring(bodies, points, [stiffness, damping, free]) => {
            mbs::Effect::spring_damper(ends(bodies, points), *stiffness, *damping, *free)
        }
        Effect::Bumper(bodies, points, [stiffness, damping, clearance]) => {
            mbs::Effect::bumper(ends(bodies, points), *stiffness, *damping, *clearance)
        }
        Effect::Pieces(bodies, points, pieces) => {
            let piece = |piece: &Vec<f64>| {
                let mut numbers = piece.iter().map(|x| Number::from(*x));
                let mut next = || numbers.next().unwrap_or_default();
                let (lower, upper) = (next(), next());
                PolynomialPiece { lower, upper, coefficients: numbers.collect() }
            };
            let pieces = pieces.iter().map(piece).collect();
            mbs::Effect::polynomial_spring(ends(bodies, points), pieces)
        }
        Effect::Torsion(joint, [stiffness, damping, free]) => {
            mbs::Effect::torsion_spring(JointId::new(*joint), *stiffness, *damping, *free)
        }
        Effect::Limit(joint, [lower, upper, stiffness, damping]) => {
            mbs::Effect::limit(JointId::new(*joint), [*lower, *upper], *stiffness, *damping)
        }
        Effect::Friction(joint, coulomb) => {
            mbs::Effect::friction(JointId::new(*joint), *coulomb, 1e-3)
        }
        Effect::Torque(joint, value) => mbs::Effect::torque(JointId::new(*joint), *value),
    }
}
