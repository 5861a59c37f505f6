//! Meshes, and the mass of geoms that are meshes.

use super::defaults::{MAIN, View};
use super::model::Model;
use crate::beside;
use crate::element::{Attribute, Element};
use crate::inertia::Mass;
use crate::mesh::{Count, Surface};
use crate::pose::{M3, Pose, V3, quaternion, v3};
use crate::robot::{FormKind, is_even};
use crate::source::{Fault, Origin, Read};
use crate::visual::mesh_file;
use mbs_scene::{TriangleMesh, nearest_name};
use std::path::{Path, PathBuf};

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
    if let (Count::Signed, Some([a, b])) = (count, Surface(&mesh).open_edge()) {
        let [a, b] = [a, b]
            .map(|i| mesh.vertices[i].iter().map(f64::to_string).collect::<Vec<_>>().join(" "));
        return Err(refused(&format!("its surface is open at the edge from {a} to {b}")));
    }
    let whole = Surface(&mesh).mass(geom.density, count);
    if whole.mass <= 0.0 {
        return Err(refused("its surface encloses nothing, or is turned inside out"));
    }
    let mass = geom.mass.unwrap_or(whole.mass);
    let own = Mass { mass, tensor: whole.tensor * (mass / whole.mass), ..whole };
    Ok(own.seen_from(&geom.pose))
}

/// The triangles as they are written.
fn surface(view: &View<'_>, model: &Model<'_, '_, '_>) -> Read<TriangleMesh> {
    if let Some(vertex) = view.attribute("vertex") {
        let numbers = vertex.list()?;
        let face = view.attribute("face").map(Attribute::list).transpose()?.unwrap_or_default();
        let vertices = numbers.chunks_exact(3).map(|x| [x[0], x[1], x[2]]).collect::<Vec<_>>();
        let is_index = |x: &f64| x.fract() == 0.0 && (0.0..vertices.len() as f64).contains(x);
        if numbers.len() % 3 != 0 || face.len() % 3 != 0 || !face.iter().all(is_index) {
            return Err(vertex.fault(
                "`vertex` or `face` is no list of triples, or a face has a vertex that is not there",
                "write three numbers for each vertex, and three vertices, counted from 0, for each face",
            ));
        }
        let triangles = face.chunks_exact(3).map(|x| [x[0] as usize, x[1] as usize, x[2] as usize]);
        return Ok(TriangleMesh { triangles: triangles.collect(), vertices });
    }
    let file = view.attribute("file").ok_or_else(|| {
        view.element.fault("the mesh has neither `file` nor `vertex`", "write file=\"...\"")
    })?;
    let name = place_of(&file.value, model);
    let path = beside::find(file, &name, None, model.context)?;
    TriangleMesh::read(&path)
        .map_err(|why| file.fault(format!("`{}`: {why}", file.value), "give a mesh as STL or OBJ"))
}

/// The place of a file of a mesh, from the folder of the model.
fn place_of(file: &str, model: &Model<'_, '_, '_>) -> PathBuf {
    let name = Path::new(file.trim());
    let name = match name.file_name().filter(|_| model.compiler.strip_path) {
        Some(last) => Path::new(last),
        None => name,
    };
    Path::new(&model.compiler.mesh_folder).join(name)
}

/// What is drawn of a geom that is a mesh: its pose and form, or why it is not drawn.
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
    let place = place_of(&file.value, model);
    let file = match mesh_file(&place.display().to_string(), model.context) {
        Ok(file) => file,
        Err(says) => return Ok(Err(says)),
    };
    let Reference { from, turn, scale } = reference(&view)?;
    if !is_even(scale) && turn != M3::identity() {
        return Ok(Err("meshes that are turned and stretched are not drawn".to_owned()));
    }
    // pose (S Rt (x - p)), where S and Rt commute
    let turn = turn.transpose();
    let own = Pose::new(turn, -(turn * from).component_mul(&v3(scale)));
    Ok(Ok((geom.pose.then(&own), FormKind::Mesh { file, scale })))
}

/// How the triangles of a file stand in the frame of a geom.
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

/// The triangles as they stand in the frame of a geom.
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
