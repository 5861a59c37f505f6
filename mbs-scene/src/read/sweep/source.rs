//! Sweeps before they meet their scene: a file, numbers of code, or both.

use super::parameter::{Combine, Parameter};
use super::{SweepFault, SweepRefusal, reader};
use crate::read::SceneFile;
use crate::read::texts::Texts;
use mbs_core::scene::Number;

/// Sweep before its scene is known: what a file says, then what code varies.
#[derive(Debug, Clone)]
pub struct SweepSource {
    file: Option<SceneFile>,
    /// Combination of the values where no file gives one.
    combine: Combine,
    /// Paths with their values, in the order in which code gives them.
    varied: Vec<(String, Vec<Number>)>,
}

impl SweepSource {
    /// Each value with each; the last path changes fastest.
    #[must_use]
    pub fn grid() -> Self {
        Self { file: None, combine: Combine::Grid, varied: Vec::new() }
    }

    /// The first values together, then the second ones, and so on: all paths have as many.
    #[must_use]
    pub fn zip() -> Self {
        Self { combine: Combine::Zip, ..Self::grid() }
    }

    /// Varies a number of the scene by its path, which is the name of its column too.
    pub fn vary(&mut self, path: &str, values: Vec<Number>) {
        self.varied.push((path.to_owned(), values));
    }

    /// The paths that code varies, with their values.
    pub fn varied(&self) -> impl Iterator<Item = (&str, &[Number])> {
        self.varied.iter().map(|(path, values)| (path.as_str(), &values[..]))
    }

    /// A text that is the same for the same sweep: that of the file with all that it includes, and a line for each path that code varies.
    #[must_use]
    pub fn text(&self) -> String {
        let combine = || format!("{:?}\n", self.combine);
        let mut text = self.file.as_ref().map_or_else(combine, SceneFile::whole_text);
        for (path, values) in self.varied() {
            let values: Vec<String> = values.iter().map(Number::text).collect();
            text += &format!("{path:?} = [{}]\n", values.join(", "));
        }
        text
    }

    /// Texts in which the bytes of parameters are places.
    pub(super) fn texts(&self) -> Texts {
        self.file.as_ref().map(|file| file.texts.clone()).unwrap_or_default()
    }

    /// Combination of the values, and the parameters with their places in a scene.
    pub(super) fn parameters(
        &self,
        scene: &SceneFile,
    ) -> Result<(Combine, Vec<Parameter>), SweepRefusal> {
        let (combine, mut parameters) = match &self.file {
            Some(file) => reader::read(file, scene, !self.varied.is_empty())?,
            None => (self.combine, Vec::new()),
        };
        for (path, values) in self.varied() {
            let refused = |fault| SweepRefusal::Numbers { path: path.to_owned(), fault };
            let parameter = Parameter::of_numbers((path, values), scene, combine);
            parameters.push(parameter.map_err(refused)?);
        }
        if parameters.is_empty() {
            return Err(SweepRefusal::Numbers { path: String::new(), fault: SweepFault::NoValues });
        }
        Ok((combine, parameters))
    }
}

impl From<SceneFile> for SweepSource {
    fn from(file: SceneFile) -> Self {
        Self { file: Some(file), ..Self::grid() }
    }
}

impl PartialEq for SweepSource {
    fn eq(&self, other: &Self) -> bool {
        let whole = |sweep: &Self| sweep.file.as_ref().map(SceneFile::whole_text);
        (whole(self), self.combine, &self.varied) == (whole(other), other.combine, &other.varied)
    }
}
