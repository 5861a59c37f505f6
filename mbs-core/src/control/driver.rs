//! Driver of the step size. It tries steps, evaluates them, repeats rejected steps with a shorter length, and plans the next step.

use super::energy::{EnergyRule, Steering};
use super::invariant::Invariant;
use crate::Real;
use crate::ode::StepControl;
use crate::step::{StepError, StepReport};

/// Factor on the length of a failed step for its next trial [-]. Chosen, not tuned.
const AFTER_FAILURE: f64 = 0.25;
/// Shortest step, relative to the largest [-]. Chosen, not tuned: a run with such steps reaches [`MOST_TRIALS`] first, which corresponds to
/// an average step of 1e-5 of the largest.
const SMALLEST: f64 = 1e-10;
/// Shortest step, in multiples of the rounding error of the time [-]. The clock then measures the step to a sixteenth of its length.
const TIME_ROUNDINGS: f64 = 16.0;
/// Largest number of trials within a time equal to the largest step [-]. A run with shorter steps on average would take too long. Chosen, not
/// tuned.
const MOST_TRIALS: u32 = 100_000;
/// Largest number of repetitions to end a step at an event [-]. Two or three are usual; the others are a reserve.
const MOST_LANDINGS: u32 = 12;
/// Growth factor of the step if no rule limits it [-]. Chosen, not tuned: the largest step limits the result.
const FREE: f64 = 2.0;

/// Mechanism that a driver steps: a formulation with a state that can be restored.
pub trait Stepper<T: Real> {
    /// Prepares a trial of length `h` [s], after `reductions` consecutive reductions of this step. A stepper may change the index of its
    /// formulation here.
    ///
    /// # Errors
    /// [`StepError`] of the kinds that a trial returns.
    fn prepare(&mut self, h: T, reductions: u32) -> Result<(), StepError> {
        let _ = (h, reductions);
        Ok(())
    }

    /// Tries a step of length `h` [s].
    ///
    /// # Errors
    /// [`StepError`]; the state is then unchanged.
    fn attempt(&mut self, h: T) -> Result<TrialStep<T>, StepError>;

    /// Restores the state before the last attempt.
    fn undo(&mut self);

    /// The first event within the last attempt of length `h` [s].
    fn first_event(&mut self, h: T) -> Option<Event> {
        let _ = h;
        None
    }

    /// Accepts the last attempt. `at_event`: the attempt ends at an event.
    fn keep(&mut self, at_event: bool);
}

/// Outcome of a trial step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrialStep<T> {
    /// Report of the formulation on the step.
    pub report: StepReport<T>,
    /// Time at the end of the step [s].
    pub t: T,
    /// Kinetic energy, potential energy and work [J] at the end of the step.
    pub energies: [f64; 3],
    /// Local error of the step, relative to the scene's length [-]. Zero if no estimate is required.
    pub error: f64,
    /// Acceleration energy 1/2 a^T M a at the beginning and end of the step [J/s^2]. It gives the energy scale of a first step, when
    /// nothing has moved yet. Once energy moves ([`Invariant::is_moving`]), the smaller of the two numbers counts. Before that the number
    /// at the end counts. Zero if unknown.
    pub acceleration_energy: [f64; 2],
}

/// An event within a trial step, or at its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// Fraction of the trial, from 0.001 to 1.05, after which the event comes. The value aims slightly past the event. It is above 1 if the
    /// trial ends just before the event, so that no tiny step must follow.
    pub share: f64,
    /// True if the end of the trial is close enough to the event to be accepted. The fraction is then one.
    pub is_landed: bool,
    /// True if this is not an event, but a contact that began with the trial and is too stiff for its length.
    pub is_too_stiff: bool,
    /// Index of the effect in the scene.
    pub effect: usize,
}

/// Rules by which the driver chooses steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rules<T> {
    /// Largest step length [s].
    pub max_step: T,
    /// Limits of the change of the energy invariant; `None`: no energy rule.
    pub energy: Option<EnergyRule>,
    /// Tolerance of the local error, relative to the scene's length [-], and the power of h to which the error is proportional. `None`: no
    /// error rule.
    pub error: Option<(f64, u32)>,
}

/// Cause that limited the length of the next step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    /// Limit by the largest step, or by the end of the run.
    Largest,
    /// Limit by the energy rule.
    Energy,
    /// Limit by the error estimate.
    Error,
    /// Limit by an event that ended the step.
    Event,
    /// Limit by a stiff contact that began with the step.
    Contact,
    /// Limit by a step that did not converge.
    Failure,
}

impl Limit {
    /// All limits, in the order of the enum.
    pub const ALL: [Self; 6] =
        [Self::Largest, Self::Energy, Self::Error, Self::Event, Self::Contact, Self::Failure];

    /// Name of the limit in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Largest => "max",
            Self::Energy => "energy",
            Self::Error => "error",
            Self::Event => "event",
            Self::Contact => "contact",
            Self::Failure => "failure",
        }
    }
}

/// A step that was accepted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accepted<T> {
    /// Outcome of the last trial. Its iterations, factorisations and solutions are the sums over all trials that converged.
    pub attempt: TrialStep<T>,
    /// Length of the step [s].
    pub step: T,
    /// Number of earlier trials of this step that were rejected, or shortened for an event.
    pub rejected: u32,
    /// Change of the energy invariant in the step [J].
    pub change: f64,
    /// Cause that limited this step or the next step.
    pub limit: Limit,
    /// Whether the step reached the end of the given time.
    pub is_last: bool,
}

/// State of the step-size control.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Driver<T> {
    max_step: T,
    energy: Option<Steering>,
    error: Option<(f64, StepControl<T>)>,
    /// Length of the next trial, and length of the first trial [s].
    next: T,
    first: T,
    /// Start of the present interval of one largest step [s], and the number of trials in it; `None` before the first trial.
    stretch: Option<(T, u32)>,
}

/// Counts a trial from time `t` [s] in the present interval, which is as long as one largest step or slightly longer. If too many trials
/// are counted, returns an error with their average length [s].
fn count<T: Real>(stretch: &mut Option<(T, u32)>, t: T, length: T) -> Result<(), StepError> {
    let (from, trials) = stretch.get_or_insert((t, 0));
    if t - *from >= length {
        (*from, *trials) = (t, 0);
    }
    if *trials >= MOST_TRIALS {
        let step = ((t - *from) / T::from_f64((*trials).into())).to_f64();
        return Err(StepError::StepTooSmall { step });
    }
    *trials += 1;
    Ok(())
}

/// History of a driver from step to step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct DriverHistory<T> {
    /// Length of the next trial [s].
    pub next: T,
    /// Memory of the energy rule, if there is one: the faded last changes [-], and the number of consecutive small changes.
    pub energy: Option<(f64, u32)>,
    /// Memory of the error estimate, if there is one: the history of its [`StepControl`].
    pub error: Option<(Option<f64>, bool)>,
    /// Start of the present interval of one largest step [s], and the number of trials in it.
    pub stretch: Option<(T, u32)>,
}

/// Record of the trials of one step so far.
#[derive(Debug, Default)]
struct Effort {
    rejected: u32,
    reductions: u32,
    landings: u32,
    /// Iterations, factorisations and solutions so far.
    work: [u32; 3],
    /// Cause that shortened the last trial.
    reason: Option<Limit>,
}

impl Effort {
    /// Records a trial that failed or was rejected.
    fn reduced(&mut self, reason: Limit) {
        self.rejected += 1;
        self.reductions += 1;
        self.reason = Some(reason);
    }

    /// Records a repetition to end at an event, or to resolve a stiff contact.
    fn landed(&mut self, is_too_stiff: bool) {
        self.landings += 1;
        if is_too_stiff {
            self.reduced(Limit::Contact);
        } else {
            self.rejected += 1;
        }
    }

    /// Adds the iterations, factorisations and solutions of a trial.
    fn add<T>(&mut self, report: &StepReport<T>) {
        let [iterations, factorizations, solves] = self.work;
        self.work = [
            iterations + report.iterations,
            factorizations + report.factorizations,
            solves + report.solves,
        ];
    }

    /// Returns the last trial with the iterations, factorisations and solutions of all trials.
    fn with_counts<T>(&self, mut attempt: TrialStep<T>) -> TrialStep<T> {
        let report = &mut attempt.report;
        [report.iterations, report.factorizations, report.solves] = self.work;
        report.rejected = self.rejected;
        attempt
    }
}

/// Decision of the rules on a trial, with the memory of the rules after the trial.
struct Judgement<T> {
    /// Factor from the length of the trial to the length of the next step. If the trial is rejected, it gives the length of the repetition.
    factor: f64,
    limit: Limit,
    is_kept: bool,
    energy: Option<Steering>,
    error: Option<(f64, StepControl<T>)>,
}

impl<T: Real> Driver<T> {
    /// Creates a driver with the length of its first step [s].
    ///
    /// # Panics
    /// If a step length is not positive and finite.
    #[must_use]
    pub fn new(rules: Rules<T>, first_step: T) -> Self {
        let is_length = |h: T| h > T::ZERO && h.is_finite();
        assert!(is_length(first_step) && is_length(rules.max_step), "positive steps");
        let first = first_step.min(rules.max_step);
        Self {
            max_step: rules.max_step,
            energy: rules.energy.map(Steering::new),
            error: rules.error.map(|(tolerance, power)| (tolerance, StepControl::new(power))),
            next: first,
            first,
            stretch: None,
        }
    }

    /// Length of the step to be tried next [s].
    #[must_use]
    pub fn next(&self) -> T {
        self.next
    }

    /// Memory from which the next step continues.
    #[must_use]
    pub fn history(&self) -> DriverHistory<T> {
        DriverHistory {
            next: self.next,
            energy: self.energy.map(|steering| steering.history()),
            error: self.error.map(|(_, control)| control.history()),
            stretch: self.stretch,
        }
    }

    /// Restores the history of a driver with the same rules. Returns `false`, and changes nothing, if the rules differ.
    pub fn set_history(&mut self, history: DriverHistory<T>) -> bool {
        let DriverHistory { next, energy, error, stretch } = history;
        let is_step = next > T::ZERO && next <= self.max_step;
        if !is_step
            || energy.is_some() != self.energy.is_some()
            || error.is_some() != self.error.is_some()
        {
            return false;
        }
        self.next = next;
        self.stretch = stretch;
        if let (Some(steering), Some(energy)) = (&mut self.energy, energy) {
            steering.set_history(energy);
        }
        if let (Some((_, control)), Some(error)) = (&mut self.error, error) {
            control.set_history(error);
        }
        true
    }

    /// Makes one step of at most `rest` [s] from time `t` [s], with as many trials as necessary. It records the accepted step in
    /// `invariant`.
    ///
    /// The driver does not allocate; the stepper may.
    ///
    /// # Errors
    /// The error of the last trial. [`StepError::StepTooSmall`] if rules reject steps at the shortest length, or if 100,000 trials advance
    /// less than one largest step. The state is then that of the last accepted step.
    ///
    /// # Panics
    /// If `rest` is not positive.
    pub fn step(
        &mut self,
        stepper: &mut impl Stepper<T>,
        invariant: &mut Invariant,
        (t, rest): (T, T),
    ) -> Result<Accepted<T>, StepError> {
        assert!(rest > T::ZERO, "time is left");
        let (mut h, is_cut) = self.planned(t, rest);
        let mut effort = Effort::default();
        loop {
            count(&mut self.stretch, t, self.max_step)?;
            stepper.prepare(h, effort.reductions)?;
            let attempt = match stepper.attempt(h) {
                Ok(attempt) => attempt,
                Err(error) => {
                    effort.reduced(Limit::Failure);
                    self.energy.iter_mut().for_each(Steering::forget);
                    h = self.shortened((t, h), AFTER_FAILURE).map_err(|_| error)?;
                    continue;
                }
            };
            effort.add(&attempt.report);
            let crossing = stepper.first_event(h);
            let retry = crossing.filter(|c| !c.is_landed && effort.landings < MOST_LANDINGS);
            let retry = retry.and_then(|c| {
                let to = self.shortened((t, h), c.share).ok()?;
                (to <= rest.min(self.max_step)).then_some((to, c.is_too_stiff))
            });
            if let Some((to, is_too_stiff)) = retry {
                stepper.undo();
                effort.landed(is_too_stiff);
                if is_too_stiff {
                    self.energy.iter_mut().for_each(Steering::forget);
                }
                h = to;
                continue;
            }
            let change = invariant.change(attempt.energies);
            let judgement = self.judge(&attempt, change, invariant);
            if !judgement.is_kept {
                stepper.undo();
                effort.reduced(judgement.limit);
                (self.energy, self.error) = (judgement.energy, judgement.error);
                h = self.shortened((t, h), judgement.factor)?;
                continue;
            }
            let is_landed = crossing.is_some_and(|c| c.is_landed);
            stepper.keep(is_landed);
            invariant.mark(attempt.t.to_f64(), attempt.energies);
            let was_cut = is_cut || effort.landings > 0;
            let limit = self.plan(h, (was_cut, effort.reductions), judgement);
            let limit = if is_landed { Limit::Event } else { effort.reason.unwrap_or(limit) };
            let (attempt, rejected) = (effort.with_counts(attempt), effort.rejected);
            return Ok(Accepted { attempt, step: h, rejected, change, limit, is_last: h >= rest });
        }
    }

    /// Length of the first trial of a step, and whether the remaining time `rest` cuts it. Normally it is the planned length. It is all of
    /// the remaining time if that is shorter. It is half of the remaining time if that is less than two planned steps, so that no tiny step
    /// remains.
    fn planned(&self, t: T, rest: T) -> (T, bool) {
        if rest <= self.next {
            (rest, rest < self.next)
        } else if rest < self.next + self.next {
            (clock_step(t, rest * T::HALF).min(rest), true)
        } else {
            (clock_step(t, self.next), false)
        }
    }

    /// Plans the next step after an accepted step of length `h`. Returns the cause that limits the next step.
    fn plan(&mut self, h: T, (was_cut, reductions): (bool, u32), judgement: Judgement<T>) -> Limit {
        let Judgement { factor, limit, energy, error, .. } = judgement;
        // A step after a reduction does not grow.
        let factor = if reductions > 0 { factor.min(1.0) } else { factor };
        let wish = h * T::from_f64(factor);
        if was_cut && reductions == 0 {
            // The remaining time cut this step. Its small error says little about a full step, so the planned step does not become shorter.
            self.next = self.next.max(wish).min(self.max_step);
        } else {
            (self.energy, self.error) = (energy, error);
            self.next = wish.min(self.max_step);
        }
        if self.next >= self.max_step { Limit::Largest } else { limit }
    }

    /// Multiplies the step by a factor. Returns an error if the result is too short.
    fn shortened(&self, (t, h): (T, T), factor: f64) -> Result<T, StepError> {
        let wish = h * T::from_f64(factor);
        let least = (self.max_step * T::from_f64(SMALLEST))
            .max(t.abs() * T::EPSILON * T::from_f64(TIME_ROUNDINGS));
        if wish >= least {
            Ok(clock_step(t, wish))
        } else {
            Err(StepError::StepTooSmall { step: wish.to_f64() })
        }
    }

    /// Decides on a trial by the rules.
    fn judge(&self, attempt: &TrialStep<T>, change: f64, invariant: &Invariant) -> Judgement<T> {
        let (mut energy, mut error) = (self.energy, self.error);
        let mut kept = (f64::INFINITY, Limit::Largest);
        let mut rejected: Option<(f64, Limit)> = None;
        if let Some(steering) = &mut energy {
            let first = self.first.to_f64();
            let [before, after] = attempt.acceleration_energy;
            // close to a singular position the accelerations at one end may be rounding errors of any size
            let accelerating = if invariant.is_moving() { before.min(after) } else { after };
            let begun = accelerating * first * first;
            let scale = invariant.scale(attempt.energies).max(begun).max(f64::MIN_POSITIVE);
            let beyond = change.abs() - invariant.rounding();
            match steering.judge(if beyond <= 0.0 { 0.0 } else { beyond / scale }) {
                Ok(wish) => kept = (wish, Limit::Energy),
                Err(wish) => rejected = Some((wish, Limit::Energy)),
            }
        }
        if let Some((tolerance, control)) = &mut error {
            let share = T::from_f64(attempt.error / *tolerance);
            if !(share <= T::ONE) {
                let wish = control.rejected(share).to_f64();
                if rejected.is_none_or(|(factor, _)| wish < factor) {
                    rejected = Some((wish, Limit::Error));
                }
            } else if rejected.is_none() {
                let wish = control.accepted(share).to_f64();
                if wish < kept.0 {
                    kept = (wish, Limit::Error);
                }
            }
        }
        let is_kept = rejected.is_none();
        if !is_kept {
            energy.iter_mut().for_each(Steering::forget);
        }
        let (factor, limit) = rejected.unwrap_or(kept);
        let factor = if factor.is_finite() { factor } else { FREE };
        Judgement { factor, limit, is_kept, energy, error }
    }
}

/// Length by which the rounded clock advances when a step of `h` [s] is added to time `t`.
fn clock_step<T: Real>(t: T, h: T) -> T {
    let step = (t + h) - t;
    if step > T::ZERO { step } else { h }
}
