//! Loops, rotors and frames in elements of the program Drake: `drake:...` and `frame`.

use super::root::WORLD;
use crate::closing::ball;
use crate::context::Named;
use crate::element::Element;
use crate::pose::{Pose, V3, roll_pitch_yaw, v3};
use crate::robot::{Coordinate, Frame, GROUND, Kind, Law, Robot, Target, What, scene_name};
use crate::source::Read;

/// Adds the ball joints that close loops.
pub(super) fn loops(root: &Element, links: &Named, prefix: &str, robot: &mut Robot) -> Read<()> {
    const WORD: &str = "drake:ball_constraint";
    for (i, element) in root.each(WORD).enumerate() {
        let need = |part: &str| {
            let name = format!("{WORD}_{part}");
            element.child(&name).ok_or_else(|| {
                element.fault(format!("no <{name}>"), format!("write <{name} ...=\"...\"/>"))
            })
        };
        let point = |body: &str, at: &str| -> Read<(usize, V3)> {
            let link = need(body)?.need("name")?;
            let is_ground = link.value == WORLD && links.get(WORLD).is_none();
            let link = if is_ground { GROUND } else { links.find(&link.value, link.at)? };
            let at = v3(need(at)?.need("value")?.numbers()?);
            Ok((link, robot.links[link].pose.point(&at)))
        };
        let ends = [point("body_A", "p_AP")?, point("body_B", "p_BQ")?];
        robot.joints.push(ball(&format!("{prefix}ball constraint {}", i + 1), element, ends)?);
    }
    Ok(())
}

/// Adds the named frames: each `frame` element has a link, a position and angles.
pub(super) fn frames(root: &Element, links: &Named, prefix: &str, robot: &mut Robot) -> Read<()> {
    for element in root.each("frame") {
        let name = format!("{prefix}{}", element.need("name")?.value);
        let word = element.need("link")?;
        let is_ground = word.value == WORLD && links.get(WORLD).is_none();
        let link = if is_ground { GROUND } else { links.find(&word.value, word.at)? };
        let at = v3(element.numbers_or("xyz", [0.0; 3])?);
        let own = Pose::new(roll_pitch_yaw(element.numbers_or("rpy", [0.0; 3])?), at);
        let pose = robot.links[link].pose.then(&own);
        robot.frames.push(Frame { name: scene_name(&name, "frame"), link, pose });
    }
    Ok(())
}

/// Adds the inertia of a motor's rotor, reflected by its gear, as given in the actuator of a transmission.
pub(super) fn rotor(element: &Element, joint: usize, robot: &mut Robot) -> Read<()> {
    let number = |word: &str, default: f64| {
        element.child(word).map_or(Ok(default), |child| child.number_or("value", default))
    };
    let [inertia, ratio] = [number("drake:rotor_inertia", 0.0)?, number("drake:gear_ratio", 1.0)?];
    let (Kind::Revolute | Kind::Prismatic) = robot.joints[joint].kind else { return Ok(()) };
    let inertia = inertia * ratio * ratio;
    if inertia > 0.0 {
        let name = format!("{} rotor", robot.joints[joint].name);
        let on = Target::Coordinate(Coordinate { joint, number: None });
        robot.laws.push(Law { name, what: What::Rotor { on, inertia } });
    }
    Ok(())
}
