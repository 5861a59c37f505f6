//! Studies of a mechanism that need a model of it: equilibrium and linear systems, each with a typed result.

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
