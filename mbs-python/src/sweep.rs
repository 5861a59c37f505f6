//! Sweeps: many runs with varied numbers, here or on other machines.

use crate::array::count;
use crate::error::{Class, Fields, exception, guarded, raised, unread, usage};
use crate::mechanism::Mechanism;
use crate::watch::{Progress, Reached, whole};
use crate::{settings, value};
use core::num::NonZeroUsize;
use mbs::scene_file::SceneFile;
use mbs_study::sweep::{self, Study, StudyError, SweepError, SweepTask};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString, PyTuple};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};

/// A sweep of a mechanism, checked; its members are independent of each other and of who runs them.
#[pyclass(frozen, module = "multibody._multibody")]
#[derive(Debug)]
pub(crate) struct Sweep {
    study: Study,
    flag: Arc<AtomicBool>,
    mechanism: Py<Mechanism>,
    source: Source,
    settings: Py<PyDict>,
}

/// Text of a sweep, its name in messages, and the folder of its file, where what it includes lies.
type Source = (String, String, Option<PathBuf>);

/// Rows of a sweep that are there.
#[pyclass(frozen, module = "multibody._multibody")]
#[derive(Debug)]
pub(crate) struct Collection {
    sweep: Py<Sweep>,
    rows: Mutex<Option<sweep::Collection>>,
}

/// A sweep that is refused.
fn refused(py: Python<'_>, error: StudyError) -> PyErr {
    match error {
        StudyError::Read(error) => unread(py, &error),
        StudyError::Settings(error) => raised(py, &error.into(), Class::Usage),
        other => {
            let hint = "leave the setting out, or the path";
            usage(py, "settings-refused", &other.to_string(), hint, "settings")
        }
    }
}

/// A sweep that could not be made.
fn failed(py: Python<'_>, error: &SweepError) -> PyErr {
    let journal = Some("journal");
    let (code, hint, argument) = match error {
        SweepError::Threads(_) => ("settings-refused", "give fewer threads", Some("threads")),
        SweepError::Journal(_) => ("journal-refused", "give another directory", journal),
        SweepError::Write(_) => ("out-unwritable", "give a directory that can be written", journal),
        SweepError::Interrupted(_) => ("interrupted", "the same call continues it", None),
        _ => ("parts-refused", "join the parts of one sweep", journal),
    };
    let fields = Fields {
        code: code.to_owned(),
        message: error.to_string(),
        hint: hint.to_owned(),
        argument: argument.map(str::to_owned),
        ..Fields::default()
    };
    exception(py, Class::Usage, &fields)
}

/// Reports how many members are done.
struct Watched<'a>(&'a Reached);

impl sweep::Watch for Watched<'_> {
    #[allow(clippy::cast_precision_loss, reason = "members are fewer than 2^53")]
    fn finished(&mut self, done: usize, _failed: usize, members: usize) {
        self.0.set(done as f64, members as f64);
    }
}

impl Sweep {
    fn make(
        mechanism: &Bound<'_, Mechanism>,
        (file, folder): (SceneFile, Option<PathBuf>),
        settings: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let py = mechanism.py();
        let (method, _) = settings::method(settings)?;
        let (method, flag) = settings::interruptible(method);
        let source = (file.text().to_owned(), file.file().to_owned(), folder);
        let file = file.into();
        let scene = mechanism.get().shared.file.clone();
        let study =
            guarded(py, || Study::new(scene, &file, &method).map_err(|error| refused(py, error)))?;
        Ok(Self {
            study,
            flag,
            mechanism: mechanism.clone().unbind(),
            source,
            settings: settings.clone().unbind(),
        })
    }

    /// Runs what is missing over threads, with a journal in a directory, or without.
    fn over_threads(
        &self,
        py: Python<'_>,
        (threads, journal): (usize, Option<PathBuf>),
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Vec<Vec<String>>> {
        let (threads, reached) = (NonZeroUsize::new(threads), Reached::default());
        let progress = Progress { call: progress, counts: true, reached: &reached };
        let done = whole(py, &self.flag, &progress, || match &journal {
            Some(out) => {
                let task = SweepTask { out, threads, anew: false, part: None };
                let report = self.study.run(&task, &mut Watched(&reached))?;
                report.lost.map_or(Ok(report.rows), |lost| Err(SweepError::Write(lost)))
            }
            None => {
                let rows = self.study.rows(threads, &mut Watched(&reached));
                let cells = |rows: Vec<sweep::Row>| {
                    rows.iter().map(|row| self.study.columns().cells(row)).collect()
                };
                rows.map(cells).map_err(SweepError::Threads)
            }
        })?;
        done.map_err(|error| failed(py, &error))
    }
}

#[pymethods]
impl Sweep {
    /// Number of members.
    #[getter]
    fn n_members(&self) -> usize {
        self.study.n_members()
    }

    /// Names of the columns.
    #[getter]
    fn columns(&self) -> Vec<String> {
        self.study.columns().header().to_vec()
    }

    /// Runs members, from 0, one after the other; a row of cells for each.
    fn run(&self, py: Python<'_>, members: Vec<usize>) -> PyResult<Vec<Vec<String>>> {
        let n = self.study.n_members();
        if let Some(member) = members.iter().find(|member| **member >= n) {
            let message = format!("member {member} of {n}");
            return Err(usage(py, "wrong-shape", &message, "members count from 0", "members"));
        }
        guarded(py, || {
            Ok(py.detach(|| {
                let cells =
                    |&member: &usize| self.study.columns().cells(&self.study.member(member));
                members.iter().map(cells).collect()
            }))
        })
    }

    /// The row of a member whose workers ended before it did.
    fn lost(&self, member: usize) -> Vec<String> {
        self.study.columns().cells(&self.study.lost(member.min(self.study.n_members() - 1)))
    }

    /// Rows in a directory, which continue an earlier start, or in memory.
    #[pyo3(signature = (journal = None))]
    fn collect(slf: &Bound<'_, Self>, journal: Option<PathBuf>) -> PyResult<Collection> {
        let py = slf.py();
        let rows = slf.get().study.collect(journal.as_deref(), false);
        let rows = rows.map_err(|error| failed(py, &error))?;
        Ok(Collection { sweep: slf.clone().unbind(), rows: Mutex::new(Some(rows)) })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyTuple>> {
        let (py, this) = (slf.py(), slf.get());
        let restore = py.import("multibody._multibody")?.getattr("_restore_sweep")?;
        let mechanism = this.mechanism.clone_ref(py);
        (restore, (mechanism, &this.source, this.settings.clone_ref(py))).into_pyobject(py)
    }
}

/// A sweep from what was pickled.
#[pyfunction]
pub(crate) fn _restore_sweep(
    mechanism: &Bound<'_, Mechanism>,
    source: Source,
    settings: &Bound<'_, PyDict>,
) -> PyResult<Sweep> {
    let (text, name, folder) = source;
    let file = match &folder {
        Some(folder) => SceneFile::parse_in(&text, &name, folder),
        None => SceneFile::parse(&text, &name),
    };
    let file = file.map_err(|error| unread(mechanism.py(), &error))?;
    Sweep::make(mechanism, (file, folder), settings)
}

#[pymethods]
impl Collection {
    /// Members, from 0, that have no row.
    fn missing(&self) -> Vec<usize> {
        let rows = self.rows.lock().unwrap_or_else(PoisonError::into_inner);
        let n = self.sweep.get().study.n_members();
        rows.as_ref().map_or_else(Vec::new, |rows| rows.missing(n))
    }

    /// Takes a row; it is in the journal then.
    fn take(&self, py: Python<'_>, row: Vec<String>) -> PyResult<()> {
        let mut rows = self.rows.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(rows) = rows.as_mut() else { return Err(over(py)) };
        self.sweep.get().study.take(rows, row).map_err(|error| failed(py, &error))
    }

    /// All rows, in the order of the members; writes the table into the directory.
    fn finish(&self, py: Python<'_>) -> PyResult<Vec<Vec<String>>> {
        let rows = self.rows.lock().unwrap_or_else(PoisonError::into_inner).take();
        let Some(rows) = rows else { return Err(over(py)) };
        let report = self.sweep.get().study.report_of(rows, NonZeroUsize::MIN, true);
        match report.lost {
            Some(lost) => Err(failed(py, &SweepError::Write(lost))),
            None => Ok(report.rows),
        }
    }
}

/// Refuses a collection that was finished.
fn over(py: Python<'_>) -> PyErr {
    usage(py, "wrong-order", "the collection is finished", "collect anew", "finish")
}

#[pymethods]
impl Mechanism {
    /// Runs the mechanism with all values of a sweep: the path of a file, its text, or a dict. `journal` is a directory in which a killed sweep
    /// continues. `client` is a client of Dask, or "ray": members then run there. Threads 0: all processors.
    #[pyo3(signature = (spec, *, threads = 0, client = None, journal = None, progress = None, **settings))]
    #[allow(clippy::too_many_arguments, reason = "they are keywords of Python")]
    fn sweep<'py>(
        slf: &Bound<'py, Self>,
        spec: &Bound<'py, PyAny>,
        threads: i64,
        client: Option<&Bound<'py, PyAny>>,
        journal: Option<PathBuf>,
        progress: Option<&Bound<'py, PyAny>>,
        settings: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = slf.py();
        let threads = count(py, "threads", threads)?;
        let unnamed = |text: String| (SceneFile::parse(&text, "sweep"), None);
        let (file, folder) = match spec.cast::<PyString>() {
            Ok(text) if text.to_string().contains('\n') => unnamed(text.to_string()),
            Err(_) if spec.hasattr("keys")? => unnamed(value::json(spec, "spec")?),
            _ => {
                let path: PathBuf = spec.extract().map_err(|_| {
                    let message = format!("a sweep is made of no {}", spec.get_type());
                    usage(py, "wrong-type", &message, "give a path, a text, or a dict", "spec")
                })?;
                (SceneFile::read(&path), path.parent().map(Path::to_owned))
            }
        };
        let file = file.map_err(|error| unread(py, &error))?;
        let settings = settings.map_or_else(|| Ok(PyDict::new(py)), |settings| settings.copy())?;
        let sweep = Sweep::make(slf, (file, folder), &settings)?;
        let columns = sweep.columns();
        let rows = match client {
            Some(client) => {
                let parallel = py.import("multibody.parallel")?.getattr("sweep")?;
                let journal = journal.map(|path| path.display().to_string());
                parallel.call1((sweep, client, journal, progress))?
            }
            None => {
                let rows = sweep.over_threads(py, (threads, journal), progress)?;
                rows.into_pyobject(py)?.into_any()
            }
        };
        crate::values::make(py, "Table", (columns, rows))
    }
}
