//! Studies of a mechanism: what needs a model or a whole run of it, each with a typed result.

use super::failure::SimulationError;
use super::inner::started;
use super::inputs::Inputs;
use super::mechanism::Mechanism;
use super::table::Table;
use super::tree::Tree;
use super::view::Observer;
use super::watched::Watched;
use crate::equilibrium::Search;
use crate::linear_system::{LinearSystem, LinearizeOptions};
use crate::modes::Modes;
use crate::names::Names;
use crate::placed::Place;
use crate::record::RunSummary;
use crate::run::Outcome;
use crate::settings::Method;
use crate::statics::StaticEquilibrium;
use mbs_core::scene::Scene;

/// Options of a run: the method, its duration included.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Run {
    /// Method by which the mechanism is stepped; what it leaves open is the mechanism's.
    pub method: Method,
}

impl Run {
    /// A run as the mechanism asks for it.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the method of the run. A [`duration`](Self::duration) that was given stays where the method has none.
    #[must_use]
    pub fn method(self, method: Method) -> Self {
        let duration = method.duration.or(self.method.duration);
        Self { method: Method { duration, ..method } }
    }

    /// Sets the duration [s], in place of the mechanism's; left out in both, 1 s.
    #[must_use]
    pub fn duration(mut self, duration: f64) -> Self {
        self.method.duration = Some(duration);
        self
    }
}

/// Result of a run.
#[derive(Debug)]
#[non_exhaustive]
pub struct RunResult {
    /// Table of the outputs over time.
    pub table: Table,
    /// Reason why the run stopped early; the table then ends there.
    pub stop: Option<SimulationError>,
    /// Summary of counts, energies and violations: the object that `mbs run --json` prints.
    pub summary: RunSummary,
    /// Notes that the user should know.
    pub notes: Vec<String>,
}

/// Runs a mechanism to its end. One that stops early is a result with [`stop`](RunResult::stop).
///
/// # Errors
/// [`SimulationError`] for a mechanism or a method that is refused.
///
/// # Examples
/// ```
/// use mbs::{Body, GROUND, Joint, Mechanism, Run, run};
/// let mut m = Mechanism::planar("pendulum");
/// m.set_gravity([0.0, -9.81]);
/// let bob = m.add(Body::planar([1.0, 0.0], 1.0, 0.0));
/// m.add(Joint::revolute([GROUND, bob], [0.0, 0.0]).named("pivot"));
/// let result = run(&m, &Run::new().duration(1.0))?;
/// let angle = result.table.column("pivot").unwrap().last().unwrap();
/// // let go at the horizontal, the bob has turned by -2.9758 rad after 1 s
/// assert!((angle + 2.9758).abs() < 1e-4 && result.stop.is_none());
/// # Ok::<(), mbs::SimulationError>(())
/// ```
pub fn run(m: &Mechanism, options: &Run) -> Result<RunResult, SimulationError> {
    run_with(m, options, &mut [])
}

/// Runs a mechanism as [`run`] does, before observers: they set inputs on the way, read the mechanism after each step, and may end the run.
///
/// Where there is an observer or an output that is code, the turns of all joints are followed. A joint that turns by more than half a circle
/// in a step then stops a run that would not have read it.
///
/// # Errors
/// As for [`run`].
pub fn run_with(
    m: &Mechanism,
    options: &Run,
    observers: &mut [&mut dyn Observer],
) -> Result<RunResult, SimulationError> {
    let (read, settings, scene) = m.prepared(&options.method)?;
    settings.check_step(&scene, &options.method)?;
    let names = Names::new(&scene);
    let inputs = Inputs::new(&scene);
    let functions = m.functions();
    let watched = Watched { settings: &settings, names: &names, inputs, observers, functions };
    let outcome = watched.run(&read);
    let Outcome { summary, error, .. } = &outcome;
    let stop = error.clone().map(|e| SimulationError::stopped(e, summary.end_time, &names));
    Ok(RunResult {
        table: Table::new(outcome.channels(), outcome.rows()),
        stop,
        summary: outcome.summary.clone(),
        notes: outcome.notes().to_vec(),
    })
}

/// Options of the search for an equilibrium.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct EquilibriumOptions {
    /// Downhill to a stable one, or to the nearest one of any kind.
    pub search: Search,
}

/// Finds a static equilibrium: where the mechanism stays at rest, dampers and time-dependent parts left out.
///
/// # Errors
/// [`SimulationError`] where there is none, or it is not found.
pub fn equilibrium(
    m: &Mechanism,
    options: &EquilibriumOptions,
) -> Result<StaticEquilibrium, SimulationError> {
    let scene = m.resolve_scene()?;
    let found = StaticEquilibrium::new(&scene, options.search);
    found.map_err(|error| SimulationError::stopped(error, 0.0, &Names::new(&scene)))
}

/// Frequencies and damping ratios of the motion about an equilibrium of this mechanism, which is sought again as it was found.
///
/// # Errors
/// [`SimulationError`] where the motion cannot be linearised.
pub fn modes(m: &Mechanism, at: &StaticEquilibrium) -> Result<Modes, SimulationError> {
    let scene = m.resolve_scene()?;
    let found = Modes::new(&scene, Place::Equilibrium, at.search);
    found.map_err(|error| SimulationError::stopped(error, 0.0, &Names::new(&scene)))
}

/// The linear motion of this mechanism about a state, with inputs and outputs by name; `None`: all of them. Outputs that are code are left
/// out.
///
/// An input is named as [`Simulation::inputs`](crate::Simulation::inputs) lists it, and an output as its column in a run, or without the
/// component for all of a vector.
///
/// # Errors
/// [`SimulationError`] for an unknown name, an input that has no derivative there, and where the motion cannot be linearised.
///
/// # Examples
/// A pendulum of 2 kg at 0.5 m, with a torque on its pivot:
/// ```
/// use mbs::{Body, Effect, GROUND, Joint, LinearizeOptions, Mechanism, Signal, linearize};
/// let mut m = Mechanism::planar("pendulum");
/// m.set_gravity([0.0, -9.81]);
/// let bob = m.add(Body::planar([0.0, -0.5], 2.0, 0.0));
/// let pivot = m.add(Joint::revolute([GROUND, bob], [0.0, 0.0]).named("pivot"));
/// m.add(Effect::torque(pivot, Signal::input(0.0)).named("motor"));
/// let system = linearize(&m, &LinearizeOptions::default(), None, None)?;
/// assert_eq!(system.states, ["pivot", "pivot.rate"]);
/// assert_eq!((&*system.inputs, &*system.outputs), (&["motor".to_owned()][..], &["pivot".to_owned()][..]));
/// // x'' = -g/l x + u / (m l^2)
/// assert!((system.a[(1, 0)] + 9.81 / 0.5).abs() < 1e-8 && (system.b[(1, 0)] - 2.0).abs() < 1e-8);
/// # Ok::<(), mbs::SimulationError>(())
/// ```
pub fn linearize(
    m: &Mechanism,
    options: &LinearizeOptions,
    inputs: Option<&[&str]>,
    outputs: Option<&[&str]>,
) -> Result<LinearSystem, SimulationError> {
    LinearSystem::new(&m.resolve_scene()?, options, inputs, outputs)
}

/// [`linearize`] about coordinates and velocities of a tree of the mechanism, at time zero with the inputs as they begin. Loops are closed
/// first; the tree is at the state then.
///
/// # Errors
/// As for [`linearize`], and those of [`Tree::set`] and [`Tree::make_consistent`].
///
/// # Examples
/// ```
/// use mbs::{Body, GROUND, Joint, Mechanism, linearize_at};
/// let mut m = Mechanism::planar("pendulum");
/// m.set_gravity([0.0, -9.81]);
/// let bob = m.add(Body::planar([0.0, -1.0], 1.0, 0.0));
/// m.add(Joint::revolute([GROUND, bob], [0.0, 0.0]));
/// // upside down
/// let system = linearize_at(&m, (&mut m.tree()?, &[core::f64::consts::PI], &[0.0]), None, None)?;
/// assert!((system.a[(1, 0)] - 9.81).abs() < 1e-8);
/// # Ok::<(), mbs::SimulationError>(())
/// ```
pub fn linearize_at(
    m: &Mechanism,
    (tree, q, v): (&mut Tree, &[f64], &[f64]),
    inputs: Option<&[&str]>,
    outputs: Option<&[&str]>,
) -> Result<LinearSystem, SimulationError> {
    let scene = at(m, (tree, q, v))?;
    LinearSystem::at(&scene, tree.motions(), inputs, outputs)
}

/// The linear motion of this mechanism about a rest or a steady motion, in axes that turn with it, without inputs and outputs: its
/// eigenvalues and shapes are those of the motion.
///
/// # Errors
/// As for [`linearize`]; `not-steady` where the state is neither a rest nor a steady motion, with what accelerates or changes.
///
/// # Examples
/// A top that spins upright about its vertical axis: m g l = 1 N m, 0.05 and 0.01 kg m^2. It sleeps from 2 (m g l A)^(1/2) / C = 44.72 rad/s on.
/// ```
/// use mbs::{Body, GROUND, InitialCondition, Joint, LinearizeOptions, Mechanism, Place, linearize_steady};
/// let grows = |rate: f64| {
///     let mut m = Mechanism::spatial("top");
///     m.set_gravity([0.0, 0.0, -10.0]);
///     let top = m.add(Body::spatial([0.0, 0.0, 0.1], 1.0, [0.04, 0.04, 0.01, 0.0, 0.0, 0.0]));
///     m.add(Joint::spherical([GROUND, top], [0.0, 0.0, 0.0]));
///     m.add(InitialCondition::angular_velocity(top, [0.0, 0.0, rate]));
///     let options = LinearizeOptions { place: Place::Initial, ..LinearizeOptions::default() };
///     let shapes = linearize_steady(&m, &options)?.shapes()?;
///     Ok::<_, mbs::SimulationError>(shapes.iter().any(|shape| shape.mode.grows()))
/// };
/// assert!(grows(44.0)? && !grows(45.0)?);
/// # Ok::<(), mbs::SimulationError>(())
/// ```
pub fn linearize_steady(
    m: &Mechanism,
    options: &LinearizeOptions,
) -> Result<LinearSystem, SimulationError> {
    LinearSystem::steady(&m.resolve_scene()?, options)
}

/// [`linearize_steady`] about coordinates and velocities of a tree of the mechanism, as [`linearize_at`] takes them.
///
/// # Errors
/// As for [`linearize_steady`] and [`linearize_at`].
pub fn linearize_steady_at(
    m: &Mechanism,
    state: (&mut Tree, &[f64], &[f64]),
) -> Result<LinearSystem, SimulationError> {
    let (tree, q, v) = state;
    let scene = at(m, (tree, q, v))?;
    LinearSystem::steady_at(&scene, tree.motions())
}

/// Linearises about any state, as [`linearize_steady`] does about a steady motion. About any other state it gives the matrices of the
/// instant, in axes that stand, and [`LinearSystem::unsteady`] says why.
///
/// # Errors
/// As for [`linearize`].
pub fn linearize_frozen(
    m: &Mechanism,
    options: &LinearizeOptions,
) -> Result<LinearSystem, SimulationError> {
    LinearSystem::frozen(&m.resolve_scene()?, options)
}

/// [`linearize_frozen`] about coordinates and velocities of a tree of the mechanism, as [`linearize_at`] takes them.
///
/// # Errors
/// As for [`linearize_at`].
pub fn linearize_frozen_at(
    m: &Mechanism,
    state: (&mut Tree, &[f64], &[f64]),
) -> Result<LinearSystem, SimulationError> {
    let (tree, q, v) = state;
    let scene = at(m, (tree, q, v))?;
    LinearSystem::frozen_at(&scene, tree.motions())
}

/// Moves a tree to a state; the scene that starts there.
fn at(
    m: &Mechanism,
    (tree, q, v): (&mut Tree, &[f64], &[f64]),
) -> Result<Scene<f64>, SimulationError> {
    tree.reset();
    tree.set(q, v)?;
    tree.make_consistent()?;
    Ok(started(&m.resolve_scene()?, &tree.joint_states()))
}
