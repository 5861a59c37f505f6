//! Text of a scene for a draft.

use crate::gauntlet::draft::{Body, Draft, Joint, Shape, id};
use mbs::core::scene::{Dimension, JointKind, Scene};
use mbs::scene_file::to_toml;
use mbs::{InitialCondition, JointId, Output};

/// Writes the scene of a draft. Its outputs are the positions of the draft's output points.
#[must_use]
pub fn text(draft: &Draft, name: &str, duration: f64) -> String {
    let initial = |(joint, rate): &(usize, f64)| {
        InitialCondition::joint(JointId::new(*joint), None, Some(vec![(*rate).into()]))
    };
    let dimension = if draft.dimension == 2 { Dimension::Planar } else { Dimension::Spatial };
    let mut scene = Scene {
        gravity: Some(draft.vector(draft.gravity).0),
        bodies: draft.bodies.iter().map(|b| body(b, draft)).collect(),
        joints: draft.joints.iter().map(|j| joint(j, draft)).collect(),
        initials: draft.rates.iter().map(initial).collect(),
        effects: draft.effects.clone(),
        outputs: draft
            .outputs
            .iter()
            .map(|o| Output::position(id(o.0), draft.vector(o.1)))
            .collect(),
        ..Scene::empty(name, dimension, duration.into())
    };
    scene.bodies.iter_mut().enumerate().for_each(|(k, b)| b.name = format!("b{}", k + 1));
    scene.joints.iter_mut().enumerate().for_each(|(k, j)| j.name = format!("j{k}"));
    scene.effects.iter_mut().enumerate().for_each(|(k, e)| e.name = format!("e{k}"));
    scene.outputs.iter_mut().enumerate().for_each(|(k, p)| p.name = format!("p{k}"));
    // the scene contains no user-defined function, so that it has a text
    to_toml(&scene).unwrap_or_default()
}

fn body(body: &Body, draft: &Draft) -> mbs::Body {
    let vector = |x| draft.vector(x);
    match body.shape {
        Shape::Rod([from, to]) => mbs::Body::rod(vector(from), vector(to), body.mass),
        Shape::Solid(center, j) if draft.dimension == 2 => {
            mbs::Body::planar(vector(center), body.mass, j[2])
        }
        Shape::Solid(center, j) => mbs::Body::spatial(vector(center), body.mass, j),
    }
}

fn joint(joint: &Joint, draft: &Draft) -> mbs::Joint {
    let kind = JointKind::ALL.into_iter().find(|kind| kind.name() == joint.kind);
    let kind = kind.unwrap_or(JointKind::Weld);
    let points = [0, joint.at.len() - 1].map(|i| draft.vector(joint.at[i]).0);
    let bodies = joint.bodies.map(id);
    let mut axes = [None, None];
    let second = if kind.axis_keys(Dimension::Spatial) == ["axes"; 2] { 2 } else { 1 };
    for (to, axis) in axes.iter_mut().zip(&joint.axes).take(second) {
        *to = Some(draft.vector(*axis).0);
    }
    mbs::Joint { name: String::new(), kind, bodies, points, axes, limits: Default::default() }
}
