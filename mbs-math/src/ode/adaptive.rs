//! Integration over a given length of time by a method with error control.

use super::{Method, OdeError, Options, Rates, StepControl, method};
use crate::Real;

/// Shortest step, in machine precisions of the time [-]: the rounding of the time is then at most a sixteenth of the step.
const SMALLEST_STEP: f64 = 16.0;
/// Largest displacement by a projection, in tolerances, for which the rates found before the projection are used again [-]. The error of
/// those rates enters the next state multiplied by the step. Chosen, not tuned.
const HOLDING_MOVE: f64 = 0.1;
/// Least number of steps before a call may end because too many more are expected [-]. Up to ten thousand steps near a discontinuity may be
/// much shorter than the later ones.
const LEAST_TRIED: u32 = 10_000;
/// Largest ratio of the last step to the planned step [-]. The last step is lengthened by up to 1 % so that no tiny step remains. Chosen,
/// not tuned.
const LAST_STEP: f64 = 1.01;
/// Number of expected steps at which a call ends, relative to the steps that it may try [-]. An explicit method on a stiff system then ends
/// early. Chosen, not tuned.
const TOO_MANY: f64 = 10.0;

/// Change of the state by the hook at the end of an accepted step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EndState {
    /// The hook changed neither the state nor any other quantity that the rates depend on. The rates found at the end of the step remain
    /// valid.
    Kept,
    /// The hook projected the state onto its constraints, and changed nothing else. The rates found before the projection are used again
    /// when the displacement is at most a tenth of the tolerance.
    Projected,
    /// The hook changed the state or another quantity that the rates depend on. The rates are evaluated again.
    Changed,
}

/// Counts of an integration, over all calls.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counts {
    /// Number of accepted steps.
    pub accepted: u64,
    /// Number of rejected steps.
    pub rejected: u64,
    /// Number of evaluations of the rates. Evaluations of a trial that ended with an error of the rates are not counted.
    pub evaluations: u64,
}

/// History of an [`Adaptive`] that the next step depends on.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct AdaptiveHistory<T> {
    /// The length of the next trial step [s].
    pub step: T,
    /// History of the [`StepControl`]: the last error, and whether the last trial was rejected.
    pub control: (Option<f64>, bool),
    /// Counts of the integration so far.
    pub counts: Counts,
}

/// A method with error control, with its history from step to step and from call to call.
#[derive(Debug, Clone, PartialEq)]
pub struct Adaptive<T, M> {
    method: M,
    control: StepControl<T>,
    step: T,
    counts: Counts,
}

impl<T: Real, M: Method<T>> Adaptive<T, M> {
    /// A driver of this method; `first_step` is the length of the first trial step [s].
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

    /// The length of the next trial step [s], unless the end of the call or the longest step limits it.
    #[must_use]
    pub fn step(&self) -> T {
        self.step
    }

    /// The method that makes the steps.
    #[must_use]
    pub fn method(&self) -> &M {
        &self.method
    }

    /// The method with write access, to restore its history.
    pub fn method_mut(&mut self) -> &mut M {
        &mut self.method
    }

    /// Counts of the integration, over all calls.
    #[must_use]
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// History that the next call continues from.
    #[must_use]
    pub fn history(&self) -> AdaptiveHistory<T> {
        AdaptiveHistory { step: self.step, control: self.control.history(), counts: self.counts }
    }

    /// Restores the history of a driver of the same method. Returns `false`, and changes nothing, when the step in the history is not
    /// positive and finite.
    pub fn set_history(&mut self, history: AdaptiveHistory<T>) -> bool {
        let AdaptiveHistory { step, control, counts } = history;
        let is_step = step > T::ZERO && step.is_finite();
        if is_step {
            (self.step, self.counts) = (step, counts);
            self.control.set_history(control);
        }
        is_step
    }

    /// Length of the next step [s] when the remaining time `rest` is longer than the `planned` step. A method that requires equal steps gets
    /// an equal part of the remaining time.
    fn share(&self, rest: T, planned: T) -> T {
        if !self.method.shares() {
            return planned;
        }
        let steps = libm::ceil((rest / (planned * T::from_f64(LAST_STEP))).to_f64());
        rest / T::from_f64(steps.max(2.0))
    }

    /// Advances `y` from `t` by exactly `dt` [s], in as many accepted steps as the tolerance requires.
    ///
    /// After each accepted step, `hook` gets the system, the time and the state. It may change the state, and returns how it did so, see
    /// [`EndState`]. The last step is shortened to end at `t + dt`, and the planned length is kept for the next call. `scratch` has at
    /// least [`Method::n_scratch`] numbers.
    ///
    /// Cost, besides the hook: one evaluation, and for each trial step one evaluation less than [`Method::evaluations`]. Each accepted step
    /// but the last costs one evaluation more when the rates at its end are not known. They are not known after `EndState::Changed`, after a
    /// projection by more than a tenth of the tolerance, and for methods that do not evaluate them. No allocation.
    ///
    /// # Errors
    ///
    /// [`OdeError::Rates`] with the error of the rates or of the hook. [`OdeError::StepTooSmall`] when the error at the smallest step is too
    /// large or is NaN. [`OdeError::TooManySteps`] when the call has tried the allowed number of steps. The call ends with this error earlier
    /// if the remaining time needs more than ten times the allowed number. This is checked after a tenth of the allowed steps, but not before
    /// ten thousand steps. `y` is then the last accepted state. When the hook failed, `y` is the state that the hook left.
    ///
    /// # Panics
    ///
    /// If `dt` is negative or not finite, if `y` has the wrong length, or if `scratch` is too short.
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

            // The negated comparison also rejects a NaN.
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
            // A last step that was cut short gives no reason to change the planned step, unless its error asks for a shorter one.
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

/// True if the call would need far too many steps. False until a tenth of the allowed steps, and at least ten thousand steps, were tried.
/// `wanted` is the remaining time divided by the length of the next step.
fn is_hopeless<T: Real>(tried: u32, wanted: T, max_steps: u32) -> bool {
    let limit = TOO_MANY * f64::from(max_steps);
    tried > (max_steps / 10).max(LEAST_TRIED) && wanted > T::from_f64(limit)
}
