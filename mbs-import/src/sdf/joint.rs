//! Joints: kinds, axes, springs, limits, mimic joints and screws.

use super::frames::Frames;
use super::scope::{Scope, link, number};
use crate::context::Context;
use crate::element::Element;
use crate::laws;
use crate::pose::{V3, direction, unit, v3};
use crate::robot::{Coordinate, Coupling, Joint, Kind, Law, Robot, Target, Term, What};
use crate::source::{Fault, Read};

/// Joint types of the format. A gearbox is not a joint, but a relation between two joints.
const TYPES: [(&str, Kind); 8] = [
    ("revolute", Kind::Revolute),
    ("continuous", Kind::Revolute),
    ("prismatic", Kind::Prismatic),
    ("ball", Kind::Spherical),
    ("universal", Kind::Universal),
    ("revolute2", Kind::Universal),
    ("screw", Kind::Cylindrical),
    ("fixed", Kind::Fixed),
];

/// Reads a joint of a model. Gearboxes are read later, when all joints exist.
pub(super) fn read(
    element: &Element,
    scope: &Scope,
    frames: &Frames,
    robot: &mut Robot,
    context: &mut Context<'_>,
) -> Read<()> {
    let name = &element.need("name")?.value;
    let word = element.need("type")?;
    let kind = TYPES.iter().find(|(known, _)| *known == word.value.trim()).map(|(_, kind)| *kind);
    let kind = kind.ok_or_else(|| {
        let known = TYPES.map(|(known, _)| known).join(", ");
        word.fault(
            format!("unknown type of joint `{}`", word.value),
            format!("types are {known}, gearbox"),
        )
    })?;
    let full = format!("{}{name}", scope.prefix);
    let [own, shown] = known(frames, &full, element)?;
    let name = shown.to_owned();
    let is_kept = kind == Kind::Fixed && context.options.keep_fixed.contains(&name);
    let kind = if is_kept { Kind::Weld } else { kind };
    let ends = [end(element, "parent", scope, frames)?, end(element, "child", scope, frames)?];
    if ends[0] == ends[1] {
        return Err(element
            .fault(format!("joint `{name}` joins a link to itself"), "give it another child"));
    }
    if is_still(element, scope, frames)? {
        element.read_whole();
        return Ok(());
    }
    let place = frames.place(own)?;
    let mut joint = Joint::new(&name, element.at, kind, ends, place.at);
    let axes = axes_of(element, &name, kind)?;
    let number = robot.joints.len();
    for axis in &axes {
        joint.axes.push(direction_of(axis, own, scope, frames)?);
    }
    if let ([axis], Kind::Revolute | Kind::Prismatic) = (&axes[..], kind) {
        let has_range = word.value.trim() != "continuous";
        if let Some(says) = limits(axis, has_range, &mut joint)? {
            let path = format!("joint[{name}]/{}/limit", axis.name);
            context.findings.approximated(axis.at, path, says);
        }
    }
    robot.joints.push(joint);
    if kind == Kind::Spherical {
        damped_ball(element, (number, &name), robot, context)?;
    }
    for (i, axis) in axes.iter().enumerate() {
        let of = coordinate(&robot.joints, number, i);
        laws(axis, of, robot, context)?;
    }
    if kind == Kind::Cylindrical {
        robot.couplings.push(screw(element, number, &name)?);
    }
    Ok(())
}

/// Reads the damping of a ball joint, which the file gives at an axis. The damping acts about all axes. The other properties of the axis have
/// no effect.
fn damped_ball(
    element: &Element,
    (number, name): (usize, &str),
    robot: &mut Robot,
    context: &mut Context<'_>,
) -> Read<()> {
    let Some(dynamics) = element.child("axis").and_then(|axis| axis.child("dynamics")) else {
        return Ok(());
    };
    let damping = self::number(dynamics, "damping", 0.0)?;
    if damping < 0.0 {
        return Err(dynamics.fault("damping is below zero", "write zero or more"));
    }
    for word in ["friction", "spring_stiffness"] {
        if self::number(dynamics, word, 0.0)? != 0.0 {
            let says = format!("{word} of a ball does not act here");
            context.findings.ignored(dynamics.at, format!("joint[{name}]/axis/dynamics"), says);
        }
    }
    if damping > 0.0 {
        let joint = &robot.joints[number];
        let of = ([joint.parent, joint.child], joint.place);
        for (corner, what) in laws::dampers(of, damping, false).enumerate() {
            robot.laws.push(Law { name: format!("{name} damping {}", corner + 1), what });
        }
    }
    Ok(())
}

/// The axis elements that a joint of a kind uses.
fn axes_of<'a>(element: &'a Element, name: &str, kind: Kind) -> Read<Vec<&'a Element>> {
    let mut axes: Vec<&Element> =
        ["axis", "axis2"].into_iter().filter_map(|word| element.child(word)).collect();
    let needed = match kind {
        Kind::Revolute | Kind::Prismatic | Kind::Cylindrical => 1,
        Kind::Universal => 2,
        _ => 0,
    };
    if axes.len() < needed {
        let missing = if axes.is_empty() { "axis" } else { "axis2" };
        let hint = format!("write <{missing}><xyz>0 0 1</xyz></{missing}>");
        return Err(element.fault(format!("joint `{name}` has no <{missing}>"), hint));
    }
    if needed == 0 {
        axes.iter().for_each(|axis| axis.read_whole());
    }
    axes.truncate(needed);
    Ok(axes)
}

/// The full name of a joint's frame, and the joint's name in the scene, by the joint's full name.
pub(super) fn known<'a>(frames: &'a Frames, full: &str, element: &Element) -> Read<[&'a str; 2]> {
    frames.joint(full).ok_or_else(|| {
        element.fault(format!("unknown joint `{}`", frames.plain(full)), "name a joint of the file")
    })
}

/// True if a joint connects two links that are fixed to the ground, for example in a static model. Such a joint has no effect.
pub(super) fn is_still(element: &Element, scope: &Scope, frames: &Frames) -> Read<bool> {
    let ends = [end(element, "parent", scope, frames)?, end(element, "child", scope, frames)?];
    Ok(ends.iter().all(|link| frames.is_still(*link)))
}

/// The link at one end of a joint; the world is the ground.
fn end(element: &Element, word: &str, scope: &Scope, frames: &Frames) -> Read<usize> {
    if element.child(word).is_none() {
        return Err(element.fault(
            format!("{} has no <{word}>", element.label()),
            format!("write <{word}>LINK</{word}>"),
        ));
    }
    link(element, word, scope, frames)
}

/// The coordinate of the first or the second axis of a joint; for a cylindrical joint it is the rotation.
pub(super) fn coordinate(joints: &[Joint], joint: usize, axis: usize) -> Coordinate {
    let number = match joints[joint].kind {
        Kind::Universal => Some(axis),
        Kind::Cylindrical => Some(1),
        _ => None,
    };
    Coordinate { joint, number }
}

/// The direction of a joint axis, in global axes.
pub(super) fn direction_of(
    axis: &Element,
    joint: &str,
    scope: &Scope,
    frames: &Frames,
) -> Read<V3> {
    let xyz = axis.child("xyz");
    let along = match xyz.map(Element::content) {
        Some(content) => direction(&v3(content.numbers()?)).ok_or_else(|| {
            content.fault("the axis has no direction", "write a direction, as 0 0 1")
        })?,
        // The format's default is z.
        None => unit(2),
    };
    let is_of_model = match axis.child("use_parent_model_frame") {
        Some(flag) => flag.content().flag()?,
        // Before version 1.5, all axes were in the frame of the model.
        None => scope.version < [1, 5],
    };
    let named = xyz.and_then(|xyz| xyz.value("expressed_in")).filter(|name| !name.is_empty());
    let frame = match named {
        Some(name) => frames.full(&scope.prefix, name, axis.at)?,
        None if is_of_model && scope.version < [1, 7] => scope.model(),
        None => joint.to_owned(),
    };
    Ok(frames.place(&frame)?.turn * along)
}

/// Reads limits, effort and rate. Returns the reason why there is no range, if the file has one or both limits.
fn limits(axis: &Element, has_range: bool, joint: &mut Joint) -> Read<Option<String>> {
    /// Value from which on a limit means that there is none, as in the format.
    const NONE: f64 = 1.0e16;
    let Some(limit) = axis.child("limit") else { return Ok(None) };
    let value = |name: &str| -> Read<Option<f64>> {
        let Some(child) = limit.child(name) else { return Ok(None) };
        // Published files write inf for a missing limit.
        let text = child.text.trim().trim_start_matches(['+', '-']).to_ascii_lowercase();
        if text.starts_with("inf") {
            return Ok(None);
        }
        let x = child.content().number()?;
        Ok(Some(x).filter(|x| x.abs() < NONE))
    };
    let (lower, upper) = (value("lower")?, value("upper")?);
    joint.effort = value("effort")?.filter(|x| *x > 0.0);
    joint.rate = value("velocity")?.filter(|x| *x > 0.0);
    Ok(match (lower, upper) {
        (None, None) => None,
        _ if !has_range => None,
        (Some(lower), Some(upper)) if lower < upper => {
            joint.range = Some([lower, upper]);
            None
        }
        (Some(lower), Some(upper)) => Some(laws::no_range(lower, upper)),
        _ => Some("one end alone: no range is taken, which has two ends here".to_owned()),
    })
}

/// Adds spring, damping, friction, stops and mimic relations of an axis.
fn laws(axis: &Element, of: Coordinate, robot: &mut Robot, context: &mut Context<'_>) -> Read<()> {
    let joint = &robot.joints[of.joint];
    let name = match of.number.filter(|_| joint.kind == Kind::Universal) {
        Some(number) => format!("{} axis {}", joint.name, number + 1),
        None => joint.name.clone(),
    };
    let path = format!("joint[{}]/{}", joint.name, axis.name);
    if let Some(dynamics) = axis.child("dynamics") {
        let [damping, friction, stiffness, reference] =
            ["damping", "friction", "spring_stiffness", "spring_reference"]
                .map(|word| number(dynamics, word, 0.0));
        let (damping, friction, stiffness, free) = (damping?, friction?, stiffness?, reference?);
        if damping < 0.0 || friction < 0.0 || stiffness < 0.0 {
            return Err(dynamics
                .fault("damping, friction or stiffness is below zero", "write zero or more"));
        }
        if damping > 0.0 || stiffness > 0.0 {
            let free = if stiffness > 0.0 { free } else { 0.0 };
            let on = Target::Coordinate(of.clone());
            let what = What::Spring { on, stiffness, damping, free };
            robot.laws.push(Law { name: format!("{name} spring"), what });
        }
        let of = (name.as_str(), of.clone());
        laws::friction((dynamics.at, &path), of, friction, robot, context);
    }
    let range = robot.joints[of.joint].range;
    if let (Some(limit), true) = (axis.child("limit"), range.is_some()) {
        let own = stiffness_of(limit)?;
        laws::stops((limit.at, &path), (&name, of), own, robot, context);
    }
    Ok(())
}

/// Stiffness and damping of stops; `None` for rigid stops.
fn stiffness_of(limit: &Element) -> Read<Option<[f64; 2]>> {
    /// Stiffness in the format that stands for a rigid stop.
    const RIGID: f64 = 1.0e8;
    let stiffness = number(limit, "stiffness", RIGID)?;
    let damping = number(limit, "dissipation", 1.0)?;
    Ok((stiffness > 0.0 && stiffness < RIGID).then_some([stiffness, damping.max(0.0)]))
}

/// The coupling of a screw: its translation is proportional to its rotation.
fn screw(element: &Element, joint: usize, name: &str) -> Read<Coupling> {
    let turn = core::f64::consts::TAU;
    let of_length = ["screw_thread_pitch", "drake:screw_thread_pitch"]
        .into_iter()
        .find_map(|word| element.child(word));
    let slide_of_turn = match (of_length, element.child("thread_pitch")) {
        // Metres per turn.
        (Some(pitch), _) => pitch.content().number()? / turn,
        // The older key has radians per metre, with the opposite sign.
        (None, Some(pitch)) => {
            let pitch = pitch.content();
            let x = pitch.number()?;
            if x == 0.0 {
                return Err(pitch.fault(
                    "the thread has no pitch",
                    "write <screw_thread_pitch>, metres for a turn",
                ));
            }
            -1.0 / x
        }
        (None, None) => 1.0 / turn,
    };
    let term = |number, factor| Term::new(Coordinate { joint, number: Some(number) }, factor);
    Ok(Coupling {
        name: format!("{name} thread"),
        terms: vec![term(0, 1.0), term(1, -slide_of_turn)],
        value: 0.0,
    })
}

/// Scope of the names of joints, and the frames by which joints are found.
pub(super) struct Names<'a> {
    pub(super) scope: &'a Scope,
    pub(super) frames: &'a Frames,
}

/// The index of a joint, by its name in the file.
pub(super) fn find(robot: &Robot, of: &Names<'_>, element: &Element, name: &str) -> Read<usize> {
    let full = format!("{}{name}", of.scope.prefix);
    let shown = of.frames.joint(&full).map(|[_, shown]| shown);
    let found = robot.joints.iter().position(|joint| Some(joint.name.as_str()) == shown);
    found.ok_or_else(|| {
        if shown.is_some() {
            let message = format!("joint `{name}` is in a static model, and does not move");
            return Fault::new(element.at, message, "leave out this <mimic>");
        }
        let names: Vec<_> = robot.joints.iter().map(|joint| joint.name.as_str()).collect();
        let hint = mbs_scene::nearest_name(of.frames.plain(&full), &names, "joints");
        Fault::new(element.at, format!("unknown joint `{name}`"), hint)
    })
}
