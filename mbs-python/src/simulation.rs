//! `Simulation`: a mechanism in motion.

use crate::array::{Numbers, array, count, vector};
use crate::error::{Class, Fields, exception, guarded, raised, refused, usage};
use crate::mechanism::Mechanism;
use crate::recording::{Recording, Tape, poses};
use crate::stepping::{Tapes, inputs};
use crate::watch::{Ear, Reached, silent, whole};
use crate::{settings, values};
use mbs::{ContactEvent, InputId, Interrupt, Method, SimulationError, Snapshot, Tree};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyTuple};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, TryLockError, Weak};

/// A mechanism in motion. One thread at a time: a second one gets a BusyError.
#[pyclass(frozen, module = "multibody")]
#[derive(Debug)]
pub(crate) struct Simulation {
    mechanism: Py<Mechanism>,
    settings: Py<PyDict>,
    flag: Arc<AtomicBool>,
    moving: Mutex<Moving>,
}

/// Simulation in motion, with its tree and its recordings.
#[derive(Debug)]
pub(crate) struct Moving {
    pub(crate) simulation: mbs::Simulation,
    /// Tree of the state in relative coordinates, from the first time that it is asked for.
    tree: Option<Tree>,
    /// Is the tree where the simulation is?
    is_followed: bool,
    /// Tapes on which the motion is recorded.
    tapes: Vec<Weak<Mutex<Tape>>>,
}

impl Moving {
    /// The recordings that are still wanted.
    fn tapes(&mut self) -> Tapes {
        self.tapes.retain(|tape| tape.strong_count() > 0);
        Tapes(self.tapes.iter().filter_map(Weak::upgrade).collect())
    }
}

/// Steps in one call beyond which interrupts are heard [-]: shorter calls end by themselves.
const LONG: f64 = 100.0;

/// Are steps of the method's length over this time so many, or does the method choose their lengths?
fn is_long(simulation: &mbs::Simulation, time: f64) -> bool {
    let n = time / simulation.step_length();
    n > LONG || simulation.is_controlled() && n > 1.0
}

impl Simulation {
    /// The simulation of a mechanism at its start.
    pub(crate) fn new(
        mechanism: &Bound<'_, Mechanism>,
        method: Method,
        settings: Py<PyDict>,
    ) -> PyResult<Self> {
        let py = mechanism.py();
        let (method, flag) = settings::interruptible(method);
        let simulation = mechanism.get().simulation(py, &method)?;
        let moving = Moving { simulation, tree: None, is_followed: false, tapes: Vec::new() };
        let mechanism = mechanism.clone().unbind();
        Ok(Self { mechanism, settings, flag, moving: Mutex::new(moving) })
    }

    /// Returns the simulation in motion, where no other thread has it.
    pub(crate) fn moving(&self, py: Python<'_>) -> PyResult<MutexGuard<'_, Moving>> {
        match self.moving.try_lock() {
            Ok(moving) => Ok(moving),
            // what a panic left is the state before the step
            Err(TryLockError::Poisoned(poisoned)) => Ok(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => {
                let fields = Fields {
                    code: "busy".to_owned(),
                    message: "another thread uses this simulation".to_owned(),
                    hint: "give each thread a `copy()` of its own".to_owned(),
                    ..Fields::default()
                };
                Err(exception(py, Class::Busy, &fields))
            }
        }
    }

    pub(crate) fn this(&self) -> &Mechanism {
        self.mechanism.get()
    }

    /// Something read of it in relative coordinates.
    fn relative<R>(
        &self,
        py: Python<'_>,
        read: impl FnOnce(&mut Tree) -> Result<R, SimulationError>,
    ) -> PyResult<R> {
        let mut moving = self.moving(py)?;
        let Moving { simulation, tree, is_followed, .. } = &mut *moving;
        let tree = match tree {
            Some(tree) => tree,
            None => tree.insert(self.this().first(py)?.clone()),
        };
        if !*is_followed {
            let followed = guarded(py, || Ok(tree.follow(&*simulation)))?;
            followed.map_err(|error| raised(py, &error.into(), Class::Stop))?;
            *is_followed = true;
        }
        let read = guarded(py, || Ok(read(tree)))?;
        read.map_err(|error| raised(py, &error, Class::Stop))
    }

    /// Advances the simulation, where no other thread has it.
    fn advance<R>(
        &self,
        py: Python<'_>,
        advance: impl FnOnce(&mut mbs::Simulation, &Tapes) -> PyResult<R>,
    ) -> PyResult<R> {
        let mut moving = self.moving(py)?;
        moving.is_followed = false;
        let tapes = moving.tapes();
        guarded(py, || advance(&mut moving.simulation, &tapes))
    }
}

impl Simulation {
    /// The inputs of a call, nothing where they stay; another number of them is refused with their names. Forces that are not named are
    /// zero; without any they stay.
    fn inputs_of(
        &self,
        py: Python<'_>,
        (u, f_ext): (Option<&Bound<'_, PyAny>>, Option<&Bound<'_, PyAny>>),
        n: Option<usize>,
    ) -> PyResult<Vec<f64>> {
        if u.is_none() && f_ext.is_none() {
            return Ok(Vec::new());
        }
        let this = self.this();
        let (nu, forces) = (this.shared.inputs.len(), &this.shared.forces);
        let external = this.external(py, f_ext)?;
        forces.check(py, &external)?;
        let present = self.moving(py)?.simulation.input_values().to_vec();
        let mut all = match u {
            None => present,
            Some(u) => {
                let own = nu - forces.range().len();
                let given =
                    inputs(u, [nu, own], n).map_err(|error| this.about_inputs(py, error))?;
                given.whole(own, forces.range(), &present)
            }
        };
        if f_ext.is_some() {
            all.chunks_exact_mut(nu.max(1)).for_each(|row| forces.write(&external, row));
        }
        Ok(all)
    }
}

/// A step that is refused or fails.
fn stopped(py: Python<'_>, error: &SimulationError) -> PyErr {
    let arguments = [("bad-step", "dt"), ("input-refused", "u")];
    refused(py, error, Class::Stop, &arguments)
}

#[pymethods]
impl Simulation {
    /// The mechanism.
    #[getter]
    fn mechanism(&self, py: Python<'_>) -> Py<Mechanism> {
        self.mechanism.clone_ref(py)
    }

    /// Time [s].
    #[getter]
    fn time(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.moving(py)?.simulation.time())
    }

    /// Coordinates (nq,): a copy.
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.relative(py, |tree| Ok(vector(py, tree.coordinates())))
    }

    /// Velocities (nv,): a copy.
    #[getter]
    fn v<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.relative(py, |tree| Ok(vector(py, tree.velocities())))
    }

    /// Accelerations (nv,) at this state, under all effects and the inputs of the last step.
    #[getter]
    fn a<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.relative(py, |tree| Ok(vector(py, tree.accelerations()?)))
    }

    /// Inputs (nu,): a copy. Set, they hold from the next step on.
    #[getter]
    fn u<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(vector(py, self.moving(py)?.simulation.input_values()))
    }

    #[setter]
    fn set_u(&self, py: Python<'_>, values: &Bound<'_, PyAny>) -> PyResult<()> {
        let all = self.inputs_of(py, (Some(values), None), None)?;
        let set = self.moving(py)?.simulation.set_inputs(&all);
        set.map_err(|error| refused(py, &error, Class::Usage, &[("input-refused", "u")]))
    }

    /// Contacts that began or ended since `watch_events`, a thousand at most.
    #[getter]
    fn events<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        let moving = self.moving(py)?;
        let effects = &self.this().shared.scene.effects;
        let event = |event: ContactEvent| {
            let effect = &effects[event.effect.index()];
            let end = effect.kind.row().ends.get(event.end).copied();
            values::make(py, "Event", (event.time, &effect.name, event.is_made, end))
        };
        moving.simulation.events().map(event).collect()
    }

    /// Lists contacts anew from now on.
    fn watch_events(&self, py: Python<'_>) -> PyResult<()> {
        let done = self.moving(py)?.simulation.clear_events();
        done.map_err(|error| raised(py, &error, Class::Stop))
    }

    /// One step of `dt` [s], else of the method's step. `u` (nu,) holds from now on. `f_ext` are forces as in `accelerations`, which hold
    /// too; the mechanism is one of `with_forces`.
    #[pyo3(signature = (dt = None, u = None, *, f_ext = None))]
    fn step(
        &self,
        py: Python<'_>,
        dt: Option<f64>,
        u: Option<&Bound<'_, PyAny>>,
        f_ext: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let all = self.inputs_of(py, (u, f_ext), None)?;
        self.advance(py, |simulation, tapes| {
            let set = if all.is_empty() { Ok(()) } else { simulation.set_inputs(&all) };
            let dt = dt.unwrap_or_else(|| simulation.step_length());
            let made = match set {
                Ok(()) if is_long(simulation, dt) => {
                    let step = || tapes.step(simulation, dt);
                    whole(py, &self.flag, &silent(&Reached::default()), step)?
                }
                Ok(()) => tapes.step(simulation, dt),
                Err(error) => Err(error),
            };
            made.map_err(|error| stopped(py, &error))
        })
    }

    /// `n` steps of `dt` [s] without Python in between. `u` is (nu,), which holds, or (n, nu), a row for each step; `f_ext` as in `step`.
    #[pyo3(signature = (dt, n, u = None, *, f_ext = None))]
    fn steps(
        &self,
        py: Python<'_>,
        dt: Option<f64>,
        n: i64,
        u: Option<&Bound<'_, PyAny>>,
        f_ext: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let (n, nu) = (count(py, "n", n)?, self.this().shared.inputs.len());
        let all = self.inputs_of(py, (u, f_ext), Some(n))?;
        self.advance(py, |simulation, tapes| {
            let dt = dt.unwrap_or_else(|| simulation.step_length());
            let step = |simulation: &mut mbs::Simulation, k: usize| {
                if nu > 0
                    && let Some(row) = all.get(nu * k..nu * (k + 1))
                {
                    simulation.set_inputs(row)?;
                }
                tapes.step(simulation, dt)
            };
            let go = |simulation: &mut mbs::Simulation, heard: &mut dyn FnMut() -> PyResult<()>| {
                for k in 0..n {
                    step(simulation, k)
                        .map_err(|error| Python::attach(|py| stopped(py, &error)))?;
                    heard()?;
                }
                Ok(())
            };
            if is_long(simulation, dt) {
                // a step is many; what is raised behind the flag is the interrupt itself
                let heard = || match self.flag.load(Ordering::Relaxed) {
                    true => Err(PyKeyboardInterrupt::new_err(())),
                    false => Ok(()),
                };
                let work = || go(simulation, &mut { heard });
                return whole(py, &self.flag, &silent(&Reached::default()), work)?;
            }
            py.detach(|| {
                let mut ear = Ear::new();
                go(simulation, &mut || ear.turn())
            })
        })
    }

    /// Records the motion from now on, for a page: `recording.page()`, `recording.save("motion.html")`. It begins anew where time goes back.
    fn record(&self, py: Python<'_>) -> PyResult<Recording> {
        let mut moving = self.moving(py)?;
        let made = Recording::new(self.mechanism.clone_ref(py), &moving.simulation);
        let (recording, tape) = made.map_err(|error| raised(py, &error, Class::Stop))?;
        moving.tapes.push(Arc::downgrade(&tape));
        Ok(recording)
    }

    /// Poses of all bodies, (bodies, 7): the centre of mass, then the quaternion (w, x, y, z) of the turn since the reference configuration.
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let n = self.this().shared.scene.bodies.len();
        let poses = poses(&self.moving(py)?.simulation, n);
        array(py, poses, &[n, 7])
    }

    /// Steps to a time [s]; the last step is shorter where they do not fit.
    fn run_until(&self, py: Python<'_>, time: f64) -> PyResult<()> {
        self.advance(py, |simulation, tapes| {
            let go = |simulation: &mut mbs::Simulation| tapes.advance_to(simulation, time);
            let done = if is_long(simulation, time - simulation.time()) {
                whole(py, &self.flag, &silent(&Reached::default()), || go(simulation))?
            } else {
                py.detach(|| go(simulation))
            };
            done.map_err(|error| refused(py, &error, Class::Stop, &[("bad-step", "time")]))
        })
    }

    /// Sets an input, by name or place, from the next step on.
    fn set_input(&self, py: Python<'_>, name: &Bound<'_, PyAny>, value: f64) -> PyResult<()> {
        let place = self.this().input(name)?;
        let set = self.moving(py)?.simulation.set_input(InputId::new(place), value);
        set.map_err(|error| refused(py, &error, Class::Usage, &[("input-refused", "value")]))
    }

    /// All outputs, in the order of the mechanism's `outputs`. `out` (n,) takes them where it is given.
    #[pyo3(signature = (out = None))]
    fn outputs<'py>(
        &self,
        py: Python<'py>,
        out: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let moving = self.moving(py)?;
        let n = moving.simulation.n_outputs();
        let wrong = || {
            let message = format!("out is no writable array of {n} float64");
            usage(py, "wrong-shape", &message, "make it by numpy.empty", "out")
        };
        let failed = |error: SimulationError| raised(py, &error, Class::Stop);
        let Some(out) = out else {
            let mut row = vec![0.0; n];
            guarded(py, || moving.simulation.write_outputs(&mut row).map_err(failed))?;
            return Ok(vector(py, &row));
        };
        {
            let array = out.cast::<PyArray1<f64>>().map_err(|_| wrong())?;
            let mut array = array.try_readwrite().map_err(|_| wrong())?;
            let row = array.as_slice_mut().map_err(|_| wrong())?;
            if row.len() != n {
                return Err(wrong());
            }
            guarded(py, || moving.simulation.write_outputs(row).map_err(failed))?;
        }
        Ok(out)
    }

    /// Puts the mechanism into a state; loops are closed. Gives the largest change of a coordinate [rad, m].
    fn set_state(
        &self,
        py: Python<'_>,
        q: &Bound<'_, PyAny>,
        v: &Bound<'_, PyAny>,
    ) -> PyResult<f64> {
        let first = self.this().first(py)?;
        let q = Numbers::row(q, "q", first.coordinates().len())?;
        let v = Numbers::row(v, "v", first.velocities().len())?;
        let mut moving = self.moving(py)?;
        let Moving { simulation, tree, is_followed, .. } = &mut *moving;
        let tree = match tree {
            Some(tree) => tree,
            None => tree.insert(first.clone()),
        };
        *is_followed = false;
        let moved = guarded(py, || Ok(py.detach(|| simulation.set_coordinates(tree, &q, &v))))?;
        let moved = moved.map_err(|error| raised(py, &error, Class::Start))?;
        // the tree stands where the simulation is, to the last bit
        *is_followed = true;
        Ok(moved)
    }

    /// Starts anew at time zero, with the inputs of the mechanism.
    fn reset(&self, py: Python<'_>) -> PyResult<()> {
        let mut moving = self.moving(py)?;
        moving.is_followed = false;
        moving.tree = None;
        let done = guarded(py, || Ok(moving.simulation.reset()))?;
        done.map_err(|error| raised(py, &error, Class::Start))
    }

    /// Another simulation in the same state.
    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        let mut simulation = self.moving(py)?.simulation.clone();
        let flag = Arc::new(AtomicBool::new(false));
        simulation.set_interrupt(Interrupt::new(flag.clone()));
        let moving = Moving { simulation, tree: None, is_followed: false, tapes: Vec::new() };
        Ok(Self {
            mechanism: self.mechanism.clone_ref(py),
            settings: self.settings.clone_ref(py),
            flag,
            moving: Mutex::new(moving),
        })
    }

    fn __copy__(&self, py: Python<'_>) -> PyResult<Self> {
        self.copy(py)
    }

    fn __deepcopy__(&self, py: Python<'_>, _memo: &Bound<'_, PyAny>) -> PyResult<Self> {
        self.copy(py)
    }

    /// All that the next steps depend on, as bytes.
    fn save<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let snapshot = self.moving(py)?.simulation.save();
        let snapshot = snapshot.map_err(|error| raised(py, &error, Class::Usage))?;
        Ok(PyBytes::new(py, &snapshot.to_bytes()))
    }

    /// Returns to what `save` gave: the next steps have the same bits.
    fn restore(&self, py: Python<'_>, data: &[u8]) -> PyResult<()> {
        let mut moving = self.moving(py)?;
        moving.is_followed = false;
        let restore = |snapshot| moving.simulation.restore(&snapshot);
        let done = guarded(py, || Ok(Snapshot::from_bytes(data).and_then(restore)))?;
        done.map_err(|error| raised(py, &error, Class::Usage))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyTuple>> {
        let (py, this) = (slf.py(), slf.get());
        let restore = py.import("multibody._multibody")?.getattr("_restore_simulation")?;
        let mechanism = this.mechanism.clone_ref(py);
        let settings = this.settings.clone_ref(py);
        (restore, (mechanism, settings, this.save(py)?)).into_pyobject(py)
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let time = self.time(py)?;
        Ok(format!("<Simulation of `{}` at {time} s>", self.this().shared.scene.name))
    }
}

/// A simulation from what was pickled.
#[pyfunction]
pub(crate) fn _restore_simulation(
    py: Python<'_>,
    mechanism: &Bound<'_, Mechanism>,
    settings: &Bound<'_, PyDict>,
    data: &[u8],
) -> PyResult<Simulation> {
    let (method, _) = settings::method(settings)?;
    let simulation = Simulation::new(mechanism, method, settings.clone().unbind())?;
    simulation.restore(py, data)?;
    Ok(simulation)
}

#[pymethods]
impl Mechanism {
    /// A simulation at its start. None leaves a setting to the scene; its default is index-3 with steps of 1 ms.
    #[pyo3(signature = (**settings))]
    fn simulate(
        slf: &Bound<'_, Self>,
        settings: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Simulation> {
        let py = slf.py();
        let given = settings.map_or_else(|| Ok(PyDict::new(py)), |settings| settings.copy())?;
        let (method, _) = settings::method(&given)?;
        Simulation::new(slf, method, given.unbind())
    }
}
