//! Situations that users met, each the smallest scene found that shows it (`mbs/tests/field`), against values from closed forms or other
//! programs. Each stands for a kind: the tests beside it are others of the kind.

mod analyses;
mod doubtful;
mod estimate;
mod formulations;
mod laws;
mod start;

use mbs::core::scene::Scene;
use mbs::scene_file::SceneFile;

/// A scene of `mbs/tests/field`.
pub(crate) fn field(name: &str) -> Scene<f64> {
    read(&text(name), name)
}

/// The text of a scene of `mbs/tests/field`, to be changed.
pub(crate) fn text(name: &str) -> String {
    let path = format!("{}/tests/field/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"))
}

/// A scene from its text.
pub(crate) fn read(text: &str, name: &str) -> Scene<f64> {
    let document = SceneFile::parse(text, name).unwrap_or_else(|e| panic!("{}", e.render()));
    document.scene().unwrap_or_else(|e| panic!("{}\n{text}", e.render()))
}
