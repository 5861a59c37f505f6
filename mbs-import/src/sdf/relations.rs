//! What relates joints to each other: gearboxes and mimicry.

use super::frames::Frames;
use super::joint::{direction_of, find};
use super::scope::{Scope, is_gearbox, missing};
use crate::context::Context;
use crate::element::Element;
use crate::pose::V3;
use crate::robot::{Coordinate, Coupling, GROUND, Kind, Robot, Term};
use crate::source::Read;

/// Adds the gearboxes and followers of a model.
pub(super) fn read(
    model: &Element,
    scope: &Scope,
    frames: &Frames,
    robot: &mut Robot,
    context: &mut Context<'_>,
) -> Read<()> {
    for element in model.each("joint") {
        if is_gearbox(element) {
            let coupling = gearbox(element, scope, frames, robot)?;
            robot.couplings.push(coupling);
            continue;
        }
        let name = &element.need("name")?.value;
        let follower = find(robot, scope, element, name)?;
        for (i, axis) in ["axis", "axis2"].into_iter().enumerate() {
            let Some(mimic) = element.child(axis).and_then(|axis| axis.child("mimic")) else {
                continue;
            };
            let leader = mimic.need("joint")?;
            let number = |word: &str, default| super::link::number(mimic, word, default);
            let (factor, offset, reference) =
                (number("multiplier", 1.0)?, number("offset", 0.0)?, number("reference", 0.0)?);
            let of_leader = coordinate(
                robot,
                find(robot, scope, mimic, &leader.value)?,
                mimic.value("axis") == Some("axis2"),
            );
            let terms = [(coordinate(robot, follower, i == 1), 1.0), (of_leader, -factor)];
            robot.couplings.push(Coupling {
                name: format!("{}{name} mimic", scope.prefix),
                terms: terms.map(|(of, factor)| Term::new(of, factor)).into(),
                value: offset - factor * reference,
            });
        }
        if let Some(mimic) = element.child("drake:mimic") {
            let leader = mimic.need("joint")?;
            let leader = find(robot, scope, mimic, &leader.value)?;
            let factor = mimic.number_or("multiplier", 1.0)?;
            let term = |joint, factor| Term::new(coordinate(robot, joint, false), factor);
            robot.couplings.push(Coupling {
                name: format!("{}{name} mimic", scope.prefix),
                terms: vec![term(follower, 1.0), term(leader, -factor)],
                value: mimic.number_or("offset", 0.0)?,
            });
        }
        reflected(element, follower, robot, context)?;
    }
    Ok(())
}

/// The coordinate that an axis of a joint means.
fn coordinate(robot: &Robot, joint: usize, is_second: bool) -> Coordinate {
    let number = match robot.joints[joint].kind {
        Kind::Universal => Some(usize::from(is_second)),
        Kind::Cylindrical => Some(1),
        _ => None,
    };
    Coordinate { joint, number }
}

/// The inertia of a motor's rotor behind its gear.
fn reflected(
    element: &Element,
    joint: usize,
    robot: &mut Robot,
    context: &mut Context<'_>,
) -> Read<()> {
    use crate::robot::{Law, Target, What};
    let _ = context;
    let Some(inertia) = element.child("drake:rotor_inertia") else { return Ok(()) };
    let inertia = inertia.content().number()?;
    let ratio =
        element.child("drake:gear_ratio").map_or(Ok(1.0), |ratio| ratio.content().number())?;
    if inertia > 0.0 && ratio != 0.0 {
        let on = Target::Coordinate(coordinate(robot, joint, false));
        let name = format!("{} rotor", robot.joints[joint].name);
        robot.laws.push(Law { name, what: What::Rotor { on, inertia: inertia * ratio * ratio } });
    }
    Ok(())
}

/// Angles of two links against a third: that of the child is minus the ratio times that of the parent.
fn gearbox(element: &Element, scope: &Scope, frames: &Frames, robot: &Robot) -> Read<Coupling> {
    let name = &element.need("name")?.value;
    let own = frames.full(&scope.prefix, name, element.at)?;
    let link = |word: &str| -> Read<usize> {
        let child = element.child(word).ok_or_else(|| missing(element, word))?;
        let full = frames.full(&scope.prefix, child.text.trim(), child.at)?;
        Ok(frames.link(&full)?.unwrap_or(GROUND))
    };
    let [parent, child, reference] =
        [link("parent")?, link("child")?, link("gearbox_reference_body")?];
    let ratio = super::link::number(element, "gearbox_ratio", 1.0)?;
    let axis = |word: &str| -> Read<V3> {
        let axis = element.child(word).ok_or_else(|| missing(element, word))?;
        direction_of(axis, &own, scope, frames)
    };
    let first = turn(element, robot, [reference, parent], &axis("axis")?)?;
    let second = turn(element, robot, [reference, child], &axis("axis2")?)?;
    let term = |(joint, sign): (usize, f64), factor: f64| {
        Term::new(coordinate(robot, joint, false), sign * factor)
    };
    Ok(Coupling {
        name: format!("{}{name}", scope.prefix),
        terms: vec![term(second, 1.0), term(first, ratio)],
        value: 0.0,
    })
}

/// The joint whose coordinate is the angle of the second link against the first about an axis, and its sign.
fn turn(element: &Element, robot: &Robot, [from, to]: [usize; 2], axis: &V3) -> Read<(usize, f64)> {
    /// Axes of one line agree so far; published ones have six digits.
    const ALIKE: f64 = 1.0e-5;
    for (number, joint) in
        robot.joints.iter().enumerate().filter(|(_, joint)| joint.kind == Kind::Revolute)
    {
        let sense = match [joint.parent, joint.child] {
            ends if ends == [from, to] => 1.0,
            ends if ends == [to, from] => -1.0,
            _ => continue,
        };
        let along = joint.axes[0].dot(axis);
        if along.abs() > 1.0 - ALIKE {
            return Ok((number, sense * along.signum()));
        }
    }
    let [from, to] = [from, to].map(|link| &robot.links[link].name);
    Err(element.fault(
        format!("no revolute joint turns `{to}` against `{from}` about the axis of this gearbox"),
        "join each of the two links to <gearbox_reference_body> by a revolute joint about its axis",
    ))
}
