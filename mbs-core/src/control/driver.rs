//! The driver: tries steps, judges them, repeats those that fail, and plans the next.

use super::energy::{EnergyRule, Steering};
use super::invariant::Invariant;
use crate::Real;
use crate::ode::StepControl;
use crate::step::{StepError, StepReport};

/// A step that failed is tried again at this share of its length.
const AFTER_FAILURE: f64 = 0.25;
/// A step is never shorter than this share of the largest.
const SMALLEST: f64 = 1e-10;
/// The last step before a limit may be this much longer than planned, so that no sliver remains.
const LAST_STEP: f64 = 1.01;
/// Re-solves of a step that shall end at an event.
const MOST_LANDINGS: u32 = 12;

/// What a driver steps: a mechanism with a formulation and a state that can be put back.
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
    fn attempt(&mut self, h: T) -> Result<Attempt<T>, StepError>;

    /// Puts the state back that was there before the last attempt.
    fn undo(&mut self);

    /// The first event within the last attempt of length `h` [s].
    fn crossing(&mut self, h: T) -> Option<Crossing> {
        let _ = h;
        None
    }

    /// The last attempt is kept; `at_event`: it ends at an event.
    fn keep(&mut self, at_event: bool);
}

/// What a trial came to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attempt<T> {
    /// What the step did.
    pub report: StepReport<T>,
    /// Time at its end [s].
    pub t: T,
    /// Kinetic energy, potential energy, work [J] at its end.
    pub energies: [f64; 3],
    /// Its local error relative to the scene's length; zero where none is asked for [-].
    pub error: f64,
}

/// An event within a trial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Where, as a share of the trial; above one where it ended just before.
    pub share: f64,
    /// The trial ends so near to it that it may be taken.
    pub is_landed: bool,
    /// No event, but a contact that began with the trial and is too stiff for its length.
    pub is_too_stiff: bool,
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

/// What kept the next step from being longer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    /// The largest step, or the end.
    Largest,
    /// The energy rule.
    Energy,
    /// The error estimate.
    Error,
    /// An event ended the step.
    Event,
    /// A contact that began with the step, and is stiff.
    Contact,
    /// A step that did not converge.
    Failure,
}

/// A step that was accepted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accepted<T> {
    /// What the last trial came to; iterations, factorisations and solutions of all of them.
    pub attempt: Attempt<T>,
    /// Its length [s].
    pub step: T,
    /// Trials before it that were rejected, or shortened for an event.
    pub rejected: u32,
    /// Change of the invariant in it [J].
    pub change: f64,
    /// What limits the next step.
    pub limit: Limit,
}

/// The state of the step-size control.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Driver<T> {
    max_step: T,
    energy: Option<Steering>,
    error: Option<(f64, StepControl<T>)>,
    /// The step that is tried next [s].
    next: T,
}

/// What became of a trial.
enum Verdict {
    /// Kept; factor for the next step and what limits it.
    Kept(f64, Limit),
    /// Repeated with the factor, because of this.
    Repeated(f64, Limit),
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
        Self {
            max_step: rules.max_step,
            energy: rules.energy.map(Steering::new),
            error: rules.error.map(|(tolerance, power)| (tolerance, StepControl::new(power))),
            next: first_step.min(rules.max_step),
        }
    }

    /// The step that will be tried next [s].
    #[must_use]
    pub fn next(&self) -> T {
        self.next
    }

    /// Makes one step of at most `rest` [s], with as many trials as it takes; the invariant is marked with it.
    ///
    /// No allocation but what the stepper does.
    ///
    /// # Errors
    /// That of the last trial, [`StepError::StepTooSmall`] where rules reject steps that no longer matter. The state is then
    /// that of the last accepted step.
    pub fn step(
        &mut self,
        stepper: &mut impl Stepper<T>,
        invariant: &mut Invariant,
        rest: T,
    ) -> Result<Accepted<T>, StepError> {
        let planned = self.next.min(self.max_step);
        let is_last = rest <= planned * T::from_f64(LAST_STEP);
        let mut h = if is_last { rest } else { planned };
        let (mut rejected, mut reductions, mut landings) = (0, 0, 0);
        let mut work = [0_u32; 3];
        let mut reason = None;
        loop {
            stepper.prepare(h, reductions)?;
            let attempt = match stepper.attempt(h) {
                Ok(attempt) => attempt,
                Err(error) => {
                    rejected += 1;
                    reductions += 1;
                    self.energy.iter_mut().for_each(Steering::forget);
                    reason = Some(Limit::Failure);
                    h = self.shortened(h, AFTER_FAILURE).ok_or(error)?;
                    continue;
                }
            };
            let r = &attempt.report;
            work = [work[0] + r.iterations, work[1] + r.factorizations, work[2] + r.solves];
            let crossing = stepper.crossing(h);
            let retry = crossing.filter(|c| !c.is_landed && landings < MOST_LANDINGS);
            let retry = retry.map(|c| (h * T::from_f64(c.share), c.is_too_stiff));
            if let Some((to, is_too_stiff)) = retry.filter(|&(to, _)| to <= rest) {
                stepper.undo();
                rejected += 1;
                landings += 1;
                if is_too_stiff {
                    self.energy.iter_mut().for_each(Steering::forget);
                    reason = Some(Limit::Contact);
                    reductions += 1;
                }
                h = to;
                continue;
            }
            let change = invariant.change(attempt.energies);
            match self.judge(&attempt, change, invariant) {
                Verdict::Repeated(factor, limit) => {
                    stepper.undo();
                    rejected += 1;
                    reductions += 1;
                    reason = Some(limit);
                    let step = h.to_f64() * factor;
                    h = self.shortened(h, factor).ok_or(StepError::StepTooSmall { step })?;
                }
                Verdict::Kept(factor, limit) => {
                    let is_landed = crossing.is_some_and(|c| c.is_landed);
                    stepper.keep(is_landed);
                    invariant.mark(attempt.t.to_f64(), attempt.energies);
                    let was_cut = is_last || is_landed;
                    // A step that was cut short says nothing against the step that was planned.
                    let wish = h * T::from_f64(factor);
                    let base = if was_cut && reductions == 0 { self.next.max(wish) } else { wish };
                    self.next = base.min(self.max_step);
                    let limit = match (is_landed, reason) {
                        (true, _) => Limit::Event,
                        (_, Some(reason)) => reason,
                        _ if self.next >= self.max_step => Limit::Largest,
                        _ => limit,
                    };
                    let mut attempt = attempt;
                    let r = &mut attempt.report;
                    [r.iterations, r.factorizations, r.solves] = work;
                    r.rejected = rejected;
                    return Ok(Accepted { attempt, step: h, rejected, change, limit });
                }
            }
        }
    }

    /// The step times a factor, if it is not too short.
    fn shortened(&self, h: T, factor: f64) -> Option<T> {
        let h = h * T::from_f64(factor);
        (h >= self.max_step * T::from_f64(SMALLEST)).then_some(h)
    }

    /// What the rules say of a trial.
    fn judge(&mut self, attempt: &Attempt<T>, change: f64, invariant: &Invariant) -> Verdict {
        let (mut factor, mut limit) = (f64::INFINITY, Limit::Largest);
        let mut rejection: Option<(f64, Limit)> = None;
        if let Some(steering) = &mut self.energy {
            let scale = invariant.scale(attempt.energies).max(f64::MIN_POSITIVE);
            let beyond = change.abs() - invariant.rounding();
            let e = if beyond <= 0.0 { 0.0 } else { beyond / scale };
            match steering.judge(e) {
                Ok(wish) => (factor, limit) = (wish, Limit::Energy),
                Err(wish) => rejection = Some((wish, Limit::Energy)),
            }
        }
        if let Some((tolerance, control)) = &mut self.error {
            let error = attempt.error / *tolerance;
            if !(error <= 1.0) {
                let wish = control.rejected(T::from_f64(error)).to_f64();
                if rejection.is_none_or(|(factor, _)| wish < factor) {
                    rejection = Some((wish, Limit::Error));
                }
            } else if rejection.is_none() {
                let wish = control.accepted(T::from_f64(error)).to_f64();
                if wish < factor {
                    (factor, limit) = (wish, Limit::Error);
                }
            }
        }
        match rejection {
            Some((factor, limit)) => Verdict::Repeated(factor, limit),
            None => Verdict::Kept(if factor.is_finite() { factor } else { 2.0 }, limit),
        }
    }
}
