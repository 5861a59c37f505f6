//! Sources of mechanisms: files and texts of scenes, and models with the options of their import.

use crate::error::{raised, unread, usage};
use crate::value;
use mbs::SimulationError;
use mbs::models::{
    self, BaseKind, FileCoordinate, FileMotion, ImportOptions, Imported, ModelFormat, Stops,
};
use mbs::scene_file::{ReadError, SceneFile};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Model that was imported: the name that messages show, and what became of its elements.
pub(crate) type Model = (String, Imported);

/// Contents of a source: its scene, the folder where it lies, and the model that it was.
pub(crate) struct Read {
    pub(crate) file: SceneFile,
    pub(crate) folder: Option<PathBuf>,
    /// The model that it was.
    pub(crate) model: Option<Arc<Model>>,
}

/// The scene of a source: a path, a text of more than one line, or a scene as a dict.
pub(crate) fn read(
    source: &Bound<'_, PyAny>,
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Read> {
    let py = source.py();
    let text = match source.cast::<PyString>() {
        Ok(text) => Some(text.to_string()).filter(|text| text.contains('\n')),
        Err(_) if source.hasattr("keys")? => Some(value::json(source, "source")?),
        Err(_) => None,
    };
    if let Some(text) = text {
        if models::is_model(text.as_bytes()) {
            return model(py, (text.as_bytes(), "model", Path::new("")), options);
        }
        no_options(py, options)?;
        let file = SceneFile::parse(&text, "scene").map_err(|error| unread(py, &error))?;
        return Ok(Read { file, folder: None, model: None });
    }
    let path: PathBuf = source.extract().map_err(|_| {
        let message = format!("a mechanism is made of no {}", source.get_type());
        let hint = "give a path, the text of a scene, or a dict";
        usage(py, "wrong-type", &message, hint, "source")
    })?;
    let folder = path.parent().map(Path::to_owned);
    let folder = folder.and_then(|folder| std::path::absolute(&folder).ok().or(Some(folder)));
    match py.detach(|| std::fs::read(&path)) {
        Ok(bytes) if models::is_model(&bytes) => {
            let home = path.parent().unwrap_or(Path::new(""));
            let read = model(py, (&bytes, &path.display().to_string(), home), options)?;
            Ok(Read { folder, ..read })
        }
        // where it cannot be read, the reader of scenes says why
        _ => {
            no_options(py, options)?;
            let file = py.detach(|| SceneFile::read(&path)).map_err(|error| unread(py, &error))?;
            Ok(Read { file, folder, model: None })
        }
    }
}

/// Options of an import beside a scene are refused.
fn no_options(py: Python<'_>, options: Option<&Bound<'_, PyDict>>) -> PyResult<()> {
    let first = options.and_then(|options| options.keys().iter().next());
    let Some(first) = first else { return Ok(()) };
    let first: String = first.extract()?;
    let message = format!("`{first}` is an option of models, and this is a scene");
    Err(usage(py, "usage", &message, "leave it out, or give a URDF, MJCF or SDF", &first))
}

/// A model, as the options say.
fn model(
    py: Python<'_>,
    (bytes, name, home): (&[u8], &str, &Path),
    options: Option<&Bound<'_, PyDict>>,
) -> PyResult<Read> {
    let refused = |error: ReadError| unread(py, &error);
    let mut taken = ImportOptions::in_folder(home.to_owned());
    if let Some(options) = options.filter(|options| !options.is_empty()) {
        take(options, models::model_format(bytes, name).map_err(refused)?, &mut taken)?;
    }
    let made = py.detach(|| {
        let model = models::import(bytes, name, &taken)?;
        Ok::<_, ReadError>((model.scene_file(name)?, model))
    });
    let (file, model) = made.map_err(refused)?;
    Ok(Read { file, folder: None, model: Some(Arc::new((name.to_owned(), model))) })
}

/// Takes options over, which are to be those of the format.
fn take(given: &Bound<'_, PyDict>, format: ModelFormat, taken: &mut ImportOptions) -> PyResult<()> {
    let py = given.py();
    for (option, value) in given {
        let option: String = option.extract()?;
        if !format.options().contains(&&*option) {
            let message = format!(
                "`{option}` is no option of a file in {}; its options: {}",
                format.name(),
                format.options().join(", ")
            );
            return Err(PyTypeError::new_err(message));
        }
        set(taken, (&option, &value)).map_err(|error| {
            if !error.is_instance_of::<PyTypeError>(py) {
                return error;
            }
            let message = format!("{option} cannot be {value}");
            usage(py, "usage", &message, meaning(&option), &option)
        })?;
    }
    Ok(())
}

/// Returns the hint on the values of an option.
fn meaning(option: &str) -> &'static str {
    match option {
        "base" => "give \"fixed\" or \"free\"",
        "limits" => "give True, or (stiffness, damping)",
        "keep_fixed" => "give a list of names of fixed joints",
        "key" => "give the name of a keyframe",
        "packages" => "give a dict of folders by the names of packages",
        _ => "give True or False",
    }
}

fn set(options: &mut ImportOptions, (option, value): (&str, &Bound<'_, PyAny>)) -> PyResult<()> {
    let wrong = || PyTypeError::new_err("");
    match option {
        "balance" => options.balance = value.extract()?,
        "base" if value.is_none() => {}
        "base" => {
            let word: String = value.extract().map_err(|_| wrong())?;
            options.base = match word.as_str() {
                "fixed" => Some(BaseKind::Fixed),
                "free" => Some(BaseKind::Free),
                _ => return Err(wrong()),
            };
        }
        "keep_fixed" => options.keep_fixed = value.extract().map_err(|_| wrong())?,
        "key" => options.key = value.extract().map_err(|_| wrong())?,
        "limits" => options.limits = limits(value)?,
        "massless_meshes" => options.massless_meshes = value.extract()?,
        "motors" => options.motors = value.extract()?,
        "no_outside" => options.no_outside = value.extract()?,
        _ => options.packages = packages(value)?,
    }
    Ok(())
}

/// Reads the stops of an option: none, those by mass, or a stiffness above zero with a damping of zero or more.
fn limits(value: &Bound<'_, PyAny>) -> PyResult<Option<Stops>> {
    if value.is_none() {
        return Ok(None);
    }
    if let Ok(are_asked) = value.extract::<bool>() {
        return Ok(are_asked.then_some(Stops::ByMass));
    }
    let wrong = || PyTypeError::new_err("");
    let (stiffness, damping): (f64, f64) = value.extract().map_err(|_| wrong())?;
    let is_meant = stiffness > 0.0 && damping >= 0.0 && (stiffness + damping).is_finite();
    if is_meant { Ok(Some(Stops::Given { stiffness, damping })) } else { Err(wrong()) }
}

/// Folders of packages by their names; one that is not there is refused.
fn packages(value: &Bound<'_, PyAny>) -> PyResult<Vec<(String, PathBuf)>> {
    let py = value.py();
    let mut folders = Vec::new();
    for (name, folder) in value::items(value, "packages", meaning("packages"))? {
        let folder: PathBuf = folder.extract()?;
        if !folder.is_dir() {
            let message = format!("package `{name}`: there is no folder {}", folder.display());
            return Err(usage(py, "usage", &message, meaning("packages"), "packages"));
        }
        folders.push((name, folder));
    }
    Ok(folders)
}

/// The object of `mbs import --json`.
pub(crate) fn report<'py>(py: Python<'py>, (name, model): &Model) -> PyResult<Bound<'py, PyAny>> {
    let faults = py.detach(|| mbs_study::imported::start_faults(name, model));
    let refused = |error: SimulationError| raised(py, &error, crate::error::Class::Scene);
    let object = mbs_study::imported::to_json(name, model, faults.map_err(refused)?.as_deref());
    value::object(py, &object)
}

/// The coordinates of a file in its own order, where it is an MJCF.
pub(crate) fn coordinates<'py>(
    py: Python<'py>,
    (_, model): &Model,
) -> Option<PyResult<Bound<'py, PyAny>>> {
    let word = |motion: FileMotion| match motion {
        FileMotion::Single => "single",
        FileMotion::Ball => "ball",
        FileMotion::Free => "free",
    };
    let object = |of: &FileCoordinate| {
        serde_json::json!({
            "motion": word(of.motion), "joint": of.joint, "number": of.number,
            "sign": of.sign, "zero": of.zero, "at": of.at, "turn": of.turn,
        })
    };
    let list = || serde_json::Value::from(model.coordinates.iter().map(object).collect::<Vec<_>>());
    (model.format == ModelFormat::Mjcf).then(|| value::object(py, &list()))
}

/// Warns where something that can act was left out.
pub(crate) fn warn(py: Python<'_>, (name, model): &Model) -> PyResult<()> {
    let ignored = || {
        let kind = models::FindingKind::Ignored;
        model.findings.iter().filter(move |finding| finding.kind == kind)
    };
    let Some(first) = ignored().next() else { return Ok(()) };
    let models::ModelFinding { line, element, says, .. } = first;
    let n = ignored().count();
    let message = format!(
        "{name}: {n} {} that can act left out, the first at line {line}: {element}: {says}; `import_report` lists them",
        if n == 1 { "element" } else { "elements" },
    );
    let class = py.import("multibody.errors")?.getattr("ModelWarning")?;
    py.import("warnings")?.call_method1("warn", (message, class, 1))?;
    Ok(())
}
