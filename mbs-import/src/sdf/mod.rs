//! Reader of SDF: nested models, frames relative to frames, and loops closed by joints.

mod collect;
mod drake;
mod frames;
mod include;
mod joint;
mod link;
mod part;
mod pose;
mod relations;
mod scope;
mod table;
mod weight;

pub(crate) use include::include;
pub(crate) use table::TABLE;

use crate::context::Context;
use crate::element::Element;
use crate::options::BaseKind;
use crate::robot::{Frame, GROUND, Joint, Kind, Link, Robot, scene_name};
use crate::source::Read;
use collect::{Collector, Model};
use frames::{Frames, WORLD};
use part::Part;
use scope::{Scope, is_gearbox, version};
use weight::Place;

/// Reads a model from the root element `sdf`.
pub(crate) fn read(root: &Element, context: &mut Context<'_>) -> Read<Robot> {
    let version = version(root.need("version")?)?;
    let (tops, world) = match root.child("world") {
        Some(world) => (world.each("model").collect::<Vec<_>>(), Some(world)),
        None => (root.each("model").collect(), None),
    };
    let Some(first) = tops.first() else {
        return Err(root.fault("the file has no model", "write a <model name=\"...\">"));
    };
    let name = world.unwrap_or(first).value("name").unwrap_or("model");
    let mut robot = Robot::new(name, root.at.source);
    let gravity = world.and_then(|world| world.child("gravity"));
    robot.gravity = gravity.map_or(Ok([0.0, 0.0, -9.8]), |gravity| gravity.content().numbers())?;
    robot.notes.push(match gravity {
        Some(_) => "Gravity: the world's.".to_owned(),
        None => "Gravity: 0 0 -9.8, the format's default.".to_owned(),
    });
    // Names in the scene leave out the name of the only model.
    let hidden = match tops[..] {
        [only] => format!("{}::", only.need("name")?.value),
        _ => String::new(),
    };
    let mut collector = Collector::new(hidden, &mut robot, context);
    for top in &tops {
        let prefix = format!("{}::", top.need("name")?.value);
        collector.model(top, Scope { prefix, version, is_static: false }, WORLD)?;
    }
    if let Some(world) = world {
        let scope = Scope { prefix: String::new(), version, is_static: false };
        collector.world(world, scope)?;
    }
    let Collector { models, parts, frames, .. } = collector;
    links(&models, &frames, &mut robot, context)?;
    let trunks: Vec<_> = parts.iter().map(Part::trunk_link).collect();
    for part in parts {
        part.add(&frames, &mut robot, context)?;
    }
    for (model, scope) in &models {
        for element in model.each("joint").filter(|element| !is_gearbox(element)) {
            joint::read(element, scope, &frames, &mut robot, context)?;
        }
    }
    for (model, scope) in &models {
        relations::read(model, scope, &frames, &mut robot)?;
        drake::read(model, scope, &frames, &mut robot, context)?;
    }
    base(&frames, &trunks, &mut robot, context);
    robot.rename_alike();
    Ok(robot)
}

/// Adds the links at their poses, with their inertias, shapes and named frames.
fn links(
    models: &[Model<'_>],
    frames: &Frames,
    robot: &mut Robot,
    context: &mut Context<'_>,
) -> Read<()> {
    for (model, scope) in models {
        for element in model.each("link") {
            let name = format!("{}{}", scope.prefix, element.need("name")?.value);
            let Some(number) = frames.link(&name)? else { continue };
            let pose = frames.place(&name)?;
            robot.links[number].pose = pose;
            let place = Place { name: &name, scope, frames };
            link::shapes(element, (number, &place), robot, context)?;
            if scope.is_static {
                // The masses of static links have no effect.
                let own = ["inertial", "gravity"].into_iter().flat_map(|name| element.each(name));
                own.for_each(Element::read_whole);
                continue;
            }
            let mass = link::mass(element, &place, context)?;
            robot.links[number].mass = mass.map(|mass| mass.seen_from(&pose));
            if let Some(gravity) = element.child("gravity") {
                robot.links[number].gravity_scale =
                    if gravity.content().flag()? { 1.0 } else { 0.0 };
            }
        }
        for element in model.each("frame") {
            let full = format!("{}{}", scope.prefix, element.need("name")?.value);
            let link = frames.link(&full)?.unwrap_or(GROUND);
            let pose = frames.place(&full)?;
            let mut name = scene_name(frames.plain(&full), "frame");
            if scope.is_world() && is_taken(&name, robot) {
                name = format!("{WORLD}::{name}");
            }
            robot.frames.push(Frame { name, link, pose });
        }
    }
    Ok(())
}

/// True if a link or a frame with this name exists.
fn is_taken(name: &str, robot: &Robot) -> bool {
    let mut links = robot.links.iter().map(|link| &link.name);
    links.any(|link| link == name) || robot.frames.iter().any(|frame| frame.name == name)
}

/// Connects every tree of links that has no connection to the ground by a joint to the ground. The joint is free, or fixed if the options
/// request it. Links of static models are always fixed.
fn base(frames: &Frames, trunks: &[usize], robot: &mut Robot, context: &Context<'_>) {
    for link in 1..robot.links.len() {
        if frames.is_still(link) {
            hold(robot, link, Kind::Fixed, "static");
        }
        // Older files call a link `world` to mean the ground.
        if robot.links[link].name.rsplit("::").next() == Some(WORLD) {
            hold(robot, link, Kind::Fixed, "ground");
        }
    }
    let kind = if context.options.base == Some(BaseKind::Fixed) { Kind::Fixed } else { Kind::Free };
    let carriers = robot.carriers(|_| true);
    let mut is_held = vec![false; robot.links.len()];
    is_held[GROUND] = true;
    let mut roots = Vec::new();
    // The base is the root of a URDF, or else the first of the connected links.
    for link in trunks.iter().copied().chain(0..carriers.len()) {
        if !std::mem::replace(&mut is_held[carriers[link]], true) {
            hold(robot, link, kind, "base");
            roots.push(format!("`{}`", robot.links[link].name));
        }
    }
    robot.notes.push(match (&roots[..], kind) {
        ([], _) => "Base: the file holds it in the world.".to_owned(),
        (_, Kind::Fixed) => {
            format!("Base: {} fixed to the ground (--base fixed).", roots.join(", "))
        }
        (_, _) => format!("Base: {} free: nothing in the file holds it.", roots.join(", ")),
    });
}

/// Adds a joint between the ground and a link.
fn hold(robot: &mut Robot, link: usize, kind: Kind, word: &str) {
    let Link { at, pose, name, .. } = &robot.links[link];
    let mut joint_name = if word == "base" { word.to_owned() } else { format!("{name} {word}") };
    while robot.joints.iter().any(|joint| joint.name == joint_name) {
        joint_name = format!("{name} {joint_name}");
    }
    let joint = Joint::new(&joint_name, *at, kind, [GROUND, link], pose.at);
    robot.joints.push(joint);
}
