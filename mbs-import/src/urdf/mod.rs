//! Reader of URDF: a tree of links with a single root.

mod control;
mod drake;
mod joint;
mod link;
mod pose;
mod root;
mod table;
mod tree;

pub(crate) use table::TABLE;
pub(crate) use tree::Tree;

use crate::context::Context;
use crate::element::Element;
use crate::options::BaseKind;
use crate::pose::Pose;
use crate::robot::{GROUND, Joint, Kind, Robot};
use crate::source::{Fault, Read};
use root::WORLD;

/// Reads a model from the root element `robot`.
pub(crate) fn read(root: &Element, context: &mut Context<'_>) -> Read<Robot> {
    let name = root.value("name").unwrap_or("robot");
    let mut robot = Robot::new(name, root.at.source);
    // The format has no gravity, so the standard value is used.
    robot.gravity = [0.0, 0.0, -9.81];
    let tree = Tree::read(root, "", &mut robot, context)?;
    let trunk = tree.trunk;
    tree.add(root, &Pose::identity(), &mut robot, context)?;
    base(&mut robot, trunk, context)?;
    robot.rename_alike();
    Ok(robot)
}

/// Adds the joint between the ground and the root link, fixed or free.
fn base(robot: &mut Robot, trunk: usize, context: &mut Context<'_>) -> Read<()> {
    let link = &robot.links[trunk];
    let (at, place) = (link.at, link.pose.at);
    let is_ground = link.name == WORLD;
    let asked = context.options.base;
    if is_ground && asked == Some(BaseKind::Free) {
        return Err(Fault::new(
            at,
            "the root link is called `world`: it is the ground, and cannot be free",
            "leave out `--base free`, or give the link another name",
        ));
    }
    let (kind, note) = match asked {
        _ if is_ground => (Kind::Fixed, "Base: its link `world` is the ground.".to_owned()),
        Some(BaseKind::Free) => {
            (Kind::Free, format!("Base: link `{}` moves freely (--base free).", link.name))
        }
        Some(BaseKind::Fixed) => (
            Kind::Fixed,
            format!("Base: link `{}` is fixed to the ground (--base fixed).", link.name),
        ),
        None => (
            Kind::Fixed,
            format!(
                "Base: link `{}` is fixed to the ground; the file does not say (--base free).",
                link.name
            ),
        ),
    };
    let name = unused("base", robot);
    robot.joints.push(Joint::new(&name, at, kind, [GROUND, trunk], place));
    robot.notes.push(note);
    robot.notes.push("Gravity: 0 0 -9.81; the format has none.".into());
    Ok(())
}

/// A name that no joint has: the given one, with an ending if needed.
fn unused(name: &str, robot: &Robot) -> String {
    let mut name = name.to_owned();
    while robot.joints.iter().any(|joint| joint.name == name) {
        name.push('~');
    }
    name
}
