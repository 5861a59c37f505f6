//! Keyframes: initial states of a run.

use super::model::{Model, Motion, Moves};
use crate::context::Context;
use crate::element::{Attribute, Element};
use crate::pose::{M3, V3, quaternion, v3};
use crate::robot::{GROUND, Kind, Signal, Start, What};
use crate::source::{Fault, Origin, Read};
use mbs_scene::nearest_name;

/// The coordinates of the keyframe that the options name; `None` when they name none.
pub(super) fn places(root: &Element, context: &Context<'_>) -> Read<Option<Vec<f64>>> {
    let Some(asked) = &context.options.key else { return Ok(None) };
    let keys = root.each("keyframe").flat_map(|keys| keys.each("key"));
    let mut named = keys.zip(0..).filter(|(key, number)| {
        key.value("name").map_or_else(|| format!("{number}"), str::to_owned) == *asked
    });
    let places = named.next().and_then(|(key, _)| key.attribute("qpos"));
    places.map(Attribute::list).transpose()
}

/// Applies the keyframe that the options name; the other keyframes are listed in the head of the scene.
pub(super) fn read(root: &Element, model: &mut Model<'_, '_, '_>) -> Read<()> {
    let keys: Vec<_> = root.each("keyframe").flat_map(|keys| keys.each("key")).collect();
    let names: Vec<_> = keys
        .iter()
        .zip(0..)
        .map(|(key, number)| key.value("name").map_or_else(|| format!("{number}"), str::to_owned))
        .collect();
    for key in &keys {
        key.read_whole();
    }
    let asked = model.context.options.key.clone();
    let mut taken = None;
    for (key, name) in keys.iter().zip(&names) {
        if Some(name) == asked.as_ref() && taken.is_none() {
            taken = Some(name);
            start(key, model)?;
            let word = if model.posed.is_some() {
                "Reference and start: the places of keyframe"
            } else {
                "Start: keyframe"
            };
            model.robot.notes.push(format!("{word} {name}."));
        } else {
            model.robot.notes.push(format!("Keyframe {name}: not taken (--key {name})."));
        }
    }
    match (asked, taken) {
        (Some(asked), None) => {
            let hint = nearest_name(&asked, &names, "keyframes");
            Err(Fault::new(
                Origin::start_of(root.at.source),
                format!("unknown keyframe `{asked}`"),
                hint,
            ))
        }
        _ => Ok(()),
    }
}

/// Splits a list of values into those of each joint.
fn numbers(
    word: Option<&Attribute>,
    count: impl Fn(Moves) -> usize,
    motions: &[Motion],
) -> Read<Option<Vec<Vec<f64>>>> {
    let Some(word) = word else { return Ok(None) };
    let list = word.list()?;
    let needed: usize = motions.iter().map(|motion| count(motion.moves)).sum();
    if list.len() != needed {
        let message = format!("`{}` has {} numbers, and the model {needed}", word.name, list.len());
        return Err(
            word.fault(message, "write a number for each coordinate, in the order of the joints")
        );
    }
    let mut rest = &list[..];
    let each = motions.iter().map(|motion| {
        let (own, others) = rest.split_at(count(motion.moves));
        rest = others;
        own.to_vec()
    });
    Ok(Some(each.collect()))
}

fn start(key: &Element, model: &mut Model<'_, '_, '_>) -> Read<()> {
    let rates = |moves: Moves| match moves {
        Moves::Hinge | Moves::Slide => 1,
        Moves::Ball => 3,
        Moves::Free => 6,
    };
    let values = numbers(key.attribute("qpos"), Moves::places, &model.motions)?;
    // The reference configuration may already be that of the keyframe.
    let values = values.filter(|_| model.posed.is_none());
    let speeds = numbers(key.attribute("qvel"), rates, &model.motions)?;
    if let Some(controls) = key.attribute("ctrl") {
        let list = controls.list()?;
        for (input, control) in model.inputs.iter().zip(list) {
            let Some(law) = input.law else { continue };
            if let What::Signal(Signal::Set { value, .. }) | What::Input { value, .. } =
                &mut model.robot.laws[law].what
            {
                *value = control * input.factor;
            }
        }
    }
    if let Some(states) = key.attribute("act") {
        activations(states, model)?;
    }
    let mut turned = vec![M3::identity(); model.robot.links.len()];
    for joint in 0..model.robot.joints.len() {
        let of = &model.robot.joints[joint];
        // Joints that close loops have no values of their own.
        let own: Vec<_> =
            (0..model.motions.len()).filter(|i| model.motions[*i].joint == joint).collect();
        let (parent, child) = (of.parent, of.child);
        if own.is_empty() {
            if of.kind == Kind::Fixed {
                turned[child] = turned[parent];
            }
            continue;
        }
        let (start, turn) =
            joint_start(joint, &own, values.as_deref(), speeds.as_deref(), &turned[parent], model)?;
        turned[child] = turned[parent] * turn;
        // When a coupling determines a joint, the keyframe does not set the initial state of this joint.
        let couplings = &model.robot.couplings;
        if couplings.iter().any(|coupling| coupling.terms[0].of.joint == joint) {
            continue;
        }
        if !(start.value.is_empty() && start.rate.is_empty()) {
            model.robot.start.push(start);
        }
    }
    Ok(())
}

/// Reads the activations of those actuators that have any, in their order.
fn activations(word: &Attribute, model: &mut Model<'_, '_, '_>) -> Read<()> {
    let list = word.list()?;
    let counts: Option<Vec<_>> = model.inputs.iter().map(|input| input.activations).collect();
    let Some(counts) = counts else {
        let says =
            "activations of actuators that do not act here are among them: they start at zero";
        model.context.findings.ignored(word.at, "keyframe/key@act", says);
        return Ok(());
    };
    let needed: usize = counts.iter().sum();
    if list.len() != needed {
        let message = format!("`act` has {} numbers, and the model {needed}", list.len());
        return Err(word.fault(message, "write a number for each actuator with an activation"));
    }
    let mut rest = &list[..];
    for (input, count) in model.inputs.iter().zip(counts) {
        let (own, others) = rest.split_at(count);
        rest = others;
        let (Some(law), [first]) = (input.activation, own) else { continue };
        if let What::Signal(Signal::Lag { value, .. } | Signal::Integral { value, .. }) =
            &mut model.robot.laws[law].what
        {
            *value = *first * input.factor;
        }
    }
    Ok(())
}

/// The initial state of a joint of the scene, and the rotation of its child in axes of the reference configuration.
fn joint_start(
    joint: usize,
    own: &[usize],
    values: Option<&[Vec<f64>]>,
    speeds: Option<&[Vec<f64>]>,
    parent: &M3,
    model: &Model<'_, '_, '_>,
) -> Read<(Start, M3)> {
    let link = &model.robot.links[model.robot.joints[joint].child];
    let count = match model.robot.joints[joint].kind {
        Kind::Free => 6,
        Kind::Planar | Kind::Spherical => 3,
        _ => 1,
    };
    let (mut value, mut rate) = (vec![0.0; count], vec![0.0; count]);
    let mut turn = M3::identity();
    for i in own {
        let motion = &model.motions[*i];
        let (q, v) = (values.map(|all| &all[*i]), speeds.map(|all| &all[*i]));
        let place = motion.number.unwrap_or(0);
        match motion.moves {
            Moves::Hinge | Moves::Slide => {
                let is_slide = motion.moves == Moves::Slide;
                let length = if is_slide { motion.size.length } else { 1.0 };
                let x = q.map_or(0.0, |q| motion.in_scene(q[0] * length));
                value[place] = x;
                rate[place] = v.map_or(0.0, |v| v[0] * length * motion.sign);
                if motion.moves == Moves::Hinge {
                    turn = crate::pose::about(&motion.axis, x * motion.sign);
                }
            }
            Moves::Ball | Moves::Free => {
                let is_free = motion.moves == Moves::Free;
                let first = if count == 6 { 3 } else { 0 };
                if let Some(q) = q {
                    let is = of_quaternion(&q[q.len() - 4..], motion)?;
                    // The quaternion of a free joint is that of the body's frame; that of a ball is the relative rotation.
                    turn = if is_free {
                        is * link.pose.turn.transpose()
                    } else {
                        link.pose.turn * is * link.pose.turn.transpose()
                    };
                    value[first..first + 3].copy_from_slice(&vector_of(&turn));
                    if is_free {
                        let moved = v3([q[0], q[1], q[2]]) - link.pose.at;
                        value[..3].copy_from_slice(moved.as_slice());
                    }
                }
                if let Some(v) = v {
                    let spin = &v[v.len() - 3..];
                    let spin: V3 = parent * turn * link.pose.turn * v3([spin[0], spin[1], spin[2]]);
                    rate[first..first + 3].copy_from_slice(spin.as_slice());
                    if is_free {
                        rate[..3].copy_from_slice(&v[..3]);
                    }
                }
            }
        }
    }
    let (value, rate) = (values.map_or(Vec::new(), |_| value), speeds.map_or(Vec::new(), |_| rate));
    debug_assert!(model.robot.joints[joint].parent == GROUND || count != 6 || own.len() > 1);
    Ok((Start { joint, value, rate }, turn))
}

fn of_quaternion(q: &[f64], motion: &Motion) -> Read<M3> {
    quaternion([q[0], q[1], q[2], q[3]]).ok_or_else(|| {
        let message = "a quaternion of length zero in the keyframe";
        Fault::new(motion.at, message, "write w x y z of unit length")
    })
}

/// The rotation vector of a rotation matrix [rad].
pub(super) fn vector_of(turn: &M3) -> [f64; 3] {
    let skew =
        v3([turn[(2, 1)] - turn[(1, 2)], turn[(0, 2)] - turn[(2, 0)], turn[(1, 0)] - turn[(0, 1)]])
            * 0.5;
    let (sine, cosine) = (skew.dot(&skew).sqrt(), (turn.trace() - 1.0) / 2.0);
    let angle = sine.atan2(cosine);
    /// Sine below which the angle is near zero or half a turn, where the axis comes from the symmetric part [-].
    const SMALL: f64 = 1.0e-6;
    if sine > SMALL {
        return (skew * (angle / sine)).into();
    }
    if cosine > 0.0 {
        return skew.into();
    }
    // At half a turn R + 1 = 2 a aᵀ, with the axis a.
    let outer = (turn + M3::identity()) * 0.5;
    let largest = (0..3).max_by(|a, b| outer[(*a, *a)].total_cmp(&outer[(*b, *b)])).unwrap_or(0);
    let axis: V3 = outer.column(largest).into_owned() / outer[(largest, largest)].sqrt();
    let sign = if axis.dot(&skew) < 0.0 { -1.0 } else { 1.0 };
    (axis * (angle * sign)).into()
}
