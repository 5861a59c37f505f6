//! SDF: models in models, frames in frames, and loops by joints.

mod drake;
mod frames;
mod joint;
mod link;
mod pose;
mod relations;
mod table;

pub(crate) use table::TABLE;

use crate::context::{Context, Named};
use crate::element::Element;
use crate::options::Base;
use crate::pose::{Pose, V3, v3};
use crate::robot::{Frame, GROUND, Joint, Kind, Link, Robot};
use crate::source::{Fault, Read};
use frames::{Frames, MODEL, Node, WORLD};

/// Where names stand.
#[derive(Debug, Clone)]
struct Scope {
    /// What stands before full names: `outer::`, or nothing.
    prefix: String,
    version: [u32; 2],
    is_static: bool,
}

impl Scope {
    /// The full name of the frame of its model.
    fn model(&self) -> String {
        format!("{}{MODEL}", self.prefix)
    }
}

/// A model of the file with its scope.
type Model<'a> = (&'a Element, Scope);

/// Reads the root element `sdf`.
pub(crate) fn read(root: &Element, context: &mut Context<'_>) -> Read<Robot> {
    let version = version(root)?;
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
    let mut frames = Frames::default();
    let mut models: Vec<Model<'_>> = Vec::new();
    let mut names = Named::new("link", 1);
    for top in &tops {
        let is_alone = tops.len() == 1;
        let own = if is_alone { String::new() } else { format!("{}::", top.need("name")?.value) };
        top.attribute("name");
        let scope = Scope { prefix: own, version, is_static: false };
        collect(
            top,
            (scope, WORLD.to_owned()),
            (&mut models, &mut frames),
            (&mut robot, &mut names),
            context,
        )?;
    }
    links(&models, &frames, &mut robot, context)?;
    for (model, scope) in &models {
        for element in model.each("joint").filter(|element| !is_gearbox(element)) {
            joint::read(element, scope, &frames, &mut robot, context)?;
        }
    }
    for (model, scope) in &models {
        relations::read(model, scope, &frames, &mut robot, context)?;
        drake::read(model, scope, &frames, &mut robot)?;
    }
    base(&models, &mut robot, context);
    Ok(robot)
}

fn is_gearbox(element: &Element) -> bool {
    element
        .attributes
        .iter()
        .any(|attribute| attribute.name == "type" && attribute.value.trim() == "gearbox")
}

fn version(root: &Element) -> Read<[u32; 2]> {
    let attribute = root.need("version")?;
    let number = |text: Option<&str>| text.and_then(|text| text.trim().parse::<u32>().ok());
    let mut parts = attribute.value.split('.');
    match (number(parts.next()), number(parts.next())) {
        (Some(major), Some(minor)) => Ok([major, minor]),
        _ => Err(attribute
            .fault(format!("`{}` is no version", attribute.value), "write version=\"1.9\"")),
    }
}

/// The frames of a model and of those in it, and their links.
fn collect<'a>(
    model: &'a Element,
    (mut scope, outer): (Scope, String),
    (models, frames): (&mut Vec<Model<'a>>, &mut Frames),
    (robot, names): (&mut Robot, &mut Named),
    context: &mut Context<'_>,
) -> Read<()> {
    if let Some(flag) = model.child("static") {
        scope.is_static |= flag.content().flag()?;
    }
    let prefix = scope.prefix.clone();
    let (own, in_frame) = pose::pose(model)?;
    let outer_prefix = outer.strip_suffix(MODEL).unwrap_or("");
    let relative_to = in_frame.map_or(outer.clone(), |name| match name {
        WORLD => WORLD.to_owned(),
        _ => format!("{outer_prefix}{name}"),
    });
    let mut first_link = None;
    for element in model.each("link") {
        let name = format!("{prefix}{}", element.need("name")?.value);
        let number = names.add(&name, element.at, &context.sources)?;
        first_link.get_or_insert(name.clone());
        let (pose, in_frame) = pose::pose(element)?;
        let relative_to = format!("{prefix}{}", in_frame.unwrap_or(MODEL));
        let node =
            Node { at: element.at, relative_to, pose, attached_to: None, link: Some(number) };
        frames.add(name.clone(), node);
        // the scene's own name for what does not move
        let name = if name == "ground" { "ground-link".to_owned() } else { name };
        robot.links.push(Link { name, at: element.at, pose: Pose::identity(), mass: None });
    }
    for element in model.each("frame") {
        let name = format!("{prefix}{}", element.need("name")?.value);
        let (pose, in_frame) = pose::pose(element)?;
        let attached = format!(
            "{prefix}{}",
            element.value("attached_to").filter(|x| !x.is_empty()).unwrap_or(MODEL)
        );
        let relative_to = in_frame.map_or(attached.clone(), |name| format!("{prefix}{name}"));
        frames.add(
            name,
            Node { at: element.at, relative_to, pose, attached_to: Some(attached), link: None },
        );
    }
    for element in model.each("joint") {
        let name = format!("{prefix}{}", element.need("name")?.value);
        let (pose, in_frame) = pose::pose(element)?;
        let child = element
            .children
            .iter()
            .find(|child| child.name == "child")
            .map_or("", |child| child.text.trim());
        let child = if child == WORLD { child.to_owned() } else { format!("{prefix}{child}") };
        let relative_to = in_frame.map_or(child.clone(), |name| format!("{prefix}{name}"));
        frames.add(
            name,
            Node { at: element.at, relative_to, pose, attached_to: Some(child), link: None },
        );
    }
    let canonical = model
        .value("canonical_link")
        .filter(|name| !name.is_empty())
        .map(|name| format!("{prefix}{name}"));
    let placement = model.value("placement_frame").filter(|name| !name.is_empty());
    for inner in model.each("model") {
        let name = &inner.need("name")?.value;
        let inside = Scope { prefix: format!("{prefix}{name}::"), ..scope.clone() };
        first_link.get_or_insert(format!("{prefix}{name}::{MODEL}"));
        collect(inner, (inside, scope.model()), (models, frames), (robot, names), context)?;
    }
    let attached_to = canonical.or(first_link);
    let at = model.at;
    let mut node = Node { at, relative_to, pose: own, attached_to, link: None };
    if let Some(placement) = placement {
        // the pose is that of this frame: the model's follows from where the frame is in the model
        frames.add(
            scope.model(),
            Node { relative_to: WORLD.into(), pose: Pose::identity(), ..node.clone() },
        );
        let inner = frames.alone(&format!("{prefix}{placement}"), &scope.model(), at)?;
        node.pose = own.then(&inner.inverse());
    }
    frames.add(scope.model(), node);
    models.push((model, scope));
    Ok(())
}

/// Links where their frames are, with their inertia, their forms, and the frames that have names.
fn links(
    models: &[Model<'_>],
    frames: &Frames,
    robot: &mut Robot,
    context: &mut Context<'_>,
) -> Read<()> {
    for (model, scope) in models {
        for element in model.each("link") {
            let name = format!("{}{}", scope.prefix, element.need("name")?.value);
            let full = frames.full("", &name, element.at)?;
            let Some(number) = frames.link(&full)? else { continue };
            let pose = frames.place(&full)?;
            let path = element.label();
            let mass = link::mass(element, &path, context)?;
            let link = &mut robot.links[number];
            link.pose = pose;
            link.mass = mass.map(|mass| mass.seen_from(&pose));
            link::shapes(element, number, robot)?;
            acts(element, &path, context)?;
        }
        for element in model.each("frame") {
            let name = format!("{}{}", scope.prefix, element.need("name")?.value);
            let full = frames.full("", &name, element.at)?;
            let link = frames.link(&full)?.unwrap_or(GROUND);
            let pose = frames.place(&full)?;
            robot.frames.push(Frame { name, link, pose });
        }
    }
    Ok(())
}

/// What a link has that acts and is not in the scene.
fn acts(element: &Element, path: &str, context: &mut Context<'_>) -> Read<()> {
    if let Some(gravity) = element.child("gravity") {
        if !gravity.content().flag()? {
            let says = "the link has no gravity in the file; here it has";
            context.findings.ignored(gravity.at, format!("{path}/gravity"), says);
        }
    }
    Ok(())
}

/// What hangs on nothing moves freely; a static model is the ground's.
fn base(models: &[Model<'_>], robot: &mut Robot, context: &Context<'_>) {
    for (model, scope) in models.iter().filter(|(_, scope)| scope.is_static) {
        for element in model.each("link") {
            let name = element.value("name").map(|name| format!("{}{name}", scope.prefix));
            let link = robot.links.iter().position(|link| Some(&link.name) == name.as_ref());
            if let Some(link) = link {
                hold(robot, link, Kind::Fixed, "static");
            }
        }
    }
    for link in 1..robot.links.len() {
        // older files call a link so, and mean what does not move
        if robot.links[link].name.rsplit("::").next() == Some(WORLD) {
            hold(robot, link, Kind::Fixed, "ground");
        }
    }
    let kind = if context.options.base == Some(Base::Fixed) { Kind::Fixed } else { Kind::Free };
    let mut is_held = vec![false; robot.links.len()];
    is_held[GROUND] = true;
    spread(robot, &mut is_held);
    let mut roots = Vec::new();
    for link in 1..robot.links.len() {
        if !is_held[link] {
            hold(robot, link, kind, "base");
            roots.push(format!("`{}`", robot.links[link].name));
            is_held[link] = true;
            spread(robot, &mut is_held);
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

/// All that is joined to what is held is held.
fn spread(robot: &Robot, is_held: &mut [bool]) {
    let mut has_changed = true;
    while has_changed {
        has_changed = false;
        for joint in &robot.joints {
            if is_held[joint.parent] != is_held[joint.child] {
                is_held[joint.parent] = true;
                is_held[joint.child] = true;
                has_changed = true;
            }
        }
    }
}

/// A joint between the ground and a link.
fn hold(robot: &mut Robot, link: usize, kind: Kind, word: &str) {
    let Link { at, pose, name, .. } = &robot.links[link];
    let mut joint_name = if word == "base" { word.to_owned() } else { format!("{name} {word}") };
    while robot.joints.iter().any(|joint| joint.name == joint_name) {
        joint_name = format!("{name} {joint_name}");
    }
    let joint = Joint::new(&joint_name, *at, kind, [GROUND, link], pose.at);
    robot.joints.push(joint);
}

/// The three numbers in a child.
fn vector(element: &Element, name: &str) -> Read<V3> {
    let child = element.child(name).ok_or_else(|| missing(element, name))?;
    Ok(v3(child.content().numbers()?))
}

fn missing(element: &Element, name: &str) -> Fault {
    element
        .fault(format!("`{}` has no <{name}>", element.name), format!("write <{name}>...</{name}>"))
}
