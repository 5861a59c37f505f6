//! Linear equations of motion of a mechanism about a state, with inputs and outputs.
//!
//! ```text
//! dx/dt = A x + B u,   y = C x + D u
//! w = (z, z', s):   x = S w + T u,   dx/dt = R w + W u,   y = P w + Q u
//! A = R S^-1,   B = W - A T,   C = P S^-1,   D = Q - C T
//! ```
//! The vector w consists of the coordinates z, their rates z' and the states s of signals. The vectors x, u and y are states, inputs and
//! outputs. The state x differs from w only in rotations, whose rates in x are angular velocities. S, T, R, W, P and Q are difference
//! quotients at neighbouring states (`mbs_linear::linearise_ports`). T is not zero if a guide is an input, because the joints that the
//! guide moves are states as well.

mod about;
mod coordinates;
mod data;
mod measured;
mod names;
mod parts;
mod shapes;
pub mod solve;
pub mod states;
mod steady;

pub use crate::unsteady::Unsteady;
pub(crate) use about::{About, Axes, at_rest};
pub use data::LinearSystem;
pub use shapes::ModeShape;

use crate::equilibrium::Search;
use crate::erased::SimulationError;
use crate::names::Names;
use crate::placed::{Place, PlacedScene};
use crate::stop::StopError;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{Dimension, Scene};
use names::{InputPlaces, OutputColumns};

/// Options of a linearisation: the state about which a mechanism is linearised.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LinearizeOptions {
    /// State about which the mechanism is linearised. Default: the static equilibrium near the start.
    pub place: Place,
    /// Search for the equilibrium. Default: descent of the potential energy, to a stable equilibrium.
    pub search: Search,
}

impl Default for LinearizeOptions {
    fn default() -> Self {
        Self { place: Place::Equilibrium, search: Search::default() }
    }
}

impl LinearSystem {
    /// Assembles a scene, searches for its equilibrium if the place needs one, and linearises it.
    ///
    /// Cost: the cost of `mbs_linear::linearise_ports`, and n^3 operations for n states.
    ///
    /// # Errors
    /// As for [`linearize`](crate::linearize).
    pub fn new(
        scene: &Scene<f64>,
        options: &LinearizeOptions,
        inputs: Option<&[&str]>,
        outputs: Option<&[&str]>,
    ) -> Result<Self, SimulationError> {
        Asked { place: Some(options.place), inputs, outputs, axes: Axes::Standing }
            .about(scene, options)
    }

    /// Linearises a scene about an equilibrium or a steady motion, without inputs and outputs. The axes turn with the motion, so the
    /// matrices are constant and the eigenvalues hold for the whole motion.
    ///
    /// About a motion, the states are the coordinates of joints with one freedom, and the positions and rotations of bodies.
    ///
    /// Cost: that of `mbs_linear::linearise_ports`; twice as much about a motion.
    ///
    /// # Errors
    /// As for [`linearize`](crate::linearize); `not-steady` if the state is neither an equilibrium nor a steady motion.
    pub fn steady(scene: &Scene<f64>, options: &LinearizeOptions) -> Result<Self, SimulationError> {
        let asked = Asked::alone(Some(options.place), Axes::Turning);
        asked.about(scene, options)?.or_not_steady(scene)
    }

    /// Linearises as [`steady`](Self::steady) does, about the state in which bodies move as given by `motions`. These motions satisfy the
    /// constraints.
    ///
    /// # Errors
    /// As for [`linearize_at`](crate::linearize_at); `not-steady` if the state is neither an equilibrium nor a steady motion.
    pub fn steady_at(
        scene: &Scene<f64>,
        motions: &[RigidMotion<f64>],
    ) -> Result<Self, SimulationError> {
        Asked::alone(None, Axes::Turning).at(scene, motions)?.or_not_steady(scene)
    }

    /// Linearises as [`steady`](Self::steady) does, about any state. If the motion is not steady, the matrices hold only at that instant,
    /// in axes that do not turn. [`unsteady`](Self::unsteady) then gives the reason.
    ///
    /// # Errors
    /// As for [`linearize`](crate::linearize).
    pub fn frozen(scene: &Scene<f64>, options: &LinearizeOptions) -> Result<Self, SimulationError> {
        Asked::alone(Some(options.place), Axes::TurningOrStanding).about(scene, options)
    }

    /// Linearises as [`frozen`](Self::frozen) does, about the state in which bodies move as given by `motions`. These motions satisfy the
    /// constraints.
    ///
    /// # Errors
    /// As for [`linearize_at`](crate::linearize_at).
    pub fn frozen_at(
        scene: &Scene<f64>,
        motions: &[RigidMotion<f64>],
    ) -> Result<Self, SimulationError> {
        Asked::alone(None, Axes::TurningOrStanding).at(scene, motions)
    }

    fn or_not_steady(self, scene: &Scene<f64>) -> Result<Self, SimulationError> {
        let Some(unsteady) = self.unsteady else { return Ok(self) };
        let stop = StopError::NotSteady(Box::new(unsteady));
        Err(SimulationError::stopped(stop, 0.0, &Names::new(scene)))
    }

    /// Linearises a scene about the state in which bodies move as given by `motions`. These motions satisfy the constraints. Full turns of
    /// angles follow from the scene's initial values.
    ///
    /// # Errors
    /// As for [`linearize_at`](crate::linearize_at).
    pub fn at(
        scene: &Scene<f64>,
        motions: &[RigidMotion<f64>],
        inputs: Option<&[&str]>,
        outputs: Option<&[&str]>,
    ) -> Result<Self, SimulationError> {
        Asked { place: None, inputs, outputs, axes: Axes::Standing }.at(scene, motions)
    }
}

/// Request for a linear system: state, inputs, outputs and axes.
struct Asked<'a> {
    place: Option<Place>,
    inputs: Option<&'a [&'a str]>,
    outputs: Option<&'a [&'a str]>,
    axes: Axes,
}

impl Asked<'_> {
    /// Makes a request without inputs and outputs.
    const fn alone(place: Option<Place>, axes: Axes) -> Self {
        Self { place, inputs: Some(&[]), outputs: Some(&[]), axes }
    }

    fn about(
        &self,
        scene: &Scene<f64>,
        &LinearizeOptions { place, search }: &LinearizeOptions,
    ) -> Result<LinearSystem, SimulationError> {
        let stopped = |error| SimulationError::stopped(error, 0.0, &Names::new(scene));
        match scene.dimension {
            Dimension::Planar => {
                let placed = PlacedScene::<2>::new(scene, place, search);
                self.system(scene, &placed.map_err(stopped)?)
            }
            Dimension::Spatial => {
                let placed = PlacedScene::<3>::new(scene, place, search);
                self.system(scene, &placed.map_err(stopped)?)
            }
        }
    }

    fn at(
        &self,
        scene: &Scene<f64>,
        motions: &[RigidMotion<f64>],
    ) -> Result<LinearSystem, SimulationError> {
        let stopped = |error| SimulationError::stopped(error, 0.0, &Names::new(scene));
        match scene.dimension {
            Dimension::Planar => {
                let placed = PlacedScene::<2>::given(scene, motions);
                self.system(scene, &placed.map_err(stopped)?)
            }
            Dimension::Spatial => {
                let placed = PlacedScene::<3>::given(scene, motions);
                self.system(scene, &placed.map_err(stopped)?)
            }
        }
    }

    fn system<const D: usize>(
        &self,
        scene: &Scene<f64>,
        placed: &PlacedScene<D>,
    ) -> Result<LinearSystem, SimulationError> {
        let stopped = |error| SimulationError::stopped(error, 0.0, &Names::new(scene));
        let columns = OutputColumns::new(scene, self.outputs)?;
        let inputs = InputPlaces::new(scene, &placed.ready.model, self.inputs)?;
        let about = About { scene, placed, columns, inputs, axes: self.axes };
        let found = about.system().map_err(stopped)?;
        Ok(LinearSystem { place: self.place, ..found })
    }
}
