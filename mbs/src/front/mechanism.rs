//! Mechanism as its scene in decimal numbers, and the file that it came from.

use super::function::{Function, FunctionId, OutputFunction};
use super::inputs::{InputInfo, Inputs};
use super::part::sealed::Id as _;
use super::{Id, Part, PathError, SceneError, SimulationError, UnknownName};
use crate::settings::Method;
use mbs_core::Real;
use mbs_core::scene::{
    Dimension, Entry, Number, Road, Scene, SceneError as RefusedScene, SceneFault, Setting, Vector3,
};
use mbs_scene::{ReadError, SceneFile, WriteError};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;

/// Mechanism of bodies, joints and what acts on them, by name. Start with [`planar`](Self::planar) or [`spatial`](Self::spatial), or
/// [`read`](Self::read) a scene file.
///
/// Adding parts does not fail; [`check`](Self::check) and whatever builds a model say what is wrong, with the part's name.
///
/// # Examples
/// ```
/// use mbs::{Body, GROUND, Joint, Mechanism};
/// let mut m = Mechanism::planar("pendulum");
/// m.set_gravity([0.0, -9.81]);
/// let arm = m.add(Body::rod([0.0, 0.0], [1.0, 0.0], 1.0).named("arm"));
/// let pivot = m.add(Joint::revolute([GROUND, arm], [0.0, 0.0]));
/// m.check()?;
/// assert_eq!(m.name(pivot), "joint-1");
/// m.set("body.arm.mass", 2.5)?;
/// assert_eq!(m.part(arm).mass.to_f64(), 2.5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Mechanism {
    pub(super) scene: Scene<Number>,
    /// The file that says the same, or said so before the last change by handle.
    file: Option<SceneFile>,
    is_changed: bool,
    functions: Vec<Function>,
}

impl PartialEq for Mechanism {
    fn eq(&self, other: &Self) -> bool {
        self.scene == other.scene && self.functions == other.functions
    }
}

impl Mechanism {
    /// An empty planar mechanism (x, y; rotation about z).
    #[must_use]
    pub fn planar(name: &str) -> Self {
        Self::empty(name, Dimension::Planar)
    }

    /// An empty mechanism in space.
    #[must_use]
    pub fn spatial(name: &str) -> Self {
        Self::empty(name, Dimension::Spatial)
    }

    fn empty(name: &str, dimension: Dimension) -> Self {
        let scene = Scene::empty(name, dimension, Number::assumed(1.0));
        Self { scene, file: None, is_changed: true, functions: Vec::new() }
    }

    /// Reads a scene file, or a model of another program: URDF, MJCF or SDF.
    ///
    /// # Errors
    /// [`ReadError`] with file, line, column and a hint.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        Self::of_file(mbs_import::read(path)?)
    }

    /// Reads the text of a scene file.
    ///
    /// # Errors
    /// [`ReadError`] with line, column and a hint.
    pub fn parse(text: &str) -> Result<Self, ReadError> {
        Self::of_file(SceneFile::parse(text, "scene")?)
    }

    /// The mechanism of a scene file that is read: with what a command line has set in it.
    ///
    /// # Errors
    /// [`ReadError`] with file, line, column and a hint.
    pub fn of_file(file: SceneFile) -> Result<Self, ReadError> {
        let scene = file.numbers()?;
        Ok(Self { scene, file: Some(file), is_changed: false, functions: Vec::new() })
    }

    /// The scene file of this mechanism. Numbers keep their digits: `parse` of it is equal to this. What came from a file keeps its text and
    /// comments but for what changed.
    ///
    /// # Errors
    /// [`WriteError`] where a part is code, or refers to a part that is not there.
    pub fn to_toml(&self) -> Result<String, WriteError> {
        Ok(self.to_file()?.text().to_owned())
    }

    /// Writes the scene file of this mechanism.
    ///
    /// # Errors
    /// As [`to_toml`](Self::to_toml), and [`WriteError::NotWritten`] where the system refuses.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), WriteError> {
        std::fs::write(path, self.to_toml()?).map_err(|e| WriteError::NotWritten(e.to_string()))
    }

    /// Sets the gravity vector [m/s^2]; without it there is none, and no code for it.
    pub fn set_gravity(&mut self, gravity: impl Into<Vector3>) -> &mut Self {
        self.scene_mut().gravity = Some(gravity.into().0);
        self
    }

    /// Length of a run [s]; without it 1 s.
    pub fn set_duration(&mut self, duration: impl Into<Number>) -> &mut Self {
        self.scene_mut().duration = duration.into();
        self
    }

    /// The road under the tires; without it there is level ground at height zero.
    ///
    /// ```
    /// use mbs::{Mechanism, Road, RoadFeature};
    /// let mut m = Mechanism::planar("quarter car");
    /// let bump = RoadFeature::Bump { start: 3.0, length: 2.0, amplitude: 0.05 };
    /// m.set_road(Road::new([bump], 5.0));
    /// assert_eq!(m.check(), Ok(()));
    /// ```
    pub fn set_road(&mut self, road: Road<Number>) -> &mut Self {
        self.scene_mut().road = road;
        self
    }

    /// Makes a method that of the mechanism, for [`simulate`](Self::simulate), [`run`](crate::run) and its file: what it leaves open stays.
    /// Precision, threads and interrupt are no part of a mechanism and are left out.
    ///
    /// ```
    /// use mbs::{FormulationKind, Mechanism, Method};
    /// let mut m = Mechanism::planar("nothing yet");
    /// m.set_method(&Method::new(FormulationKind::Index1).step(1e-4));
    /// assert!(m.to_toml()?.contains("formulation = \"index-1\"\nstep = 0.0001"));
    /// # Ok::<(), mbs::WriteError>(())
    /// ```
    pub fn set_method(&mut self, method: &Method) -> &mut Self {
        let scene = self.scene_mut();
        for (key, row) in Setting::of_table("solver") {
            if let (Some(value), Some(slot)) = (method.value(row.name), scene.solver.slot(key)) {
                // both have the form of the row
                let _ = slot.set(value.map(&mut Number::from));
            }
        }
        if let Some(duration) = method.duration {
            scene.duration = duration.into();
        }
        self
    }

    /// Length of a run that the mechanism's file or code asks for [s].
    #[must_use]
    pub fn duration(&self) -> Option<f64> {
        let duration = &self.scene.duration;
        (!duration.is_absent()).then(|| duration.to_f64())
    }

    /// Adds a body, joint, initial condition, guide, effect or output and returns its handle. A part without a name is `body-1`, ...
    pub fn add<P: Part>(&mut self, part: P) -> P::Id {
        P::Id::new(part.add_to(self.scene_mut()))
    }

    /// Adds an output that is code: a column of runs, and read by [`Simulation::function`](crate::Simulation::function). It lives beside the
    /// scene: clones share it, and what writes the mechanism as text refuses it. Its name is that of no other column: [`check`](Self::check).
    pub fn add_function(
        &mut self,
        name: &str,
        function: impl OutputFunction + 'static,
    ) -> FunctionId {
        self.functions.push(Function { name: name.to_owned(), code: Arc::new(function) });
        FunctionId(self.functions.len() - 1)
    }

    /// Returns the outputs that are code.
    pub(super) fn functions(&self) -> &[Function] {
        &self.functions
    }

    /// The handle of a name: `m.find::<JointId>("elbow")`. Guides and initial conditions go by the name of their joint or body.
    ///
    /// # Errors
    /// [`UnknownName`], which proposes the nearest name.
    pub fn find<I: Id>(&self, name: &str) -> Result<I, UnknownName> {
        let names = I::parts(&self.scene).iter().map(|part| I::name(part, &self.scene));
        if let Some(index) = names.clone().position(|n| n == name) {
            return Ok(I::new(index));
        }
        let known = names.map(str::to_owned).collect();
        Err(UnknownName { word: I::WORD, name: name.to_owned(), known })
    }

    /// Takes all initial conditions out: it then starts at rest in the reference configuration.
    pub fn clear_initial_conditions(&mut self) -> &mut Self {
        self.scene_mut().initials.clear();
        self
    }

    /// The name of a part; the ground's is `ground`.
    ///
    /// # Panics
    /// For a handle of another mechanism, as an index does.
    pub fn name<I: Id>(&self, id: I) -> &str {
        match id.place() {
            Some(index) => I::name(&I::parts(&self.scene)[index], &self.scene),
            None => "ground",
        }
    }

    /// Handles of all parts of a kind: `m.ids::<BodyId>()`. The ground is no part.
    pub fn ids<I: Id>(&self) -> impl ExactSizeIterator<Item = I> + use<I> {
        (0..I::parts(&self.scene).len()).map(I::new)
    }

    /// The data of a part.
    ///
    /// # Panics
    /// For a handle of another mechanism, as an index does, and for the ground.
    pub fn part<I: Id>(&self, id: I) -> &I::Part {
        &I::parts(&self.scene)[id.place().unwrap_or(usize::MAX)]
    }

    /// The data of a part, to change it.
    ///
    /// # Panics
    /// As [`part`](Self::part).
    pub fn part_mut<I: Id>(&mut self, id: I) -> &mut I::Part {
        &mut I::parts_mut(self.scene_mut())[id.place().unwrap_or(usize::MAX)]
    }

    /// A number by its path, as sweeps write it: `body.upper.mass`, `joint.tie-rod.points.0.2`.
    ///
    /// # Errors
    /// [`PathError`] for a path to nothing, or to something that is no number.
    pub fn get(&self, path: &str) -> Result<f64, PathError> {
        let file = self.data().map_err(PathError::NotWritten)?;
        let fault = |fault| PathError::Path { path: path.to_owned(), fault };
        Ok(file.number(path).map_err(fault)?.to_f64())
    }

    /// Sets a number by its path. A mechanism from a file keeps the rest of its text.
    ///
    /// Cost: the scene is read again from the tree of its file; no text is parsed.
    ///
    /// # Errors
    /// As [`get`](Self::get), and a number that is not finite. One that cannot be meant is refused by [`check`](Self::check).
    pub fn set(&mut self, path: &str, value: impl Into<Number>) -> Result<&mut Self, PathError> {
        let file = self.data().map_err(PathError::NotWritten)?;
        let fault = |fault| PathError::Path { path: path.to_owned(), fault };
        let value = value.into();
        if !value.to_f64().is_finite() {
            return Err(PathError::NotFinite { path: path.to_owned() });
        }
        let file = file.with_number(path, &value).map_err(fault)?;
        let fresh = Self::of_file(file).map_err(PathError::Refused)?;
        *self = Self { functions: core::mem::take(&mut self.functions), ..fresh };
        Ok(self)
    }

    /// Inputs that can be set between steps, in the order of effects, guides, couplings, then signals.
    ///
    /// # Errors
    /// As [`check`](Self::check).
    pub fn inputs(&self) -> Result<Vec<InputInfo>, SceneError> {
        Ok(Inputs::new(&self.resolve_scene()?).list().to_vec())
    }

    /// Everything that can be wrong before a model is built.
    ///
    /// # Errors
    /// [`SceneError`] with the part's name and key, and the place in the file that it came from.
    pub fn check(&self) -> Result<(), SceneError> {
        self.resolve_scene().map(|_| ())
    }

    /// The scene in `f64`, checked. A fault of a scene that came from a file has its place there.
    ///
    /// # Errors
    /// [`SimulationError`] as [`check`](Self::check).
    pub fn resolve(&self) -> Result<Scene<f64>, SimulationError> {
        self.resolve_scene().map_err(|error| self.located(error))
    }

    /// A refusal of the scene; of one that came from a file with its place there.
    pub(super) fn located(&self, error: SceneError) -> SimulationError {
        match (&self.file, self.data()) {
            (Some(_), Ok(file)) => file.meaning(*error.error()).into(),
            _ => error.into(),
        }
    }

    /// The scene in `f64`, checked.
    pub(crate) fn resolve_scene(&self) -> Result<Scene<f64>, SceneError> {
        self.resolved()
    }

    /// The scene in a precision, checked.
    pub(crate) fn resolved<T: Real>(&self) -> Result<Scene<T>, SceneError> {
        let scene = self.scene.resolve().and_then(|scene| {
            self.check_functions()?;
            Ok(scene)
        });
        scene.map_err(|error| {
            let file = self.file.as_ref().filter(|_| !self.is_changed);
            let place = file.map(|file| file.place(error.entry, error.field).1);
            SceneError::new(error, &self.scene, self.columns(), place)
        })
    }

    /// Names of all outputs, those that are code last. Where there are no others the joints are recorded.
    fn columns(&self) -> impl Iterator<Item = &String> {
        let Scene { outputs, joints, .. } = &self.scene;
        let joints = if outputs.is_empty() { &joints[..] } else { &[] };
        let data = outputs.iter().map(|o| &o.name).chain(joints.iter().map(|joint| &joint.name));
        data.chain(self.functions.iter().map(|f| &f.name))
    }

    /// Outputs that are code have names of their own.
    fn check_functions(&self) -> Result<(), RefusedScene> {
        let names: Vec<&String> = self.columns().collect();
        for (i, name) in names.iter().enumerate().skip(names.len() - self.functions.len()) {
            let fault = match names[..i].iter().position(|n| n == name) {
                Some(first) => SceneFault::DuplicateName(first),
                None if name.is_empty() || *name == "t" => SceneFault::ReservedName,
                None => continue,
            };
            return Err(RefusedScene { entry: Entry::Output(i), field: "name", fault });
        }
        Ok(())
    }

    /// The scene, to change it.
    pub(crate) fn scene_mut(&mut self) -> &mut Scene<Number> {
        self.is_changed = true;
        &mut self.scene
    }

    /// The scene file of this mechanism as it is now.
    ///
    /// # Errors
    /// [`WriteError`] where a part of it is code.
    pub fn to_file(&self) -> Result<SceneFile, WriteError> {
        match self.functions.first() {
            Some(function) => Err(WriteError::InCode(format!("output `{}`", function.name))),
            None => self.data().map(Cow::into_owned),
        }
    }

    /// Returns the scene file of all that is data.
    fn data(&self) -> Result<Cow<'_, SceneFile>, WriteError> {
        match &self.file {
            Some(file) if !self.is_changed => Ok(Cow::Borrowed(file)),
            Some(file) => file.updated(&self.scene).map(Cow::Owned),
            None => SceneFile::of(&self.scene).map(Cow::Owned),
        }
    }
}

impl Serialize for Mechanism {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.to_file().map_err(serde::ser::Error::custom)?.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Mechanism {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let file = SceneFile::deserialize(deserializer)?;
        Self::of_file(file).map_err(|error| serde::de::Error::custom(error.render()))
    }
}
