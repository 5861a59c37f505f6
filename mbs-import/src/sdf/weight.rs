//! Masses computed from collision shapes: `inertial auto="true"`.

use super::frames::Frames;
use super::pose::pose;
use super::scope::{Scope, number};
use crate::beside::{first, home, places};
use crate::context::Context;
use crate::element::Element;
use crate::inertia::Mass;
use crate::mesh::Surface;
use crate::pose::{Pose, V3, v3};
use crate::solid::Solid;
use crate::source::Read;
use mbs_scene::{TriangleMesh, VolumeRule};

/// Default density [kg/m³]: that of water, as in the format.
const DENSITY: f64 = 1000.0;
/// Hint when the mass cannot be computed.
const HINT: &str = "write <mass> and <inertia> with numbers, and leave out auto=\"true\"";

/// Link whose parts are read: its full name, and the scope of names in it.
pub(super) struct Place<'a> {
    pub(super) name: &'a str,
    pub(super) scope: &'a Scope,
    pub(super) frames: &'a Frames,
}

impl Place<'_> {
    /// The pose of a part of the link, relative to the link.
    pub(super) fn pose(&self, part: &Element) -> Read<Pose> {
        let (own, in_frame) = pose(part)?;
        let Some(name) = in_frame else { return Ok(own) };
        let frame = self.frames.full(&self.scope.prefix, name, part.at)?;
        let link = self.frames.place(self.name)?.inverse();
        Ok(link.then(&self.frames.place(&frame)?).then(&own))
    }
}

/// The mass of a link from its collision shapes, in the axes of the link.
pub(super) fn mass(
    link: &Element,
    inertial: &Element,
    place: &Place<'_>,
    context: &mut Context<'_>,
) -> Read<Mass> {
    for name in ["pose", "inertia"] {
        if let Some(child) = inertial.child(name) {
            child.read_whole();
            let says = "auto=\"true\": what follows from forms of collision holds";
            context.findings.ignored(child.at, format!("{}/inertial/{name}", link.label()), says);
        }
    }
    let density = number(inertial, "density", DENSITY)?;
    let mut sum = Mass::none();
    let mut is_empty = true;
    // The scene still has no contact, so the collision itself does not count as read.
    for collision in link.children.iter().filter(|child| child.name == "collision") {
        let density = number(collision, "density", density)?;
        if density < 0.0 {
            return Err(
                collision.fault("the density is below zero", "write zero or more, in kg/m^3")
            );
        }
        let own = form(collision, density, context)?;
        sum = sum.with(&own.seen_from(&place.pose(collision)?));
        is_empty = false;
    }
    if is_empty {
        return Err(inertial.fault("auto=\"true\", and the link has no <collision>", HINT));
    }
    let Some(written) = inertial.child("mass") else { return Ok(sum) };
    let mass = written.content().number()?;
    if mass < 0.0 {
        return Err(written.fault("the mass is below zero", "write a mass of zero or more, in kg"));
    }
    if mass == 0.0 {
        return Ok(Mass::none());
    }
    if sum.mass == 0.0 {
        return Err(written.fault("the forms of collision have no mass that could be scaled", HINT));
    }
    Ok(Mass { mass, tensor: sum.tensor * (mass / sum.mass), ..sum })
}

/// The mass of a collision shape at a density, in the frame of the shape.
fn form(collision: &Element, density: f64, context: &Context<'_>) -> Read<Mass> {
    let refused = |what: &str| {
        collision.fault(format!("a mass follows from this collision, and {what}"), HINT)
    };
    let geometry = collision.child("geometry").ok_or_else(|| refused("it has no <geometry>"))?;
    let Some(form) = geometry.children.first() else {
        return Err(refused("its <geometry> has no form"));
    };
    let half = |name: &str| number(form, name, 1.0).map(|x| x / 2.0);
    let solid = match form.name.as_str() {
        "box" => Solid::Box(three(form, "size", [1.0; 3])?.map(|x| x / 2.0)),
        "sphere" => Solid::Sphere(number(form, "radius", 1.0)?),
        "cylinder" => Solid::Cylinder(number(form, "radius", 1.0)?, half("length")?),
        "capsule" => Solid::Capsule(number(form, "radius", 1.0)?, half("length")?),
        "cone" => Solid::Cone(number(form, "radius", 1.0)?, half("length")?),
        "ellipsoid" => Solid::Ellipsoid(three(form, "radii", [1.0; 3])?),
        "mesh" => return mesh(form, density, context),
        other => return Err(refused(&format!("a `{other}` has none"))),
    };
    if !(solid.volume() > 0.0) {
        return Err(form.fault(format!("a `{}` without volume", form.name), "write its sizes"));
    }
    Ok(solid.mass(false, density, None))
}

/// The three numbers in a child element, or `default` when there is no such child.
fn three(element: &Element, name: &str, default: [f64; 3]) -> Read<[f64; 3]> {
    element.child(name).map_or(Ok(default), |child| child.content().numbers())
}

/// The mass of the volume within a triangle mesh.
fn mesh(form: &Element, density: f64, context: &Context<'_>) -> Read<Mass> {
    if form.child("submesh").is_some() {
        return Err(form.fault("masses of parts of meshes are not computed", HINT));
    }
    let missing = || form.fault("the mesh has no <uri>", "write the place of its file");
    let uri = form.child("uri").ok_or_else(missing)?.content();
    let all = places(&uri.value, home(&uri, HINT, context)?, context.options)
        .map_err(|scheme| uri.fault(format!("meshes are not fetched by `{scheme}://`"), HINT))?;
    let path = first(&uri, all, context)?
        .ok_or_else(|| uri.fault(format!("there is no mesh `{}`", uri.value), HINT))?;
    let mut surface = TriangleMesh::read(&path)
        .map_err(|why| uri.fault(format!("`{}`: {why}", uri.value), "give a mesh as STL or OBJ"))?;
    let scale: V3 = v3(three(form, "scale", [1.0; 3])?);
    for vertex in &mut surface.vertices {
        *vertex = v3(*vertex).component_mul(&scale).into();
    }
    if scale.iter().product::<f64>() < 0.0 {
        surface.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    }
    let surface = Surface(&surface);
    let mass = surface.opening().map_or_else(|| surface.enclosed(density, VolumeRule::Signed), Err);
    mass.map_err(|why| form.fault(format!("a mass follows from this mesh: {why}"), HINT))
}
