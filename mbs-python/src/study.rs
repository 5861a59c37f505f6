//! Analyses and studies: equilibrium, modes, linear system, doctor, explanation, comparison.

use crate::array::{Numbers, array};
use crate::error::{Class, guarded, raised, unknown_name, usage};
use crate::mechanism::Mechanism;
use crate::watch::{Progress, Reached, left, silent, whole};
use crate::{settings, value, values};
use mbs::core::scene::Entry;
use mbs::{
    EquilibriumOptions, FormulationKind, Interrupt, LinearSystem, LinearizeOptions, Matrix, Method,
    Place, Precision, ResolvedMethod, Run, Search, SimulationError, Tree,
};
use mbs_study::compare::{self, Earlier, Request};
use mbs_study::doctor::{Effort, examine, to_json};
use mbs_study::explain::{self, explain_run};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Timings of a run in a quick comparison.
const QUICK_REPEATS: u32 = 2;
/// CPU time of all runs of a quick comparison, roughly [s].
const QUICK_BUDGET: f64 = 5.0;

/// Returns the search with this name; refuses an unknown name.
fn search(py: Python<'_>, name: &str) -> PyResult<Search> {
    let search = Search::ALL.into_iter().find(|search| search.name() == name);
    let unknown = || unknown_name(py, ["search", "searches"], ("search", name), &Search::NAMES);
    search.ok_or_else(unknown)
}

/// Returns the place with this name; refuses an unknown name.
fn place(py: Python<'_>, name: &str) -> PyResult<Place> {
    let place = Place::ALL.into_iter().find(|place| place.name() == name);
    place.ok_or_else(|| unknown_name(py, ["state", "states"], ("at", name), &Place::NAMES))
}

/// Watch of a comparison, which notes the share that is done.
struct Watched<'a>(&'a Reached);

impl compare::Watch for Watched<'_> {
    fn doing(&mut self, share: f64, _what: &str) {
        self.0.set(share, 1.0);
    }
}

/// A part of a JSON object.
fn part<'py>(py: Python<'py>, object: &Value, key: &str) -> PyResult<Bound<'py, PyAny>> {
    value::object(py, object.get(key).unwrap_or(&Value::Null))
}

impl Mechanism {
    fn settings(
        &self,
        py: Python<'_>,
        given: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<(Method, ResolvedMethod, Arc<AtomicBool>)> {
        let none = PyDict::new(py);
        let (method, _) = settings::method(given.unwrap_or(&none))?;
        let (method, flag) = settings::interruptible(method);
        let settings = ResolvedMethod::new(&self.shared.scene, &method);
        let settings = settings.map_err(|e| raised(py, &SimulationError::from(e), Class::Usage))?;
        Ok((method, settings, flag))
    }
}

#[pymethods]
impl Mechanism {
    /// The static equilibrium: downhill to a stable one, or the one `near` the reference configuration.
    #[pyo3(signature = (search = "down"))]
    fn equilibrium<'py>(&self, py: Python<'py>, search: &str) -> PyResult<Bound<'py, PyAny>> {
        let options = EquilibriumOptions { search: self::search(py, search)? };
        let mut mechanism = self.shared.mechanism.clone();
        let found = left(py, move || {
            let found = mbs::equilibrium(&mechanism, &options)?;
            let simulation = mechanism.start_from(&found).simulate(&Method::default())?;
            Ok((found, simulation))
        })?;
        let (found, simulation) = found.map_err(|error| raised(py, &error, Class::Start))?;
        let object = found.to_json();
        let state = self.state_of(py, &simulation)?;
        // the scene's initial velocities are no part of it
        let at_rest = state.getattr("v")?.call_method1("__mul__", (0.0,))?;
        let state = values::make(py, "State", (state.getattr("q")?, at_rest))?;
        let is_stable = found.unstable.map(|n| n == 0);
        let [joints, reactions, outputs] =
            ["joints", "reactions", "outputs"].map(|key| part(py, &object, key));
        let summary = value::object(py, &object)?;
        values::make(py, "Equilibrium", (state, is_stable, joints?, reactions?, outputs?, summary))
    }

    /// What is wrong or doubtful, with remedies, the worst first.
    #[pyo3(signature = (**settings))]
    fn doctor<'py>(
        &self,
        py: Python<'py>,
        settings: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let (_, resolved, flag) = self.settings(py, settings)?;
        let shared = &self.shared;
        let line = |entry: Entry, key: &str| {
            let (file, place) = shared.file.place(entry, key);
            Some(((file != shared.file.file()).then(|| file.to_owned()), place.line))
        };
        let reached = Reached::default();
        let object = whole(py, &flag, &silent(&reached), || {
            let checkup = examine(&shared.scene, &resolved, &Effort::default());
            to_json(&checkup.with_unused_parameters(&shared.file.unused_parameters()), &line)
        })?;
        let findings =
            object.get("findings").and_then(Value::as_array).cloned().unwrap_or_default();
        let finding = |finding: &Value| {
            let text = |key: &str| finding.get(key).and_then(Value::as_str).unwrap_or_default();
            let (code, severity) = (text("code"), text("severity"));
            let fields =
                (code, severity, text("message"), text("remedy"), value::object(py, finding)?);
            values::make(py, "Finding", fields)
        };
        findings.iter().map(finding).collect()
    }

    /// What the mechanism simulates, what it does not, and the measured cost of each effect: the object of `mbs explain --json`.
    #[pyo3(signature = (**settings))]
    fn explain<'py>(
        &self,
        py: Python<'py>,
        settings: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (method, _, flag) = self.settings(py, settings)?;
        let options = Run::new().method(method);
        let reached = Reached::default();
        let explained = whole(py, &flag, &silent(&reached), || {
            explain_run(&self.shared.mechanism, &options, &explain::Effort::default())
        })?;
        let explained = explained.map_err(|error| raised(py, &error, Class::Usage))?;
        let Some(explained) = explained else {
            let hint = "leave precision out, or give f32";
            let message = "an explanation is made in f64 or f32";
            return Err(usage(py, "settings-refused", message, hint, "precision"));
        };
        json(py, &explained.to_json())
    }

    /// Time and error of formulations, integrators and steps, against a reference that is not under test: the object of `mbs compare --json`.
    /// `quick` takes about 5 s. `progress` is called with the part that is done and 1.
    #[pyo3(signature = (methods = None, steps = None, *, duration = None, errors = None, quick = true, progress = None))]
    #[allow(clippy::too_many_arguments, reason = "they are keywords of Python")]
    fn compare<'py>(
        &self,
        py: Python<'py>,
        methods: Option<Vec<String>>,
        steps: Option<Vec<f64>>,
        duration: Option<f64>,
        errors: Option<Vec<f64>>,
        quick: bool,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let known = &mbs::FORMULATIONS[1..];
        let kinds = methods.unwrap_or_default().into_iter().map(|name| {
            let unknown =
                || unknown_name(py, ["formulation", "formulations"], ("methods", &name), known);
            FormulationKind::of_name(&name).ok_or_else(unknown)
        });
        for (argument, numbers) in [("steps", &steps), ("errors", &errors)] {
            positive(py, argument, numbers.as_deref().unwrap_or_default())?;
        }
        let flag = Arc::new(AtomicBool::new(false));
        let plain = Request::default();
        let request = Request {
            formulations: kinds.collect::<PyResult<_>>()?,
            precisions: if quick { vec![Precision::F64] } else { Vec::new() },
            steps: steps.unwrap_or_default(),
            errors: errors.unwrap_or_else(|| plain.errors.clone()),
            duration,
            repeats: if quick { QUICK_REPEATS } else { plain.repeats },
            budget: if quick { QUICK_BUDGET } else { plain.budget },
            maps: !quick,
            interrupt: Interrupt::new(flag.clone()),
            ..plain
        };
        let reached = Reached::default();
        let progress = Progress { call: progress, counts: false, reached: &reached };
        let file = &self.shared.file;
        let compared = whole(py, &flag, &progress, || {
            let none = (None, Earlier::default());
            let compared = compare::compare(file, &request, None, none, &mut Watched(&reached));
            reached.set(1.0, 1.0);
            compared
        })?;
        let compared = compared.map_err(|e| raised(py, &SimulationError::from(e), Class::Start))?;
        json(py, &compared.to_json())
    }
}

/// Refuses an argument with a number that is not larger than zero, or infinite.
fn positive(py: Python<'_>, argument: &str, numbers: &[f64]) -> PyResult<()> {
    let Some(wrong) = numbers.iter().find(|x| !(**x > 0.0 && x.is_finite())) else {
        return Ok(());
    };
    let message = format!("{argument} has {wrong}");
    Err(usage(py, "settings-refused", &message, "give numbers larger than zero", argument))
}

/// The object of a text of JSON.
fn json<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    let object: Value = serde_json::from_str(text)
        .map_err(|error| crate::error::internal(py, &error.to_string()))?;
    value::object(py, &object)
}

/// Operating point of a linear system: a place, with the search for its equilibrium, or a state.
enum Where {
    Place(Place, Search),
    State(Vec<f64>, Vec<f64>),
}

/// A state, and the values of all inputs; without them those at which they begin.
struct At {
    state: Where,
    inputs: Option<Vec<f64>>,
}

/// Names of inputs and of outputs; without them all.
type Ports = [Option<Vec<String>>; 2];

impl Mechanism {
    fn at(
        &self,
        py: Python<'_>,
        at: Option<&Bound<'_, PyAny>>,
        u: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<At> {
        let held = |u: &Bound<'_, PyAny>| self.inputs_of(u);
        let of = |state| Ok(At { state, inputs: u.map(held).transpose()? });
        let Some(at) = at else { return of(Where::Place(Place::Equilibrium, Search::Down)) };
        if let Ok(name) = at.extract::<String>() {
            return of(Where::Place(place(py, &name)?, Search::Down));
        }
        if at.hasattr("is_stable")? {
            // it is sought again, as it was found
            let name: String = at.getattr("summary")?.get_item("search")?.extract()?;
            return of(Where::Place(Place::Equilibrium, search(py, &name)?));
        }
        let state = |q: &Bound<'_, PyAny>, v: &Bound<'_, PyAny>| {
            let first = self.first(py)?;
            let q = Numbers::row(q, "q", first.coordinates().len())?;
            Ok::<_, PyErr>(Where::State(q, Numbers::row(v, "v", first.velocities().len())?))
        };
        if let Ok((q, v, own)) =
            at.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>, Bound<'_, PyAny>)>()
        {
            if u.is_some() {
                let hint = "give (q, v) beside u, or (q, v, u) alone";
                return Err(usage(py, "usage", "u stands twice", hint, "u"));
            }
            return Ok(At { state: state(&q, &v)?, inputs: Some(held(&own)?) });
        }
        let wrong = |_| {
            let hint = "give a name, an equilibrium, (q, v) or (q, v, u)";
            usage(py, "wrong-type", "at is no state", hint, "at")
        };
        let (q, v): (Bound<'_, PyAny>, Bound<'_, PyAny>) = at.extract().map_err(wrong)?;
        of(state(&q, &v)?)
    }

    /// This mechanism and its tree, with the inputs at these values.
    fn held(&self, py: Python<'_>, inputs: Option<&[f64]>) -> PyResult<(mbs::Mechanism, Tree)> {
        let mut mechanism = self.shared.mechanism.clone();
        let Some(inputs) = inputs else { return Ok((mechanism, self.first(py)?.clone())) };
        let made = guarded(py, || {
            Ok(mechanism.set_inputs(inputs).and_then(|mechanism| mechanism.tree()))
        })?;
        let tree = made.map_err(|error| raised(py, &error, Class::Start))?;
        Ok((mechanism, tree))
    }

    /// The linear system about a state.
    fn linear(&self, py: Python<'_>, (at, names): (At, Ports)) -> PyResult<LinearSystem> {
        let (mechanism, mut tree) = self.held(py, at.inputs.as_deref())?;
        let made = left(py, move || {
            let [inputs, outputs] = names.each_ref().map(|names| {
                names.as_ref().map(|names| names.iter().map(String::as_str).collect::<Vec<_>>())
            });
            let (inputs, outputs) = (inputs.as_deref(), outputs.as_deref());
            match at.state {
                Where::Place(place, search) => {
                    let options = LinearizeOptions { place, search };
                    mbs::linearize(&mechanism, &options, inputs, outputs)
                }
                Where::State(q, v) => {
                    let state = (&mut tree, &q[..], &v[..]);
                    mbs::linearize_at(&mechanism, state, inputs, outputs)
                }
            }
        })?;
        made.map_err(|error| raised(py, &error, Class::Start))
    }

    /// Shapes about a state, the names of their states, and what the command says of a place.
    fn shapes(&self, py: Python<'_>, at: At, frozen: bool) -> PyResult<Shapes> {
        let (mechanism, mut tree) = self.held(py, at.inputs.as_deref())?;
        let shared = self.shared.clone();
        let made = left(py, move || {
            let (system, named) = match at.state {
                Where::Place(place, search) => {
                    let options = LinearizeOptions { place, search };
                    let by = if frozen { mbs::linearize_frozen } else { mbs::linearize_steady };
                    let system = by(&mechanism, &options)?;
                    let names = mbs::Names::new(&shared.scene);
                    let stopped = |error| SimulationError::stopped(error, 0.0, &names);
                    let named = mbs::Modes::of_system(&system, place).map_err(stopped)?;
                    (system, Some(named))
                }
                Where::State(q, v) => {
                    let by =
                        if frozen { mbs::linearize_frozen_at } else { mbs::linearize_steady_at };
                    (by(&mechanism, (&mut tree, &q, &v))?, None)
                }
            };
            Ok((system.shapes()?, system.states, named))
        })?;
        made.map_err(|error: SimulationError| raised(py, &error, Class::Start))
    }
}

/// Shapes, the names of their states, and what the command says of a place.
type Shapes = (Vec<mbs::ModeShape>, Vec<String>, Option<mbs::Modes>);

fn matrix<'py>(py: Python<'py>, matrix: &Matrix) -> PyResult<Bound<'py, PyAny>> {
    array(py, matrix.data.clone(), &[matrix.rows, matrix.columns])
}

#[pymethods]
impl Mechanism {
    /// dx/dt = A x + B u, y = C x + D u about a state: `"equilibrium"`, `"initial"`, `"moving"`, what `equilibrium()` gives, (q, v), or
    /// (q, v, u). `u` are the values of all inputs there, else those at which they begin. The states x are independent coordinates and their
    /// rates, then the states of signals. About a state that is neither a rest nor a steady motion the matrices hold for the instant, and
    /// `unsteady` says why.
    #[pyo3(signature = (at = None, inputs = None, outputs = None, *, u = None))]
    fn linearize<'py>(
        &self,
        py: Python<'py>,
        at: Option<&Bound<'py, PyAny>>,
        inputs: Option<Vec<String>>,
        outputs: Option<Vec<String>>,
        u: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let at = self.at(py, at, u)?;
        let s = self.linear(py, (at, [inputs, outputs]))?;
        let [a, b, c, d] = [&s.a, &s.b, &s.c, &s.d].map(|m| matrix(py, m));
        let unsteady = s.unsteady.map(|unsteady| value::object(py, &unsteady.to_json()));
        let fields = (a?, b?, c?, d?, s.states, s.inputs, s.outputs);
        values::make(py, "Linear", (fields, unsteady.transpose()?))
    }

    /// Eigenvalues of the motion about a state, with frequencies, damping ratios and shapes, from the slowest to the fastest.
    ///
    /// `at` and `u` are those of `linearize`. About a state that is neither a rest nor a steady motion `frozen` gives the eigenvalues of the
    /// instant; else it is refused.
    #[pyo3(signature = (at = None, *, u = None, frozen = false))]
    fn modes<'py>(
        &self,
        py: Python<'py>,
        at: Option<&Bound<'py, PyAny>>,
        u: Option<&Bound<'py, PyAny>>,
        frozen: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let at = self.at(py, at, u)?;
        let (shapes, states, named) = self.shapes(py, at, frozen)?;
        let pairs = shapes.iter().flat_map(|shape| &shape.states).flatten().copied();
        let (n, m) = (shapes.len(), states.len());
        let pairs = array(py, pairs.collect(), &[n, 2 * m])?;
        let complex = |pairs: Bound<'py, PyAny>| pairs.call_method1("view", ("complex128",));
        let modes = || shapes.iter().map(|shape| &shape.mode);
        let values = modes().flat_map(|mode| [mode.real, mode.imaginary]).collect();
        let eigenvalues = complex(array(py, values, &[2 * n])?)?;
        let frequencies = array(py, modes().map(mbs::Mode::frequency).collect(), &[n])?;
        let damping = modes().map(|mode| mode.damping_ratio().unwrap_or(f64::NAN)).collect();
        let damping = array(py, damping, &[n])?;
        let summary = match named {
            Some(named) => value::object(py, &named.to_json())?,
            None => PyDict::new(py).into_any(),
        };
        let shapes = complex(pairs)?;
        let fields = (eigenvalues, frequencies, damping, shapes, states, summary);
        values::make(py, "Modes", fields)
    }
}
