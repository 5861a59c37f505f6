//! Scene files of the repository.

use mbs_core::Real;
use mbs_core::scene::Scene;
use mbs_scene::SceneFile;
use std::path::{Path, PathBuf};

/// Path of a scene of `scenes`.
#[must_use]
pub fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes").join(format!("{name}.toml"))
}

/// The text of a scene of `scenes`, read when it is asked for: a package holds no file from outside its folder.
pub(crate) fn scene_text(name: &str) -> String {
    text_of(&path(name))
}

/// The text of a scene of `mbs/tests/field`, to be changed.
///
/// # Panics
/// Where it is not there.
#[must_use]
pub fn text(name: &str) -> String {
    let field = Path::new(env!("CARGO_MANIFEST_DIR")).join("../mbs/tests/field");
    text_of(&field.join(format!("{name}.toml")))
}

/// A scene of `mbs/tests/field`.
#[must_use]
pub fn field(name: &str) -> Scene<f64> {
    read(&text(name), name)
}

/// A scene from its text.
///
/// # Panics
/// With the fault of a text that is no scene.
#[must_use]
pub fn read(text: &str, name: &str) -> Scene<f64> {
    read_in(text, name)
}

/// A scene from its text, in numbers of a kind.
pub(crate) fn read_in<T: Real>(text: &str, name: &str) -> Scene<T> {
    let document = SceneFile::parse(text, name).unwrap_or_else(|e| panic!("{}", e.render()));
    document.scene().unwrap_or_else(|e| panic!("{}\n{text}", e.render()))
}

/// The four-bar whose third axis is off by so many radians.
#[must_use]
pub fn tilted(angle: f64) -> Scene<f64> {
    let text = text("11-axis-off-by-1e-7");
    let axis = format!("axis = [{}, 0, {}]", angle.sin(), angle.cos());
    read(&text.replace("axis = [9.999999999999982e-08, 0, 0.999999999999995]", &axis), "tilted")
}

fn text_of(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}
