//! A mechanism in motion.

use super::failure::SimulationError;
use super::function::{Function, FunctionId};
use super::inner::Inner;
use super::inputs::{InputId, InputInfo, Inputs};
use super::seen::Read;
use super::values::{ContactEvent, Coordinates, StepReport};
use super::view::View;
use crate::checkpoint::CheckpointError;
use crate::fingerprint::fingerprint;
use crate::interrupt::Interrupt;
use crate::names::Names;
use crate::settings::length::SAME_LENGTH;
use crate::stop::StopError;
use mbs_core::model::Owner;
use mbs_core::scene::{EffectId, GuideId, JointId};
use std::sync::Arc;

/// Largest difference of a sum of steps and its end, in units of rounding of the time [-]. Chosen, not tuned.
const TIME_ROUNDINGS: f64 = 4.0;
/// Largest difference of a sum of steps and its end, relative to a step [-]. Chosen, not tuned.
const STEP_FRACTION: f64 = 1e-3;

/// A mechanism in motion: stepped by hand, read between steps, and cloned to try something and throw the copy away.
///
/// Numbers are in SI units, vectors in global axes; in a planar mechanism the third component is zero, and rotations are about z. Handles are
/// those of the [`Mechanism`](crate::Mechanism) that it was made of: one of another mechanism panics like an index.
///
/// ```
/// use mbs::{Body, GROUND, Joint, Mechanism, Method};
/// let mut m = Mechanism::planar("double pendulum");
/// m.set_gravity([0.0, -9.81]);
/// let upper = m.add(Body::rod([0.0, 0.0], [1.0, 0.0], 1.0));
/// let lower = m.add(Body::rod([1.0, 0.0], [2.0, 0.0], 1.0));
/// let pivot = m.add(Joint::revolute([GROUND, upper], [0.0, 0.0]));
/// let elbow = m.add(Joint::revolute([upper, lower], [1.0, 0.0]));
/// let mut sim = m.simulate(&Method::default())?;
/// sim.advance_to(1.0)?;
/// assert!((sim.value(pivot) - -2.778493).abs() < 1e-6 && (sim.value(elbow) - 0.393281).abs() < 1e-6);
/// # Ok::<(), mbs::SimulationError>(())
/// ```
#[derive(Debug)]
pub struct Simulation {
    pub(super) inner: Box<dyn Inner>,
    inputs: Inputs,
    names: Arc<Names>,
    functions: Arc<[Function]>,
}

impl Clone for Simulation {
    fn clone(&self) -> Self {
        let (inputs, functions) = (self.inputs.clone(), self.functions.clone());
        Self { inner: self.inner.clone_box(), inputs, names: self.names.clone(), functions }
    }
}

impl<'a> From<&'a Simulation> for View<'a> {
    fn from(simulation: &'a Simulation) -> Self {
        simulation.view()
    }
}

impl Simulation {
    pub(super) fn of(
        inner: Box<dyn Inner>,
        inputs: Inputs,
        names: Names,
        functions: &[Function],
    ) -> Self {
        Self { inner, inputs, names: Arc::new(names), functions: functions.into() }
    }

    pub(super) fn seen(&self) -> &dyn Read {
        self.inner.seen()
    }

    pub(super) fn view(&self) -> View<'_> {
        View::new(self.inner.seen(), &self.names)
    }

    pub(super) fn stopped(&self, error: StopError) -> SimulationError {
        SimulationError::stopped(error, self.time(), &self.names)
    }

    /// Advances by `dt` [s]: one step, or as many as the step control takes. What an integrator divides by itself is divided into equal parts
    /// before, of a hundred of the longest steps at most: an interrupt is heard between them.
    ///
    /// # Errors
    /// [`SimulationError`] with time and joint; the state is then that before the failed step.
    pub fn step(&mut self, dt: f64) -> Result<StepReport, SimulationError> {
        if !(dt > 0.0 && dt.is_finite()) {
            let message = format!("a step must be positive and finite, but is {dt} s");
            return Err(SimulationError::new(
                "bad-step",
                message,
                "write a number larger than zero",
            ));
        }
        self.inner.step(Some(dt), None).map_err(|error| self.stopped(error))
    }

    /// Does the method choose the length of its steps?
    #[must_use]
    pub fn is_controlled(&self) -> bool {
        self.inner.is_controlled()
    }

    /// Sets what ends [`advance_to`](Self::advance_to), and calls that make several steps of a controlled length, from now on. Copies share it
    /// with what they are copies of until they get their own.
    pub fn set_interrupt(&mut self, interrupt: Interrupt) {
        self.inner.set_interrupt(interrupt);
    }

    /// Length of the steps that the method asks for [s].
    #[must_use]
    pub fn step_length(&self) -> f64 {
        self.inner.length()
    }

    /// Advances to `time` [s] by steps of the method's length, the last one shorter where they do not fit; at once where the method controls
    /// their length.
    ///
    /// # Errors
    /// As for [`step`](Self::step); one before now is refused.
    pub fn advance_to(&mut self, time: f64) -> Result<StepReport, SimulationError> {
        let (from, h) = (self.time(), self.inner.length());
        let (there, epsilon) = self.inner.rounded(time);
        let span = there - from;
        let mut sum = StepReport::default();
        if span == 0.0 {
            return Ok(sum);
        }
        if !(span > 0.0 && span.is_finite()) {
            let message = format!("a simulation at {from} s cannot advance to {time} s");
            return Err(SimulationError::new(
                "bad-step",
                message,
                "clone or save an earlier state to return to it",
            ));
        }
        if self.inner.is_controlled() {
            return self.inner.step(None, Some(time)).map_err(|error| self.stopped(error));
        }
        // times of short numbers round, by more than short steps last where they are late
        let rounding = (TIME_ROUNDINGS * epsilon * there.abs()).min(STEP_FRACTION * h);
        let slack = SAME_LENGTH * (span + h) + rounding;
        loop {
            let rest = there - self.time();
            let is_last = rest <= h + slack;
            let is_full = !is_last || (rest - h).abs() <= slack;
            let (dt, to) = (is_full.then_some(h), is_last.then_some(time));
            let report = self.inner.step(dt, to).map_err(|error| self.stopped(error))?;
            sum.join_report(&report);
            if is_last {
                return Ok(sum);
            }
            if self.inner.is_interrupted() {
                return Err(self.stopped(StopError::Interrupted));
            }
        }
    }

    /// The present value of an output that is code, whatever it gives.
    ///
    /// # Panics
    /// For a handle of another mechanism, as an index does.
    #[must_use]
    pub fn function(&self, function: FunctionId) -> f64 {
        self.functions[function.0].code.evaluate(&self.view())
    }

    /// Contacts of bumpers, limits and tires that began or ended since the last [`clear_events`](Self::clear_events), in order, a thousand at
    /// most; none before its first call. Their times are interpolated within steps.
    pub fn events(&self) -> impl Iterator<Item = ContactEvent> + '_ {
        self.inner.events().iter().map(ContactEvent::of)
    }

    /// Lists contacts anew from now on. The first call begins to watch them, which costs an evaluation of each one-sided effect at a step.
    /// Another state, by [`set_state`](Self::set_state), [`reset`](Self::reset) or [`restore`](Self::restore), clears the list too.
    ///
    /// # Errors
    /// None that a simulation that was built can make; those of the model.
    ///
    /// ```
    /// use mbs::{Body, Effect, GROUND, Joint, Mechanism, Method};
    /// let mut m = Mechanism::planar("drop on a stop");
    /// m.set_gravity([0.0, -9.81]);
    /// let mass = m.add(Body::planar([0.0, 0.0], 1.0, 0.1));
    /// let slide = m.add(Joint::prismatic([GROUND, mass], [0.0, 0.0]).along([0.0, 1.0]));
    /// let stop = m.add(Effect::limit(slide, [-0.1, 1.0], 1e5, 0.0));
    /// let mut sim = m.simulate(&Method::default())?;
    /// sim.clear_events()?;
    /// sim.advance_to(0.2)?;
    /// let hit = sim.events().next().expect("it falls by 0.1 m");
    /// assert_eq!((hit.effect, hit.is_made), (stop, true));
    /// assert!((hit.time - (2.0 * 0.1_f64 / 9.81).sqrt()).abs() < 1e-4);
    /// # Ok::<(), mbs::SimulationError>(())
    /// ```
    pub fn clear_events(&mut self) -> Result<(), SimulationError> {
        self.inner.watch_events().map_err(|error| self.stopped(error))
    }

    /// Inputs that can be set between steps, in the order of effects, guides, couplings, then signals.
    #[must_use]
    pub fn inputs(&self) -> &[InputInfo] {
        self.inputs.list()
    }

    /// The present values of all inputs, in the order of [`inputs`](Self::inputs).
    #[must_use]
    pub fn input_values(&self) -> &[f64] {
        self.inputs.values()
    }

    /// Writes all inputs into what was started anew.
    pub(super) fn renew_inputs(&mut self) -> Result<(), SimulationError> {
        self.inputs.renew(&mut *self.inner)
    }

    /// The first input of an effect; those of a vector follow it.
    ///
    /// # Errors
    /// Where the effect has none: its signal is no [`Signal::Input`](crate::Signal::Input).
    pub fn input_of(&self, effect: EffectId) -> Result<InputId, SimulationError> {
        self.inputs.of_effect(effect)
    }

    /// Sets an input from now on: it acts in the whole of the next step.
    ///
    /// # Errors
    /// A value that is not finite, or an input of another mechanism. Nothing is set then.
    pub fn set_input(&mut self, input: InputId, value: f64) -> Result<(), SimulationError> {
        self.inputs.set(&mut *self.inner, input, value)
    }

    /// Sets all inputs, in the order of [`inputs`](Self::inputs).
    ///
    /// # Errors
    /// As for [`set_input`](Self::set_input); a wrong number of values.
    pub fn set_inputs(&mut self, all: &[f64]) -> Result<(), SimulationError> {
        self.inputs.set_all(&mut *self.inner, all)
    }

    /// Sets value, rate and acceleration that a guide has at the end of the next step.
    ///
    /// # Errors
    /// A guide that is no [`Motion::Input`](crate::Motion::Input), or a number that is not finite.
    pub fn set_guide(
        &mut self,
        guide: GuideId,
        value: f64,
        rate: f64,
        acceleration: f64,
    ) -> Result<(), SimulationError> {
        self.inputs.set_guide(&mut *self.inner, guide, [value, rate, acceleration])
    }

    /// Puts the mechanism into another state: coordinates and rates of these joints hold exactly, the rest follows by the least
    /// mass-weighted change from the reference configuration. `[].into()` holds nothing. The clock stays; energies and work are counted
    /// anew, and inputs keep their values.
    ///
    /// # Errors
    /// States that the joints do not allow, a wrong number of numbers, a joint that comes twice, a number that is not finite. After time zero
    /// also a mechanism with guides, whose joints are assembled where guides begin. The simulation is then as it was.
    pub fn set_state(
        &mut self,
        joints: &[(JointId, Coordinates, Coordinates)],
    ) -> Result<(), SimulationError> {
        self.check_state(joints)?;
        if self.inner.is_guided() && self.time() != 0.0 {
            let message = "guided joints are assembled where their guides begin, at time zero";
            let hint = "reset the simulation first, or restore a snapshot";
            return Err(SimulationError::new("state-refused", message, hint));
        }
        let started = self.inner.start(Some(joints), self.time());
        started.map_err(|error| self.stopped(error))?;
        self.renew_inputs()
    }

    /// Each joint once, with all its coordinates or none, and its rates likewise, finite.
    fn check_state(
        &self,
        joints: &[(JointId, Coordinates, Coordinates)],
    ) -> Result<(), SimulationError> {
        for (i, (joint, values, rates)) in joints.iter().enumerate() {
            let n = self.values(*joint).len();
            let (message, hint) = if joints[..i].iter().any(|(other, ..)| other == joint) {
                ("the joint comes twice".to_owned(), "name it once")
            } else if let Some(x) = [values, rates].into_iter().find(|x| ![0, n].contains(&x.len()))
            {
                let message = format!("{} numbers for a joint that has {n} coordinates", x.len());
                (message, "give all its numbers, or none")
            } else if values.iter().chain(rates.iter()).any(|x| !x.is_finite()) {
                ("a number of the state is not finite".to_owned(), "give finite numbers")
            } else {
                continue;
            };
            let (name, _) = self.names.of(Owner::Joint(joint.index()));
            return Err(SimulationError::new("state-refused", message, hint).about(name));
        }
        Ok(())
    }

    /// Starts anew at time zero, with the inputs of the mechanism.
    ///
    /// # Errors
    /// Those of the first start.
    pub fn reset(&mut self) -> Result<(), SimulationError> {
        self.inner.start(None, 0.0).map_err(|error| self.stopped(error))?;
        self.inputs.reset();
        Ok(())
    }

    /// All that the next steps depend on.
    ///
    /// # Errors
    /// None that a user can make; those of the format.
    pub fn save(&self) -> Result<Snapshot, SimulationError> {
        Ok(Snapshot { bytes: self.inner.save()?, inputs: self.inputs.values().to_vec() })
    }

    /// Returns to a snapshot of a simulation of the same mechanism and method: the next steps have the same bits.
    ///
    /// # Errors
    /// A snapshot of another mechanism, method or version; the simulation is then as it was.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), SimulationError> {
        self.inputs.check(&snapshot.inputs)?;
        self.inner.restore(&snapshot.bytes)?;
        self.inputs.restore(&snapshot.inputs);
        Ok(())
    }
}

/// A state to return to.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    bytes: Vec<u8>,
    inputs: Vec<f64>,
}

/// First bytes of a snapshot, with the number of its form.
const MAGIC: &[u8; 10] = b"mbs-snap\x02\x00";

impl Snapshot {
    /// Returns the snapshot as bytes, for a file: the checkpoint in it knows its mechanism, method and version.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend((self.inputs.len() as u64).to_le_bytes());
        bytes.extend(self.inputs.iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend_from_slice(&self.bytes);
        bytes.extend(fingerprint(&bytes).to_le_bytes());
        bytes
    }

    /// From the bytes of [`to_bytes`](Self::to_bytes); what is in them is checked by [`Simulation::restore`].
    ///
    /// # Errors
    /// Bytes that are no snapshot, or not all of it as they were.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, SimulationError> {
        let parts = || {
            let (bytes, sum) = bytes.split_last_chunk::<8>()?;
            if fingerprint(bytes) != u64::from_le_bytes(*sum) {
                return None;
            }
            let (count, rest) = bytes.strip_prefix(MAGIC)?.split_first_chunk::<8>()?;
            let n = usize::try_from(u64::from_le_bytes(*count)).ok()?;
            let (inputs, bytes) = rest.split_at_checked(n.checked_mul(8)?)?;
            let inputs = inputs.chunks_exact(8).map(|x| x.try_into().map(f64::from_le_bytes));
            Some(Self { bytes: bytes.to_vec(), inputs: inputs.collect::<Result<_, _>>().ok()? })
        };
        parts().ok_or_else(|| CheckpointError::NotACheckpoint.into())
    }
}

mbs_steps::readings!(Simulation);
