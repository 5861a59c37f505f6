//! Triangles of meshes, from files or from the model itself.

use super::built_in::built_in;
use super::defaults::View;
use super::model::Model;
use crate::beside;
use crate::element::Attribute;
use crate::source::Read;
use mbs_scene::TriangleMesh;
use std::path::{Path, PathBuf};

/// The triangles as they are written. The list is empty when the vertices are given alone, and stand for their convex hull.
pub(super) fn read(view: &View<'_>, model: &Model<'_, '_, '_>) -> Read<TriangleMesh> {
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
    if let Some(word) = view.attribute("builtin").filter(|word| word.value.trim() != "none") {
        let vertices = built_in(word, view)?;
        return Ok(TriangleMesh { vertices, triangles: Vec::new() });
    }
    let file = view.attribute("file").ok_or_else(|| {
        view.element.fault("the mesh has neither `file` nor `vertex`", "write file=\"...\"")
    })?;
    let (name, own) = places_of(file, model);
    let path = beside::find(file, &name, own.as_deref(), model.context)?;
    TriangleMesh::read_first(&path)
        .map_err(|why| file.fault(format!("`{}`: {why}", file.value), "give a mesh as STL or OBJ"))
}

/// Paths of a mesh file: in the folder of meshes relative to the model, and next to the included file that names it.
pub(super) fn places_of(file: &Attribute, model: &Model<'_, '_, '_>) -> (PathBuf, Option<PathBuf>) {
    let written = Path::new(file.value.trim());
    let name = match written.file_name().filter(|_| model.compiler.strip_path) {
        Some(last) => Path::new(last),
        None => written,
    };
    let own = model.context.sources.beside(file.at, written);
    (Path::new(&model.compiler.mesh_folder).join(name), own)
}
