//! URDF: a tree of links, from one root.

mod control;
mod drake;
mod joint;
mod link;
mod pose;
mod table;

pub(crate) use table::TABLE;

use crate::context::{Context, Named};
use crate::element::Element;
use crate::options::BaseKind;
use crate::pose::Pose;
use crate::robot::{GROUND, Joint, Kind, Robot};
use crate::source::{Fault, Read};

/// Reads the root element `robot`.
pub(crate) fn read(root: &Element, context: &mut Context<'_>) -> Read<Robot> {
    let name = root.value("name").unwrap_or("robot");
    let mut robot = Robot::new(name, root.at.source);
    // the format has none
    robot.gravity = [0.0, 0.0, -9.81];
    let mut links = Named::new("link", 1);
    let colours = link::colours(root)?;
    for element in root.each("link") {
        links.add(&element.need("name")?.value, element.at, &context.sources)?;
        robot.links.push(link::read(element)?);
    }
    let mut joints = Named::new("joint", 0);
    let mut origins = Vec::new();
    for element in root.each("joint") {
        let (joint, origin) = joint::read(element, &links, context)?;
        joints.add(&joint.name, element.at, &context.sources)?;
        robot.joints.push(joint);
        origins.push(origin);
    }
    let trunk = root_link(&robot, root)?;
    place(&mut robot, trunk, &origins)?;
    for (link, element) in root.each("link").enumerate() {
        link::shapes(element, link + 1, &colours, (&mut robot, context))?;
    }
    for (number, element) in root.each("joint").enumerate() {
        joint::laws(element, number, &joints, &mut robot, context)?;
    }
    joint::check_mimics(&robot)?;
    drake::loops(root, &links, &mut robot)?;
    control::inputs(root, &joints, &mut robot, context)?;
    base(&mut robot, trunk, context)?;
    Ok(robot)
}

/// The one link that is no child.
fn root_link(robot: &Robot, root: &Element) -> Read<usize> {
    let mut parent = vec![None; robot.links.len()];
    for (number, joint) in robot.joints.iter().enumerate() {
        if let Some(first) = parent[joint.child].replace(number) {
            let link = &robot.links[joint.child].name;
            let first: &Joint = &robot.joints[first];
            return Err(Fault::new(
                joint.at,
                format!("link `{link}` is the child of a second joint"),
                format!(
                    "the first one is `{}`: a URDF is a tree; write a loop as MJCF or SDF",
                    first.name
                ),
            ));
        }
    }
    let roots: Vec<_> = (1..parent.len()).filter(|link| parent[*link].is_none()).collect();
    match roots[..] {
        [trunk] if robot.links.len() > 1 => {
            // with one root, what does not hang on it is a circle
            reached(robot, trunk, &parent)?;
            Ok(trunk)
        }
        [] if robot.links.len() < 2 => {
            Err(root.fault("the robot has no link", "write a <link name=\"...\"/>"))
        }
        [] => Err(circle(robot, 1, &parent)),
        [first, second, ..] => {
            let [first, second] = [first, second].map(|link| &robot.links[link]);
            Err(Fault::new(
                second.at,
                format!("two links have no parent: `{}` and `{}`", first.name, second.name),
                "join them by a joint: a URDF is one tree",
            ))
        }
        _ => unreachable!("one root is a tree"),
    }
}

fn reached(robot: &Robot, trunk: usize, parent: &[Option<usize>]) -> Read<()> {
    // the walk that reached each link; the root is reached before all
    let mut by = vec![0; robot.links.len()];
    by[trunk] = usize::MAX;
    for link in 1..robot.links.len() {
        let mut at = link;
        while by[at] == 0 {
            by[at] = link;
            at = parent[at].map_or(at, |joint| robot.joints[joint].parent);
        }
        if by[at] == link {
            return Err(circle(robot, link, parent));
        }
    }
    Ok(())
}

/// The links of a circle that is met from a link on.
fn circle(robot: &Robot, from: usize, parent: &[Option<usize>]) -> Fault {
    let up = |link: usize| parent[link].map_or(link, |joint| robot.joints[joint].parent);
    let mut at = from;
    for _ in 0..robot.links.len() {
        at = up(at);
    }
    let (start, mut names) = (at, Vec::new());
    loop {
        names.push(format!("`{}`", robot.links[at].name));
        at = up(at);
        if at == start {
            break;
        }
    }
    names.reverse();
    let joint = parent[start].map_or(robot.links[start].at, |joint| robot.joints[joint].at);
    Fault::new(
        joint,
        format!("links are each other's parents in a circle: {}", names.join(", ")),
        "a URDF is a tree: give one of these joints another parent",
    )
}

/// Takes all from the frames of the file to global axes: the root link's frame is the origin, all joints are at zero.
fn place(robot: &mut Robot, trunk: usize, origins: &[Pose]) -> Read<()> {
    let mut of_parent = vec![Vec::new(); robot.links.len()];
    for (number, joint) in robot.joints.iter().enumerate() {
        of_parent[joint.parent].push(number);
    }
    let mut open = vec![trunk];
    while let Some(link) = open.pop() {
        let pose = robot.links[link].pose;
        for number in &of_parent[link] {
            let joint = &mut robot.joints[*number];
            let here = pose.then(&origins[*number]);
            joint.place = here.at;
            for axis in &mut joint.axes {
                *axis = here.turn * *axis;
            }
            robot.links[joint.child].pose = here;
            open.push(joint.child);
        }
        let link = &mut robot.links[link];
        link.mass = link.mass.map(|mass| mass.seen_from(&pose));
    }
    Ok(())
}

/// What holds the root: the ground, or nothing.
fn base(robot: &mut Robot, trunk: usize, context: &mut Context<'_>) -> Read<()> {
    let link = &robot.links[trunk];
    let (at, place) = (link.at, link.pose.at);
    let is_ground = link.name == "world";
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

/// A name that no joint has.
fn unused(name: &str, robot: &Robot) -> String {
    let mut name = name.to_owned();
    while robot.joints.iter().any(|joint| joint.name == name) {
        name.push('~');
    }
    name
}
