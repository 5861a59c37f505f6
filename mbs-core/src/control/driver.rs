//! Driver of the step size: it tries steps, judges them, repeats those that fail, and plans the next.

use super::energy::{EnergyRule, Steering};
use super::invariant::Invariant;
use crate::Real;
use crate::ode::StepControl;
use crate::step::{StepError, StepReport};

/// Factor on the length of a step that failed, for its next trial [-]. Chosen, not tuned.
const AFTER_FAILURE: f64 = 0.25;
/// Shortest step, relative to the largest [-]. Chosen, not tuned: [`MOST_TRIALS`] ends a run whose average step is a hundred-thousandth.
const SMALLEST: f64 = 1e-10;
/// Shortest step, in units of rounding of the time [-]: the clock then measures it to a sixteenth.
const TIME_ROUNDINGS: f64 = 16.0;
/// Most trials within a length of time equal to the largest step [-]. A run with shorter steps on average would not end. Chosen, not tuned.
const MOST_TRIALS: u32 = 100_000;
/// Most repetitions of a step that shall end at an event [-]: two or three are usual, the rest is reserve.
const MOST_LANDINGS: u32 = 12;
/// Growth of the step where no rule limits it [-]. Chosen, not tuned: the largest step limits what follows.
const FREE: f64 = 2.0;

/// Mechanism that a driver steps, with a formulation and a state that can be put back.
pub trait Stepper<T: Real> {
    /// Called before a trial of length `h` [s], after `reductions` in a row of this step: the place to change the index.
    ///
    /// # Errors
    /// [`StepError`] as a trial's.
    fn prepare(&mut self, h: T, reductions: u32) -> Result<(), StepError> {
        let _ = (h, reductions);
        Ok(())
    }

    /// Tries a step of length `h` [s].
    ///
    /// # Errors
    /// [`StepError`]; the state is then as before.
    fn attempt(&mut self, h: T) -> Result<TrialStep<T>, StepError>;

    /// Puts the state back that was there before the last attempt.
    fn undo(&mut self);

    /// The first event within the last attempt of length `h` [s].
    fn first_event(&mut self, h: T) -> Option<Event> {
        let _ = h;
        None
    }

    /// The last attempt is kept; `at_event`: it ends at an event.
    fn keep(&mut self, at_event: bool);
}

/// Outcome of a trial step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrialStep<T> {
    /// Report on the step.
    pub report: StepReport<T>,
    /// Time at its end [s].
    pub t: T,
    /// Kinetic energy, potential energy, work [J] at its end.
    pub energies: [f64; 3],
    /// Local error of the step relative to the scene's length; zero where none is asked for [-].
    pub error: f64,
    /// 1/2 a^T M a at its beginning and at its end [J/s^2]. From rest nothing has moved yet: the energy that the accelerations give in a
    /// first step takes the place of the energy that moves. Once energy moves ([`Invariant::is_moving`]) the smaller of the two counts,
    /// before that the one at the end. Zero where they are not known.
    pub acceleration_energy: [f64; 2],
}

/// An event within a trial, or at its end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// Fraction of the trial after which it comes, aimed a little past it: from 0.001 to 1. Up to 1.05 where the trial ends just
    /// short of it, so that no tiny step need follow.
    pub share: f64,
    /// The trial's end lies so near that it may serve; the share is one.
    pub is_landed: bool,
    /// No event, but a contact that began with the trial and is too stiff for its length.
    pub is_too_stiff: bool,
    /// Index of the effect in the scene.
    pub effect: usize,
}

/// By what steps are chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rules<T> {
    /// No step is longer [s].
    pub max_step: T,
    /// The change of the invariant steers.
    pub energy: Option<EnergyRule>,
    /// The local error estimate steers: its tolerance, relative to the scene's length, and the power of h it goes with.
    pub error: Option<(f64, u32)>,
}

/// Cause that kept the next step from being longer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    /// The largest step, or the end.
    Largest,
    /// Limit by the energy rule.
    Energy,
    /// Limit by the error estimate.
    Error,
    /// An event ended the step.
    Event,
    /// A contact that began with the step, and is stiff.
    Contact,
    /// A step that did not converge.
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
    /// Outcome of the last trial; iterations, factorisations and solutions are those of all trials that came to their end.
    pub attempt: TrialStep<T>,
    /// Length of the step [s].
    pub step: T,
    /// Trials before it that were rejected, or shortened for an event.
    pub rejected: u32,
    /// Change of the invariant in it [J].
    pub change: f64,
    /// Cause that kept this step or the next from being longer.
    pub limit: Limit,
    /// Whether the step took the whole of the time that was left.
    pub is_last: bool,
}

/// The state of the step-size control.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Driver<T> {
    max_step: T,
    energy: Option<Steering>,
    error: Option<(f64, StepControl<T>)>,
    /// The step that is tried next, and the first one [s].
    next: T,
    first: T,
    /// Start of the present stretch of a largest step [s], and the trials in it; `None` before the first.
    stretch: Option<(T, u32)>,
}

/// Counts a trial from time `t` [s] in the stretch of a largest step, or a little more. The error has the average length of a trial [s],
/// where that is too short.
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
    /// The step that is tried next [s].
    pub next: T,
    /// Of the energy rule, where there is one: the last changes, faded [-], and small changes in a row.
    pub energy: Option<(f64, u32)>,
    /// Of the error estimate, where there is one: that of its [`StepControl`].
    pub error: Option<(Option<f64>, bool)>,
    /// Start of the present stretch of a largest step [s], and the trials in it.
    pub stretch: Option<(T, u32)>,
}

/// The trials of one step so far.
#[derive(Debug, Default)]
struct Effort {
    rejected: u32,
    reductions: u32,
    landings: u32,
    /// Iterations, factorisations and solutions so far.
    work: [u32; 3],
    /// Why the last trial was shortened.
    reason: Option<Limit>,
}

impl Effort {
    /// A trial failed or was rejected.
    fn reduced(&mut self, reason: Limit) {
        self.rejected += 1;
        self.reductions += 1;
        self.reason = Some(reason);
    }

    /// A trial is made again to end at an event, or to resolve a contact.
    fn landed(&mut self, is_too_stiff: bool) {
        self.landings += 1;
        if is_too_stiff {
            self.reduced(Limit::Contact);
        } else {
            self.rejected += 1;
        }
    }

    /// Adds the work of a trial.
    fn add<T>(&mut self, report: &StepReport<T>) {
        let [iterations, factorizations, solves] = self.work;
        self.work = [
            iterations + report.iterations,
            factorizations + report.factorizations,
            solves + report.solves,
        ];
    }

    /// The last trial with the work of all.
    fn with_counts<T>(&self, mut attempt: TrialStep<T>) -> TrialStep<T> {
        let report = &mut attempt.report;
        [report.iterations, report.factorizations, report.solves] = self.work;
        report.rejected = self.rejected;
        attempt
    }
}

/// Judgement of the rules on a trial, with what they would remember of it.
struct Judgement<T> {
    /// Factor for the next step, or for its repetition.
    factor: f64,
    limit: Limit,
    is_kept: bool,
    energy: Option<Steering>,
    error: Option<(f64, StepControl<T>)>,
}

impl<T: Real> Driver<T> {
    /// A driver with the step to try first [s].
    ///
    /// # Panics
    /// If a step is not positive and finite.
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

    /// The step that will be tried next [s].
    #[must_use]
    pub fn next(&self) -> T {
        self.next
    }

    /// State that the next step continues from.
    #[must_use]
    pub fn history(&self) -> DriverHistory<T> {
        DriverHistory {
            next: self.next,
            energy: self.energy.map(|steering| steering.history()),
            error: self.error.map(|(_, control)| control.history()),
            stretch: self.stretch,
        }
    }

    /// Restores the history of a driver with the same rules. Returns whether it is one; else nothing is changed.
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

    /// Makes one step of at most `rest` [s] from time `t` [s], with as many trials as it takes; the invariant is marked with it.
    ///
    /// No allocation but what the stepper does.
    ///
    /// # Errors
    /// That of the last trial, [`StepError::StepTooSmall`] where rules reject steps that no longer matter, or where 100,000 trials
    /// came less far than one largest step. The state is then that of the last accepted step.
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

    /// The first trial of a step: the planned one, or all that is left, or half of it where that is less than two planned ones. So no
    /// tiny step remains. Says whether it is cut short by what is left.
    fn planned(&self, t: T, rest: T) -> (T, bool) {
        if rest <= self.next {
            (rest, rest < self.next)
        } else if rest < self.next + self.next {
            (clock_step(t, rest * T::HALF).min(rest), true)
        } else {
            (clock_step(t, self.next), false)
        }
    }

    /// Plans the next step after one of length `h` that is kept; gives what limits it.
    fn plan(&mut self, h: T, (was_cut, reductions): (bool, u32), judgement: Judgement<T>) -> Limit {
        let Judgement { factor, limit, energy, error, .. } = judgement;
        // Right after a reduction the step does not grow.
        let factor = if reductions > 0 { factor.min(1.0) } else { factor };
        let wish = h * T::from_f64(factor);
        if was_cut && reductions == 0 {
            // A step that was cut short says nothing against the planned one, and little about its error.
            self.next = self.next.max(wish).min(self.max_step);
        } else {
            (self.energy, self.error) = (energy, error);
            self.next = wish.min(self.max_step);
        }
        if self.next >= self.max_step { Limit::Largest } else { limit }
    }

    /// The step times a factor, if it is not too short.
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

    /// Judges a trial by the rules.
    fn judge(&self, attempt: &TrialStep<T>, change: f64, invariant: &Invariant) -> Judgement<T> {
        let (mut energy, mut error) = (self.energy, self.error);
        let mut kept = (f64::INFINITY, Limit::Largest);
        let mut rejected: Option<(f64, Limit)> = None;
        if let Some(steering) = &mut energy {
            let first = self.first.to_f64();
            let [before, after] = attempt.acceleration_energy;
            // beside a singular position the accelerations at one end may be rounding of any size
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

/// The step by which the clock moves when it is asked to move by `h` [s]: times are rounded.
fn clock_step<T: Real>(t: T, h: T) -> T {
    let step = (t + h) - t;
    if step > T::ZERO { step } else { h }
}
