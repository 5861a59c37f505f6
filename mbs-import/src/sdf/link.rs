//! Links: inertia, and shapes for pictures.

use super::pose::pose;
use super::scope::number;
use super::weight::{self, Place};
use crate::context::Context;
use crate::element::{Attribute, Element};
use crate::inertia::{Mass, tensor};
use crate::pose::V3;
use crate::robot::{self, Form, FormKind, Robot};
use crate::source::Read;
use crate::visual::mesh_form;

/// The inertia of a link, in the axes of the link.
pub(super) fn mass(
    element: &Element,
    place: &Place<'_>,
    context: &mut Context<'_>,
) -> Read<Option<Mass>> {
    let Some(inertial) = element.child("inertial") else {
        let says = "no <inertial>: the format's 1 kg with moments of 1 kg m^2";
        context.findings.noted(element.at, element.label(), says);
        return Ok(Some(Mass {
            mass: 1.0,
            center: V3::zeros(),
            tensor: tensor([1.0, 1.0, 1.0, 0.0, 0.0, 0.0]),
        }));
    };
    if inertial.attribute("auto").map_or(Ok(false), Attribute::flag)? {
        return weight::mass(element, inertial, place, context).map(Some);
    }
    let (at, _) = pose(inertial)?;
    let mass = number(inertial, "mass", 1.0)?;
    if mass < 0.0 {
        return Err(inertial.fault("the mass is below zero", "write a mass of zero or more, in kg"));
    }
    let mut six = [1.0, 1.0, 1.0, 0.0, 0.0, 0.0];
    if let Some(inertia) = inertial.child("inertia") {
        for (x, name) in six.iter_mut().zip(["ixx", "iyy", "izz", "ixy", "iyz", "ixz"]) {
            *x = number(inertia, name, *x)?;
        }
    }
    let local = Mass { mass, center: V3::zeros(), tensor: tensor(six) };
    Ok(Some(local.seen_from(&at)))
}

/// Adds the shapes of `visual` elements.
pub(super) fn shapes(
    element: &Element,
    (link, place): (usize, &Place<'_>),
    robot: &mut Robot,
    context: &mut Context<'_>,
) -> Read<()> {
    for visual in element.each("visual") {
        let Some(geometry) = visual.child("geometry") else { continue };
        visual.attribute("name");
        let kind = match geometry.child("mesh").map(|mesh| surface(mesh, context)) {
            None => form(geometry)?,
            Some(Ok(kind)) => kind,
            Some(Err(says)) => {
                visual.read_whole();
                context.findings.not_drawn(visual.at, "visual", says);
                None
            }
        };
        let Some(kind) = kind else { continue };
        let pose = robot.links[link].pose.then(&place.pose(visual)?);
        let colour = visual.child("material").and_then(colour);
        robot.shapes.push(Form { link, pose, kind, colour });
    }
    Ok(())
}

/// The shape of a mesh. The error is the reason why it is not drawn.
fn surface(mesh: &Element, context: &Context<'_>) -> Result<Option<FormKind>, String> {
    if mesh.child("submesh").is_some() {
        return Err("parts of meshes are not drawn".to_owned());
    }
    let [uri, scale] = ["uri", "scale"].map(|name| mesh.child(name).map(Element::content));
    mesh_form(uri.as_ref(), scale.as_ref(), context)
}

fn colour(material: &Element) -> Option<[f64; 4]> {
    let words = ["diffuse", "ambient"].into_iter().find_map(|word| material.child(word))?;
    robot::colour(&words.content().list().ok()?)
}

fn form(geometry: &Element) -> Read<Option<FormKind>> {
    if let Some(size) = geometry.child("box").and_then(|form| form.child("size")) {
        let size = size.content().numbers::<3>()?;
        return Ok(FormKind::Box(size).of_size());
    }
    if let Some(form) = geometry.child("sphere") {
        let radius = number(form, "radius", 1.0)?;
        return Ok(FormKind::Sphere { radius }.of_size());
    }
    for name in ["cylinder", "capsule"] {
        if let Some(form) = geometry.child(name) {
            let (radius, length) = (number(form, "radius", 1.0)?, number(form, "length", 1.0)?);
            let kind = match name {
                "cylinder" => FormKind::Cylinder { radius, length },
                _ => FormKind::Capsule { radius, length },
            };
            return Ok(kind.of_size());
        }
    }
    Ok(None)
}
