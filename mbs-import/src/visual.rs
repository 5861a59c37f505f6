//! Files of meshes that are drawn: where they are, and how the scene names them.

use crate::beside::{existing, is_barred, package, places, whole};
use crate::context::Context;
use crate::element::Attribute;
use crate::robot::FormKind;
use mbs_scene::{MESH_ENDINGS, mesh_ending};
use std::path::{Component, Path, PathBuf};

/// The form of a mesh by its file and the factors of its numbers, where none is zero; or why it is not drawn.
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

/// A file that is drawn, as the scene names it; or why it is not.
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

/// The whole path of a file that is there.
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

/// A file from a folder, if they have more than the root in common: a scene and its files can move together.
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
