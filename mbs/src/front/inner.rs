//! What a simulation is behind its door: one implementation for every scalar and dimension.

use super::clock::StepClock;
use super::readings::Readings;
use super::tree::{Tree, TreeError};
use super::values::{
    BodyMotion, Coordinates, Energies, PointMotion, Pose, Sizes, StepReport, Wrench,
};
use crate::checkpoint::CheckpointError;
use crate::checkpoint::tape::{Eye, Pen, Tape, holds};
use crate::driver::{Observer, Stretch, drive};
use crate::precision::Work;
use crate::settings::{Settings, exact};
use crate::simulation::Simulation;
use crate::stop::StopError;
use core::fmt::Debug;
use core::ops::ControlFlow;
use mbs_core::Real;
use mbs_core::control::Accepted;
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{BodyId, InitialCondition, InitialTarget, JointId, Scene, Start};
use mbs_core::step::InputError;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A simulation without its scalar and its dimension.
pub(crate) trait Inner: Debug + Send + Sync {
    fn clone_box(&self) -> Box<dyn Inner>;
    fn time(&self) -> f64;
    fn values(&self, joint: usize) -> Coordinates;
    fn rates(&self, joint: usize) -> Coordinates;
    fn output(&self, output: usize) -> Result<Coordinates, StopError>;
    fn write_outputs(&self, out: &mut [f64]) -> Result<(), StopError>;
    fn n_outputs(&self) -> usize;
    fn reaction(&self, joint: usize) -> Result<Wrench, StopError>;
    fn body(&self, body: BodyId) -> (Pose, BodyMotion);
    fn point(&self, body: BodyId, at: [f64; 3]) -> PointMotion;
    fn energies(&self) -> Energies;
    fn sizes(&self) -> Sizes;
    /// Puts a tree of the same mechanism where the simulation is.
    fn follow(&self, tree: &mut Tree) -> Result<(), TreeError>;
    /// Length of the steps that the method asks for [s].
    fn length(&self) -> f64;
    fn is_controlled(&self) -> bool;
    /// Advances by `dt` [s]; `to` is the time at its end where that is known.
    fn step(&mut self, dt: f64, to: Option<f64>) -> Result<StepReport, StopError>;
    fn set_effect_input(&mut self, effect: usize, value: [f64; 3]) -> Result<(), InputError>;
    fn set_guide_input(&mut self, guide: usize, motion: [f64; 3]) -> Result<(), InputError>;
    /// Starts anew with these coordinates and rates of joints, or as the scene says, at a time [s].
    fn start(
        &mut self,
        states: Option<&[(JointId, Coordinates, Coordinates)]>,
        t: f64,
    ) -> Result<(), StopError>;
    fn save(&self) -> Result<Vec<u8>, CheckpointError>;
    fn restore(&mut self, bytes: &[u8]) -> Result<(), CheckpointError>;
}

/// It, in its scalar and dimension.
#[derive(Debug)]
struct Typed<T: Real, const D: usize> {
    scene: Scene<T>,
    settings: Settings,
    simulation: Simulation<T, D>,
    clock: StepClock<T>,
    readings: Mutex<Readings<T, D>>,
}

impl<T: Real, const D: usize> Typed<T, D> {
    fn new(scene: Scene<T>, settings: &Settings) -> Result<Self, StopError> {
        let simulation = Simulation::new(&scene, settings)?;
        let readings = Mutex::new(Readings::new(&scene, &simulation)?);
        let clock = StepClock::default();
        Ok(Self { scene, settings: settings.clone(), simulation, clock, readings })
    }

    fn read(&self) -> MutexGuard<'_, Readings<T, D>> {
        // readings are made anew from the state: a panic while they were made leaves nothing behind
        self.readings.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T: Real, const D: usize> Inner for Typed<T, D> {
    fn clone_box(&self) -> Box<dyn Inner> {
        Box::new(Self {
            scene: self.scene.clone(),
            settings: self.settings.clone(),
            simulation: self.simulation.clone(),
            clock: self.clock,
            readings: Mutex::new(self.read().clone()),
        })
    }

    fn time(&self) -> f64 {
        self.simulation.state().t.to_f64()
    }

    fn values(&self, joint: usize) -> Coordinates {
        self.read().values(joint, self.simulation.state())
    }

    fn rates(&self, joint: usize) -> Coordinates {
        self.read().rates(joint, self.simulation.state())
    }

    fn output(&self, output: usize) -> Result<Coordinates, StopError> {
        self.read().output(output, self.simulation.state())
    }

    fn write_outputs(&self, out: &mut [f64]) -> Result<(), StopError> {
        self.read().write(self.simulation.state(), out)
    }

    fn n_outputs(&self) -> usize {
        self.read().n_components()
    }

    fn reaction(&self, joint: usize) -> Result<Wrench, StopError> {
        self.read().reaction(joint, (&self.scene, &self.simulation))
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
        } = self.simulation.model().motion(&self.scene, body, self.simulation.state());
        let rotation =
            core::array::from_fn(|i| core::array::from_fn(|j| rotation[(i, j)].to_f64()));
        let pose = Pose { position: numbers(position.as_slice()), rotation };
        let motion = BodyMotion {
            velocity: numbers(velocity.as_slice()),
            acceleration: numbers(acceleration.as_slice()),
            angular_velocity: numbers(omega.as_slice()),
            angular_acceleration: numbers(angular_acceleration.as_slice()),
        };
        (pose, motion)
    }

    fn point(&self, body: BodyId, at: [f64; 3]) -> PointMotion {
        let (point, s) =
            (self.simulation.model().point(body, at.map(T::from_f64)), self.simulation.state());
        PointMotion {
            position: numbers(point.value(&s.q).as_slice()),
            velocity: numbers(point.rate(&s.v).as_slice()),
            acceleration: numbers(point.rate(&s.a).as_slice()),
        }
    }

    fn energies(&self) -> Energies {
        let [kinetic, potential, work] = self.simulation.energies();
        Energies { kinetic, potential, work }
    }

    fn follow(&self, tree: &mut Tree) -> Result<(), TreeError> {
        let (model, state) = (self.simulation.model(), self.simulation.state());
        let motion = |b| in_doubles(&model.motion(&self.scene, b, state));
        let motions: Vec<_> = (0..self.scene.bodies.len()).map(motion).collect();
        let applied: Vec<f64> = state.applied.iter().map(|x| x.to_f64()).collect();
        tree.follow_motions((state.t.to_f64(), &applied), &motions)
    }

    fn sizes(&self) -> Sizes {
        let [coordinates, constraints, rank] = self.simulation.sizes();
        Sizes { coordinates, constraints, rank }
    }

    fn length(&self) -> f64 {
        self.settings.step_max
    }

    fn step(&mut self, dt: f64, to: Option<f64>) -> Result<StepReport, StopError> {
        let (length, now) = (exact(&self.scene, dt), self.simulation.state().t);
        let end = self.clock.advance(now, (dt, length));
        let end = to.map_or(end, |to| exact(&self.scene, to));
        let readings = self.readings.get_mut().unwrap_or_else(PoisonError::into_inner);
        let fixed = (!self.simulation.is_controlled()).then_some(length);
        let mut watch = Watch { readings, sum: StepReport::default() };
        let interrupt = &self.settings.interrupt;
        drive(&mut self.simulation, [Stretch::to(end).in_one(fixed)], interrupt, &mut watch)?;
        let sum = watch.sum;
        self.clock.land(end);
        Ok(sum)
    }

    fn is_controlled(&self) -> bool {
        self.simulation.is_controlled()
    }

    fn set_effect_input(&mut self, effect: usize, value: [f64; 3]) -> Result<(), InputError> {
        self.simulation.set_input(effect, value.map(T::from_f64))?;
        self.readings.get_mut().unwrap_or_else(PoisonError::into_inner).stale();
        Ok(())
    }

    fn set_guide_input(&mut self, guide: usize, motion: [f64; 3]) -> Result<(), InputError> {
        self.simulation.set_guide(guide, motion.map(T::from_f64))
    }

    fn start(
        &mut self,
        states: Option<&[(JointId, Coordinates, Coordinates)]>,
        t: f64,
    ) -> Result<(), StopError> {
        let mut scene = self.scene.clone();
        if let Some(states) = states {
            let numbers = |from: &Coordinates| from.iter().map(|x| T::from_f64(*x)).collect();
            let condition = |(joint, values, rates): &(JointId, Coordinates, Coordinates)| {
                let (joint, value, rate) = (*joint, Some(numbers(values)), Some(numbers(rates)));
                InitialCondition { target: InitialTarget::Joint { joint, value, rate } }
            };
            scene.initials = states.iter().map(condition).collect();
            scene.start = Start::Initial;
        }
        let mut fresh = Self::new(scene, &self.settings)?;
        fresh.simulation.set_time(exact(&self.scene, t));
        // the scene's own conditions are those of a later reset
        core::mem::swap(&mut fresh.scene, &mut self.scene);
        *self = fresh;
        Ok(())
    }

    fn save(&self) -> Result<Vec<u8>, CheckpointError> {
        let mut pen = Pen::default();
        let mut state = Vec::new();
        self.simulation.save((&self.scene, &self.settings), &mut state)?;
        pen.list(&mut state, 1, |tape, byte| tape.bytes(core::slice::from_mut(byte)))?;
        self.read().clone().walk(&mut pen)?;
        self.clock.clone().walk(&mut pen)?;
        Ok(pen.0)
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), CheckpointError> {
        let (mut eye, mut state) = (Eye(bytes), Vec::new());
        eye.list(&mut state, 1, |tape, byte| tape.bytes(core::slice::from_mut(byte)))?;
        let (mut readings, mut clock) = (self.read().clone(), self.clock);
        readings.walk(&mut eye)?;
        clock.walk(&mut eye)?;
        holds(eye.0.is_empty())?;
        self.simulation.restore((&self.scene, &self.settings), &state[..])?;
        readings.stale();
        (self.readings, self.clock) = (Mutex::new(readings), clock);
        Ok(())
    }
}

/// Follows the readings of a simulation over its steps, and adds their reports.
struct Watch<'a, T: Real, const D: usize> {
    readings: &'a mut Readings<T, D>,
    sum: StepReport,
}

impl<T: Real, const D: usize> Observer<T, D> for Watch<'_, T, D> {
    fn step(
        &mut self,
        now: &Simulation<T, D>,
        accepted: &Accepted<T>,
        _: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        self.sum.add(accepted);
        self.readings.follow(now)?;
        Ok(ControlFlow::Continue(()))
    }
}

/// Components as plain numbers; those that the plane lacks are zero.
fn numbers<T: Real>(from: &[T]) -> [f64; 3] {
    core::array::from_fn(|i| from.get(i).map_or(0.0, |x| x.to_f64()))
}

/// A motion of a body, nearest doubles.
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

/// Building a simulation in the precision of its settings.
pub(super) struct Built<'a>(pub(super) &'a Settings);

impl Work for Built<'_> {
    type Done = Result<Box<dyn Inner>, StopError>;

    fn done<T: Real, const D: usize>(self, scene: &Scene<T>) -> Self::Done {
        Ok(Box::new(Typed::<T, D>::new(scene.clone(), self.0)?))
    }
}
