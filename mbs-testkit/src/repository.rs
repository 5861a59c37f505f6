//! Scene files of the repository.

use mbs_core::Real;
use mbs_core::scene::Scene;
use mbs_scene::SceneFile;
use std::path::{Path, PathBuf};

/// Returns the path of a scene in `scenes`.
#[must_use]
pub fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes").join(format!("{name}.toml"))
}

/// Reads the text of a scene in `scenes` at run time, because a package contains no file from outside its folder.
pub(crate) fn scene_text(name: &str) -> String {
    text_of(&path(name))
}

/// Reads the text of a scene in `mbs/tests/field`, for a test that changes it.
///
/// # Panics
/// If there is no such file.
#[must_use]
pub fn text(name: &str) -> String {
    let field = Path::new(env!("CARGO_MANIFEST_DIR")).join("../mbs/tests/field");
    text_of(&field.join(format!("{name}.toml")))
}

/// Reads a scene in `mbs/tests/field`.
#[must_use]
pub fn field(name: &str) -> Scene<f64> {
    read(&text(name), name)
}

/// Reads a scene from its text.
///
/// # Panics
/// If the text is not a valid scene, with the fault as message.
#[must_use]
pub fn read(text: &str, name: &str) -> Scene<f64> {
    read_in(text, name)
}

/// Reads a scene from its text, in numbers of type `T`.
pub(crate) fn read_in<T: Real>(text: &str, name: &str) -> Scene<T> {
    let document = SceneFile::parse(text, name).unwrap_or_else(|e| panic!("{}", e.render()));
    document.scene().unwrap_or_else(|e| panic!("{}\n{text}", e.render()))
}

/// Returns the four-bar linkage whose third axis is tilted by `angle` [rad].
#[must_use]
pub fn tilted(angle: f64) -> Scene<f64> {
    let text = text("11-axis-off-by-1e-7");
    let axis = format!("axis = [{}, 0, {}]", angle.sin(), angle.cos());
    read(&text.replace("axis = [9.999999999999982e-08, 0, 0.999999999999995]", &axis), "tilted")
}

fn text_of(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}
