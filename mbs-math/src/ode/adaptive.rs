//! Methods with error control, over given lengths of time.

use super::{Method, OdeError, Options, Rates, StepControl, method};
use crate::Real;

/// Shortest step, in units of rounding of the time [-]: the clock then measures it to a sixteenth.
const SMALLEST_STEP: f64 = 16.0;
/// Largest move of a projection, in tolerances, after which the rates found before it hold [-]: their error enters the state times the
/// step. Chosen, not tuned.
const HOLDING_MOVE: f64 = 0.1;
/// Least steps before a call ends since too many more are expected [-]. Beside a change point ten thousand may be as short.
const LEAST_TRIED: u32 = 10_000;
/// Largest ratio of the last step to the planned one [-], so that no tiny step remains. Chosen, not tuned.
const LAST_STEP: f64 = 1.01;
/// Expected steps at which a call ends, relative to those that it may try [-]: an explicit method on a stiff system stops early. Chosen, not
/// tuned.
const TOO_MANY: f64 = 10.0;

/// Change of the state by the hook at the end of an accepted step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EndState {
    /// The hook left the state, and whatever else its rates depend on, as they were: the rates found there hold.
    Kept,
    /// The hook moved the state back to where it belongs, as a projection does, and nothing else. The rates found before are taken where
    /// it was moved by less than a tenth of the tolerance.
    Projected,
    /// The hook changed the state, or what rates depend on beside it: the rates are evaluated anew.
    Changed,
}

/// Counts of an integration, over all calls.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counts {
    /// Number of accepted steps.
    pub accepted: u64,
    /// Number of rejected steps.
    pub rejected: u64,
    /// Evaluations of the rates; those of a trial that the rates ended are not counted.
    pub evaluations: u64,
}

/// History of an [`Adaptive`] from step to step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct AdaptiveHistory<T> {
    /// The step that will be tried next [s].
    pub step: T,
    /// History of its [`StepControl`].
    pub control: (Option<f64>, bool),
    /// Counts of the integration so far.
    pub counts: Counts,
}

/// A method with error control: what it remembers from step to step and from call to call.
#[derive(Debug, Clone, PartialEq)]
pub struct Adaptive<T, M> {
    method: M,
    control: StepControl<T>,
    step: T,
    counts: Counts,
}

impl<T: Real, M: Method<T>> Adaptive<T, M> {
    /// A driver of this method, with the step to try first [s].
    ///
    /// # Panics
    ///
    /// If the step is not positive and finite.
    #[must_use]
    pub fn new(method: M, first_step: T) -> Self {
        assert!(first_step > T::ZERO && first_step.is_finite(), "a positive step");
        let control = StepControl::new(method.power());
        Self { method, control, step: first_step, counts: Counts::default() }
    }

    /// The step that will be tried next [s], if the end of the call and the longest step allow it.
    #[must_use]
    pub fn step(&self) -> T {
        self.step
    }

    /// Method of the steps.
    #[must_use]
    pub fn method(&self) -> &M {
        &self.method
    }

    /// The method, to restore its history.
    pub fn method_mut(&mut self) -> &mut M {
        &mut self.method
    }

    /// Counts of the integration, over all calls.
    #[must_use]
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// State that the next call continues from.
    #[must_use]
    pub fn history(&self) -> AdaptiveHistory<T> {
        AdaptiveHistory { step: self.step, control: self.control.history(), counts: self.counts }
    }

    /// Restores the history of a driver of the same method; returns whether its step is valid: positive and finite.
    pub fn set_history(&mut self, history: AdaptiveHistory<T>) -> bool {
        let AdaptiveHistory { step, control, counts } = history;
        let is_step = step > T::ZERO && step.is_finite();
        if is_step {
            (self.step, self.counts) = (step, counts);
            self.control.set_history(control);
        }
        is_step
    }

    /// The step to make of what is left, which is longer than the planned one.
    fn share(&self, rest: T, planned: T) -> T {
        if !self.method.shares() {
            return planned;
        }
        let steps = libm::ceil((rest / (planned * T::from_f64(LAST_STEP))).to_f64());
        rest / T::from_f64(steps.max(2.0))
    }

    /// Advances `y` from `t` by exactly `dt` [s], in as many accepted steps as the tolerance asks for.
    ///
    /// After each accepted step `hook` gets the system, the time and the state, which it may change, and says what it
    /// did, see [`EndState`]. The last step is shortened to end at `t + dt`; what the step would have been is remembered for the
    /// next call. `scratch` is [`Method::n_scratch`] numbers or more.
    ///
    /// Cost, beside the hook: one evaluation, and [`Method::evaluations`] less one for each step tried. Where the hook changed
    /// the state by more than a little, or the method does not end with the rates there, one more for each accepted step but the
    /// last. No allocation.
    ///
    /// # Errors
    ///
    /// [`OdeError::Rates`] with what the rates or the hook say. [`OdeError::StepTooSmall`] where the error stays too large
    /// or is no number at the smallest step. [`OdeError::TooManySteps`] where the steps are used up, or a tenth of a large number and
    /// the rest would take more than ten times as many as may be tried. `y` is then the last accepted state
    /// (if the hook failed, as the hook left it).
    ///
    /// # Panics
    ///
    /// If `dt` is negative or not finite, or a slice has the wrong length.
    pub fn advance<R: Rates<T>>(
        &mut self,
        system: &mut R,
        (t, dt): (T, T),
        (y, scratch): (&mut [T], &mut [T]),
        options: &Options<'_, T>,
        mut hook: impl FnMut(&mut R, T, &mut [T]) -> Result<EndState, R::Error>,
    ) -> Result<(), OdeError<R::Error>> {
        assert!(dt >= T::ZERO && dt.is_finite(), "a length of time");
        let n = system.n();
        let (n_scratch, there) = (self.method.n_scratch(n), scratch.len());
        assert!(there >= n_scratch && y.len() == n, "scratch and components of the state");
        let scratch = &mut scratch[..n_scratch];
        let smallest = T::from_f64(SMALLEST_STEP) * T::EPSILON * (t.abs() + dt);
        let (mut done, mut tried, mut first_is_known) = (T::ZERO, 0, false);
        while done < dt {
            let time = t + done;
            let rest = dt - done;
            let planned = self.step.min(options.max_step);
            let is_last = rest <= planned * T::from_f64(LAST_STEP);
            let h = if is_last { rest } else { self.share(rest, planned) };
            if tried == options.max_steps || is_hopeless(tried, rest / h, options.max_steps) {
                return Err(OdeError::TooManySteps { time: time.to_f64(), steps: tried });
            }
            tried += 1;

            let error = self
                .method
                .trial(system, (time, h), y, first_is_known, (options, scratch))
                .map_err(|error| OdeError::Rates { time: time.to_f64(), error })?;
            self.counts.evaluations += self.method.evaluations(first_is_known);
            first_is_known = true;

            // A NaN is no error within the tolerance.
            if !(error <= T::ONE) {
                self.counts.rejected += 1;
                self.step = h * self.control.rejected(error);
                if self.step < smallest {
                    let (time, step) = (time.to_f64(), self.step.to_f64());
                    return Err(OdeError::StepTooSmall { time, step });
                }
                continue;
            }

            self.counts.accepted += 1;
            y.copy_from_slice(self.method.new_state(n, scratch));
            done = if is_last { dt } else { done + h };
            // A step cut short at the end says nothing about the step that was planned, unless it is the shorter one.
            if h >= planned || self.method.shares() {
                let factor = self.control.accepted(error);
                let wish = h * self.method.worth(factor);
                let is_informative = h >= planned || factor < T::ONE && h >= planned * T::HALF;
                self.step = if is_informative { wish } else { planned.max(wish) };
            }
            let at_end = t + done;
            let end = hook(system, at_end, y)
                .map_err(|error| OdeError::Rates { time: at_end.to_f64(), error })?;
            let holds = match end {
                EndState::Kept => true,
                EndState::Projected => {
                    let found = self.method.new_state(n, scratch);
                    method::distance(found, y, options) <= T::from_f64(HOLDING_MOVE)
                }
                EndState::Changed => false,
            };
            first_is_known = holds && self.method.carry(n, scratch);
        }
        Ok(())
    }
}

/// After a tenth of the steps, would the rest with steps of the next one's length take far more than may be tried?
fn is_hopeless<T: Real>(tried: u32, wanted: T, max_steps: u32) -> bool {
    let limit = TOO_MANY * f64::from(max_steps);
    tried > (max_steps / 10).max(LEAST_TRIED) && wanted > T::from_f64(limit)
}
