//! Mesh files for pictures: their paths, and their names in the scene.

use crate::beside::{existing, is_barred, package, places, whole};
use crate::context::Context;
use crate::element::Attribute;
use crate::robot::FormKind;
use mbs_scene::{MESH_ENDINGS, mesh_ending};
use std::path::{Component, Path, PathBuf};

/// The shape of a mesh, from its file and the scale factors of its coordinates. The error is the reason why it is not drawn.
pub(crate) fn mesh_form(
    file: Option<&Attribute>,
    scale: Option<&Attribute>,
    context: &Context<'_>,
) -> Result<Option<FormKind>, String> {
    let file = file.ok_or("meshes without a file are not drawn")?;
    let scale = match scale.map(Attribute::list) {
        None => [1.0; 3],
        Some(Ok(factors)) if factors.len() == 1 => [factors[0]; 3],
        Some(Ok(factors)) if factors.len() == 3 => [factors[0], factors[1], factors[2]],
        Some(_) => return Err("meshes whose scale is no three numbers are not drawn".to_owned()),
    };
    let file = mesh_file(&file.value, context)?;
    Ok(FormKind::Mesh { file, scale }.of_size())
}

/// The name in the scene of a mesh file. The error is the reason why it is not drawn.
pub(crate) fn mesh_file(written: &str, context: &Context<'_>) -> Result<String, String> {
    let written = written.trim();
    let ending = mesh_ending(Path::new(written));
    if !MESH_ENDINGS.contains(&ending.as_str()) {
        return Err(match ending.as_str() {
            "" => "meshes without an ending are not drawn".to_owned(),
            _ => format!("meshes `.{ending}` are not drawn; those as STL or OBJ are"),
        });
    }
    let path = found(written, context)?;
    if is_barred(&path, context.options) {
        return Err("meshes outside of the folder are not drawn (--no-outside)".to_owned());
    }
    let folder = context.options.scene_home().unwrap_or(Path::new(""));
    Ok(from_folder(folder, &path))
}

/// The absolute path of an existing file.
fn found(written: &str, context: &Context<'_>) -> Result<PathBuf, String> {
    let Some(home) = &context.options.folder else {
        return Err("meshes are not drawn: this text has no folder".to_owned());
    };
    let candidates = places(written, home, context.options)
        .map_err(|scheme| format!("meshes `{scheme}://` are not drawn"))?;
    existing(candidates).ok_or_else(|| match package(written) {
        Some((package, _)) => format!(
            "meshes of the package `{package}` that are not found are not drawn: --package {package}=FOLDER"
        ),
        None => "meshes that are not found are not drawn".to_owned(),
    })
}

/// A path relative to a folder, if both have more than the root in common. The scene and its files can then be moved together.
fn from_folder(folder: &Path, file: &Path) -> String {
    let folder = whole(folder);
    let common = folder.components().zip(file.components()).take_while(|(a, b)| a == b).count();
    let is_near = folder.components().take(common).any(|part| matches!(part, Component::Normal(_)));
    if !is_near {
        return file.display().to_string();
    }
    let up = folder.components().skip(common).map(|_| "..".to_owned());
    let down = file.components().skip(common).map(|x| x.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}
