//! Studies of one model of a mechanism: equilibria and linear systems, each with a typed result.

use super::failure::SimulationError;
use super::inner::started;
use super::mechanism::Mechanism;
use super::tree::Tree;
use crate::equilibrium::Search;
use crate::linear_system::{LinearSystem, LinearizeOptions};
use crate::modes::Modes;
use crate::names::Names;
use crate::placed::Place;
use crate::statics::StaticEquilibrium;
use mbs_core::scene::Scene;

/// Options of the search for an equilibrium.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct EquilibriumOptions {
    /// Kind of the search: for a stable equilibrium downhill in potential energy, or for the nearest equilibrium of any kind.
    pub search: Search,
}

/// Finds a static equilibrium: a configuration in which the mechanism stays at rest. Dampers and time-dependent parts are left out.
///
/// # Errors
/// [`SimulationError`] where there is no equilibrium, or the search does not find one.
pub fn equilibrium(
    m: &Mechanism,
    options: &EquilibriumOptions,
) -> Result<StaticEquilibrium, SimulationError> {
    let scene = m.resolve_scene()?;
    let found = StaticEquilibrium::new(&scene, options.search);
    found.map_err(|error| SimulationError::stopped(error, 0.0, &Names::new(&scene)))
}

/// Finds frequencies and damping ratios of the motion about an equilibrium of this mechanism. The equilibrium is searched again in the way it
/// was found.
///
/// # Errors
/// [`SimulationError`] where the motion cannot be linearised.
pub fn modes(m: &Mechanism, at: &StaticEquilibrium) -> Result<Modes, SimulationError> {
    let scene = m.resolve_scene()?;
    let found = Modes::new(&scene, Place::Equilibrium, at.search);
    found.map_err(|error| SimulationError::stopped(error, 0.0, &Names::new(&scene)))
}

/// Linearises the motion of this mechanism about a state, with inputs and outputs selected by name. `None` selects all of them. Outputs that
/// are code are left out.
///
/// The name of an input is that in [`Simulation::inputs`](crate::Simulation::inputs). The name of an output is that of its column in a run. A
/// vector without a component selects all of its columns.
///
/// # Errors
/// [`SimulationError`] for an unknown name, for an input without a derivative in this state, and for motion that cannot be linearised.
///
/// # Examples
/// A pendulum of 2 kg at a length of 0.5 m, with a torque on its pivot:
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

/// Linearises as [`linearize`] does, about coordinates and velocities of a tree of the mechanism. The time is zero, and the inputs have their
/// start values. Loops are closed first. The tree is in the linearised state afterwards.
///
/// # Errors
/// Those of [`linearize`], [`Tree::set`] and [`Tree::make_consistent`].
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

/// Linearises the motion about a state of rest or a steady motion, in axes that rotate with the steady motion. The system has no inputs and
/// outputs. Its eigenvalues and mode shapes describe small disturbances of the motion.
///
/// # Errors
/// Those of [`linearize`]. The code `not-steady` reports a state that is neither at rest nor steady, and names the quantity that accelerates
/// or changes.
///
/// # Examples
/// A top spins upright about its vertical axis. m g l is 1 N m. Its moments of inertia are A = 0.05 kg m^2 about the pivot, and C = 0.01 kg
/// m^2 about its axis. The motion is stable from a rate of 2 (m g l A)^(1/2) / C = 44.72 rad/s on.
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

/// Linearises as [`linearize_steady`] does, about coordinates and velocities of a tree as in [`linearize_at`].
///
/// # Errors
/// Those of [`linearize_steady`] and [`linearize_at`].
pub fn linearize_steady_at(
    m: &Mechanism,
    state: (&mut Tree, &[f64], &[f64]),
) -> Result<LinearSystem, SimulationError> {
    let (tree, q, v) = state;
    let scene = at(m, (tree, q, v))?;
    LinearSystem::steady_at(&scene, tree.motions())
}

/// Linearises about any state. About a steady motion it does the same as [`linearize_steady`]. About any other state it gives the matrices of
/// this instant, in axes that do not rotate, and [`LinearSystem::unsteady`] gives the reason.
///
/// # Errors
/// Those of [`linearize`].
pub fn linearize_frozen(
    m: &Mechanism,
    options: &LinearizeOptions,
) -> Result<LinearSystem, SimulationError> {
    LinearSystem::frozen(&m.resolve_scene()?, options)
}

/// Linearises as [`linearize_frozen`] does, about coordinates and velocities of a tree as in [`linearize_at`].
///
/// # Errors
/// Those of [`linearize_at`].
pub fn linearize_frozen_at(
    m: &Mechanism,
    state: (&mut Tree, &[f64], &[f64]),
) -> Result<LinearSystem, SimulationError> {
    let (tree, q, v) = state;
    let scene = at(m, (tree, q, v))?;
    LinearSystem::frozen_at(&scene, tree.motions())
}

/// Moves a tree to a state, and returns the scene whose start is this state.
fn at(
    m: &Mechanism,
    (tree, q, v): (&mut Tree, &[f64], &[f64]),
) -> Result<Scene<f64>, SimulationError> {
    tree.reset();
    tree.set(q, v)?;
    tree.make_consistent()?;
    Ok(started(&m.resolve_scene()?, &tree.joint_states()))
}
