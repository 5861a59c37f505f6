//! Meshes of the file, and the masses of geoms that are meshes.

use super::defaults::{MAIN, View};
use super::fitted::{Fitted, fitted};
use super::model::Model;
use super::surface;
use crate::element::{Attribute, Element};
use crate::inertia::Mass;
use crate::mesh::Surface;
use crate::pose::{M3, Pose, V3, quaternion, v3};
use crate::robot::{FormKind, is_even};
use crate::source::{Fault, Origin, Read};
use crate::visual::mesh_file;
use mbs_scene::{TriangleMesh, VolumeRule, hull, nearest_name};
use std::path::{Path, PathBuf};

/// A geom that is a mesh with mass.
#[derive(Debug, Clone)]
pub(super) struct MeshGeom {
    pub(super) at: Origin,
    /// The name of the mesh.
    pub(super) mesh: Option<Attribute>,
    /// Shape that is fitted to the mesh, if the geom requests one.
    pub(super) fit: Option<Fit>,
    pub(super) mass: Option<f64>,
    pub(super) density: f64,
    /// Pose of the geom in global axes.
    pub(super) pose: Pose,
}

/// A request for a shape that is fitted to a mesh.
#[derive(Debug, Clone)]
pub(super) struct Fit {
    pub(super) kind: String,
    /// Factor of the sizes of the fitted shape [-].
    pub(super) scale: f64,
    pub(super) is_shell: bool,
}

/// Hint when the mass of a mesh cannot be computed.
const HINT: &str = "write an <inertial> in its body, or mass=\"0\" here, or let --massless-meshes count it as massless";

/// Attributes of meshes that affect a mass. They count as read even when no mass is computed from them.
const ATTRIBUTES: [&str; 11] = [
    "name",
    "file",
    "vertex",
    "face",
    "scale",
    "inertia",
    "refpos",
    "refquat",
    "maxhullvert",
    "builtin",
    "params",
];

/// Lists the meshes of a model. A mesh file is opened only when its mass is needed.
pub(super) fn collect<'a>(root: &'a Element, model: &mut Model<'a, '_, '_>) -> Read<()> {
    for asset in root.each("asset") {
        for element in asset.each("mesh") {
            let view = model.classes.view(element, MAIN)?;
            for name in ATTRIBUTES {
                view.own(name);
            }
            let stem = |file: &str| Some(Path::new(file.trim()).file_stem()?.to_str()?.to_owned());
            let name = view.own("name").map(|name| name.value.clone());
            if let Some(name) = name.or_else(|| stem(view.value("file")?)) {
                model.meshes.insert(name, element);
            }
        }
    }
    Ok(())
}

/// The mass of a geom that is a mesh, in global axes.
pub(super) fn mass(geom: &MeshGeom, model: &mut Model<'_, '_, '_>) -> Read<Mass> {
    let refused = |why: &str| {
        Fault::new(geom.at, format!("the mass of this geom follows from a mesh: {why}"), HINT)
    };
    let Some(name) = &geom.mesh else { return Err(refused("it has no `mesh`")) };
    let Some(element) = model.meshes.get(&name.value) else {
        let known: Vec<_> = model.meshes.keys().collect();
        let hint = nearest_name(&name.value, &known, "meshes");
        return Err(name.fault(format!("unknown mesh `{}`", name.value), hint));
    };
    let classes = model.classes;
    let view = classes.view(element, MAIN)?;
    let (mesh, count, whole) = whole(&view, model)?.map_err(|why| refused(&why))?;
    if let (VolumeRule::Signed, Some(opening)) = (count, Surface(&mesh).opening()) {
        let says = format!("{opening}: its volume is that of tetrahedra from its centre");
        model.context.findings.approximated(geom.at, "geom", says);
    }
    let Some(fit) = &geom.fit else {
        let mass = geom.mass.unwrap_or(geom.density * whole.mass);
        let own = Mass { mass, tensor: whole.tensor * (mass / whole.mass), ..whole };
        return Ok(own.seen_from(&geom.pose));
    };
    let Fitted { solid, frame, is_chosen } =
        fitted(&fit.kind, &mesh, &whole, &model.compiler).map_err(|why| refused(&why))?;
    if is_chosen {
        let says = "principal moments of its mesh are alike: the axes of the form are a choice";
        model.context.findings.approximated(geom.at, "geom", says);
    }
    let own = solid.scaled(fit.scale).mass(fit.is_shell, geom.density, geom.mass);
    Ok(own.seen_from(&geom.pose.then(&frame)))
}

/// Triangles of a mesh in the frame of a geom, the rule for their volume, and their mass at a density of one.
type Whole = (TriangleMesh, VolumeRule, Mass);

/// Reads a mesh and computes its mass. The inner error is the reason why it has no mass.
fn whole(view: &View<'_>, model: &Model<'_, '_, '_>) -> Read<Result<Whole, String>> {
    let is_exact = model.compiler.is_mesh_exact;
    let word = view.value("inertia").unwrap_or(if is_exact { "exact" } else { "legacy" });
    let count = match word {
        "exact" | "convex" => VolumeRule::Signed,
        "legacy" => VolumeRule::Unsigned,
        "shell" => VolumeRule::Shell,
        other => return Ok(Err(format!("the inertia `{other}` of meshes is not computed"))),
    };
    let mesh = surface::read(view, model)?;
    let mesh = if mesh.triangles.is_empty() || word == "convex" {
        // A limit that no hull reaches is no limit.
        let most = view.number_or("maxhullvert", -1.0)?;
        let Some(hull) = hull(&mesh.vertices) else {
            return Ok(Err("its vertices are in one plane, and have no hull".to_owned()));
        };
        if most >= 0.0 && hull.vertices.len() as f64 > most {
            return Ok(Err("a hull with the vertices of `maxhullvert` is not computed".to_owned()));
        }
        hull
    } else {
        mesh
    };
    let mesh = placed(view, mesh)?;
    let mass = Surface(&mesh).enclosed(1.0, count);
    Ok(mass.map(|mass| (mesh, count, mass)))
}

/// Pose and shape for the picture of a geom that is a mesh. The inner error is the reason why it is not drawn.
pub(super) fn form(
    geom: &MeshGeom,
    model: &Model<'_, '_, '_>,
) -> Read<Result<(Pose, FormKind), String>> {
    let element = geom.mesh.as_ref().and_then(|name| model.meshes.get(&name.value));
    let Some(element) = element else { return Ok(Err("unknown meshes are not drawn".to_owned())) };
    let view = model.classes.view(element, MAIN)?;
    let Some(file) = view.attribute("file") else {
        return Ok(Err("meshes that the file itself writes are not drawn".to_owned()));
    };
    let (place, own) = surface::places_of(file, model);
    let drawn = |place: PathBuf| mesh_file(&place.display().to_string(), model.context);
    let file = match drawn(place).or_else(|says| own.map_or(Err(says), drawn)) {
        Ok(file) => file,
        Err(says) => return Ok(Err(says)),
    };
    let Reference { from, turn, scale } = reference(&view)?;
    if !is_even(scale) && turn != M3::identity() {
        return Ok(Err("meshes that are turned and stretched are not drawn".to_owned()));
    }
    // The pose follows from S Rᵗ (x − p), where S and Rᵗ commute.
    let turn = turn.transpose();
    let own = Pose::new(turn, -(turn * from).component_mul(&v3(scale)));
    Ok(Ok((geom.pose.then(&own), FormKind::Mesh { file, scale })))
}

/// Transformation of the vertices of a mesh file to the frame of a geom.
struct Reference {
    from: V3,
    turn: M3,
    scale: [f64; 3],
}

fn reference(view: &View<'_>) -> Read<Reference> {
    let from = v3(view.numbers_or("refpos", [0.0; 3])?);
    let turn = quaternion(view.numbers_or("refquat", [1.0, 0.0, 0.0, 0.0])?);
    let turn: M3 = turn.ok_or_else(|| {
        view.element.fault("a quaternion of length zero", "write refquat=\"1 0 0 0\"")
    })?;
    Ok(Reference { from, turn, scale: view.numbers_or("scale", [1.0; 3])? })
}

/// Transforms the vertices of a mesh to the frame of a geom.
fn placed(view: &View<'_>, mut mesh: TriangleMesh) -> Read<TriangleMesh> {
    let Reference { from, turn, scale } = reference(view)?;
    for vertex in &mut mesh.vertices {
        *vertex = (turn.transpose() * (v3(*vertex) - from)).component_mul(&v3(scale)).into();
    }
    if scale.iter().product::<f64>() < 0.0 {
        mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    }
    Ok(mesh)
}
