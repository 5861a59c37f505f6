//! Runs, as `mbs run` makes them.

use crate::error::{Class, exception, guarded, refused, usage};
use crate::mechanism::Mechanism;
use crate::watch::{Progress, Reached, watched};
use crate::{settings, value};
use mbs::core::scene::{SETTINGS, SettingValue};
use mbs::record::Provenance;
use mbs::{
    Checkpoint, CheckpointWriter, Goal, InputTable, Method, Outcome, ResolvedMethod, Run,
    RunResult, SimulationError, Watchers,
};
use mbs_study::run_with;
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;

/// A run, of which a page can be made.
#[pyclass(frozen, module = "multibody._multibody")]
#[derive(Debug)]
pub(crate) struct Record {
    outcome: Outcome,
    provenance: Provenance,
}

#[pymethods]
impl Record {
    /// The page: HTML that stands alone.
    fn page(&self, py: Python<'_>) -> PyResult<String> {
        let page = || mbs_report::page(&self.outcome.record(self.provenance.clone()));
        guarded(py, || Ok(py.detach(page)))
    }
}

/// The table of inputs: `{"t": [..], "motor": [..]}`.
fn table(inputs: &Bound<'_, PyAny>) -> PyResult<InputTable> {
    let py = inputs.py();
    let (mut times, mut columns) = (None, Vec::new());
    let hint = "give {\"t\": times, NAME: values, ..}";
    for (name, values) in value::items(inputs, "inputs", hint)? {
        let numbers = crate::array::Numbers::new(&values, &name, false)?;
        if numbers.shape().len() != 1 {
            return Err(crate::array::wrong_shape(py, &name, numbers.shape(), "(rows,)"));
        }
        let values = numbers.slice().to_vec();
        if name == "t" {
            times = Some(values);
        } else {
            columns.push((name, values));
        }
    }
    let missing = || usage(py, "inputs-refused", "inputs have no times `t`", hint, "inputs");
    Ok(InputTable::new(times.ok_or_else(missing)?, columns))
}

/// Arguments that the errors of a run are about, by their code.
fn arguments(is_resumed: bool) -> [(&'static str, &'static str); 3] {
    let of_checkpoint = if is_resumed { "resume" } else { "checkpoints" };
    [("goal-refused", "error"), ("inputs-refused", "inputs"), ("checkpoint-refused", of_checkpoint)]
}

/// Sets the settings that ran, for a result that is made anew in another process.
fn set_settings(given: &Bound<'_, PyDict>, ran: &ResolvedMethod) -> PyResult<()> {
    let method = ran.decided();
    for row in &SETTINGS {
        match method.value(row.name) {
            None => Ok(()),
            Some(SettingValue::Word(word)) => given.set_item(row.name, word),
            Some(SettingValue::Number(x)) => given.set_item(row.name, x),
            Some(SettingValue::Pair(pair)) => given.set_item(row.name, pair),
            Some(SettingValue::Flag(is_set)) => given.set_item(row.name, is_set),
            Some(SettingValue::Count(n)) => given.set_item(row.name, n),
        }?;
    }
    given.set_item("duration", ran.duration)
}

/// A result of Python.
fn result<'py>(
    py: Python<'py>,
    result: RunResult,
    again: (&Bound<'py, Mechanism>, &Bound<'py, PyDict>),
) -> PyResult<Bound<'py, PyAny>> {
    let (outcome, settings) = (result.outcome(), result.settings());
    let rows = outcome.rows();
    let [columns, units] = outcome.columns();
    let mut data = vec![0.0; rows.len() * columns.len()];
    for (i, (_, row)) in rows.iter().enumerate() {
        for (k, x) in row.iter().enumerate() {
            data[k * rows.len() + i] = *x;
        }
    }
    let data = data.into_pyarray(py).reshape([columns.len(), rows.len()])?;
    let t: Vec<f64> = rows.iter().map(|(t, _)| *t).collect();
    let failed = |error: serde_json::Error| crate::error::internal(py, &error.to_string());
    let summary = serde_json::to_value(&outcome.summary).map_err(failed)?;
    let error = result.stop().map(|stop| {
        let class = if outcome.summary.steps == 0 { Class::Start } else { Class::Stop };
        exception(py, class, &crate::error::fields(&stop)).into_value(py)
    });
    let provenance = Provenance {
        precision: settings.precision.name().to_owned(),
        formulation: settings.formulation.name().to_owned(),
        integrator: settings.integrator.name().to_owned(),
        step: mbs::words::steps(&outcome.summary.method_used),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        ..Provenance::default()
    };
    let mut notes = outcome.notes().to_vec();
    if let Some(error) = result.checkpoints().and_then(CheckpointWriter::failure) {
        notes.push(format!("the last checkpoint could not be written: {error}"));
    }
    let record = Record { outcome: result.into_outcome(), provenance };
    let fields = (
        t.into_pyarray(py),
        data,
        columns,
        units,
        value::object(py, &summary)?,
        notes,
        error,
        record,
        again,
    );
    py.import("multibody.result")?.getattr("Result")?.call1(fields)
}

#[pymethods]
impl Mechanism {
    /// Runs the mechanism, as `mbs run` does. None leaves a setting to the scene; `error` chooses the method by a pilot. `inputs` is
    /// `{"t": times, NAME: values}`. `progress` is called with time and duration [s], at most ten times a second. A run that stops early is a
    /// result with `error`. Ctrl-C raises KeyboardInterrupt, whose `result` has what was recorded; None where a method was still sought.
    ///
    /// `checkpoints` is a folder and the simulated time between two checkpoints [s]; the last one, `checkpoint.mbs`, stays there, and the next
    /// run replaces it. `resume` is such a file.
    #[pyo3(signature = (duration = None, *, error = None, inputs = None, progress = None, checkpoints = None, resume = None, **settings))]
    #[allow(clippy::too_many_arguments, reason = "they are keywords of Python")]
    fn run<'py>(
        slf: &Bound<'py, Self>,
        duration: Option<f64>,
        error: Option<f64>,
        inputs: Option<&Bound<'py, PyAny>>,
        progress: Option<&Bound<'py, PyAny>>,
        checkpoints: Option<(PathBuf, f64)>,
        resume: Option<PathBuf>,
        settings: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (py, shared) = (slf.py(), &slf.get().shared);
        let given = settings.map_or_else(|| Ok(PyDict::new(py)), |settings| settings.copy())?;
        let (method, estimate) = settings::method(&given)?;
        let (method, flag) = settings::interruptible(Method { duration, ..method });
        given.set_item("duration", duration)?;
        given.set_item("error", error)?;
        given.set_item("inputs", inputs)?;
        let is_resumed = resume.is_some();
        let refuse = |error| refused(py, &error, Class::Start, &arguments(is_resumed));
        let resume = resume.map(|file| Checkpoint::open(&file)).transpose();
        let options = Run {
            method,
            goal: Goal { error, deadline: None },
            inputs: inputs.map(table).transpose()?,
            resume: resume.map_err(|error| refuse(SimulationError::not_resumed(error)))?,
            checkpoints,
            estimate,
            ..Run::new()
        };
        let reached = Reached::default();
        let progress = Progress { call: progress, counts: false, reached: &reached };
        let of_checkpoint = options.resume.as_ref().map(|from| from.overrides(&options.method));
        let of_checkpoint = of_checkpoint.and_then(Result::ok).and_then(|method| method.duration);
        let duration = of_checkpoint.or(duration).unwrap_or(shared.scene.duration);
        let (done, raised_by) = watched(py, &flag, &progress, || {
            let mut look = |t: f64| reached.set(t, duration);
            run_with(&shared.mechanism, &options, &mut Watchers::progress(&mut look))
        })?;
        match done {
            Ok(done) => {
                if is_resumed {
                    set_settings(&given, done.settings())?;
                }
                let result = result(py, done, (slf, &given))?;
                match raised_by {
                    Some(error) => {
                        error.value(py).setattr("result", result)?;
                        Err(error)
                    }
                    None => Ok(result),
                }
            }
            Err(error) => Err(match raised_by {
                // the choice of a method was interrupted: there is no run
                Some(interrupt) => {
                    interrupt.value(py).setattr("result", py.None())?;
                    interrupt
                }
                None => refuse(error),
            }),
        }
    }
}
