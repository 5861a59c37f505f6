//! `Mechanism`: a checked scene, immutable and shared.

use crate::array::{Numbers, array, count, vector, wrong_shape};
use crate::error::{Class, guarded, raised, refused, unknown_name, unread, usage};
use crate::forces::Forces;
use crate::import::{self, Model, Read};
use crate::value;
use crate::values;
use mbs::core::scene::{Output, Scene};
use mbs::record::Channel;
use mbs::scene_file::SceneFile;
use mbs::{BodyId, EffectId, InputInfo, JointId, Method, SimulationError, Tree, TreeRange};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PySlice, PyString, PyTuple};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// A mechanism, checked and immutable. Threads may share it.
#[pyclass(frozen, weakref, module = "multibody")]
#[derive(Debug, Clone)]
pub(crate) struct Mechanism {
    pub(crate) shared: Arc<Shared>,
}

/// Parts of a mechanism that its copies share.
#[derive(Debug)]
pub(crate) struct Shared {
    pub(crate) mechanism: mbs::Mechanism,
    pub(crate) file: SceneFile,
    pub(crate) scene: Scene<f64>,
    pub(crate) inputs: Vec<InputInfo>,
    /// Names of the outputs with their units: the columns of runs but for magnitudes.
    pub(crate) columns: Vec<[String; 2]>,
    pub(crate) folder: Option<PathBuf>,
    pub(crate) model: Option<Arc<Model>>,
    pub(crate) forces: Forces,
    dof: OnceLock<usize>,
    /// Tree at rest in the reference configuration.
    first: OnceLock<Tree>,
    /// Trees that are not in use.
    trees: Mutex<Vec<Tree>>,
}

impl Mechanism {
    /// The mechanism of a scene file, checked.
    pub(crate) fn new(py: Python<'_>, read: Read) -> PyResult<Self> {
        Self::with(py, read, Forces::default())
    }

    /// The mechanism of a scene file, some inputs of which are external forces.
    pub(crate) fn with(py: Python<'_>, read: Read, forces: Forces) -> PyResult<Self> {
        let Read { file, folder, model } = read;
        let scene = file.scene::<f64>().map_err(|error| unread(py, &error))?;
        let mechanism =
            mbs::Mechanism::of_file(file.clone()).map_err(|error| unread(py, &error))?;
        let refused = |error| raised(py, &SimulationError::from(error), Class::Scene);
        let inputs = mechanism.inputs().map_err(refused)?;
        let unit = |component: &mbs::core::outputs::Component| component.unit.clone();
        let columns = channels(&scene).into_iter().flat_map(|channel| {
            let units: Vec<String> = channel.components.iter().map(unit).collect();
            channel.columns().zip(units).map(|(name, unit)| [name, unit]).collect::<Vec<_>>()
        });
        let columns = columns.collect();
        let (dof, first) = (OnceLock::new(), OnceLock::new());
        let trees = Mutex::new(Vec::new());
        let shared = Shared {
            mechanism,
            file,
            scene,
            inputs,
            columns,
            folder,
            model,
            forces,
            dof,
            first,
            trees,
        };
        Ok(Self { shared: Arc::new(shared) })
    }

    /// The tree at rest in the reference configuration.
    pub(crate) fn first(&self, py: Python<'_>) -> PyResult<&Tree> {
        if let Some(first) = self.shared.first.get() {
            return Ok(first);
        }
        let built = guarded(py, || Ok(self.shared.mechanism.tree()))?;
        let first = built.map_err(|error| raised(py, &error, Class::Start))?;
        Ok(self.shared.first.get_or_init(|| first))
    }

    /// Works with a tree of its own, at time zero with the inputs as they begin.
    pub(crate) fn with_tree<R>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut Tree) -> R,
    ) -> PyResult<R> {
        let first = self.first(py)?;
        let trees = || self.shared.trees.lock().unwrap_or_else(PoisonError::into_inner);
        let spare = trees().pop();
        let mut tree = spare.unwrap_or_else(|| first.clone());
        tree.reset();
        let done = guarded(py, || Ok(work(&mut tree)))?;
        trees().push(tree);
        Ok(done)
    }

    /// The text of the scene: its file's own, or with the files that it includes.
    pub(crate) fn text_of(&self) -> PyResult<String> {
        let file = &self.shared.file;
        if file.files().count() <= 1 {
            return Ok(file.text().to_owned());
        }
        serde_json::to_string(file).map_err(|error| PyTypeError::new_err(error.to_string()))
    }

    pub(crate) fn joint(&self, py: Python<'_>, name: &str) -> PyResult<JointId> {
        let joints = &self.shared.scene.joints;
        let place = joints.iter().position(|joint| joint.name == name);
        place.map(JointId::new).ok_or_else(|| {
            let known: Vec<&str> = joints.iter().map(|joint| joint.name.as_str()).collect();
            unknown_name(py, ["joint", "joints"], ("joint", name), &known)
        })
    }

    pub(crate) fn body(&self, py: Python<'_>, name: &str) -> PyResult<BodyId> {
        if name == "ground" {
            return Ok(BodyId::Ground);
        }
        let bodies = &self.shared.scene.bodies;
        let place = bodies.iter().position(|body| body.name == name);
        place.map(BodyId::new).ok_or_else(|| {
            let known: Vec<&str> = bodies.iter().map(|body| body.name.as_str()).collect();
            unknown_name(py, ["body", "bodies"], ("body", name), &known)
        })
    }

    pub(crate) fn effect(&self, py: Python<'_>, name: &str) -> PyResult<EffectId> {
        let effects = &self.shared.scene.effects;
        let place = effects.iter().position(|effect| effect.name == name);
        place.map(EffectId::new).ok_or_else(|| {
            let known: Vec<&str> = effects.iter().map(|effect| effect.name.as_str()).collect();
            unknown_name(py, ["effect", "effects"], ("effect", name), &known)
        })
    }

    /// Number of an input, by name or place.
    pub(crate) fn input(&self, input: &Bound<'_, PyAny>) -> PyResult<usize> {
        let (py, list) = (input.py(), &self.shared.inputs);
        if let Ok(name) = input.cast::<PyString>() {
            let name = name.to_string();
            let place = list.iter().position(|info| info.name == name);
            return place.ok_or_else(|| {
                let known: Vec<&str> = list.iter().map(|info| info.name.as_str()).collect();
                unknown_name(py, ["input", "inputs"], ("name", &name), &known)
            });
        }
        let place = count(py, "name", input.extract()?)?;
        if place < list.len() {
            return Ok(place);
        }
        let message = format!("input {place} of {}", list.len());
        Err(usage(py, "unknown-name", &message, "inputs count from 0", "name"))
    }

    /// The simulation of settings.
    pub(crate) fn simulation(&self, py: Python<'_>, method: &Method) -> PyResult<mbs::Simulation> {
        let built = guarded(py, || Ok(py.detach(|| self.shared.mechanism.simulate(method))))?;
        built.map_err(|error| raised(py, &error, Class::Start))
    }

    /// The state of a simulation.
    pub(crate) fn state_of<'py>(
        &self,
        py: Python<'py>,
        simulation: &mbs::Simulation,
    ) -> PyResult<Bound<'py, PyAny>> {
        let state = self.with_tree(py, |tree| {
            tree.follow(simulation)?;
            Ok::<_, mbs::TreeError>((tree.coordinates().to_vec(), tree.velocities().to_vec()))
        })?;
        let (q, v) = state.map_err(|error| raised(py, &error.into(), Class::Usage))?;
        values::state(py, q, v)
    }
}

/// The channels of a scene without magnitudes, in the order of its columns.
pub(crate) fn channels(scene: &Scene<f64>) -> Vec<Channel> {
    let outputs = scene.channels().into_iter().map(|o| Output { magnitude: false, ..o });
    Channel::of_outputs(outputs, scene)
}

/// Codes of joints without coordinates.
const OF_JOINTS: [(&str, &str); 3] =
    [("cut-joint", "joint"), ("guided-joint", "joint"), ("no-coordinates", "joint")];

/// Names of the parts of a list.
macro_rules! names {
    ($of:expr) => {
        $of.iter().map(|part| part.name.clone()).collect()
    };
}

#[pymethods]
impl Mechanism {
    #[new]
    #[pyo3(signature = (source, **import_options))]
    fn py_new(
        source: &Bound<'_, PyAny>,
        import_options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let py = source.py();
        guarded(py, || {
            let read = import::read(source, import_options)?;
            if let Some(model) = &read.model {
                import::warn(py, model)?;
            }
            Self::new(py, read)
        })
    }

    /// A builder of a scene: its parts are added by calls, and `done()` gives the mechanism.
    #[staticmethod]
    #[pyo3(signature = (name, dimension = 3))]
    fn build<'py>(py: Python<'py>, name: &str, dimension: u8) -> PyResult<Bound<'py, PyAny>> {
        py.import("multibody.builder")?.getattr("Builder")?.call1((name, dimension))
    }

    /// The scene's name.
    #[getter]
    fn name(&self) -> &str {
        &self.shared.scene.name
    }

    /// 2 or 3.
    #[getter]
    fn dimension(&self) -> usize {
        self.shared.scene.dimension.count()
    }

    /// Names of the bodies.
    #[getter]
    fn bodies(&self) -> Vec<String> {
        names!(self.shared.scene.bodies)
    }

    /// Names of the joints.
    #[getter]
    fn joints(&self) -> Vec<String> {
        names!(self.shared.scene.joints)
    }

    /// Names of the effects.
    #[getter]
    fn effects(&self) -> Vec<String> {
        names!(self.shared.scene.effects)
    }

    /// Names of the frames.
    #[getter]
    fn frames(&self) -> Vec<String> {
        names!(self.shared.scene.frames)
    }

    /// Names of the inputs, in the order of `u`.
    #[getter]
    fn inputs(&self) -> Vec<String> {
        names!(self.shared.inputs)
    }

    /// Units of the inputs.
    #[getter]
    fn input_units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        self.shared.inputs.iter().try_for_each(|info| dict.set_item(&info.name, &info.unit))?;
        Ok(dict)
    }

    /// Names of the outputs: the columns of runs, without magnitudes.
    #[getter]
    fn outputs(&self) -> Vec<String> {
        self.shared.columns.iter().map(|[name, _]| name.clone()).collect()
    }

    /// Units of the outputs.
    #[getter]
    fn output_units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        self.shared.columns.iter().try_for_each(|[name, unit]| dict.set_item(name, unit))?;
        Ok(dict)
    }

    /// Numbers in q.
    #[getter]
    fn nq(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.first(py)?.coordinates().len())
    }

    /// Numbers in v.
    #[getter]
    fn nv(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(self.first(py)?.velocities().len())
    }

    /// Number of inputs.
    #[getter]
    fn nu(&self) -> usize {
        self.shared.inputs.len()
    }

    /// Freedoms at the start: loops and guides take some of v.
    #[getter]
    fn dof(&self, py: Python<'_>) -> PyResult<usize> {
        if let Some(dof) = self.shared.dof.get() {
            return Ok(*dof);
        }
        let simulation = self.simulation(py, &Method::default())?;
        Ok(*self.shared.dof.get_or_init(|| simulation.sizes().freedoms()))
    }

    /// Length of a run that the scene asks for [s].
    #[getter]
    fn duration(&self) -> f64 {
        self.shared.mechanism.duration().unwrap_or(1.0)
    }

    /// The text of the scene.
    #[getter]
    fn text(&self) -> PyResult<String> {
        self.text_of()
    }

    /// The scene as a dict.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let value = serde_json::to_value(&self.shared.file);
        value::object(py, &value.map_err(|error| PyTypeError::new_err(error.to_string()))?)
    }

    /// Where the numbers of a joint stand in q and in v. A joint that closes a loop, or is guided, has none: UsageError.
    fn coordinates<'py>(
        &self,
        py: Python<'py>,
        joint: &str,
    ) -> PyResult<(Bound<'py, PySlice>, Bound<'py, PySlice>)> {
        let first = self.first(py)?;
        let place = self.joint(py, joint);
        let range = match &place {
            Ok(joint) => first.coordinates_of(*joint),
            // a free body goes by its own name
            Err(_) => match self.body(py, joint).ok().and_then(|b| first.free_coordinates_of(b)) {
                Some(range) => Ok(range),
                None => return Err(place.err().unwrap_or_else(|| PyTypeError::new_err("joint"))),
            },
        };
        let TreeRange { q, v, .. } =
            range.map_err(|error| refused(py, &error.into(), Class::Usage, &OF_JOINTS))?;
        let slice = |range: core::ops::Range<usize>| {
            PySlice::new(py, range.start.cast_signed(), range.end.cast_signed(), 1)
        };
        Ok((slice(q), slice(v)))
    }

    /// A number of the scene by its path: `body.upper.mass`.
    fn get(&self, py: Python<'_>, path: &str) -> PyResult<f64> {
        let found = self.shared.mechanism.get(path);
        let of_path = [("unknown-path", "path")];
        found.map_err(|error| refused(py, &error.into(), Class::Usage, &of_path))
    }

    /// The mechanism with other numbers, by their paths: `m.replace({"body.upper.mass": 2.0})`.
    #[pyo3(signature = (values = None, **paths))]
    fn replace(
        &self,
        py: Python<'_>,
        values: Option<&Bound<'_, PyAny>>,
        paths: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let mut all = Vec::new();
        for given in [values, paths.map(|paths| paths.as_any())].into_iter().flatten() {
            for (path, value) in value::items(given, "values", "give numbers by their paths")? {
                let number = Numbers::new(&value, &path, false)?;
                if !number.shape().is_empty() {
                    return Err(wrong_shape(py, &path, number.shape(), "()"));
                }
                all.extend(number.slice().iter().map(|x| (path.clone(), *x)));
            }
        }
        guarded(py, || {
            let mut mechanism = self.shared.mechanism.clone();
            for (path, value) in all {
                let set = mechanism.set(&path, value);
                let of_values = [("unknown-path", "values"), ("not-finite", "values")];
                set.map_err(|error| refused(py, &error.into(), Class::Usage, &of_values))?;
            }
            let file = mechanism.to_file();
            let file = file.map_err(|error| raised(py, &error.into(), Class::Usage))?;
            let (folder, model) = (self.shared.folder.clone(), self.shared.model.clone());
            Self::new(py, Read { file, folder, model })
        })
    }

    /// The reference configuration at rest.
    fn reference<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let first = self.first(py)?;
        values::state(py, first.coordinates().to_vec(), first.velocities().to_vec())
    }

    /// The state in which runs begin.
    fn initial<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let simulation = self.simulation(py, &Method::default())?;
        self.state_of(py, &simulation)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyTuple>> {
        let (py, this) = (slf.py(), slf.get());
        let restore = py.import("multibody._multibody")?.getattr("_restore")?;
        let version = env!("CARGO_PKG_VERSION");
        let shared = &this.shared;
        let folder = shared.folder.as_ref().map(|folder| folder.display().to_string());
        let arguments = (version, this.text_of()?, shared.file.file(), folder);
        (restore, arguments).into_pyobject(py)
    }

    fn __copy__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: PyRef<'py, Self>, _memo: &Bound<'_, PyAny>) -> PyRef<'py, Self> {
        slf
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.shared.mechanism == other.shared.mechanism
    }

    fn __hash__(&self) -> u64 {
        // equal mechanisms may have other texts
        let scene = &self.shared.scene;
        let names = scene.bodies.iter().map(|body| &body.name);
        let names = names.chain(scene.joints.iter().map(|joint| &joint.name));
        let text = names.fold(scene.name.clone(), |text, name| text + "\n" + name);
        mbs::inside::fingerprint(text.as_bytes())
    }

    fn __repr__(&self) -> String {
        let scene = &self.shared.scene;
        let (bodies, joints) = (scene.bodies.len(), scene.joints.len());
        format!("<Mechanism `{}`: {bodies} bodies, {joints} joints>", scene.name)
    }
}

/// A mechanism from what was pickled.
#[pyfunction]
pub(crate) fn _restore(
    py: Python<'_>,
    version: &str,
    text: &str,
    file: &str,
    folder: Option<PathBuf>,
) -> PyResult<Mechanism> {
    if version != env!("CARGO_PKG_VERSION") {
        let message = format!(
            "a mechanism of version {version}, and this is version {}",
            env!("CARGO_PKG_VERSION")
        );
        return Err(usage(py, "checkpoint-refused", &message, "pickle it anew", "version"));
    }
    let read = match &folder {
        Some(folder) => SceneFile::parse_in(text, file, folder),
        None => SceneFile::parse(text, file),
    };
    let file = read.map_err(|error| unread(py, &error))?;
    Mechanism::new(py, Read { file, folder, model: None })
}

/// An array of a list of vectors.
pub(crate) fn pair<'py>(
    py: Python<'py>,
    [a, b]: [[f64; 3]; 2],
) -> (Bound<'py, PyAny>, Bound<'py, PyAny>) {
    (vector(py, &a), vector(py, &b))
}

/// Position and rotation (3, 3).
pub(crate) fn pose<'py>(
    py: Python<'py>,
    pose: &mbs::Pose,
) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
    let rotation = pose.rotation.iter().flatten().copied().collect();
    Ok((vector(py, &pose.position), array(py, rotation, &[3, 3])?))
}
