//! Geoms: their mass, and their shapes for pictures.

use super::asset::{self, Fit, MeshGeom};
use super::defaults::View;
use super::model::Model;
use super::orientation::{from_to, pose};
use crate::inertia::Mass;
use crate::pose::Pose;
use crate::robot::Form;
use crate::solid::Solid;
use crate::source::Read;

/// Last of the groups of geoms that MuJoCo's viewer shows by default [-]; the other groups are for contact.
const SEEN_GROUPS: f64 = 2.0;

/// Kind of a geom by its mass: a solid, a mesh, or neither.
#[derive(Debug, Clone)]
pub(super) enum Geom {
    /// A solid with its mass, which is zero when the geom does not count.
    Solid(Mass),
    /// A mesh whose mass is added to that of its body.
    Mesh(MeshGeom),
    /// Neither a solid nor a mesh whose mass is added to that of its body.
    Nothing,
}

/// Reads a geom in the frame `scope`: returns its mass in global axes, and adds its shape.
pub(super) fn read(
    view: &View<'_>,
    link: usize,
    scope: &Pose,
    model: &mut Model<'_, '_, '_>,
) -> Read<Geom> {
    let kind = view.value("type").unwrap_or("sphere");
    for name in ["name", "class", "rgba", "shellinertia", "fitscale"] {
        view.own(name);
    }
    let group = view.number_or("group", 0.0)?;
    if view.number_or("contype", 1.0)? != 0.0 || view.number_or("conaffinity", 1.0)? != 0.0 {
        model.touching += 1;
    }
    let [first, last] = model.compiler.groups;
    let written = view.number("mass")?;
    let density = view.number_or("density", 1000.0)?;
    if written.unwrap_or(0.0) < 0.0 || density < 0.0 {
        return Err(view.element.fault("mass or density is below zero", "write zero or more"));
    }
    let counts = (first..=last).contains(&group) && written.unwrap_or(density) > 0.0;
    if view.attribute("mesh").is_some() || matches!(kind, "mesh" | "sdf") {
        view.attribute("size");
        let pose = scope.then(&pose(view, &model.compiler)?);
        let mesh = view.attribute("mesh").cloned();
        let scale = view.number_or("fitscale", 1.0)?;
        let is_shell = view.value("shellinertia") == Some("true");
        let fit = (!matches!(kind, "mesh" | "sdf")).then(|| Fit {
            kind: kind.to_owned(),
            scale,
            is_shell,
        });
        let geom = MeshGeom { at: view.element.at, mesh, fit, mass: written, density, pose };
        if kind == "mesh" && group <= SEEN_GROUPS {
            draw(&geom, view, link, model)?;
        }
        return Ok(if counts { Geom::Mesh(geom) } else { Geom::Nothing });
    }
    let (frame, half) = match view.attribute("fromto") {
        Some(ends) => {
            // The two ends replace all attributes of the pose.
            for name in ["pos", "quat", "euler", "axisangle", "xyaxes", "zaxis"] {
                view.own(name);
            }
            from_to(ends).map(|(frame, half)| (frame, Some(half)))?
        }
        None => (pose(view, &model.compiler)?, None),
    };
    let frame = scope.then(&frame);
    if matches!(kind, "plane" | "hfield") {
        view.attribute("size");
        return Ok(Geom::Nothing);
    }
    let solid = solid(view, kind, half)?;
    if let Some(form) = solid.form().filter(|_| group <= SEEN_GROUPS) {
        let colour = view.numbers("rgba")?;
        model.robot.shapes.push(Form { link, pose: frame, kind: form, colour });
    }
    if !counts {
        return Ok(Geom::Nothing);
    }
    let is_shell = view.value("shellinertia") == Some("true");
    Ok(Geom::Solid(solid.mass(is_shell, density, written).seen_from(&frame)))
}

/// Adds the shape of a mesh for pictures.
fn draw(geom: &MeshGeom, view: &View<'_>, link: usize, model: &mut Model<'_, '_, '_>) -> Read<()> {
    match asset::form(geom, model)? {
        Ok((pose, kind)) => {
            let colour = view.numbers("rgba")?;
            model.robot.shapes.push(Form { link, pose, kind, colour });
        }
        Err(says) => model.context.findings.not_drawn(geom.at, view.element.label(), says),
    }
    Ok(())
}

/// Reads the solid and its sizes. `half` is the half length, when two end points give it.
fn solid(view: &View<'_>, kind: &str, half: Option<f64>) -> Read<Solid> {
    let sizes = view.attribute("size").map(|size| size.list()).transpose()?.unwrap_or_default();
    let needed = match (kind, half) {
        ("sphere", _) => 1,
        ("capsule" | "cylinder", None) => 2,
        ("ellipsoid" | "box", None) => 3,
        ("capsule" | "cylinder" | "ellipsoid" | "box", Some(_)) => 1,
        _ => {
            return Err(view.element.fault(
                format!("unknown type of geom `{kind}`"),
                "types are plane, hfield, sphere, capsule, ellipsoid, cylinder, box, mesh and sdf",
            ));
        }
    };
    if sizes.len() < needed || sizes.iter().take(needed).any(|size| *size <= 0.0) {
        return Err(view.element.fault(
            format!("`size` of a {kind} has {needed} numbers above zero"),
            "write radius, or radius and half the length, or three half lengths",
        ));
    }
    let size = |i: usize| sizes[i];
    Ok(match (kind, half) {
        ("sphere", _) => Solid::Sphere(size(0)),
        ("capsule", half) => Solid::Capsule(size(0), half.unwrap_or_else(|| size(1))),
        ("cylinder", half) => Solid::Cylinder(size(0), half.unwrap_or_else(|| size(1))),
        (_, half) => {
            let half = half.map_or_else(|| [size(0), size(1), size(2)], |h| [size(0), size(0), h]);
            if kind == "box" { Solid::Box(half) } else { Solid::Ellipsoid(half) }
        }
    })
}
