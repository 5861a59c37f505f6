//! Meshes, and the mass of geoms that are meshes.

use super::defaults::{MAIN, View};
use super::model::Model;
use crate::beside;
use crate::element::{Attribute, Element};
use crate::inertia::Mass;
use crate::mesh::{self, Count, Mesh};
use crate::pose::{M3, Pose, quaternion, v3};
use crate::source::{Fault, MOST_BYTES, Origin, Read};
use mbs_scene::nearest_name;
use std::path::Path;

/// A geom that is a mesh, and whose mass counts.
#[derive(Debug, Clone)]
pub(super) struct MeshGeom {
    pub(super) at: Origin,
    /// The name of the mesh.
    pub(super) mesh: Option<Attribute>,
    /// A form that is fitted to the mesh, where it is one.
    pub(super) is_fitted: bool,
    pub(super) mass: Option<f64>,
    pub(super) density: f64,
    /// Global.
    pub(super) pose: Pose,
}

/// Finds the meshes of a model; none is opened before its mass is asked for.
pub(super) fn collect<'a>(root: &'a Element, model: &mut Model<'a, '_, '_>) -> Read<()> {
    for asset in root.each("asset") {
        for element in asset.each("mesh") {
            let view = model.classes.view(element, MAIN)?;
            let stem = |file: &str| Some(Path::new(file.trim()).file_stem()?.to_str()?.to_owned());
            let name = view.own("name").map(|name| name.value.clone());
            if let Some(name) = name.or_else(|| stem(view.value("file")?)) {
                model.meshes.insert(name, element);
            }
        }
    }
    Ok(())
}

/// The mass of a geom, global.
pub(super) fn mass(geom: &MeshGeom, model: &Model<'_, '_, '_>) -> Read<Mass> {
    let refused = |why: &str| {
        let hint = "write an <inertial> in its body, or mass=\"0\" here, or let --massless-meshes count it as massless";
        Fault::new(geom.at, format!("the mass of this geom follows from a mesh: {why}"), hint)
    };
    if geom.is_fitted {
        return Err(refused("forms that are fitted to meshes are not computed"));
    }
    let Some(name) = &geom.mesh else { return Err(refused("it has no `mesh`")) };
    let Some(element) = model.meshes.get(&name.value) else {
        let known: Vec<_> = model.meshes.keys().collect();
        let hint = nearest_name(&name.value, &known, "meshes");
        return Err(name.fault(format!("unknown mesh `{}`", name.value), hint));
    };
    let view = model.classes.view(element, MAIN)?;
    let is_exact = model.compiler.is_mesh_exact;
    let count = match view.value("inertia").unwrap_or(if is_exact { "exact" } else { "legacy" }) {
        "exact" => Count::Signed,
        "legacy" => Count::Unsigned,
        other => return Err(refused(&format!("the inertia `{other}` of meshes is not computed"))),
    };
    let mesh = placed(&view, surface(&view, model)?)?;
    if mesh.triangles.is_empty() {
        return Err(refused("it has no triangles; the hull of its vertices is not computed"));
    }
    if let (Count::Signed, Some([a, b])) = (count, mesh.open_edge()) {
        let [a, b] = [a, b]
            .map(|i| mesh.vertices[i].iter().map(f64::to_string).collect::<Vec<_>>().join(" "));
        return Err(refused(&format!("its surface is open at the edge from {a} to {b}")));
    }
    let whole = mesh.mass(geom.density, count);
    if whole.mass <= 0.0 {
        return Err(refused("its surface encloses nothing, or is turned inside out"));
    }
    let mass = geom.mass.unwrap_or(whole.mass);
    let own = Mass { mass, tensor: whole.tensor * (mass / whole.mass), ..whole };
    Ok(own.seen_from(&geom.pose))
}

/// The triangles as they are written.
fn surface(view: &View<'_>, model: &Model<'_, '_, '_>) -> Read<Mesh> {
    if let Some(vertex) = view.attribute("vertex") {
        let numbers = vertex.list()?;
        let face = view.attribute("face").map(Attribute::list).transpose()?.unwrap_or_default();
        let vertices = numbers.chunks_exact(3).map(|x| v3([x[0], x[1], x[2]])).collect::<Vec<_>>();
        let is_index = |x: &f64| x.fract() == 0.0 && (0.0..vertices.len() as f64).contains(x);
        if numbers.len() % 3 != 0 || face.len() % 3 != 0 || !face.iter().all(is_index) {
            return Err(vertex.fault(
                "`vertex` or `face` is no list of triples, or a face has a vertex that is not there",
                "write three numbers for each vertex, and three vertices, counted from 0, for each face",
            ));
        }
        let triangles = face.chunks_exact(3).map(|x| [x[0] as usize, x[1] as usize, x[2] as usize]);
        return Ok(Mesh { triangles: triangles.collect(), vertices });
    }
    let file = view.attribute("file").ok_or_else(|| {
        view.element.fault("the mesh has neither `file` nor `vertex`", "write file=\"...\"")
    })?;
    let name = Path::new(file.value.trim());
    let name = match name.file_name().filter(|_| model.compiler.strip_path) {
        Some(last) => Path::new(last),
        None => name,
    };
    let path =
        beside::find(file, &Path::new(&model.compiler.mesh_folder).join(name), &[], model.context)?;
    let unread =
        |why: String| file.fault(format!("`{}`: {why}", file.value), "give a mesh as STL or OBJ");
    let size = std::fs::metadata(&path).map_err(|error| unread(error.to_string()))?.len();
    if size > MOST_BYTES as u64 {
        return Err(unread(format!("more than {} MiB", MOST_BYTES >> 20)));
    }
    let bytes = std::fs::read(&path).map_err(|error| unread(error.to_string()))?;
    let ending = path.extension().and_then(|x| x.to_str()).unwrap_or_default().to_ascii_lowercase();
    mesh::read(&bytes, &ending).map_err(unread)
}

/// The triangles as they stand in the frame of a geom.
fn placed(view: &View<'_>, mut mesh: Mesh) -> Read<Mesh> {
    let from = v3(view.numbers_or("refpos", [0.0; 3])?);
    let turn = quaternion(view.numbers_or("refquat", [1.0, 0.0, 0.0, 0.0])?);
    let turn: M3 = turn.ok_or_else(|| {
        view.element.fault("a quaternion of length zero", "write refquat=\"1 0 0 0\"")
    })?;
    let scale = view.numbers_or("scale", [1.0; 3])?;
    for vertex in &mut mesh.vertices {
        *vertex = (turn.transpose() * (*vertex - from)).component_mul(&v3(scale));
    }
    if scale.iter().product::<f64>() < 0.0 {
        mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    }
    Ok(mesh)
}
