//! View of a run between its steps, for an observer, and the inputs that the observer may set.

use super::failure::SimulationError;
use super::inputs::{InputId, InputInfo, InputOwner, Inputs, Sink};
use super::readings::Readings;
use super::seen::{Read, Seen};
use super::values::StepReport;
use crate::names::Names;
use crate::simulation::Simulation;
use crate::stop::StopError;
use crate::typed;
use core::ops::ControlFlow;
use mbs_core::Real;
use mbs_core::control::Accepted;
use mbs_core::scene::{EffectId, GuideId, Scene, SignalId};
use mbs_core::step::InputError;
use std::sync::Arc;

/// A mechanism at an instant of a run, with the same methods as a `Simulation` for reading.
#[derive(Debug, Clone, Copy)]
pub struct View<'a> {
    seen: &'a dyn Read,
    names: &'a Names,
}

impl<'a> View<'a> {
    pub fn new(seen: &'a dyn Read, names: &'a Names) -> Self {
        Self { seen, names }
    }

    pub fn seen(&self) -> &dyn Read {
        self.seen
    }

    pub fn stopped(&self, error: StopError) -> SimulationError {
        SimulationError::stopped(error, self.time(), self.names)
    }
}

impl<'a> From<&Self> for View<'a> {
    fn from(view: &Self) -> Self {
        *view
    }
}

/// Observes a run, sets its inputs, and may end it. All methods do nothing by default.
///
/// An error that an observer returns stops the run and becomes its reason; [`SimulationError::new`] creates a user-defined error.
/// [`ControlFlow::Break`] ends the run without an error.
///
/// # Examples
/// ```
/// use core::ops::ControlFlow;
/// use mbs::{
///     Body, Effect, EffectId, GROUND, Joint, JointId, Mechanism, Observer, Run, RunInputs, Signal,
///     SimulationError, StepReport, View, Watchers, run_with,
/// };
///
/// /// Holds an arm where it is by PD control, and ends the run when it is at rest.
/// struct Hold {
///     motor: EffectId,
///     pivot: JointId,
/// }
/// impl Observer for Hold {
///     fn inputs(&mut self, now: &View<'_>, inputs: &mut RunInputs<'_>) -> Result<(), SimulationError> {
///         let torque = -200.0 * (now.value(self.pivot) - 0.5) - 20.0 * now.rate(self.pivot);
///         inputs.set(inputs.of_effect(self.motor)?, torque)
///     }
///     fn step(&mut self, now: &View<'_>, _: &StepReport) -> Result<ControlFlow<()>, SimulationError> {
///         let off = (now.value(self.pivot) - 0.5).abs() + now.rate(self.pivot).abs();
///         Ok(if off < 1e-6 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
///     }
/// }
///
/// let mut m = Mechanism::planar("arm");
/// let arm = m.add(Body::rod([0.0, 0.0], [1.0, 0.0], 3.0));
/// let pivot = m.add(Joint::revolute([GROUND, arm], [0.0, 0.0]));
/// let motor = m.add(Effect::torque(pivot, Signal::input(0.0)));
/// let result = run_with(&m, &Run::new().duration(5.0), &mut Watchers::observers(&mut [&mut Hold { motor, pivot }]))?;
/// let angle = result.table().column("joint-1").unwrap().last().unwrap();
/// // inertia 1 kg m², stiffness 200 N m/rad, damping 20 N m s/rad: e^(−10 t) falls to 1e-6 well before 5 s
/// assert!((angle - 0.5).abs() < 1e-6 && result.summary().end_time < 2.5);
/// # Ok::<(), SimulationError>(())
/// ```
pub trait Observer {
    /// Sets inputs before a step. The values hold until they are set again.
    ///
    /// # Errors
    /// The error that stops the run.
    fn inputs(
        &mut self,
        now: &View<'_>,
        inputs: &mut RunInputs<'_>,
    ) -> Result<(), SimulationError> {
        let _ = (now, inputs);
        Ok(())
    }

    /// Called after each accepted step.
    ///
    /// # Errors
    /// The error that stops the run.
    fn step(
        &mut self,
        now: &View<'_>,
        report: &StepReport,
    ) -> Result<ControlFlow<()>, SimulationError> {
        let _ = (now, report);
        Ok(ControlFlow::Continue(()))
    }

    /// Receives the final state of a run; `stop` is the reason if the run stopped early.
    fn end(&mut self, now: &View<'_>, stop: Option<&SimulationError>) {
        let _ = (now, stop);
    }
}

/// Inputs of a run, which an observer can set before a step.
#[derive(Debug)]
pub struct RunInputs<'a> {
    inputs: &'a mut Inputs,
    pending: &'a mut Pending,
}

impl RunInputs<'_> {
    /// All inputs, in the order of effects, guides, couplings, then signals.
    #[must_use]
    pub fn list(&self) -> &[InputInfo] {
        self.inputs.list()
    }

    /// The first input of an effect; the further components of a vector follow it.
    ///
    /// # Errors
    /// If the effect has no input.
    pub fn of_effect(&self, effect: EffectId) -> Result<InputId, SimulationError> {
        self.inputs.of_effect(effect)
    }

    /// Sets the value of an input. The value acts from the beginning of the next step until it is set again.
    ///
    /// # Errors
    /// A value that is not finite, or an input of another mechanism. Then no input is set.
    pub fn set(&mut self, input: InputId, value: f64) -> Result<(), SimulationError> {
        self.inputs.set(self.pending, input, value)
    }

    /// Sets the value, rate and acceleration that a guide has at the end of the next step.
    ///
    /// # Errors
    /// A guide that is no input, or a value that is not finite.
    pub fn set_guide(&mut self, guide: GuideId, motion: [f64; 3]) -> Result<(), SimulationError> {
        self.inputs.set_guide(self.pending, guide, motion)
    }
}

/// Inputs that an observer has set and that the simulation has not yet received: owner and values of each.
#[derive(Debug, Default)]
struct Pending(Vec<(InputOwner, [f64; 3])>);

impl Sink for Pending {
    fn set_effect_input(&mut self, effect: usize, value: [f64; 3]) -> Result<(), InputError> {
        InputError::check(effect, &value)?;
        self.0.push((InputOwner::Effect(EffectId::new(effect)), value));
        Ok(())
    }

    fn set_guide_input(&mut self, guide: usize, motion: [f64; 3]) -> Result<(), InputError> {
        InputError::check(guide, &motion)?;
        self.0.push((InputOwner::Guide(GuideId::new(guide)), motion));
        Ok(())
    }

    fn set_signal_input(&mut self, signal: usize, value: f64) -> Result<(), InputError> {
        let value = [value, 0.0, 0.0];
        InputError::check(signal, &value)?;
        self.0.push((InputOwner::Signal(SignalId::new(signal)), value));
        Ok(())
    }
}

impl Pending {
    fn write<T: Real, const D: usize>(
        &mut self,
        to: &mut typed::StepInputs<'_, T, D>,
    ) -> Result<(), SimulationError> {
        for (owner, numbers) in self.0.drain(..) {
            let numbers = numbers.map(T::from_f64);
            match owner {
                InputOwner::Effect(effect) => to.set_input(effect.index(), numbers)?,
                InputOwner::Guide(guide) | InputOwner::Coupling { sum: guide, .. } => {
                    to.set_guide(guide.index(), numbers)?;
                }
                InputOwner::Signal(signal) => to.set_signal(signal.index(), numbers[0])?,
            }
        }
        Ok(())
    }
}

/// Readings of a run for its views: created by the first view, and updated after each step.
#[allow(
    missing_debug_implementations,
    reason = "it holds what has none, and is made and used in one call"
)]
pub struct Sight<'a, T: Real, const D: usize> {
    scene: Arc<Scene<T>>,
    names: &'a Names,
    readings: Option<Readings<T, D>>,
}

impl<'a, T: Real, const D: usize> Sight<'a, T, D> {
    pub fn new(scene: &Scene<T>, names: &'a Names) -> Self {
        Self { scene: Arc::new(scene.clone()), names, readings: None }
    }

    /// Updates the readings after a step.
    pub fn follow(&mut self, now: &Simulation<T, D>) -> Result<(), StopError> {
        self.readings.as_mut().map_or(Ok(()), |readings| readings.follow(now))
    }

    /// Calls a function with the view of the current state.
    pub fn show<R>(
        &mut self,
        now: &Simulation<T, D>,
        show: impl FnOnce(&View<'_>) -> R,
    ) -> Result<R, StopError> {
        let known = match self.readings.take() {
            Some(known) => known,
            None => Readings::new(&self.scene, now)?,
        };
        let seen = Seen::new(self.scene.clone(), now, known);
        let shown = show(&View::new(&seen, self.names));
        self.readings = Some(seen.into_readings());
        Ok(shown)
    }
}

/// Adapter that makes several observers in `f64` one observer of a run in its scalar and dimension.
#[allow(
    missing_debug_implementations,
    reason = "it holds what has none, and is made and used in one call"
)]
pub struct Observed<'a, 'b, T: Real, const D: usize> {
    sight: Sight<'a, T, D>,
    inputs: Inputs,
    pending: Pending,
    observers: &'a mut [&'b mut dyn Observer],
}

impl<'a, 'b, T: Real, const D: usize> Observed<'a, 'b, T, D> {
    pub fn new(
        sight: Sight<'a, T, D>,
        inputs: Inputs,
        observers: &'a mut [&'b mut dyn Observer],
    ) -> Self {
        Self { sight, inputs, pending: Pending::default(), observers }
    }

    /// Shows the current state to each observer.
    fn show(
        &mut self,
        now: &Simulation<T, D>,
        mut show: impl FnMut(&mut dyn Observer, &View<'_>, RunInputs<'_>) -> Result<(), SimulationError>,
    ) -> Result<(), StopError> {
        let Self { sight, inputs, pending, observers } = self;
        let shown = sight.show(now, |view| {
            observers.iter_mut().try_for_each(|observer| {
                let inputs = RunInputs { inputs: &mut *inputs, pending: &mut *pending };
                show(&mut **observer, view, inputs)
            })
        });
        shown?.map_err(|error| error.into_stop())
    }
}

impl<T: Real, const D: usize> typed::StepObserver<T, D> for Observed<'_, '_, T, D> {
    fn before(&mut self, to: &mut typed::StepInputs<'_, T, D>) -> Result<(), StopError> {
        self.show(to, |observer, now, mut inputs| observer.inputs(now, &mut inputs))?;
        self.pending.write(to).map_err(|error| error.into_stop())
    }

    fn step(
        &mut self,
        now: &Simulation<T, D>,
        accepted: &Accepted<T>,
        _: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        self.sight.follow(now)?;
        let mut report = StepReport::default();
        report.add(accepted);
        let mut flow = ControlFlow::Continue(());
        self.show(now, |observer, now, _| {
            let asked = observer.step(now, &report)?;
            flow = if asked.is_break() { asked } else { flow };
            Ok(())
        })?;
        Ok(flow)
    }

    fn end(&mut self, now: &Simulation<T, D>, stop: Option<&StopError>) {
        let (t, names) = (now.state().t.to_f64(), self.sight.names);
        let stop = stop.map(|stop| SimulationError::stopped(stop.clone(), t, names));
        // The run has already ended, so an error that an observer returns here is ignored.
        let _ = self.show(now, |observer, now, _| {
            observer.end(now, stop.as_ref());
            Ok(())
        });
    }
}
