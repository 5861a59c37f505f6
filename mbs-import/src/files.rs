//! Reads files that contain either a scene or a model of another format.

use crate::import::{Imported, import, is_model};
use crate::options::ImportOptions;
use mbs_scene::{ReadError, SceneFile};
use std::path::Path;

/// Reads the bytes of a scene, or of a model, which is converted by the options. Paths in the file are relative to the folder in the
/// options; `file` is the name in messages.
///
/// # Errors
/// The errors of [`SceneFile::from_bytes_in`] and of [`import`].
pub fn scene_file(
    bytes: &[u8],
    file: &str,
    options: &ImportOptions,
) -> Result<(SceneFile, Option<Imported>), ReadError> {
    if !is_model(bytes) {
        let folder = options.folder.as_deref().unwrap_or(Path::new(""));
        return SceneFile::from_bytes_in(bytes, file, folder).map(|scene| (scene, None));
    }
    let model = import(bytes, file, options)?;
    Ok((model.scene_file(file)?, Some(model)))
}

/// Reads a file with a scene, or with a model, which is converted to a scene.
///
/// # Errors
/// The errors of [`SceneFile::read`] and of [`import`].
pub fn read(path: impl AsRef<Path>) -> Result<SceneFile, ReadError> {
    let path = path.as_ref();
    let Ok(bytes) = std::fs::read(path) else {
        // The reader of scenes returns the error of the system.
        return SceneFile::read(path);
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    let options = ImportOptions::in_folder(folder.to_owned());
    scene_file(&bytes, &path.display().to_string(), &options).map(|(scene, _)| scene)
}
