//! Loops and springs in elements of the program Drake, `drake:...`.

use super::frames::Frames;
use super::scope::{Scope, placed, vector};
use crate::closing::{CLOSED, ball};
use crate::context::Context;
use crate::element::Element;
use crate::pose::V3;
use crate::robot::{Joint, Kind, Law, Robot, What};
use crate::source::{Fault, Read};

/// Adds the constraints and bushings of a model.
pub(super) fn read(
    model: &Element,
    scope: &Scope,
    frames: &Frames,
    robot: &mut Robot,
    context: &mut Context<'_>,
) -> Read<()> {
    if scope.is_static {
        model.each("drake:joint").for_each(Element::read_whole);
    }
    if let Some(joint) = model.child("drake:joint").filter(|_| !scope.is_static) {
        let hint = "write it as a <joint> of the format, and a planar one as two prismatic joints and a revolute one";
        return Err(joint.fault("a joint of another program is not read", hint));
    }
    for (i, element) in model.each("drake:ball_constraint").enumerate() {
        let ends = points(element, "drake:ball_constraint", scope, frames)?;
        if are_still(&ends, frames) {
            element.read_whole();
            continue;
        }
        let name = format!("{}ball constraint {}", frames.plain(&scope.prefix), i + 1);
        robot.joints.push(ball(&name, element, ends)?);
    }
    for (i, element) in model.each("drake:distance_constraint").enumerate() {
        let word = "drake:distance_constraint";
        let [a, b] = points(element, word, scope, frames)?;
        if are_still(&[a, b], frames) {
            element.read_whole();
            continue;
        }
        let name = format!("{}distance constraint {}", frames.plain(&scope.prefix), i + 1);
        let wanted = element
            .child(&format!("{word}_distance"))
            .map(|child| child.content().number())
            .transpose()?;
        let found = (a.1 - b.1).norm();
        if wanted.is_some_and(|wanted| (wanted - found).abs() > CLOSED) {
            return Err(element.fault(
                format!("the two points are {found} m apart where all joints are at zero"),
                "give poses in which they have the distance that is written",
            ));
        }
        robot.joints.push(Joint::new(&name, element.at, Kind::Distance(b.1), [a.0, b.0], a.1));
    }
    for (i, element) in model.each("drake:linear_bushing_rpy").enumerate() {
        if !bushing(element, (i, scope), frames, robot)? {
            continue;
        }
        let says = "moments by roll, pitch and yaw in a frame halfway there; here by a rotation vector in the first frame";
        context.findings.approximated(element.at, "drake:linear_bushing_rpy", says);
    }
    Ok(())
}

/// The two points of a constraint, each with its link and its global position.
fn points(element: &Element, word: &str, scope: &Scope, frames: &Frames) -> Read<[(usize, V3); 2]> {
    let point = |body: &str, at: &str| -> Read<(usize, V3)> {
        let name = format!("{word}_{body}");
        let (link, pose) = placed(element, &name, scope, frames)?;
        Ok((link, pose.point(&vector(element, &format!("{word}_{at}"))?)))
    };
    Ok([point("body_A", "p_AP")?, point("body_B", "p_BQ")?])
}

/// True if both points are fixed to the ground.
fn are_still(ends: &[(usize, V3); 2], frames: &Frames) -> bool {
    ends.iter().all(|(link, _)| frames.is_still(*link))
}

/// Adds a spring in six directions between two frames that coincide. Returns `false` when both frames are fixed to the ground.
fn bushing(
    element: &Element,
    (i, scope): (usize, &Scope),
    frames: &Frames,
    robot: &mut Robot,
) -> Read<bool> {
    let frame = |word: &str| placed(element, word, scope, frames);
    let [(a, first), (c, second)] =
        [frame("drake:bushing_frameA")?, frame("drake:bushing_frameC")?];
    if frames.is_still(a) && frames.is_still(c) {
        element.read_whole();
        return Ok(false);
    }
    if (first.at - second.at).norm() > CLOSED
        || (first.turn - second.turn).norm() > CLOSED
        || !is_global(&first.turn)
    {
        return Err(Fault::new(
            element.at,
            "a bushing whose frames do not coincide, or are turned against the model, is not read",
            "place both frames at one place with the axes of the model",
        ));
    }
    let six = |word: &str| -> Read<[f64; 6]> {
        let force = vector(element, &format!("drake:bushing_force_{word}"))?;
        let moment = vector(element, &format!("drake:bushing_torque_{word}"))?;
        Ok([force[0], force[1], force[2], moment[0], moment[1], moment[2]])
    };
    let what = What::Bushing {
        links: [a, c],
        place: first.at,
        stiffness: six("stiffness")?,
        damping: six("damping")?,
    };
    let name = format!("{}bushing {}", frames.plain(&scope.prefix), i + 1);
    robot.laws.push(Law { name, what });
    Ok(true)
}

fn is_global(turn: &crate::pose::M3) -> bool {
    (turn - crate::pose::M3::identity()).norm() < CLOSED
}
