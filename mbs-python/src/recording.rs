//! Recording of a motion that is stepped from Python: pictures and outputs, of which a page can be made.

use crate::array::{array, vector};
use crate::error::{Class, guarded, raised, unknown_name};
use crate::mechanism::{Mechanism, channels};
use mbs::core::scene::BodyId;
use mbs::record::{ChannelSeries, N_POSE, Provenance, RecordedMotion, RunRecord};
use mbs::{Method, ResolvedMethod, Run, Simulation, SimulationError};
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

/// Most instants of a recording [-], some for each pixel of a plot: then every second one is left out, and half as many are taken.
const MOST_INSTANTS: usize = 2400;

/// Poses and outputs at instants of a motion.
#[derive(Debug)]
pub(crate) struct Tape {
    times: Vec<f64>,
    /// Of each instant all bodies, as [`RecordedMotion::poses`].
    poses: Vec<f64>,
    /// Of each instant all columns.
    rows: Vec<f64>,
    n_bodies: usize,
    n_columns: usize,
    /// Steps from one instant to the next.
    stride: usize,
    /// Steps since the last instant.
    since: usize,
}

impl Tape {
    /// Takes an instant where one is due.
    pub(crate) fn offer(&mut self, simulation: &Simulation) -> Result<(), SimulationError> {
        if self.times.last().is_some_and(|last| simulation.time() <= *last) {
            self.times.clear();
            self.poses.clear();
            self.rows.clear();
            (self.stride, self.since) = (1, 0);
        }
        self.since += 1;
        if self.since < self.stride {
            return Ok(());
        }
        self.since = 0;
        self.take(simulation)?;
        if self.times.len() >= MOST_INSTANTS {
            let [n_poses, n_columns] = [self.n_bodies * N_POSE, self.n_columns];
            halve(&mut self.times, 1);
            halve(&mut self.poses, n_poses);
            halve(&mut self.rows, n_columns);
            // the last of an even number went
            self.since = self.stride;
            self.stride *= 2;
        }
        Ok(())
    }

    fn take(&mut self, simulation: &Simulation) -> Result<(), SimulationError> {
        let row = self.rows.len();
        self.rows.resize(row + self.n_columns, 0.0);
        if let Err(error) = simulation.write_outputs(&mut self.rows[row..]) {
            self.rows.truncate(row);
            return Err(error);
        }
        self.times.push(simulation.time());
        self.poses.extend(poses(simulation, self.n_bodies));
        Ok(())
    }
}

/// Keeps every second of some groups of `n` numbers, the first of them.
fn halve(numbers: &mut Vec<f64>, n: usize) {
    let mut place = 0;
    numbers.retain(|_| {
        place += 1;
        ((place - 1) / n.max(1)).is_multiple_of(2)
    });
}

/// The poses of all bodies: place of the centre of mass, and quaternion of the turn since the reference configuration.
pub(crate) fn poses(simulation: &Simulation, n_bodies: usize) -> Vec<f64> {
    let of = |body: usize| {
        let mbs::Pose { position, rotation, .. } = simulation.pose(BodyId::Body(body));
        let column = |i: usize| [0, 1, 2].map(|row: usize| rotation[row][i]);
        let turn = mbs::inside::tested::of_axes([column(0), column(1), column(2)]);
        position.into_iter().chain(turn)
    };
    (0..n_bodies).flat_map(of).collect()
}

/// Returns the drawing of a scene, with its start as the only picture: a run of one step.
pub(crate) fn drawing(mechanism: &Mechanism) -> Result<Option<RecordedMotion>, SimulationError> {
    let shared = &mechanism.shared;
    let settings = ResolvedMethod::new(&shared.scene, &Method::default())?;
    let result = mbs::run(&shared.mechanism, &Run::new().duration(settings.step))?;
    let motion = result.outcome().record(Provenance::default()).motion;
    Ok(motion.map(|mut motion| {
        let n = motion.bodies.len() * N_POSE;
        motion.times.truncate(1);
        motion.poses.truncate(n);
        motion
    }))
}

/// The motion of a simulation from where it was when this was asked for.
#[pyclass(frozen, module = "multibody")]
#[derive(Debug)]
pub(crate) struct Recording {
    mechanism: Py<Mechanism>,
    tape: Arc<Mutex<Tape>>,
}

impl Recording {
    /// Begins with the present instant.
    pub(crate) fn new(
        mechanism: Py<Mechanism>,
        simulation: &Simulation,
    ) -> Result<(Self, Arc<Mutex<Tape>>), SimulationError> {
        let shared = &mechanism.get().shared;
        let mut tape = Tape {
            times: Vec::new(),
            poses: Vec::new(),
            rows: Vec::new(),
            n_bodies: shared.scene.bodies.len(),
            n_columns: shared.columns.len(),
            stride: 1,
            since: 0,
        };
        tape.take(simulation)?;
        let tape = Arc::new(Mutex::new(tape));
        Ok((Self { mechanism, tape: tape.clone() }, tape))
    }

    fn read<R>(&self, read: impl FnOnce(&Tape) -> R) -> R {
        read(&self.tape.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// The record that a page shows.
    fn record(&self) -> Result<RunRecord, SimulationError> {
        let mechanism = self.mechanism.get();
        let scene = &mechanism.shared.scene;
        let drawn = drawing(mechanism)?;
        Ok(self.read(|tape| {
            let motion = drawn.map(|drawn| RecordedMotion {
                times: tape.times.clone(),
                poses: tape.poses.clone(),
                ..drawn
            });
            let mut first = 0;
            let channels = channels(scene).into_iter().map(|channel| {
                let n = channel.components.len();
                let column = |i: usize| {
                    let rows = tape.rows.chunks_exact(tape.n_columns.max(1));
                    rows.map(|row| row[first + i]).collect()
                };
                let values = (0..n).map(column).collect();
                first += n;
                ChannelSeries { channel, times: tape.times.clone(), values, stats: Vec::new() }
            });
            let last = tape.times.last().copied().unwrap_or_default();
            RunRecord {
                scene: scene.name.clone(),
                provenance: Provenance {
                    command: "stepped from Python".to_owned(),
                    version: env!("CARGO_PKG_VERSION").to_owned(),
                    ..Provenance::default()
                },
                channels: channels.collect(),
                motion,
                summary: vec![("time reached".to_owned(), format!("{last} s"))],
                ..RunRecord::default()
            }
        }))
    }
}

#[pymethods]
impl Recording {
    /// Times of the instants that are kept [s].
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyAny> {
        self.read(|tape| vector(py, &tape.times))
    }

    /// An output at the instants, by its name; all of them, (instants, outputs), by `outputs`.
    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let columns = &self.mechanism.get().shared.columns;
        let place = columns.iter().position(|[known, _]| known == name);
        let Some(place) = place else {
            let known: Vec<&str> = columns.iter().map(|[known, _]| known.as_str()).collect();
            return Err(unknown_name(py, ["output", "outputs"], ("name", name), &known));
        };
        let rows = self.read(|tape| {
            let rows = tape.rows.chunks_exact(tape.n_columns.max(1));
            rows.map(|row| row[place]).collect::<Vec<_>>()
        });
        Ok(vector(py, &rows))
    }

    /// All outputs at the instants, (instants, outputs).
    #[getter]
    fn outputs<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (rows, shape) =
            self.read(|tape| (tape.rows.clone(), [tape.times.len(), tape.n_columns]));
        array(py, rows, &shape)
    }

    /// The page of the motion: HTML that stands alone, as `mbs run` writes it.
    fn page(&self, py: Python<'_>) -> PyResult<String> {
        let page = || self.record().map(|record| mbs_report::page(&record));
        let made = guarded(py, || Ok(py.detach(page)))?;
        made.map_err(|error| raised(py, &error, Class::Start))
    }

    /// Writes the page.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let page = self.page(py)?;
        Ok(std::fs::write(path, page)?)
    }

    fn _repr_html_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("multibody.result")?.getattr("embedded")?.call1((self.page(py)?,))
    }

    fn __len__(&self) -> usize {
        self.read(|tape| tape.times.len())
    }

    fn __repr__(&self) -> String {
        self.read(|tape| {
            let ends = [tape.times.first(), tape.times.last()].map(|t| t.copied().unwrap_or(0.0));
            format!("<Recording of {} instants, {} to {} s>", tape.times.len(), ends[0], ends[1])
        })
    }
}

#[pymethods]
impl Mechanism {
    /// The page of the mechanism at its start alone, for `multibody.render`.
    fn _still(&self, py: Python<'_>) -> PyResult<String> {
        let page = || {
            let motion = drawing(self)?;
            let scene = self.shared.scene.name.clone();
            Ok(mbs_report::page(&RunRecord { scene, motion, ..RunRecord::default() }))
        };
        let made = guarded(py, || Ok(py.detach(page)))?;
        made.map_err(|error: SimulationError| raised(py, &error, Class::Start))
    }
}
