//! Files that are a scene or a model.

use crate::import::{Imported, import, is_model};
use crate::options::ImportOptions;
use mbs_scene::{ReadError, SceneFile};
use std::path::Path;

/// Reads the bytes of a file that lies in the folder of the options: a scene, or a model, which becomes one as they say. `file` is the name
/// that messages show.
///
/// # Errors
/// Those of [`SceneFile::from_bytes_in`] and of [`import`].
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

/// Reads a file: a scene, or a model, which becomes one.
///
/// # Errors
/// Those of [`SceneFile::read`] and of [`import`].
pub fn read(path: impl AsRef<Path>) -> Result<SceneFile, ReadError> {
    let path = path.as_ref();
    let Ok(bytes) = std::fs::read(path) else {
        // it says why a file cannot be read
        return SceneFile::read(path);
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    let options = ImportOptions::in_folder(folder.to_owned());
    scene_file(&bytes, &path.display().to_string(), &options).map(|(scene, _)| scene)
}
