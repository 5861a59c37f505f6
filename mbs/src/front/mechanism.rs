//! Mechanism as data: its scene in decimal numbers, and the file that it was read from.

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

/// Mechanism of bodies, joints, effects and other named parts. Start with [`planar`](Self::planar) or [`spatial`](Self::spatial), or
/// [`read`](Self::read) a scene file.
///
/// Adding a part never fails. [`check`](Self::check), and each function that builds a model, reports a wrong part by its name.
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
    /// Scene file of this mechanism. If `is_changed` is true, the file is older than the scene.
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

    /// Makes the mechanism of a scene file that is already read, including the values that a command line has set in it.
    ///
    /// # Errors
    /// [`ReadError`] with file, line, column and a hint.
    pub fn of_file(file: SceneFile) -> Result<Self, ReadError> {
        let scene = file.numbers()?;
        Ok(Self { scene, file: Some(file), is_changed: false, functions: Vec::new() })
    }

    /// Returns the text of the mechanism's scene file. Numbers keep their digits: `parse` of the text gives an equal mechanism. A mechanism
    /// that was read from a file keeps its text and comments, except in the parts that were changed.
    ///
    /// # Errors
    /// [`WriteError`] where a part is code, or refers to a part that does not exist.
    pub fn to_toml(&self) -> Result<String, WriteError> {
        Ok(self.to_file()?.text().to_owned())
    }

    /// Writes the scene file of this mechanism.
    ///
    /// # Errors
    /// Those of [`to_toml`](Self::to_toml), and [`WriteError::NotWritten`] where the file cannot be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), WriteError> {
        std::fs::write(path, self.to_toml()?).map_err(|e| WriteError::NotWritten(e.to_string()))
    }

    /// Sets the gravity vector [m/s^2]. Default: no gravity.
    pub fn set_gravity(&mut self, gravity: impl Into<Vector3>) -> &mut Self {
        self.scene_mut().gravity = Some(gravity.into().0);
        self
    }

    /// Sets the length of a run [s]. Default: 1 s.
    pub fn set_duration(&mut self, duration: impl Into<Number>) -> &mut Self {
        self.scene_mut().duration = duration.into();
        self
    }

    /// Sets the road under the tires. Default: level ground at height zero.
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

    /// Sets the method of the mechanism, which [`simulate`](Self::simulate), [`run`](crate::run) and the scene file use. Settings that
    /// `method` leaves open keep their value. Precision, threads and interrupt are no part of a mechanism: they are ignored.
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
                // value and slot have the same type, as both belong to this row: `set` cannot fail
                let _ = slot.set(value.map(&mut Number::from));
            }
        }
        if let Some(duration) = method.duration {
            scene.duration = duration.into();
        }
        self
    }

    /// Length of a run that the mechanism's file or code sets [s]; `None` where neither sets it.
    #[must_use]
    pub fn duration(&self) -> Option<f64> {
        let duration = &self.scene.duration;
        (!duration.is_absent()).then(|| duration.to_f64())
    }

    /// Adds a body, joint, initial condition, guide, effect or output and returns its handle. A part without a name is named `body-1`,
    /// `joint-1` and so on.
    pub fn add<P: Part>(&mut self, part: P) -> P::Id {
        P::Id::new(part.add_to(self.scene_mut()))
    }

    /// Adds an output that is code. A run records it as a column, and [`Simulation::function`](crate::Simulation::function) reads its present
    /// value. Clones of the mechanism share the function. A mechanism with such an output cannot be written as text. [`check`](Self::check)
    /// refuses a name that another column has.
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

    /// Finds the handle of a named part: `m.find::<JointId>("elbow")`. A guide or an initial condition has the name of its joint or body.
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

    /// Removes all initial conditions. The mechanism then starts without velocity, in its reference configuration.
    pub fn clear_initial_conditions(&mut self) -> &mut Self {
        self.scene_mut().initials.clear();
        self
    }

    /// Returns the name of a part; the name of the ground is `ground`.
    ///
    /// # Panics
    /// For a handle of another mechanism whose index is out of range.
    pub fn name<I: Id>(&self, id: I) -> &str {
        match id.place() {
            Some(index) => I::name(&I::parts(&self.scene)[index], &self.scene),
            None => "ground",
        }
    }

    /// Handles of all parts of a kind: `m.ids::<BodyId>()`. The ground is not among the bodies.
    pub fn ids<I: Id>(&self) -> impl ExactSizeIterator<Item = I> + use<I> {
        (0..I::parts(&self.scene).len()).map(I::new)
    }

    /// The data of a part.
    ///
    /// # Panics
    /// For the ground, and for a handle of another mechanism whose index is out of range.
    pub fn part<I: Id>(&self, id: I) -> &I::Part {
        &I::parts(&self.scene)[id.place().unwrap_or(usize::MAX)]
    }

    /// Returns the data of a part for changes.
    ///
    /// # Panics
    /// For the same handles as [`part`](Self::part).
    pub fn part_mut<I: Id>(&mut self, id: I) -> &mut I::Part {
        &mut I::parts_mut(self.scene_mut())[id.place().unwrap_or(usize::MAX)]
    }

    /// Reads a number by its path, in the form that sweeps use: `body.upper.mass`, `joint.tie-rod.points.0.2`.
    ///
    /// # Errors
    /// [`PathError`] for a path that does not exist, or whose value is not a number.
    pub fn get(&self, path: &str) -> Result<f64, PathError> {
        let file = self.data().map_err(PathError::NotWritten)?;
        let fault = |fault| PathError::Path { path: path.to_owned(), fault };
        Ok(file.number(path).map_err(fault)?.to_f64())
    }

    /// Sets a number by its path. The text of a mechanism's file changes at this number only.
    ///
    /// Cost: the scene is read again from the syntax tree of its file; no text is parsed.
    ///
    /// # Errors
    /// Those of [`get`](Self::get), and a number that is not finite. Other invalid values, such as a negative mass, are found by
    /// [`check`](Self::check).
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

    /// Inputs that can be set between steps. Inputs of effects come first, then those of guides, couplings and signals.
    ///
    /// # Errors
    /// Those of [`check`](Self::check).
    pub fn inputs(&self) -> Result<Vec<InputInfo>, SceneError> {
        Ok(Inputs::new(&self.resolve_scene()?).list().to_vec())
    }

    /// Checks the mechanism for all faults that can be found before a model is built.
    ///
    /// # Errors
    /// [`SceneError`] with the part's name and key, and the place in the file where the mechanism was read from one.
    pub fn check(&self) -> Result<(), SceneError> {
        self.resolve_scene().map(|_| ())
    }

    /// Returns the checked scene in `f64`. An error of a mechanism that was read from a file names the place in the file.
    ///
    /// # Errors
    /// [`SimulationError`] for the faults that [`check`](Self::check) finds.
    pub fn resolve(&self) -> Result<Scene<f64>, SimulationError> {
        self.resolve_scene().map_err(|error| self.located(error))
    }

    /// Makes an error of a refused scene. The error names the place in the scene file where the mechanism was read from a file.
    pub(super) fn located(&self, error: SceneError) -> SimulationError {
        match (&self.file, self.data()) {
            (Some(_), Ok(file)) => file.meaning(*error.error()).into(),
            _ => error.into(),
        }
    }

    /// Returns the checked scene in `f64`.
    pub(crate) fn resolve_scene(&self) -> Result<Scene<f64>, SceneError> {
        self.resolved()
    }

    /// Returns the checked scene in a given precision.
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

    /// Names of the columns of a run: outputs of the scene, then outputs that are code. A scene without outputs records its joints.
    fn columns(&self) -> impl Iterator<Item = &String> {
        let Scene { outputs, joints, .. } = &self.scene;
        let joints = if outputs.is_empty() { &joints[..] } else { &[] };
        let data = outputs.iter().map(|o| &o.name).chain(joints.iter().map(|joint| &joint.name));
        data.chain(self.functions.iter().map(|f| &f.name))
    }

    /// Checks that no output that is code has an empty or reserved name, or the name of an earlier column.
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

    /// Returns the scene for changes, and marks the mechanism as changed.
    pub(crate) fn scene_mut(&mut self) -> &mut Scene<Number> {
        self.is_changed = true;
        &mut self.scene
    }

    /// Returns the scene file of this mechanism in its present state.
    ///
    /// # Errors
    /// [`WriteError`] where a part of the mechanism is code.
    pub fn to_file(&self) -> Result<SceneFile, WriteError> {
        match self.functions.first() {
            Some(function) => Err(WriteError::InCode(format!("output `{}`", function.name))),
            None => self.data().map(Cow::into_owned),
        }
    }

    /// Returns the scene file of the mechanism without the outputs that are code.
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
