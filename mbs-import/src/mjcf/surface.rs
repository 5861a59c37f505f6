//! The triangles of meshes: of files, written in the model, or built in.

use super::defaults::View;
use super::model::Model;
use crate::beside;
use crate::element::Attribute;
use crate::source::Read;
use core::f64::consts::TAU;
use mbs_scene::TriangleMesh;
use std::path::{Path, PathBuf};

/// Most corners of a built-in cone. Chosen, not tuned.
const MAX_CORNERS: f64 = 10_000.0;

/// The triangles as they are written; none where the vertices stand for their hull.
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
        return built_in(word, view);
    }
    let file = view.attribute("file").ok_or_else(|| {
        view.element.fault("the mesh has neither `file` nor `vertex`", "write file=\"...\"")
    })?;
    let name = place_of(&file.value, model);
    let path = beside::find(file, &name, None, model.context)?;
    TriangleMesh::read(&path)
        .map_err(|why| file.fault(format!("`{}`: {why}", file.value), "give a mesh as STL or OBJ"))
}

/// A mesh that the format makes: a cone has two rings around the z axis, at -1 with radius 1 and at 1 with its own.
fn built_in(word: &Attribute, view: &View<'_>) -> Read<TriangleMesh> {
    let kind = word.value.trim();
    if kind != "cone" {
        return Err(word.fault(
            format!("a mass follows from this mesh, and the built-in mesh `{kind}` is not computed"),
            "write an <inertial> in the body of its geom, or mass=\"0\" at the geom, or let --massless-meshes count it as massless",
        ));
    }
    let params = view.attribute("params").map(Attribute::list).transpose()?.unwrap_or_default();
    let [count, radius] = params[..] else {
        return Err(
            word.fault("`params` of a cone are two numbers", "write params=\"CORNERS RADIUS\"")
        );
    };
    let is_count = count.fract() == 0.0 && (3.0..=MAX_CORNERS).contains(&count);
    if !is_count || radius < 0.0 {
        let hint = format!("write 3 to {MAX_CORNERS} corners, and a radius of zero or more");
        return Err(word.fault("`params` of a cone do not fit", hint));
    }
    let ring = |radius: f64, z: f64| {
        (0..count as usize).map(move |i| {
            let (sine, cosine) = (TAU * i as f64 / count).sin_cos();
            [radius * cosine, radius * sine, z]
        })
    };
    let vertices = ring(1.0, -1.0).chain(ring(radius, 1.0)).collect();
    Ok(TriangleMesh { vertices, triangles: Vec::new() })
}

/// The place of a file of a mesh, from the folder of the model.
pub(super) fn place_of(file: &str, model: &Model<'_, '_, '_>) -> PathBuf {
    let name = Path::new(file.trim());
    let name = match name.file_name().filter(|_| model.compiler.strip_path) {
        Some(last) => Path::new(last),
        None => name,
    };
    Path::new(&model.compiler.mesh_folder).join(name)
}
