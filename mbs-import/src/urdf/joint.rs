//! Joints: kinds, axes, limits, damping and mimic joints.

use super::pose::origin;
use crate::context::{Context, Named};
use crate::element::Element;
use crate::laws;
use crate::pose::{Pose, V3, direction, v3};
use crate::robot::{Coordinate, Coupling, Joint, Kind, Law, Robot, Target, What};
use crate::source::{Fault, Read};

/// Joint types of the format, with the kinds of joints.
const TYPES: [(&str, Kind); 7] = [
    ("revolute", Kind::Revolute),
    ("continuous", Kind::Revolute),
    ("prismatic", Kind::Prismatic),
    ("fixed", Kind::Fixed),
    ("floating", Kind::Free),
    ("planar", Kind::Planar),
    // Type of later versions of the format.
    ("spherical", Kind::Spherical),
];

/// Reads a joint in the frame of its parent link, and the pose of the joint's frame there.
pub(super) fn read(
    element: &Element,
    prefix: &str,
    links: &Named,
    context: &Context<'_>,
) -> Read<(Joint, Pose)> {
    let name = &format!("{prefix}{}", element.need("name")?.value);
    let word = element.need("type")?;
    let kind = TYPES.iter().find(|(name, _)| *name == word.value.trim()).map(|(_, kind)| *kind);
    let kind = kind.ok_or_else(|| {
        let known = TYPES.map(|(name, _)| name).join(", ");
        word.fault(format!("unknown type of joint `{}`", word.value), format!("types are {known}"))
    })?;
    let is_kept = kind == Kind::Fixed && context.options.keep_fixed.iter().any(|kept| kept == name);
    let kind = if is_kept { Kind::Weld } else { kind };
    let mut ends = [0; 2];
    for (end, word) in ends.iter_mut().zip(["parent", "child"]) {
        let child = element.child(word).ok_or_else(|| {
            element.fault(
                format!("joint `{name}` has no <{word}>"),
                format!("write <{word} link=\"...\"/>"),
            )
        })?;
        let link = child.need("link")?;
        *end = links.find(&link.value, link.at)?;
    }
    if ends[0] == ends[1] {
        return Err(element
            .fault(format!("joint `{name}` joins a link to itself"), "give it another child"));
    }
    let mut joint = Joint::new(name, element.at, kind, ends, V3::zeros());
    match kind {
        Kind::Revolute | Kind::Prismatic => joint.axes = vec![axis(element)?],
        Kind::Planar => {
            let normal = axis(element)?;
            joint.axes = vec![normal, across(&normal)];
        }
        // Published files write any axis for a fixed joint, such as 0 0 0.
        _ => element.child("axis").map_or((), Element::read_whole),
    }
    if matches!(kind, Kind::Fixed | Kind::Weld) {
        // Limits and friction have no effect on a fixed joint.
        ["limit", "dynamics"]
            .into_iter()
            .flat_map(|word| element.each(word))
            .for_each(Element::read_whole);
    }
    if let (Kind::Revolute | Kind::Prismatic, Some(limit)) = (kind, element.child("limit")) {
        let number = |name| limit.number_or(name, 0.0);
        let [effort, rate] = [number("effort")?, number("velocity")?];
        joint.effort = (effort > 0.0).then_some(effort);
        joint.rate = (rate > 0.0).then_some(rate);
        if word.value.trim() != "continuous" {
            let range = [number("lower")?, number("upper")?];
            joint.range = (range[0] < range[1]).then_some(range);
        }
    }
    Ok((joint, origin(element)?))
}

/// Returns the reason why a joint with a `limit` gets no range.
fn no_range(limit: &Element) -> Read<String> {
    let [lower, upper] = ["lower", "upper"].map(|name| limit.number_or(name, 0.0));
    let (lower, upper) = (lower?, upper?);
    if limit.attribute("lower").is_none() && limit.attribute("upper").is_none() {
        let says = "neither `lower` nor `upper`: no range is taken; the format's default is 0 to 0, which holds the joint";
        return Ok(says.to_owned());
    }
    Ok(laws::no_range(lower, upper))
}

/// The axis in the frame of the joint; the default of the format is x.
fn axis(element: &Element) -> Read<V3> {
    let Some(xyz) = element.child("axis").and_then(|axis| axis.attribute("xyz")) else {
        return Ok(v3([1.0, 0.0, 0.0]));
    };
    let numbers = v3(xyz.numbers()?);
    direction(&numbers)
        .ok_or_else(|| xyz.fault("the axis has no direction", "write a direction, as 0 0 1"))
}

/// A unit vector perpendicular to `normal`. It is the part of the x axis across the normal, scaled to unit length. When x is nearly along the
/// normal, the axis with the smallest component of the normal replaces x.
fn across(normal: &V3) -> V3 {
    let least = (0..3).min_by(|a, b| normal[*a].abs().total_cmp(&normal[*b].abs())).unwrap_or(0);
    let first = crate::pose::unit(if normal[0].abs() < 0.9 { 0 } else { least });
    let slide = first - normal * normal.dot(&first);
    direction(&slide).unwrap_or(first)
}

/// Adds damping, friction, stops and the mimic relation of a joint.
pub(super) fn laws(
    element: &Element,
    number: usize,
    joints: &Named,
    robot: &mut Robot,
    context: &mut Context<'_>,
) -> Read<()> {
    let joint = &robot.joints[number];
    let (name, path) = (joint.name.clone(), format!("robot/{}", element.label()));
    if joint.kind == Kind::Planar {
        let says = "the format leaves the slides of a plane open: the first is x of the joint's frame, made right-angled to the normal";
        context.findings.approximated(element.at, path.as_str(), says);
    }
    if !matches!(joint.kind, Kind::Revolute | Kind::Prismatic) {
        return Ok(());
    }
    let of = Coordinate { joint: number, number: None };
    if let Some(limit) = element.child("limit") {
        if joint.range.is_some() {
            laws::stops((limit.at, &path), (&name, of.clone()), None, robot, context);
        } else if element.value("type") != Some("continuous") {
            context.findings.approximated(limit.at, format!("{path}/limit"), no_range(limit)?);
        }
    }
    if let Some(dynamics) = element.child("dynamics") {
        let [damping, friction] =
            [dynamics.number_or("damping", 0.0)?, dynamics.number_or("friction", 0.0)?];
        if damping < 0.0 || friction < 0.0 {
            return Err(dynamics.fault("damping or friction is below zero", "write zero or more"));
        }
        if damping > 0.0 {
            let on = Target::Coordinate(of.clone());
            let what = What::Spring { on, stiffness: 0.0, damping, free: 0.0 };
            robot.laws.push(Law { name: format!("{name} damping"), what });
        }
        laws::friction((dynamics.at, &path), (&name, of), friction, robot, context);
    }
    if let Some(mimic) = element.child("mimic") {
        let leader = mimic.need("joint")?;
        let leader = joints.find(&leader.value, leader.at)?;
        let factor = mimic.number_or("multiplier", 1.0)?;
        robot.couplings.push(Coupling::follows(
            &name,
            [number, leader].map(|joint| Coordinate { joint, number: None }),
            factor,
            mimic.number_or("offset", 0.0)?,
        ));
    }
    Ok(())
}

/// Checks the mimic couplings, which begin at index `first`. Each must be between joints with one coordinate, and no cycle is allowed.
pub(super) fn check_mimics(robot: &Robot, first: usize) -> Read<()> {
    let couplings = &robot.couplings[first..];
    let leader = |joint: usize| {
        let of = |coupling: &&Coupling| coupling.terms[0].of.joint == joint;
        couplings.iter().find(of).map(|coupling| coupling.terms[1].of.joint)
    };
    for coupling in couplings {
        let [follower, first] = [0, 1].map(|i| coupling.terms[i].of.joint);
        let at = robot.joints[follower].at;
        if !matches!(robot.joints[first].kind, Kind::Revolute | Kind::Prismatic) {
            return Err(Fault::new(
                at,
                format!(
                    "`{}` mimics `{}`, which has no single coordinate",
                    robot.joints[follower].name, robot.joints[first].name
                ),
                "a joint mimics one that is revolute, continuous or prismatic",
            ));
        }
        let (mut next, mut names) = (Some(first), vec![follower]);
        while let Some(joint) = next {
            if names.contains(&joint) {
                let names: Vec<_> =
                    names.iter().map(|joint| format!("`{}`", robot.joints[*joint].name)).collect();
                let message = format!("joints mimic each other in a circle: {}", names.join(", "));
                return Err(Fault::new(at, message, "let one of them move by itself"));
            }
            names.push(joint);
            next = leader(joint);
        }
    }
    Ok(())
}
