//! Reader of MJCF: bodies within bodies, with defaults, loops, tendons and actuators.
#![allow(clippy::float_cmp, reason = "what a file writes is compared as it stands")]

mod actuator;
mod asset;
mod attach;
mod body;
mod built_in;
mod compiler;
mod crank;
mod defaults;
mod drive;
mod effort;
mod equality;
mod fitted;
mod flywheel;
mod geom;
mod include;
mod joint;
mod keyframe;
mod model;
mod offset;
mod orientation;
mod passive;
mod size;
mod springs;
mod stops;
mod strength;
mod surface;
mod table;
mod tendon;
#[cfg(test)]
mod tests;
mod transmission;
mod weights;

pub(crate) use attach::attach;
pub(crate) use include::include;
pub(crate) use table::TABLE;

use crate::context::Context;
use crate::element::Element;
use crate::robot::Robot;
use crate::source::Read;
use compiler::Compiler;
use defaults::Classes;
use model::Model;

/// Reads a model from the root element `mujoco`.
pub(crate) fn read(root: &Element, context: &mut Context<'_>) -> Read<Robot> {
    let before = context.findings.clone();
    let (robot, is_open) = whole(root, None, context)?;
    if !is_open {
        return Ok(robot);
    }
    // A loop is open in the drawn configuration. If the options name a keyframe, the model is read again with its bodies placed as in the
    // keyframe.
    let Some(posed) = keyframe::places(root, context)? else { return Ok(robot) };
    context.findings = before;
    whole(root, Some(posed), context).map(|(robot, _)| robot)
}

/// Reads a model, with its bodies as drawn or at the coordinates of a keyframe. Also returns whether a loop is open in that configuration.
fn whole(
    root: &Element,
    posed: Option<Vec<f64>>,
    context: &mut Context<'_>,
) -> Read<(Robot, bool)> {
    let name = root.value("model").unwrap_or("mujoco");
    let mut robot = Robot::new(name, root.at.source);
    let compiler = Compiler::read(root)?;
    robot.gravity = compiler.gravity;
    let classes = Classes::read(root)?;
    let mut model = Model::new(compiler, &classes, robot, context);
    model.posed = posed;
    asset::collect(root, &mut model)?;
    body::read(root, &mut model)?;
    if model.robot.links.len() == 1 {
        return Err(root.fault("the model has no body", "put a <body> into the <worldbody>"));
    }
    weights::settle(&mut model)?;
    let factor = stops::Lazy::new();
    stops::add(&factor, &mut model);
    tendon::read(root, &factor, &mut model)?;
    equality::read(root, &mut model)?;
    drive::read(root, &factor, &mut model)?;
    keyframe::read(root, &mut model)?;
    weights::armatures(&mut model);
    body::frames(&mut model);
    model.robot.coordinates =
        model.motions.iter().map(|motion| motion.of_file(&model.robot)).collect();
    if model.touching > 1 && model.compiler.acts.contact {
        let says = format!(
            "{} of them could touch: there is no contact between bodies yet",
            model.touching
        );
        model.context.findings.ignored(root.at, "geom", says);
    }
    if let Some(step) = root.each("option").filter_map(|option| option.value("timestep")).last() {
        model
            .robot
            .notes
            .push(format!("Step of the file: {step} s; methods here choose their own."));
    }
    Ok((model.robot, model.is_open))
}
