//! Links: inertia, and what is drawn.

use super::pose::origin;
use crate::element::Element;
use crate::inertia::{Mass, tensor};
use crate::pose::V3;
use crate::robot::{self, Form, FormKind, Link, Robot};
use crate::source::Read;
use std::collections::HashMap;

/// Colours of the robot's materials.
pub(super) type Colours = HashMap<String, [f64; 4]>;

/// A link in its own frame.
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

/// The colours of materials that stand beside the links.
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

/// The forms of `visual` that are drawn; meshes are not.
pub(super) fn shapes(
    element: &Element,
    link: usize,
    colours: &Colours,
    robot: &mut Robot,
) -> Read<()> {
    for visual in element.each("visual") {
        let Some(kind) = visual.child("geometry").map(form).transpose()?.flatten() else {
            continue;
        };
        let pose = robot.links[link].pose.then(&origin(visual)?);
        visual.attribute("name");
        let material = visual.child("material");
        let own = material.map(colour).transpose()?.flatten();
        let named = material.and_then(|material| colours.get(material.value("name")?).copied());
        robot.shapes.push(Form { link, pose, kind, colour: own.or(named) });
    }
    Ok(())
}

fn form(geometry: &Element) -> Read<Option<FormKind>> {
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
