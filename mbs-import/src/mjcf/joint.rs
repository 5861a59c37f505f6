//! Joints of a body, which are connected in series.

use super::compiler::word;
use super::defaults::View;
use super::model::{Model, Motion, Moves, Sort};
use super::passive;
use super::size::Size;
use super::strength::Strength;
use crate::pose::{M3, Pose, V3, about, direction, quaternion, v3};
use crate::robot::{GROUND, Joint, Kind, Link, What};
use crate::source::{Fault, Origin, Read};
use mbs_core::algebra::cross;

/// Largest product of two axes of unit length that count as perpendicular [-]. Six printed digits leave 1e-6, so such axes must be written
/// exactly.
const RIGHT_ANGLE: f64 = 1.0e-9;

/// A joint as read from the file, in global axes.
#[derive(Debug, Clone)]
pub(super) struct Written {
    motion: Motion,
    place: V3,
    friction: f64,
    limited_ball: bool,
}

impl Written {
    pub(super) const fn at(&self) -> Origin {
        self.motion.at
    }
}

fn moves(view: &View<'_>) -> Read<Moves> {
    Ok(match view.attribute("type") {
        _ if view.element.name == "freejoint" => Moves::Free,
        None => Moves::Hinge,
        Some(kind) => [Moves::Hinge, Moves::Slide, Moves::Ball, Moves::Free]
            [word(kind, &["hinge", "slide", "ball", "free"])?],
    })
}

/// Global axis of a joint; zero for a joint without an axis.
fn axis(view: &View<'_>, scope: &Pose, (name, is_single): (&str, bool)) -> Read<V3> {
    match direction(&v3(view.numbers_or("axis", [0.0, 0.0, 1.0])?)) {
        Some(axis) => Ok(scope.turn * axis),
        None if is_single => Err(view.element.fault(
            format!("the axis of joint `{name}` has no direction"),
            "write a direction, as 0 0 1",
        )),
        None => Ok(V3::zeros()),
    }
}

/// Stiffness, damping and friction of a joint, scaled by the size of its frames.
struct Strong {
    strengths: [Strength; 2],
    friction: f64,
    armature: f64,
    effort: Option<[f64; 2]>,
}

fn strong(
    view: &View<'_>,
    name: &str,
    (is_slide, size): (bool, Size),
    model: &Model<'_, '_, '_>,
) -> Read<Strong> {
    let by = |power| if is_slide { size.force_by(power) } else { size.moment() };
    let [friction, armature] =
        [view.number_or("frictionloss", 0.0)?, view.number_or("armature", 0.0)?];
    if friction < 0.0 || armature < 0.0 {
        return Err(view.element.fault(
            format!("frictionloss or armature of joint `{name}` is below zero"),
            "write zero or more",
        ));
    }
    let auto = model.compiler.of(view.element.at).auto_limits;
    let is_clamped = view.is_limited("actuatorfrclimited", "actuatorfrcrange", auto)?;
    let effort = view.numbers::<2>("actuatorfrcrange")?.filter(|_| is_clamped);
    let acts = model.compiler.acts;
    let [stiffness, damping] = [("stiffness", acts.spring), ("damping", acts.damper)]
        .map(|(name, acts)| Strength::read(view, name).map(|of| of.where_it(acts).grown(by)));
    Ok(Strong {
        strengths: [stiffness?, damping?],
        friction: friction * by(0),
        armature: armature * by(1),
        effort: effort.map(|range| range.map(|end| end * by(0))),
    })
}

/// Reads the time constant and the damping ratio that define stiffness and damping.
fn timed(view: &View<'_>) -> Read<Option<[f64; 2]>> {
    let Some(word) = view.attribute("springdamper") else { return Ok(None) };
    match word.numbers()? {
        [0.0, 0.0] => Ok(None),
        [time, ratio] if time > 0.0 && ratio > 0.0 => Ok(Some([time, ratio])),
        _ => Err(word.fault(
            "`springdamper` has a number that is not above zero",
            "write a time and a damping ratio, both above zero",
        )),
    }
}

/// Lists a free joint whose frame must move to the centre of mass.
fn aligned(view: &View<'_>, model: &mut Model<'_, '_, '_>) -> Read<()> {
    let is_free = view.element.name == "freejoint";
    let word = view.attribute("align").map(|align| word(align, &["false", "true", "auto"]));
    let by_default = is_free && model.compiler.of(view.element.at).align_free;
    if word.transpose()?.map_or(by_default, |word| word == 1 || word == 2 && by_default) {
        let says = "the frame of a free joint stays where the file has it";
        model.context.findings.ignored(view.element.at, view.element.label(), says);
    }
    Ok(())
}

/// Reads a `joint` or `freejoint`; `scope` is the frame that contains it.
pub(super) fn read(
    view: &View<'_>,
    name: String,
    (scope, size): (&Pose, Size),
    model: &mut Model<'_, '_, '_>,
) -> Read<Written> {
    let at = view.element.at;
    view.own("class");
    let moves = moves(view)?;
    aligned(view, model)?;
    let settings = model.compiler.of(at);
    let angle = |x: f64| match moves {
        Moves::Hinge => settings.angle(x),
        Moves::Slide => x * size.length,
        Moves::Ball | Moves::Free => x,
    };
    let place = scope.point(&(v3(view.numbers_or("pos", [0.0; 3])?) * size.length));
    let is_single = matches!(moves, Moves::Hinge | Moves::Slide);
    let axis = axis(view, scope, (&name, is_single))?;
    let zero = if is_single { angle(view.number_or("ref", 0.0)?) } else { 0.0 };
    let spring = if is_single { angle(view.number_or("springref", 0.0)?) } else { 0.0 };
    let is_limited = view.is_limited("limited", "range", settings.auto_limits)?;
    let range = view.numbers::<2>("range")?.filter(|range| is_limited && *range != [0.0; 2]);
    let stops = view.merged("solreflimit", [0.02, 1.0])?;
    view.attribute("solimplimit");
    let strong = strong(view, &name, (moves == Moves::Slide, size), model)?;
    let acts = model.compiler.acts;
    let timed = timed(view)?;
    Ok(Written {
        limited_ball: range.is_some() && !is_single,
        motion: Motion {
            name,
            at,
            moves,
            joint: 0,
            number: None,
            sign: 1.0,
            zero,
            drawn: zero,
            spring,
            range: range.filter(|_| is_single).map(|range| range.map(angle)),
            effort: strong.effort,
            armature: strong.armature,
            axis,
            stops: (range.is_some() && is_single && acts.limit).then_some(stops),
            timed,
            strengths: strong.strengths,
            size,
        },
        place,
        friction: if acts.friction { strong.friction } else { 0.0 },
    })
}

/// Moves the joints of a body with frame `frame` to the coordinates of a keyframe. Returns the displacement of the body and the number of
/// coordinates that it uses.
pub(super) fn posed(joints: &mut [Written], frame: &Pose, places: &[f64]) -> Read<(Pose, usize)> {
    let mut moved = Pose::identity();
    let mut taken = 0;
    for Written { motion, place, .. } in joints {
        let count = motion.moves.places();
        let own = places.get(taken..taken + count).ok_or_else(|| {
            let message = "the keyframe has no coordinates for this joint";
            Fault::new(
                motion.at,
                message,
                "write all coordinates in `qpos`, in the order of the joints",
            )
        })?;
        taken += count;
        *place = moved.point(place);
        motion.axis = moved.turn * motion.axis;
        let turned_by = |turn: M3| Pose::new(turn, *place - turn * *place);
        let of_ball = |own: &[f64]| {
            quaternion([own[0], own[1], own[2], own[3]]).ok_or_else(|| {
                let message = "a quaternion of length zero in the keyframe";
                Fault::new(motion.at, message, "write w x y z of unit length")
            })
        };
        let step = match motion.moves {
            Moves::Hinge => turned_by(about(&motion.axis, own[0] - motion.zero)),
            Moves::Slide => {
                let way = own[0] * motion.size.length - motion.zero;
                Pose::new(M3::identity(), motion.axis * way)
            }
            Moves::Ball => {
                let is = moved.then(frame).turn;
                turned_by(is * of_ball(own)? * is.transpose())
            }
            Moves::Free => {
                let wanted = Pose::new(of_ball(&own[3..])?, v3([own[0], own[1], own[2]]));
                wanted.then(&moved.then(frame).inverse())
            }
        };
        match motion.moves {
            Moves::Hinge => motion.zero = own[0],
            Moves::Slide => motion.zero = own[0] * motion.size.length,
            Moves::Ball | Moves::Free => {}
        }
        moved = step.then(&moved);
    }
    Ok((moved, taken))
}

/// Joins a body to its parent by its joints, with the outermost first. Joints that form one joint of the scene are combined. Massless links
/// are added between the others.
pub(super) fn join(
    joints: Vec<Written>,
    parent: usize,
    body: usize,
    model: &mut Model<'_, '_, '_>,
) -> Read<()> {
    let body_link = &model.robot.links[body];
    let (at, pose, body_name) = (body_link.at, body_link.pose, body_link.name.clone());
    if joints.is_empty() {
        let joint = Joint::new(&body_name, at, Kind::Fixed, [parent, body], pose.at);
        model.robot.joints.push(joint);
        return Ok(());
    }
    let free = joints.iter().find(|joint| joint.motion.moves == Moves::Free);
    if let Some(free) = free.filter(|_| joints.len() > 1 || parent != GROUND) {
        let other =
            if parent == GROUND { "another joint" } else { "a parent that is not the world" };
        return Err(Fault::new(
            free.motion.at,
            format!("body `{body_name}` has a free joint, and {other}"),
            "a free joint is the only joint of a child of the world",
        ));
    }
    let mut rest = &joints[..];
    let (mut from, mut number) = (parent, 0);
    while let Some(first) = rest.first() {
        let group = group(rest);
        let (own, others) = rest.split_at(group.len);
        rest = others;
        number += 1;
        let to = if rest.is_empty() {
            body
        } else {
            let name = model.free_name(Sort::Link, &format!("{body_name}~{number}"));
            model.robot.links.push(Link { pose, ..Link::new(&name, first.motion.at) });
            model.robot.links.len() - 1
        };
        add(own, &group, [from, to], model)?;
        from = to;
    }
    Ok(())
}

/// Joints of the file that form one joint of the scene.
struct Group {
    len: usize,
    kind: Kind,
    axes: Vec<V3>,
    /// Index and sign of the scene's coordinate for each joint; empty when the scene's joint has a single coordinate.
    places: Vec<(usize, f64)>,
}

fn group(joints: &[Written]) -> Group {
    let moves: Vec<_> = joints.iter().take(4).map(|joint| joint.motion.moves).collect();
    let axis = |i: usize| joints[i].motion.axis;
    let is_across = |a: &V3, b: &V3| a.dot(b).abs() <= RIGHT_ANGLE;
    if moves.starts_with(&[Moves::Slide, Moves::Slide, Moves::Hinge]) {
        let [a, b, turn] = [axis(0), axis(1), axis(2)];
        if is_across(&a, &b) && is_across(&a, &turn) && is_across(&b, &turn) {
            // The second translation of the scene is along the normal times the first.
            let sign = cross(&turn, &a).dot(&b).signum();
            return Group {
                len: 3,
                kind: Kind::Planar,
                axes: vec![turn, a],
                places: vec![(0, 1.0), (1, sign), (2, 1.0)],
            };
        }
    }
    if moves == [Moves::Slide, Moves::Slide, Moves::Slide, Moves::Ball] {
        // The three translations must have the same armature.
        let is_alike = (1..3).all(|i| joints[i].motion.armature == joints[0].motion.armature);
        // The translations of the scene's free joint are along the global axes.
        let along = |axis: V3| {
            (0..3).find(|i| 1.0 - axis[*i].abs() <= RIGHT_ANGLE).map(|i| (i, axis[i].signum()))
        };
        let places: Vec<_> = (0..3).filter_map(|i| along(axis(i))).collect();
        let mut numbers: Vec<_> = places.iter().map(|(number, _)| *number).collect();
        numbers.sort_unstable();
        if is_alike && numbers == [0, 1, 2] {
            return Group { len: 4, kind: Kind::Free, axes: Vec::new(), places };
        }
    }
    let first = &joints[0];
    let kind = match first.motion.moves {
        Moves::Hinge => Kind::Revolute,
        Moves::Slide => Kind::Prismatic,
        Moves::Ball => Kind::Spherical,
        Moves::Free => Kind::Free,
    };
    let axes = if first.motion.is_single() { vec![first.motion.axis] } else { Vec::new() };
    Group { len: 1, kind, axes, places: Vec::new() }
}

/// Adds the joint of the scene for a group of joints of the file.
fn add(
    joints: &[Written],
    group: &Group,
    ends: [usize; 2],
    model: &mut Model<'_, '_, '_>,
) -> Read<()> {
    let number = model.robot.joints.len();
    let names: Vec<_> = joints.iter().map(|joint| joint.motion.name.as_str()).collect();
    let name = names.join("+");
    let last = &joints[joints.len() - 1];
    let place = if group.kind == Kind::Free && joints.len() == 1 {
        model.robot.links[ends[1]].pose.at
    } else {
        last.place
    };
    let mut joint = Joint::new(&name, joints[0].motion.at, group.kind, ends, place);
    joint.axes.clone_from(&group.axes);
    if let [only] = joints {
        joint.zero = only.motion.zero;
        joint.range = only.motion.range.map(|range| only.motion.ends(range));
    } else {
        model
            .robot
            .notes
            .push(format!("Joint {name}: the coordinates {} of the file.", names.join(", ")));
    }
    model.robot.joints.push(joint);
    for (i, read) in joints.iter().enumerate() {
        let mut motion = read.motion.clone();
        motion.joint = number;
        if let Some((place, sign)) = group.places.get(i) {
            (motion.number, motion.sign) = (Some(*place), *sign);
        }
        model.joints.add(&motion.name, motion.at, &model.context.sources)?;
        if motion.zero != 0.0 {
            let note = format!("Joint {}: {} in the file is 0 here.", motion.name, motion.zero);
            model.robot.notes.push(note);
        }
        if motion.timed.is_none() {
            passive::add(&motion, motion.strengths, model);
        }
        if motion.is_single() {
            single(read, &motion, model)
        } else {
            several(read, &motion, model)
        }
        model.motions.push(motion);
    }
    Ok(())
}

/// Adds the friction and the armature of a hinge or a slide.
fn single(read: &Written, motion: &Motion, model: &mut Model<'_, '_, '_>) {
    let (name, on) = (&motion.name, motion.target());
    if read.friction > 0.0 {
        let says = "frictionloss is a soft constraint there; here it is friction that falls to zero below a rate of 1e-3";
        model.context.findings.approximated(motion.at, format!("joint[{name}]"), says);
        model.law(
            &format!("{name} friction"),
            What::Friction { on: on.clone(), coulomb: read.friction },
        );
    }
    // The armature of a free joint is added to the mass of its body.
    let is_free = model.robot.joints[motion.joint].kind == Kind::Free;
    if motion.armature > 0.0 && !is_free {
        model.law(&format!("{name} armature"), What::Rotor { on, inertia: motion.armature });
    }
}

/// Reports the properties of a ball or a free joint that have no counterpart.
fn several(read: &Written, motion: &Motion, model: &mut Model<'_, '_, '_>) {
    let label = format!("joint[{}]", motion.name);
    if read.friction > 0.0 {
        let says = "frictionloss of a joint with several coordinates does not act here";
        model.context.findings.ignored(motion.at, label.as_str(), says);
    }
    if read.limited_ball {
        let says = "ends of a joint with several coordinates do not act here";
        model.context.findings.ignored(motion.at, label, says);
    }
}
