//! Simulation of a mechanism, step by step.

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

/// Largest difference between the sum of the steps and the end time, in units of the rounding of that time [-]. Chosen, not tuned.
const TIME_ROUNDINGS: f64 = 4.0;
/// Largest difference between the sum of the steps and the end time, relative to a step [-]. Chosen, not tuned.
const STEP_FRACTION: f64 = 1e-3;

/// Simulation of a mechanism. A program makes the steps, reads the state between them, and can clone the simulation to try something out.
///
/// Numbers are in SI units, vectors in global axes. In a planar mechanism the third component is zero, and rotations are about z. Handles are
/// those of the [`Mechanism`](crate::Mechanism) that was simulated. A handle of another mechanism panics if its index is out of range.
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

    /// Advances by `dt` [s]: in one step, or in several if the method controls their length. An integrator with its own step control first
    /// divides `dt` into equal parts. A part is at most a hundred of its longest steps, and an interrupt can end the call between two parts.
    ///
    /// # Errors
    /// [`SimulationError`] with time and joint. The state is then the state before the failed step.
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

    /// True if the method chooses the length of its steps.
    #[must_use]
    pub fn is_controlled(&self) -> bool {
        self.inner.is_controlled()
    }

    /// Sets the interrupt that ends [`advance_to`](Self::advance_to) and steps of controlled length from now on. A copy of the simulation
    /// shares the interrupt of the original until another interrupt is set in the copy.
    pub fn set_interrupt(&mut self, interrupt: Interrupt) {
        self.inner.set_interrupt(interrupt);
    }

    /// Step length of the method [s].
    #[must_use]
    pub fn step_length(&self) -> f64 {
        self.inner.length()
    }

    /// Advances to `time` [s] by steps of the method's length. The last step is shorter if the length does not divide the interval. A method
    /// that controls its steps advances in one call.
    ///
    /// # Errors
    /// Those of [`step`](Self::step), and a time before the present one.
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
        // times in single precision are rounded; late in a run with short steps, this rounding may exceed a step, hence the bound by
        // `STEP_FRACTION`
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

    /// Returns the present value of an output that is code, without a check that it is finite.
    ///
    /// # Panics
    /// For a handle of another mechanism whose index is out of range.
    #[must_use]
    pub fn function(&self, function: FunctionId) -> f64 {
        self.functions[function.0].code.evaluate(&self.view())
    }

    /// Contacts of bumpers, limits and tires that began or ended since the last [`clear_events`](Self::clear_events), in the order of time.
    /// The list has at most a thousand events, and none before the first call of `clear_events`. The time of an event is interpolated within
    /// a step.
    pub fn events(&self) -> impl Iterator<Item = ContactEvent> + '_ {
        self.inner.events().iter().map(ContactEvent::of)
    }

    /// Clears the list of contact events. The first call also starts the recording of events, which evaluates each one-sided effect once more
    /// a step. Changing the state by [`set_state`](Self::set_state), [`reset`](Self::reset) or [`restore`](Self::restore) clears the list
    /// too.
    ///
    /// # Errors
    /// Errors of the model. They cannot occur after the simulation was built.
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

    /// Inputs that can be set between steps. Inputs of effects come first, then those of guides, couplings and signals.
    #[must_use]
    pub fn inputs(&self) -> &[InputInfo] {
        self.inputs.list()
    }

    /// The present values of all inputs, in the order of [`inputs`](Self::inputs).
    #[must_use]
    pub fn input_values(&self) -> &[f64] {
        self.inputs.values()
    }

    /// Writes all inputs into the model after the model was restarted.
    pub(super) fn renew_inputs(&mut self) -> Result<(), SimulationError> {
        self.inputs.renew(&mut *self.inner)
    }

    /// Returns the first input of an effect; inputs of the other components of a vector follow it.
    ///
    /// # Errors
    /// An effect without input: its signal is no [`Signal::Input`](crate::Signal::Input).
    pub fn input_of(&self, effect: EffectId) -> Result<InputId, SimulationError> {
        self.inputs.of_effect(effect)
    }

    /// Sets the value of an input. The value acts from the start of the next step.
    ///
    /// # Errors
    /// A value that is not finite, or an input of another mechanism. The input keeps its value then.
    pub fn set_input(&mut self, input: InputId, value: f64) -> Result<(), SimulationError> {
        self.inputs.set(&mut *self.inner, input, value)
    }

    /// Sets all inputs, in the order of [`inputs`](Self::inputs).
    ///
    /// # Errors
    /// Those of [`set_input`](Self::set_input), and a wrong number of values.
    pub fn set_inputs(&mut self, all: &[f64]) -> Result<(), SimulationError> {
        self.inputs.set_all(&mut *self.inner, all)
    }

    /// Sets the value, rate and acceleration that a guide has at the end of the next step.
    ///
    /// # Errors
    /// A guide whose motion is no [`Motion::Input`](crate::Motion::Input), or a number that is not finite.
    pub fn set_guide(
        &mut self,
        guide: GuideId,
        value: f64,
        rate: f64,
        acceleration: f64,
    ) -> Result<(), SimulationError> {
        self.inputs.set_guide(&mut *self.inner, guide, [value, rate, acceleration])
    }

    /// Sets the state of the mechanism at the present time. The given joints have exactly the given coordinates and rates. All others follow
    /// by the smallest mass-weighted change from the reference configuration. `[].into()` leaves the coordinates or rates of a joint free.
    /// Energy and work are counted from zero again, and inputs keep their values.
    ///
    /// # Errors
    /// A state that the joints do not allow, a wrong number of values, a joint that is given twice, or a value that is not finite. After time
    /// zero, a mechanism with guides is refused, because guided joints can be assembled only where their guides begin. The simulation keeps
    /// its state then.
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

    /// Checks that each joint is given once. All of its coordinates or none must be given, likewise its rates, and all must be finite.
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

    /// Starts again at time zero, with the start values of the mechanism's inputs.
    ///
    /// # Errors
    /// The errors with which the first start can fail.
    pub fn reset(&mut self) -> Result<(), SimulationError> {
        self.inner.start(None, 0.0).map_err(|error| self.stopped(error))?;
        self.inputs.reset();
        Ok(())
    }

    /// Saves the state that the next steps depend on.
    ///
    /// # Errors
    /// Errors of the snapshot's format only. No call of this interface causes them.
    pub fn save(&self) -> Result<Snapshot, SimulationError> {
        Ok(Snapshot { bytes: self.inner.save()?, inputs: self.inputs.values().to_vec() })
    }

    /// Restores a snapshot of a simulation of the same mechanism and method. The next steps then give the same bits as after the snapshot was
    /// taken.
    ///
    /// # Errors
    /// A snapshot of another mechanism, method or version. The simulation keeps its state then.
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), SimulationError> {
        self.inputs.check(&snapshot.inputs)?;
        self.inner.restore(&snapshot.bytes)?;
        self.inputs.restore(&snapshot.inputs);
        Ok(())
    }
}

/// Saved state of a simulation, which it can return to.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    bytes: Vec<u8>,
    inputs: Vec<f64>,
}

/// First bytes of a snapshot, with the version number of its format.
const MAGIC: &[u8; 10] = b"mbs-snap\x02\x00";

impl Snapshot {
    /// Returns the snapshot as bytes for a file. The bytes identify the mechanism, method and version.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend((self.inputs.len() as u64).to_le_bytes());
        bytes.extend(self.inputs.iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend_from_slice(&self.bytes);
        bytes.extend(fingerprint(&bytes).to_le_bytes());
        bytes
    }

    /// Makes a snapshot from the bytes of [`to_bytes`](Self::to_bytes). [`Simulation::restore`] checks that the state suits the simulation.
    ///
    /// # Errors
    /// Bytes that are no snapshot, or that were truncated or changed.
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
