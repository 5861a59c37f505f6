//! Loop that makes the steps of a run from one instant to the next, and calls observers.

use crate::interrupt::Interrupt;
use crate::precision::is_finer;
use crate::simulation::Simulation;
use crate::stop::StopError;
use core::ops::{ControlFlow, Deref};
use mbs_core::control::Accepted;
use mbs_core::once::found;
use mbs_core::step::{InputError, Step, StepError, StepReport};
use mbs_core::{Real, instances};

/// Largest remaining time at the end of a stretch that is skipped, in units of the machine precision of the time [-]. Chosen, not tuned.
const ROUNDINGS: f64 = 32.0;
/// Largest remaining time that is skipped, relative to the length of the stretch [-]. It limits the effect of `ROUNDINGS` in `f32`, where a
/// rounding error of the time can exceed a short step.
const MAX_SLIVER: f64 = 1e-5;

/// Observes a run, sets inputs between steps, and may end the run. All methods do nothing by default.
///
/// An error that an observer returns stops the run and becomes its reason. [`ControlFlow::Break`] ends the run without an error.
///
/// ```
/// use core::ops::ControlFlow;
/// use mbs::core::control::Accepted;
/// use mbs::typed::{StepObserver, Simulation, run};
/// use mbs::{Method, ResolvedMethod, StopError, scene_file::SceneFile};
///
/// /// Ends a run when the first coordinate falls below zero.
/// struct Ground;
/// impl StepObserver<f64, 2> for Ground {
///     fn step(
///         &mut self,
///         now: &Simulation<f64, 2>,
///         _: &Accepted<f64>,
///         _: bool,
///     ) -> Result<ControlFlow<()>, StopError> {
///         let height = now.state().q[1];
///         Ok(if height < 0.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
///     }
/// }
///
/// let text = r#"
/// [scene]
/// dimension = 2
/// duration = 1.0
/// gravity = [0.0, -9.81]
/// [[body]]
/// name = "stone"
/// mass = 1.0
/// center = [0.0, 1.0]
/// inertia = 0.1
/// "#;
/// let scene = SceneFile::parse(text, "stone.toml")?.scene::<f64>()?;
/// let settings = ResolvedMethod::new(&scene, &Method::default())?;
/// let outcome = run::<f64, 2>(&scene, &settings, &mut Ground);
/// // a stone falls 1 m in √(2/9.81) s
/// assert!((outcome.summary.end_time - 0.4515).abs() < 2e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait StepObserver<T: Real, const D: usize> {
    /// Prepares a step; inputs may be set here. With step control, a rejected trial step is repeated with the same inputs.
    ///
    /// # Errors
    /// The error that stops the run.
    fn before(&mut self, inputs: &mut StepInputs<'_, T, D>) -> Result<(), StopError> {
        let _ = inputs;
        Ok(())
    }

    /// Called after each accepted step; `is_last` is true for the step that ends the run.
    ///
    /// # Errors
    /// The error that stops the run.
    fn step(
        &mut self,
        now: &Simulation<T, D>,
        accepted: &Accepted<T>,
        is_last: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        let _ = (now, accepted, is_last);
        Ok(ControlFlow::Continue(()))
    }

    /// Called at each instant at which a step must end. It is a row of a comparison, or the end of a period or of a fixed step.
    ///
    /// # Errors
    /// The error that stops the run.
    fn instant(&mut self, now: &Simulation<T, D>) -> Result<ControlFlow<()>, StopError> {
        let _ = now;
        Ok(ControlFlow::Continue(()))
    }

    /// Called when the run has ended; `stop` is the reason if the run stopped early.
    fn end(&mut self, now: &Simulation<T, D>, stop: Option<&StopError>) {
        let _ = (now, stop);
    }
}

impl<T: Real, const D: usize> StepObserver<T, D> for () {}

/// Observer that calls two observers, the first one first.
impl<T: Real, const D: usize, A: StepObserver<T, D>> StepObserver<T, D>
    for (&mut A, &mut dyn StepObserver<T, D>)
{
    fn before(&mut self, inputs: &mut StepInputs<'_, T, D>) -> Result<(), StopError> {
        self.0.before(inputs)?;
        self.1.before(inputs)
    }

    fn step(
        &mut self,
        now: &Simulation<T, D>,
        accepted: &Accepted<T>,
        is_last: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        let first = self.0.step(now, accepted, is_last)?;
        let second = self.1.step(now, accepted, is_last)?;
        Ok(if first.is_break() { first } else { second })
    }

    fn instant(&mut self, now: &Simulation<T, D>) -> Result<ControlFlow<()>, StopError> {
        let first = self.0.instant(now)?;
        let second = self.1.instant(now)?;
        Ok(if first.is_break() { first } else { second })
    }

    fn end(&mut self, now: &Simulation<T, D>, stop: Option<&StopError>) {
        self.0.end(now, stop);
        self.1.end(now, stop);
    }
}

/// A simulation between two steps, whose inputs can be set.
#[derive(Debug)]
pub struct StepInputs<'a, T: Real, const D: usize>(&'a mut Simulation<T, D>);

impl<T: Real, const D: usize> StepInputs<'_, T, D> {
    /// Sets the input of an effect, as [`Simulation::set_input`] does.
    ///
    /// # Errors
    /// [`InputError`] where there is no such input, or a component is not finite.
    pub fn set_input(&mut self, effect: usize, value: [T; 3]) -> Result<(), InputError> {
        self.0.set_input(effect, value)
    }

    /// Sets the motion of a guide, as [`Simulation::set_guide`] does.
    ///
    /// # Errors
    /// [`InputError`] where there is no such input, or a component is not finite.
    pub fn set_guide(&mut self, guide: usize, motion: [T; 3]) -> Result<(), InputError> {
        self.0.set_guide(guide, motion)
    }

    /// Sets the value of a signal, as [`Simulation::set_signal`] does.
    ///
    /// # Errors
    /// [`InputError`] where there is no such input, or the value is not finite.
    pub fn set_signal(&mut self, signal: usize, value: T) -> Result<(), InputError> {
        self.0.set_signal(signal, value)
    }
}

impl<T: Real, const D: usize> Deref for StepInputs<'_, T, D> {
    type Target = Simulation<T, D>;

    fn deref(&self) -> &Simulation<T, D> {
        self.0
    }
}

/// Returns `Continue` if the condition holds, else `Break`.
pub fn continue_if(yes: bool) -> ControlFlow<()> {
    if yes { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
}

/// System that the loop steps. It is one simulation, or several simulations that step alternately; observers see one of them.
pub trait Plant<T: Real, const D: usize> {
    /// The simulation that makes the next step.
    fn stepped(&mut self) -> &mut Simulation<T, D>;

    /// The simulation that observers see.
    fn shown(&self) -> &Simulation<T, D>;

    /// Makes one step of length `rest` [s], or of at most `rest` with step control.
    fn advance(&mut self, rest: T) -> Result<Accepted<T>, StepError> {
        self.stepped().advance(rest)
    }

    /// Sets the time of the simulation [s].
    fn set_time(&mut self, t: T) {
        self.stepped().set_time(t);
    }
}

impl<T: Real, const D: usize> Plant<T, D> for Simulation<T, D> {
    fn stepped(&mut self) -> &mut Self {
        self
    }

    fn shown(&self) -> &Self {
        self
    }
}

/// Interval of simulated time that ends at an instant at which a step has to end.
#[derive(Debug, Clone, Copy)]
pub struct Stretch<T> {
    /// End of the stretch [s].
    pub to: T,
    /// Steps of fixed length; `None`: the step control chooses the number of steps.
    pub fixed: Option<Fixed<T>>,
    /// True if the run ends with this stretch.
    pub is_last: bool,
}

/// Number of steps, time before the first step, and step length, for steps of fixed length.
#[derive(Debug, Clone, Copy)]
pub struct Fixed<T> {
    /// Number of steps in the stretch.
    pub n: u64,
    /// Time before the first step, in the precision of the run and in `f64` [s].
    pub from: (T, f64),
    /// Length of a step, in the precision of the run and in `f64` [s].
    pub dt: (T, f64),
}

impl<T: Real> Stretch<T> {
    /// Stretch from the current time to an instant. The step control chooses its steps, or a single step covers it.
    pub fn to(to: T) -> Self {
        Self { to, fixed: None, is_last: false }
    }

    /// Stretch with a single step of length `dt` [s]. If `dt` is `None`, the step control chooses the steps.
    pub fn in_one(self, dt: Option<T>) -> Self {
        let fixed = |dt: T| Fixed { n: 1, from: (T::ZERO, 0.0), dt: (dt, dt.to_f64()) };
        Self { fixed: dt.map(fixed), ..self }
    }

    /// Stretch with `n` equal steps from time `now`. The total length `dt` [s] is given in the precision of the run and in `f64`.
    pub fn in_parts(self, now: T, dt: (T, f64), n: f64) -> Self {
        let dt = (dt.0 / T::from_f64(n), dt.1 / n);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let n = n as u64;
        Self { fixed: Some(Fixed { n, from: (now, now.to_f64()), dt }), ..self }
    }

    /// Time after `j` steps of fixed length [s]; `None` for steps of controlled length.
    fn known(&self, j: u64) -> Option<T> {
        let Fixed { n, from, dt } = self.fixed?;
        Some(if j == n { self.to } else { multiple(from, j, dt) })
    }
}

/// Time t + k h [s]: `k` steps of length h after time t. It is computed in `f64` unless `T` has more digits, so that times in an `f32` run
/// have no accumulated rounding error.
pub fn multiple<T: Real>(t: (T, f64), k: u64, h: (T, f64)) -> T {
    #[allow(clippy::cast_precision_loss, reason = "step counts stay far below 2^53")]
    let count = k as f64;
    if is_finer::<T>() { t.0 + T::from_f64(count) * h.0 } else { T::from_f64(t.1 + count * h.1) }
}

/// Makes the steps of all stretches, until the end, an error, or an interrupt.
///
/// # Errors
/// The reason why the run stopped.
pub fn drive<T: Real, const D: usize>(
    plant: &mut impl Plant<T, D>,
    stretches: impl IntoIterator<Item = Stretch<T>>,
    interrupt: &Interrupt,
    observer: &mut (impl StepObserver<T, D> + ?Sized),
) -> Result<(), StopError> {
    for stretch in stretches {
        match along(plant, &stretch, interrupt, observer) {
            Ok(ControlFlow::Continue(())) => {}
            Ok(ControlFlow::Break(())) => break,
            Err(stop) => {
                observer.end(plant.shown(), Some(&stop));
                return Err(stop);
            }
        }
    }
    observer.end(plant.shown(), None);
    Ok(())
}

/// [`drive`] for one simulation, compiled in this crate. It is for callers that contain the simulation.
///
/// # Errors
/// The reason why the run stopped.
pub fn drive_simulation<T: Real, const D: usize>(
    simulation: &mut Simulation<T, D>,
    stretches: impl IntoIterator<Item = Stretch<T>>,
    interrupt: &Interrupt,
    observer: &mut dyn StepObserver<T, D>,
) -> Result<(), StopError> {
    let stretches = &mut stretches.into_iter();
    if T::HAS_INSTANCES {
        return found::<Drive<T, D>>(DRIVE)(simulation, stretches, interrupt, observer);
    }
    drive_here(simulation, stretches, interrupt, observer)
}

type Drive<T, const D: usize> = fn(
    &mut Simulation<T, D>,
    &mut dyn Iterator<Item = Stretch<T>>,
    &Interrupt,
    &mut dyn StepObserver<T, D>,
) -> Result<(), StopError>;
instances!(DRIVE: Drive<T, D> = drive_here::<T, D>);

fn drive_here<T: Real, const D: usize>(
    simulation: &mut Simulation<T, D>,
    stretches: &mut dyn Iterator<Item = Stretch<T>>,
    interrupt: &Interrupt,
    observer: &mut dyn StepObserver<T, D>,
) -> Result<(), StopError> {
    drive(simulation, stretches, interrupt, observer)
}

/// Largest remaining time [s] of a stretch that is skipped, because it is close to the rounding error of the time. `to` is the end of the
/// stretch [s] and `length` its length [s].
fn remainder<T: Real>(to: T, length: T) -> T {
    (to * T::EPSILON * T::from_f64(ROUNDINGS)).min(length * T::from_f64(MAX_SLIVER))
}

/// Makes the steps of one stretch; returns whether the run continues.
fn along<T: Real, const D: usize>(
    plant: &mut impl Plant<T, D>,
    stretch: &Stretch<T>,
    interrupt: &Interrupt,
    observer: &mut (impl StepObserver<T, D> + ?Sized),
) -> Result<ControlFlow<()>, StopError> {
    let mut j = 0;
    let least = remainder(stretch.to, stretch.to - plant.shown().state().t);
    loop {
        let left = stretch.to - plant.shown().state().t;
        let rest = stretch.fixed.map_or(left, |fixed| fixed.dt.0);
        if stretch.fixed.is_none() && left <= least {
            plant.set_time(stretch.to);
            break;
        }
        observer.before(&mut StepInputs(plant.stepped()))?;
        let accepted = plant.advance(rest).map_err(|error| plant.stepped().explain(error))?;
        j += 1;
        let left = stretch.to - plant.shown().state().t;
        let ends = match stretch.fixed {
            Some(fixed) => j == fixed.n,
            None => accepted.is_last || left <= least,
        };
        if let Some(t) = stretch.known(j).or(ends.then_some(stretch.to)) {
            plant.set_time(t);
        }
        let is_last = ends && stretch.is_last;
        let flow = observer.step(plant.shown(), &accepted, is_last)?;
        if flow.is_break() {
            return Ok(flow);
        }
        if interrupt.is_set() && !is_last {
            return Err(StopError::Interrupted);
        }
        if ends {
            break;
        }
    }
    observer.instant(plant.shown())
}

/// Observer that adds the reports of all steps.
struct Sum<T>(StepReport<T>);

impl<T: Real, const D: usize> StepObserver<T, D> for Sum<T> {
    fn step(
        &mut self,
        _: &Simulation<T, D>,
        accepted: &Accepted<T>,
        _: bool,
    ) -> Result<ControlFlow<()>, StopError> {
        self.0.add(&accepted.attempt.report);
        Ok(ControlFlow::Continue(()))
    }
}

impl<T: Real, const D: usize> Simulation<T, D> {
    /// Advances by `dt` [s]: in one step, or in as many steps as the step control makes.
    ///
    /// # Errors
    /// [`StopError`] with the joint or body concerned; the state is then the state after the last accepted step.
    pub fn step(&mut self, dt: T) -> Result<StepReport<T>, StopError> {
        let mut stretch = Stretch::to(self.state().t + dt);
        if self.is_controlled() {
            let step = Step { dt, length: self.model().length() }.checked();
            step.map_err(|error| self.explain(error))?;
        } else {
            stretch = stretch.in_one(Some(dt));
        }
        let mut sum = Sum(StepReport { steps: 0, ..StepReport::default() });
        drive(self, [stretch], &Interrupt::default(), &mut sum)?;
        Ok(sum.0)
    }
}
