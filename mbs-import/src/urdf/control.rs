//! Drives: transmissions and effort interfaces become inputs of the scene.

use super::drake::rotor;
use crate::context::{Context, Named};
use crate::element::Element;
use crate::robot::{Coordinate, Kind, Law, Robot, Target, What};
use crate::source::Read;

/// Adds an input for every joint that has an effort interface.
pub(super) fn inputs(
    root: &Element,
    joints: &Named,
    robot: &mut Robot,
    context: &mut Context<'_>,
) -> Read<()> {
    for transmission in root.each("transmission") {
        transmission.attribute("name");
        transmission.child("type");
        for joint in transmission.each("joint") {
            let interface =
                joint.child("hardwareInterface").map_or("", |interface| interface.text.as_str());
            input(joint, interface, joints, robot, context)?;
        }
        let path = format!("robot/{}", transmission.label());
        for actuator in transmission.each("actuator") {
            actuator.attribute("name");
            actuator.child("hardwareInterface");
            let joint = transmission.child("joint").and_then(|joint| joint.value("name"));
            if let Some(number) = joint.and_then(|joint| joints.get(joint)) {
                rotor(actuator, number, robot)?;
            }
            let reduction = actuator.child("mechanicalReduction");
            if let Some(reduction) = reduction.filter(|ratio| ratio.text.trim().parse() != Ok(1.0))
            {
                let says = format!(
                    "gear ratio {}: not used; the input is the effort of the joint",
                    reduction.text.trim()
                );
                context.findings.ignored(
                    reduction.at,
                    format!("{path}/actuator/mechanicalReduction"),
                    says,
                );
            }
        }
    }
    for control in root.each("ros2_control") {
        control.attribute("name");
        control.attribute("type");
        for joint in control.each("joint") {
            let commands: Vec<_> = joint.each("command_interface").collect();
            let effort = commands.iter().find(|command| command.value("name") == Some("effort"));
            input(joint, if effort.is_some() { "effort" } else { "" }, joints, robot, context)?;
        }
    }
    Ok(())
}

/// Adds the input of a joint if its interface is an effort.
fn input(
    element: &Element,
    interface: &str,
    joints: &Named,
    robot: &mut Robot,
    context: &mut Context<'_>,
) -> Read<()> {
    let name = element.need("name")?;
    let path = format!("robot/{}", element.label());
    let Some(number) = joints.get(&name.value) else {
        context.findings.ignored(element.at, path, "the robot has no joint of that name");
        return Ok(());
    };
    if !interface.to_ascii_lowercase().contains("effort") {
        context.findings.ignored(
            element.at,
            path,
            "the interface is no effort: the joint gets no input",
        );
        return Ok(());
    }
    if !matches!(robot.joints[number].kind, Kind::Revolute | Kind::Prismatic) {
        context.findings.ignored(
            element.at,
            path,
            "the joint has no single coordinate: it gets no input",
        );
        return Ok(());
    }
    let law_name = format!("{} effort", robot.joints[number].name);
    if robot.laws.iter().any(|law| law.name == law_name) {
        return Ok(());
    }
    let on = Target::Coordinate(Coordinate { joint: number, number: None });
    robot.laws.push(Law { name: law_name, what: What::Input { on, value: 0.0 } });
    Ok(())
}
