//! Runs, as `mbs run` makes them.

use crate::error::{Class, exception, guarded, no_inputs, raised, unread, usage};
use crate::mechanism::Mechanism;
use crate::watch::{Progress, Reached, watched};
use crate::{settings, value};
use mbs::core::scene::Scene;
use mbs::record::Provenance;
use mbs::scene_file::SceneFile;
use mbs::{Method, Names, Outcome, ResolvedMethod, SimulationError, run_document};
use mbs_study::auto::{Goal, PlanError, Processor, plan, run_plan};
use mbs_study::estimate::estimate;
use mbs_study::remedy::name_what_runs;
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::fmt::Write;

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

/// Why a run did not begin.
enum Refused {
    Error(SimulationError),
    Goal(String, String),
}

impl From<mbs::PrecisionError> for Refused {
    fn from(error: mbs::PrecisionError) -> Self {
        Self::Error(error.into())
    }
}

/// Runs a scene as its settings say, or as a pilot finds.
fn go(
    (file, scene): (&SceneFile, &Scene<f64>),
    (method, has_estimate): (&Method, bool),
    error: Option<f64>,
    reached: &Reached,
) -> Result<(Outcome, ResolvedMethod), Refused> {
    let mut clock = Processor::new(method.threads.unwrap_or(1));
    let settings = ResolvedMethod::new(scene, method)
        .and_then(|settings| settings.check_step(scene, method).map(|()| settings));
    let settings = settings.map_err(|error| Refused::Error(error.into()))?;
    let goal = Goal { error, deadline: None };
    let duration = settings.duration;
    let mut look = |t: f64| reached.set(t, duration);
    let pilot = &mut Processor::new(settings.threads);
    let plan =
        plan((file, scene), (method, settings), goal, pilot).map_err(|error| match error {
            PlanError::Goal(error) => Refused::Goal(error.to_string(), error.hint().to_owned()),
            PlanError::Read(error) => Refused::Error(error.into()),
            other => Refused::Goal(other.render(), String::new()),
        })?;
    let settings = plan.first();
    if settings.choice.is_some() {
        return Ok(run_plan((file, scene), &plan, &mut look)?);
    }
    let mut outcome = run_document((file, scene), settings, &mut look)?;
    if has_estimate {
        estimate(scene, settings, &mut outcome, &mut clock);
        name_what_runs(scene, (method, settings), &mut outcome);
    }
    Ok((outcome, settings.clone()))
}

/// The text of a table of inputs: `{"t": [..], "motor": [..]}`.
fn table(inputs: &Bound<'_, PyAny>) -> PyResult<String> {
    let py = inputs.py();
    let (mut names, mut columns) = (Vec::new(), Vec::new());
    let hint = "give {\"t\": times, NAME: values, ..}";
    for (name, values) in value::items(inputs, "inputs", hint)? {
        let numbers = crate::array::Numbers::new(&values, &name, false)?;
        if numbers.shape().len() != 1 {
            return Err(crate::array::wrong_shape(py, &name, numbers.shape(), "(rows,)"));
        }
        let place = if name == "t" { 0 } else { names.len() };
        names.insert(place, name);
        columns.insert(place, numbers.slice().to_vec());
    }
    if names.first().is_none_or(|name| name != "t") {
        return Err(usage(py, "inputs-refused", "inputs have no times `t`", hint, "inputs"));
    }
    let n = columns[0].len();
    if let Some(i) = columns.iter().position(|column| column.len() != n) {
        let message = format!("input `{}` has {} rows, and `t` {n}", names[i], columns[i].len());
        return Err(usage(py, "wrong-shape", &message, "give one value for each time", "inputs"));
    }
    let quoted: Vec<String> =
        names.iter().map(|name| format!("\"{}\"", name.replace('"', "\"\""))).collect();
    let mut text = quoted.join(",") + "\n";
    for i in 0..n {
        for (k, column) in columns.iter().enumerate() {
            // writing into a text has nothing to fail on
            let _ = write!(text, "{}{:?}", if k > 0 { "," } else { "" }, column[i]);
        }
        text.push('\n');
    }
    Ok(text)
}

/// A result of Python.
fn result<'py>(
    py: Python<'py>,
    outcome: Outcome,
    settings: &ResolvedMethod,
    scene: &Scene<f64>,
    again: (&Bound<'py, Mechanism>, &Bound<'py, PyDict>),
) -> PyResult<Bound<'py, PyAny>> {
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
    let error = outcome.error.as_ref().map(|stop| {
        let time = outcome.summary.end_time;
        let class = if outcome.summary.steps == 0 { Class::Start } else { Class::Stop };
        let error = SimulationError::stopped(stop.clone(), time, &Names::new(scene));
        exception(py, class, &crate::error::fields(&error)).into_value(py)
    });
    let provenance = Provenance {
        precision: settings.precision.name().to_owned(),
        formulation: settings.formulation.name().to_owned(),
        integrator: settings.integrator.name().to_owned(),
        step: mbs::words::steps(&outcome.summary.method_used),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        ..Provenance::default()
    };
    let notes = outcome.notes().to_vec();
    let record = Record { outcome, provenance };
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
    /// result with `error`. Ctrl-C raises KeyboardInterrupt, whose `result` has what was recorded.
    #[pyo3(signature = (duration = None, *, error = None, inputs = None, progress = None, **settings))]
    fn run<'py>(
        slf: &Bound<'py, Self>,
        duration: Option<f64>,
        error: Option<f64>,
        inputs: Option<&Bound<'py, PyAny>>,
        progress: Option<&Bound<'py, PyAny>>,
        settings: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (py, shared) = (slf.py(), &slf.get().shared);
        let given = settings.map_or_else(|| Ok(PyDict::new(py)), |settings| settings.copy())?;
        let (method, has_estimate) = settings::method(&given)?;
        let method = Method { duration, ..method };
        let (method, flag) = settings::interruptible(method);
        given.set_item("duration", duration)?;
        given.set_item("error", error)?;
        given.set_item("inputs", inputs)?;
        let driven = match inputs {
            Some(inputs) => {
                let text = table(inputs)?;
                let file = mbs::with_inputs(&shared.file, text.as_bytes(), "inputs");
                let file = file.map_err(|error| no_inputs(py, error))?;
                let scene = file.scene::<f64>().map_err(|error| unread(py, &error))?;
                Some((file, scene))
            }
            None => None,
        };
        let (file, scene) = driven.as_ref().map_or((&shared.file, &shared.scene), |(f, s)| (f, s));
        let reached = Reached::default();
        let progress = Progress { call: progress, counts: false, reached: &reached };
        let (done, raised_by) = watched(py, &flag, &progress, || {
            go((file, scene), (&method, has_estimate), error, &reached)
        })?;
        match done {
            Ok((outcome, settings)) => {
                let result = result(py, outcome, &settings, scene, (slf, &given))?;
                match raised_by {
                    Some(error) => {
                        error.value(py).setattr("result", result)?;
                        Err(error)
                    }
                    None => Ok(result),
                }
            }
            Err(refused) => Err(raised_by.unwrap_or_else(|| match refused {
                Refused::Error(error) => raised(py, &error, Class::Start),
                Refused::Goal(message, hint) => usage(py, "goal-refused", &message, &hint, "error"),
            })),
        }
    }
}
