//! Sweeps before they are applied to a scene: from a file, from numbers in code, or from both.

use super::parameter::{Combine, Parameter};
use super::{SweepFault, SweepRefusal, reader};
use crate::read::SceneFile;
use crate::read::texts::Texts;
use mbs_core::scene::Number;

/// A sweep before its scene is known: the parameters of the file, then those of code.
#[derive(Debug, Clone)]
pub struct SweepSource {
    file: Option<SceneFile>,
    /// Combination of the values when no file defines one.
    combine: Combine,
    /// Paths with their values, in the order of the calls.
    varied: Vec<(String, Vec<Number>)>,
}

impl SweepSource {
    /// A sweep over every combination of values; the last path changes fastest.
    #[must_use]
    pub fn grid() -> Self {
        Self { file: None, combine: Combine::Grid, varied: Vec::new() }
    }

    /// A sweep over the first values of all paths together, then the second ones, and so on. All paths have the same number of values.
    #[must_use]
    pub fn zip() -> Self {
        Self { combine: Combine::Zip, ..Self::grid() }
    }

    /// Varies the number of the scene at a path. The path is also the name of its column.
    pub fn vary(&mut self, path: &str, values: Vec<Number>) {
        self.varied.push((path.to_owned(), values));
    }

    /// The paths that code varies, with their values, in the order of the calls.
    pub fn varied(&self) -> impl Iterator<Item = (&str, &[Number])> {
        self.varied.iter().map(|(path, values)| (path.as_str(), &values[..]))
    }

    /// A text that identifies the sweep: the file with all its included files, and a line for each path that code varies. Equal sweeps have
    /// equal texts.
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

    /// Texts that the byte positions of the parameters refer to.
    pub(super) fn texts(&self) -> Texts {
        self.file.as_ref().map(|file| file.texts.clone()).unwrap_or_default()
    }

    /// The combination of the values, and the parameters with their addresses in a scene.
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
