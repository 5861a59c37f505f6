//! The scene of a command line: a file or standard input, with replaced values.

use crate::input;
use crate::model::of_words;
use crate::refusal::Refusal;
use clap::Args;
use mbs::core::scene::Scene;
use mbs::scene_file::SceneFile;
use std::ops::Deref;
use std::path::{Path, PathBuf};

/// A scene on a command line.
#[derive(Debug, Clone, Args)]
pub(crate) struct SceneArgument {
    /// Scene file (TOML or JSON), or - for standard input.
    #[arg(value_name = "SCENE")]
    scene: PathBuf,
    /// Another value at a path of the scene, as sweeps write it: body.rod.mass=2, 'parameter.k=36 kN/m'. May be repeated. Default: none.
    #[arg(long, value_name = "PATH=VALUE", display_order = 800)]
    set: Vec<String>,
    /// An option of `mbs import`, where the scene is a model: base=free, key=home, limits. May be repeated. Default: none.
    #[arg(long, value_name = "OPTION", display_order = 801)]
    import: Vec<String>,
}

/// A scene file, and its scene in `f64`.
pub(crate) struct CheckedScene {
    pub(crate) document: SceneFile,
    pub(crate) scene: Scene<f64>,
}

impl Deref for SceneArgument {
    type Target = Path;

    fn deref(&self) -> &Path {
        &self.scene
    }
}

impl SceneArgument {
    /// The argument for a file with replaced values.
    pub(crate) fn new(path: &Path, set: &[String]) -> Self {
        Self { scene: path.to_owned(), set: set.to_vec(), import: Vec::new() }
    }

    /// True if there is a file or standard input to read.
    pub(crate) fn is_there(&self) -> bool {
        input::is_standard(&self.scene) || self.scene.is_file()
    }

    /// Reads the scene file and the scene in `f64`; otherwise returns the refusal.
    pub(crate) fn read(&self) -> Result<CheckedScene, Refusal> {
        let document = self.document()?;
        let scene = document.scene::<f64>();
        let scene = scene.map_err(|error| Refusal::read("scene-refused", &error))?;
        Ok(CheckedScene { document, scene })
    }

    /// Reads the scene file with replaced values; otherwise returns the refusal.
    pub(crate) fn document(&self) -> Result<SceneFile, Refusal> {
        self.document_for(false)
    }

    /// Reads the scene file with replaced values; otherwise returns the refusal. With `geometry_alone` only positions are needed, and
    /// impossible inertias of a model are left out.
    pub(crate) fn document_for(&self, geometry_alone: bool) -> Result<SceneFile, Refusal> {
        let options = (of_words(&self.import)?, geometry_alone);
        let mut document = input::document(&self.scene, "scene file", options)?;
        for assignment in &self.set {
            let set = document.with_set(assignment);
            document = set.map_err(|error| Refusal::read("set-refused", &error))?;
        }
        Ok(document)
    }

    /// Returns the argument as text of a command line.
    pub(crate) fn line(&self) -> String {
        let set = self.set.iter().map(|assignment| format!(" --set '{assignment}'"));
        let import = self.import.iter().map(|option| format!(" --import '{option}'"));
        format!("{}{}", self.scene.display(), set.chain(import).collect::<String>())
    }
}
