//! Quantities of a simulation, for every scalar and dimension: one implementation for `Simulation` and [`View`](super::View).

use super::readings::Readings;
use super::values::{BodyMotion, Coordinates, Energies, PointMotion, Pose, Sizes, Wrench, rows};
use crate::simulation::Simulation;
use crate::stop::StopError;
use crate::tree::{Tree, TreeError};
use core::borrow::Borrow;
use core::fmt::Debug;
use mbs_core::Real;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{BodyId, Scene};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Quantities of a mechanism between two steps.
pub trait Read: Debug + Send + Sync {
    fn time(&self) -> f64;
    fn values(&self, joint: usize) -> Coordinates;
    fn rates(&self, joint: usize) -> Coordinates;
    fn output(&self, output: usize) -> Result<Coordinates, StopError>;
    fn write_outputs(&self, out: &mut [f64]) -> Result<(), StopError>;
    fn n_outputs(&self) -> usize;
    fn reaction(&self, joint: usize) -> Result<Wrench, StopError>;
    fn effect_force(&self, effect: usize) -> Result<Wrench, StopError>;
    fn body(&self, body: BodyId) -> (Pose, BodyMotion);
    fn point(&self, body: BodyId, at: [f64; 3]) -> PointMotion;
    fn energies(&self) -> Energies;
    fn sizes(&self) -> Sizes;
    /// Sets a tree of the same mechanism to the current state of the simulation.
    fn follow(&self, tree: &mut Tree) -> Result<(), TreeError>;
}

/// Simulation with its readings. The simulation is owned, or borrowed for one call.
#[derive(Debug)]
pub struct Seen<T: Real, const D: usize, S> {
    pub scene: Arc<Scene<T>>,
    pub simulation: S,
    pub readings: Mutex<Readings<T, D>>,
}

impl<T: Real, const D: usize, S> Seen<T, D, S> {
    pub fn new(scene: Arc<Scene<T>>, simulation: S, readings: Readings<T, D>) -> Self {
        Self { scene, simulation, readings: Mutex::new(readings) }
    }

    pub fn read(&self) -> MutexGuard<'_, Readings<T, D>> {
        // Readings are always recomputed from the state. So a panic during an earlier computation leaves no invalid data, and a poisoned
        // lock is ignored.
        self.readings.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub fn into_readings(self) -> Readings<T, D> {
        self.readings.into_inner().unwrap_or_else(PoisonError::into_inner)
    }

    pub fn readings(&mut self) -> &mut Readings<T, D> {
        self.readings.get_mut().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T, const D: usize, S> Read for Seen<T, D, S>
where
    T: Real,
    S: Borrow<Simulation<T, D>> + Debug + Send + Sync,
{
    fn time(&self) -> f64 {
        self.simulation.borrow().state().t.to_f64()
    }

    fn values(&self, joint: usize) -> Coordinates {
        self.read().values(joint, self.simulation.borrow())
    }

    fn rates(&self, joint: usize) -> Coordinates {
        self.read().rates(joint, self.simulation.borrow())
    }

    fn output(&self, output: usize) -> Result<Coordinates, StopError> {
        self.read().output(output, self.simulation.borrow())
    }

    fn write_outputs(&self, out: &mut [f64]) -> Result<(), StopError> {
        self.read().write(self.simulation.borrow(), out)
    }

    fn n_outputs(&self) -> usize {
        self.read().n_components()
    }

    fn reaction(&self, joint: usize) -> Result<Wrench, StopError> {
        self.read().reaction(joint, (&self.scene, self.simulation.borrow()))
    }

    fn effect_force(&self, effect: usize) -> Result<Wrench, StopError> {
        assert!(effect < self.scene.effects.len(), "an effect of another mechanism");
        self.read().effect(effect, (&self.scene, self.simulation.borrow()))
    }

    fn body(&self, body: BodyId) -> (Pose, BodyMotion) {
        let BodyId::Body(body) = body else { return (Pose::default(), BodyMotion::default()) };
        let RigidMotion {
            position,
            rotation,
            omega,
            velocity,
            angular_acceleration,
            acceleration,
            ..
        } = self.simulation.borrow().model().motion(
            &self.scene,
            body,
            self.simulation.borrow().state(),
        );
        let pose = Pose { position: numbers(position.as_slice()), rotation: rows(&rotation) };
        let motion = BodyMotion {
            velocity: numbers(velocity.as_slice()),
            acceleration: numbers(acceleration.as_slice()),
            angular_velocity: numbers(omega.as_slice()),
            angular_acceleration: numbers(angular_acceleration.as_slice()),
        };
        (pose, motion)
    }

    fn point(&self, body: BodyId, at: [f64; 3]) -> PointMotion {
        let (point, s) = (
            self.simulation.borrow().model().point(body, at.map(T::from_f64)),
            self.simulation.borrow().state(),
        );
        PointMotion {
            position: numbers(point.value(&s.q).as_slice()),
            velocity: numbers(point.rate(&s.v).as_slice()),
            acceleration: numbers(point.rate(&s.a).as_slice()),
        }
    }

    fn energies(&self) -> Energies {
        let [kinetic, potential, work] = self.simulation.borrow().energies();
        Energies { kinetic, potential, work }
    }

    fn follow(&self, tree: &mut Tree) -> Result<(), TreeError> {
        let (model, state) = (self.simulation.borrow().model(), self.simulation.borrow().state());
        let motion = |b| in_doubles(&model.motion(&self.scene, b, state));
        let motions: Vec<_> = (0..self.scene.bodies.len()).map(motion).collect();
        let applied: Vec<f64> = state.applied.iter().map(|x| x.to_f64()).collect();
        let signals: Vec<_> = state.signals.iter().map(|x| x.map(|x| x.to_f64())).collect();
        tree.follow_motions((state.t.to_f64(), &applied, &signals), &motions)
    }

    fn sizes(&self) -> Sizes {
        let [coordinates, constraints, rank] = self.simulation.borrow().sizes();
        Sizes { coordinates, constraints, rank }
    }
}

/// Converts components to `f64`. For a planar mechanism, the missing third component is zero.
fn numbers<T: Real>(from: &[T]) -> [f64; 3] {
    core::array::from_fn(|i| from.get(i).map_or(0.0, |x| x.to_f64()))
}

/// Converts the motion of a body to `f64`.
fn in_doubles<T: Real>(from: &RigidMotion<T>) -> RigidMotion<f64> {
    let vector = |x: &[T]| numbers(x).into();
    RigidMotion {
        origin: vector(from.origin.as_slice()),
        position: vector(from.position.as_slice()),
        rotation: from.rotation.map(|x| x.to_f64()),
        omega: vector(from.omega.as_slice()),
        velocity: vector(from.velocity.as_slice()),
        angular_acceleration: vector(from.angular_acceleration.as_slice()),
        acceleration: vector(from.acceleration.as_slice()),
    }
}
