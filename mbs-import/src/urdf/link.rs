//! Links: inertia, and shapes for pictures.

use super::pose::origin;
use crate::context::Context;
use crate::element::Element;
use crate::inertia::{Mass, tensor};
use crate::pose::V3;
use crate::robot::{self, Form, FormKind, Link, Robot};
use crate::source::Read;
use crate::visual::mesh_form;
use std::collections::HashMap;

/// Colours of the robot's materials, by material name.
pub(super) type Colours = HashMap<String, [f64; 4]>;

/// Reads a link, in its own frame.
pub(super) fn read(element: &Element) -> Read<Link> {
    let name = &element.need("name")?.value;
    let mass = element.child("inertial").map(inertial).transpose()?;
    Ok(Link { mass, ..Link::new(name, element.at) })
}

fn inertial(element: &Element) -> Read<Mass> {
    let pose = origin(element)?;
    let mass = match element.child("mass") {
        Some(mass) => {
            let value = mass.need("value")?;
            let x = value.number()?;
            if x < 0.0 {
                return Err(
                    value.fault("the mass is below zero", "write a mass of zero or more, in kg")
                );
            }
            x
        }
        None => 0.0,
    };
    let six = match element.child("inertia") {
        Some(inertia) => {
            let mut six = [0.0; 6];
            for (x, name) in six.iter_mut().zip(["ixx", "iyy", "izz", "ixy", "iyz", "ixz"]) {
                *x = inertia.number_or(name, 0.0)?;
            }
            six
        }
        None => [0.0; 6],
    };
    let local = Mass { mass, center: V3::zeros(), tensor: tensor(six) };
    Ok(local.seen_from(&pose))
}

/// The colours of the materials that are defined at the robot, outside of links.
pub(super) fn colours(root: &Element) -> Read<Colours> {
    let mut colours = Colours::new();
    for material in root.each("material") {
        if let (Some(name), Some(colour)) = (material.value("name"), colour(material)?) {
            colours.insert(name.to_owned(), colour);
        }
    }
    Ok(colours)
}

fn colour(material: &Element) -> Read<Option<[f64; 4]>> {
    let Some(rgba) = material.child("color").and_then(|color| color.attribute("rgba")) else {
        return Ok(None);
    };
    Ok(robot::colour(&rgba.list()?))
}

/// Adds the shapes of `visual` elements; if none of them can be drawn, the shapes of `collision` elements.
pub(super) fn shapes(
    element: &Element,
    link: usize,
    colours: &Colours,
    (robot, context): (&mut Robot, &mut Context<'_>),
) -> Read<()> {
    let (first, mut lost) = (robot.shapes.len(), Vec::new());
    let frame = robot.links[link].pose;
    let draw = |visual: &Element, colour, robot: &mut Robot| -> Read<Option<String>> {
        match visual.child("geometry").map(|g| form(g, context)).transpose()?.flatten() {
            Some(Ok(kind)) => {
                let pose = frame.then(&origin(visual)?);
                robot.shapes.push(Form { link, pose, kind, colour });
            }
            Some(Err(says)) => return Ok(Some(says)),
            None => {}
        }
        Ok(None)
    };
    for visual in element.each("visual") {
        visual.attribute("name");
        let material = visual.child("material");
        let own = material.map(colour).transpose()?.flatten();
        let named = material.and_then(|material| colours.get(material.value("name")?).copied());
        let says = draw(visual, own.or(named), robot)?;
        if let Some(says) = says {
            visual.read_whole();
            lost.push((visual.at, says));
        }
    }
    if robot.shapes.len() == first && !lost.is_empty() {
        // The scene still has no contact, so the collision itself does not count as read.
        let collisions = element.children.iter().filter(|child| child.name == "collision");
        let mut why = None;
        for collision in collisions {
            // An invalid collision shape is no reason to refuse the model.
            why = why.or(draw(collision, None, robot).ok().flatten());
        }
        let stands_in = match why {
            _ if robot.shapes.len() > first => "; forms of contact stand in".to_owned(),
            Some(why) if lost.iter().all(|(_, says)| *says != why) => {
                format!("; of contact, {why}")
            }
            _ => String::new(),
        };
        lost.iter_mut().for_each(|(_, says)| says.push_str(&stands_in));
    }
    for (at, says) in lost {
        context.findings.not_drawn(at, "visual", says);
    }
    Ok(())
}

/// The shape of a geometry. The inner error is the reason why it is not drawn; `None` when there is no shape.
fn form(geometry: &Element, context: &Context<'_>) -> Read<Option<Result<FormKind, String>>> {
    if let Some(mesh) = geometry.child("mesh") {
        let form = mesh_form(mesh.attribute("filename"), mesh.attribute("scale"), context);
        return Ok(form.transpose());
    }
    Ok(solid(geometry)?.map(Ok))
}

fn solid(geometry: &Element) -> Read<Option<FormKind>> {
    if let Some(element) = geometry.child("box") {
        let size = element.need("size")?.numbers::<3>()?;
        return Ok(FormKind::Box(size).of_size());
    }
    if let Some(element) = geometry.child("sphere") {
        let radius = element.need("radius")?.number()?;
        return Ok(FormKind::Sphere { radius }.of_size());
    }
    for name in ["cylinder", "capsule"] {
        if let Some(element) = geometry.child(name) {
            let [radius, length] =
                [element.need("radius")?.number()?, element.need("length")?.number()?];
            let kind = match name {
                "cylinder" => FormKind::Cylinder { radius, length },
                _ => FormKind::Capsule { radius, length },
            };
            return Ok(kind.of_size());
        }
    }
    Ok(None)
}
