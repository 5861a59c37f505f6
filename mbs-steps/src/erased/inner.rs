//! Simulations whose scalar and dimension are hidden: one interface that is implemented for every scalar and dimension.

use super::clock::StepClock;
use super::inputs::Sink;
use super::readings::Readings;
use super::seen::{Read, Seen};
use super::values::{Coordinates, StepReport};
use crate::checkpoint::CheckpointError;
use crate::checkpoint::tape::{Eye, Pen, Tape, holds};
use crate::driver::{StepObserver, Stretch, drive};
use crate::interrupt::Interrupt;
use crate::precision::{ReadScene, SceneWork};
use crate::ready::AssembledScene;
use crate::settings::{ResolvedMethod, exact};
use crate::simulation::Simulation;
use crate::stop::StopError;
use core::fmt::Debug;
use core::ops::ControlFlow;
use mbs_core::Real;
use mbs_core::algebra::Vector;
use mbs_core::control::Accepted;
use mbs_core::outputs::{Contacts, Instant};
use mbs_core::rigid::RigidMotion;
use mbs_core::scene::{InitialCondition, InitialTarget, JointId, Scene, Start};
use mbs_core::step::InputError;
use std::sync::{Arc, Mutex, PoisonError};

/// A simulation whose scalar and dimension are hidden.
pub trait Inner: Sink + Debug + Send + Sync {
    fn clone_box(&self) -> Box<dyn Inner>;
    /// Interface through which the quantities of the simulation are read.
    fn seen(&self) -> &dyn Read;
    /// Contacts that began or ended since monitoring started.
    fn events(&self) -> &[Instant];
    /// Starts the monitoring of contacts.
    fn watch_events(&mut self) -> Result<(), StopError>;
    /// Length of the steps, according to the method [s].
    fn length(&self) -> f64;
    /// Returns a time rounded to the precision of the simulation [s], and the relative machine precision.
    fn rounded(&self, time: f64) -> (f64, f64);
    fn is_controlled(&self) -> bool;
    /// True if the interrupt flag of the simulation is set.
    fn is_interrupted(&self) -> bool;
    fn set_interrupt(&mut self, interrupt: Interrupt);
    /// Advances the simulation by `dt` [s], or to the time `to` [s] if `dt` is `None`. If `to` is given, the time at the end is exactly
    /// `to`.
    fn step(&mut self, dt: Option<f64>, to: Option<f64>) -> Result<StepReport, StopError>;
    /// True if the motion of some joint is prescribed by a guide.
    fn is_guided(&self) -> bool;
    /// Restarts the simulation at time `t` [s] from the given joint coordinates and rates; `None`: from the scene's initial conditions.
    fn start(
        &mut self,
        states: Option<&[(JointId, Coordinates, Coordinates)]>,
        t: f64,
    ) -> Result<(), StopError>;
    /// Restarts the simulation at the current time from the given motions of the bodies, which satisfy the constraints. For each angle the
    /// number of full turns is chosen such that it is closest to the given joint coordinate.
    fn place(
        &mut self,
        states: &[(JointId, Coordinates, Coordinates)],
        motions: &[RigidMotion<f64>],
    ) -> Result<(), StopError>;
    fn save(&self) -> Result<Vec<u8>, CheckpointError>;
    fn restore(&mut self, bytes: &[u8]) -> Result<(), CheckpointError>;
}

/// Largest length of a part of a step, in units of the largest step [-]. A step that an integrator divides internally is made in such
/// parts, so that an interrupt takes effect between them. Chosen, not tuned.
const INTERRUPTED: f64 = 100.0;

/// Simulation with its scalar, dimension, settings and clock.
#[derive(Debug)]
struct Typed<T: Real, const D: usize> {
    seen: Seen<T, D, Simulation<T, D>>,
    settings: ResolvedMethod,
    clock: StepClock<T>,
    /// Contacts, if they are monitored.
    contacts: Option<Contacts<T, D>>,
}

impl<T: Real, const D: usize> Typed<T, D> {
    fn new(scene: Scene<T>, settings: &ResolvedMethod) -> Result<Self, StopError> {
        let simulation = Simulation::new(&scene, settings)?;
        Self::of(scene, simulation, settings)
    }

    fn of(
        scene: Scene<T>,
        simulation: Simulation<T, D>,
        settings: &ResolvedMethod,
    ) -> Result<Self, StopError> {
        let readings = Readings::new(&scene, &simulation)?;
        let seen = Seen::new(Arc::new(scene), simulation, readings);
        let clock = StepClock::default();
        Ok(Self { seen, settings: settings.clone(), clock, contacts: None })
    }

    /// Replaces this simulation by another simulation of the same mechanism. The original scene remains, because a later reset uses its
    /// initial conditions.
    fn take(&mut self, fresh: Self) {
        let (own, contacts) = (self.seen.scene.clone(), self.contacts.take());
        *self = fresh;
        (self.seen.scene, self.contacts) = (own, contacts);
        self.rewatch();
    }

    /// Clears the list of contacts, because the current state was set and is not the end of the last step.
    fn rewatch(&mut self) {
        if let Some(contacts) = &mut self.contacts {
            contacts.resume(self.seen.simulation.state(), &[], 0);
        }
    }
}

impl<T: Real, const D: usize> Sink for Typed<T, D> {
    fn set_effect_input(&mut self, effect: usize, value: [f64; 3]) -> Result<(), InputError> {
        self.seen.simulation.set_input(effect, value.map(T::from_f64))?;
        self.seen.readings().stale();
        Ok(())
    }

    fn set_guide_input(&mut self, guide: usize, motion: [f64; 3]) -> Result<(), InputError> {
        self.seen.simulation.set_guide(guide, motion.map(T::from_f64))
    }

    fn set_signal_input(&mut self, signal: usize, value: f64) -> Result<(), InputError> {
        self.seen.simulation.set_signal(signal, T::from_f64(value))?;
        self.seen.readings().stale();
        Ok(())
    }
}

impl<T: Real, const D: usize> Inner for Typed<T, D> {
    fn clone_box(&self) -> Box<dyn Inner> {
        let Self { seen, settings, clock, contacts } = self;
        let readings = seen.read().clone();
        let seen = Seen::new(seen.scene.clone(), seen.simulation.clone(), readings);
        let (settings, contacts) = (settings.clone(), contacts.clone());
        Box::new(Self { seen, settings, clock: *clock, contacts })
    }

    fn seen(&self) -> &dyn Read {
        &self.seen
    }

    fn events(&self) -> &[Instant] {
        self.contacts.as_ref().map_or(&[], Contacts::instants)
    }

    fn watch_events(&mut self) -> Result<(), StopError> {
        if self.contacts.is_none() {
            let contacts = Contacts::new(&self.seen.scene, self.seen.simulation.model());
            self.contacts = Some(contacts.map_err(|e| StopError::Start(e.into()))?);
        }
        self.rewatch();
        Ok(())
    }

    fn length(&self) -> f64 {
        self.settings.step_max
    }

    fn is_interrupted(&self) -> bool {
        self.settings.interrupt.is_set()
    }

    fn set_interrupt(&mut self, interrupt: Interrupt) {
        self.settings.interrupt = interrupt;
    }

    fn step(&mut self, dt: Option<f64>, to: Option<f64>) -> Result<StepReport, StopError> {
        let Self { seen: Seen { scene, simulation, readings }, settings, clock, contacts } = self;
        let (now, to) = (simulation.state().t, to.map(|to| exact::<T>(scene, to)));
        let left = to.map_or(T::ZERO, |to| to - now);
        let (dt, length) = match dt {
            Some(dt) => (dt, exact(scene, dt)),
            None => (left.to_f64(), left),
        };
        let end = clock.advance(now, (dt, length));
        let end = to.unwrap_or(end);
        let readings = readings.get_mut().unwrap_or_else(PoisonError::into_inner);
        let fixed = (!simulation.is_controlled()).then_some(length);
        let mut watch = Watch { readings, contacts, sum: StepReport::default() };
        // An interrupt ends the call between two steps. After the last step the call is complete, so no interrupt is reported.
        let mut stretch = Stretch { is_last: true, ..Stretch::to(end).in_one(fixed) };
        let parts = (dt / (settings.step_max * INTERRUPTED)).ceil();
        if fixed.is_some() && settings.integrator.controls_its_step() && parts > 1.0 {
            stretch = stretch.in_parts(now, (length, dt), parts);
        }
        drive(simulation, [stretch], &settings.interrupt, &mut watch)?;
        clock.land(end);
        Ok(watch.sum)
    }

    fn rounded(&self, time: f64) -> (f64, f64) {
        (exact::<T>(&self.seen.scene, time).to_f64(), T::EPSILON.to_f64())
    }

    fn is_guided(&self) -> bool {
        !self.seen.scene.guides.is_empty()
    }

    fn is_controlled(&self) -> bool {
        self.seen.simulation.is_controlled()
    }

    fn start(
        &mut self,
        states: Option<&[(JointId, Coordinates, Coordinates)]>,
        t: f64,
    ) -> Result<(), StopError> {
        let own = &self.seen.scene;
        let scene = states.map_or_else(|| Scene::clone(own), |states| started(own, states));
        let mut fresh = Self::new(scene, &self.settings)?;
        let t = exact(own, t);
        if t != T::ZERO {
            // Inputs, guides and signals must have their values at the current time.
            let simulation = &mut fresh.seen.simulation;
            simulation.set_time(t);
            simulation.resume().map_err(|error| simulation.explain(error))?;
            fresh.seen.readings = Mutex::new(Readings::new(own, simulation)?);
        }
        self.take(fresh);
        Ok(())
    }

    fn place(
        &mut self,
        states: &[(JointId, Coordinates, Coordinates)],
        motions: &[RigidMotion<f64>],
    ) -> Result<(), StopError> {
        let scene = started(&self.seen.scene, states);
        let motions: Vec<_> = motions.iter().map(in_scalar).collect();
        let ready = AssembledScene::placed(&scene, (self.seen.simulation.state().t, &motions))?;
        let simulation = Simulation::of(&scene, &self.settings, ready)?;
        self.take(Self::of(scene, simulation, &self.settings)?);
        Ok(())
    }

    fn save(&self) -> Result<Vec<u8>, CheckpointError> {
        let mut pen = Pen::default();
        let mut state = Vec::new();
        self.seen.simulation.save((&self.seen.scene, &self.settings), &mut state)?;
        pen.list(&mut state, 1, |tape, byte| tape.bytes(core::slice::from_mut(byte)))?;
        self.seen.read().clone().walk(&mut pen)?;
        self.clock.clone().walk(&mut pen)?;
        Ok(pen.0)
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), CheckpointError> {
        let (mut eye, mut state) = (Eye(bytes), Vec::new());
        eye.list(&mut state, 1, |tape, byte| tape.bytes(core::slice::from_mut(byte)))?;
        let (mut readings, mut clock) = (self.seen.read().clone(), self.clock);
        readings.walk(&mut eye)?;
        clock.walk(&mut eye)?;
        holds(eye.0.is_empty())?;
        let Seen { scene, simulation, .. } = &mut self.seen;
        simulation.restore((scene, &self.settings), &state[..])?;
        readings.stale();
        (self.seen.readings, self.clock) = (Mutex::new(readings), clock);
        self.rewatch();
        Ok(())
    }
}

/// Returns the scene with the given initial coordinates and rates of its joints.
pub fn started<T: Real>(
    own: &Scene<T>,
    states: &[(JointId, Coordinates, Coordinates)],
) -> Scene<T> {
    let numbers = |from: &Coordinates| from.iter().map(|x| T::from_f64(*x)).collect();
    let condition = |(joint, values, rates): &(JointId, Coordinates, Coordinates)| {
        let (joint, value, rate) = (*joint, Some(numbers(values)), Some(numbers(rates)));
        InitialCondition { target: InitialTarget::Joint { joint, value, rate } }
    };
    let initials = states.iter().map(condition).collect();
    Scene { initials, start: Start::Initial, ..own.clone() }
}

/// Converts the motion of a body to another scalar.
fn in_scalar<T: Real>(from: &RigidMotion<f64>) -> RigidMotion<T> {
    let vector = |x: &Vector<f64, 3>| x.map(T::from_f64);
    RigidMotion {
        origin: vector(&from.origin),
        position: vector(&from.position),
        rotation: from.rotation.map(T::from_f64),
        omega: vector(&from.omega),
        velocity: vector(&from.velocity),
        angular_acceleration: vector(&from.angular_acceleration),
        acceleration: vector(&from.acceleration),
    }
}

/// Observer that updates the readings of a simulation after each step, and adds the reports of the steps.
struct Watch<'a, T: Real, const D: usize> {
    readings: &'a mut Readings<T, D>,
    contacts: &'a mut Option<Contacts<T, D>>,
    sum: StepReport,
}

impl<T: Real, const D: usize> StepObserver<T, D> for Watch<'_, T, D> {
    fn step(
        &mut self,
        now: &Simulation<T, D>,
        accepted: &Accepted<T>,
        _: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        self.sum.add(accepted);
        if let Some(contacts) = self.contacts {
            contacts.watch(now.state());
        }
        self.readings.follow(now)?;
        Ok(ControlFlow::Continue(()))
    }
}

/// Builds the simulation of a scene in the precision of the scene's numbers.
///
/// # Errors
/// [`StopError`] if there is no model, no consistent start, or no such formulation.
pub fn built(read: &ReadScene<'_>, settings: &ResolvedMethod) -> Result<Box<dyn Inner>, StopError> {
    read.work(Built(settings))
}

struct Built<'a>(&'a ResolvedMethod);

impl SceneWork for Built<'_> {
    type Done = Result<Box<dyn Inner>, StopError>;

    fn done<T: Real, const D: usize>(self, scene: &Scene<T>) -> Self::Done {
        Ok(Box::new(Typed::<T, D>::new(scene.clone(), self.0)?))
    }
}
