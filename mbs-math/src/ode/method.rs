//! Interface between a one-step method and the step control, options of the caller, and norms of an error.

use super::Rates;
use crate::Real;

/// A one-step method that estimates its own error: an embedded pair, or an extrapolation.
///
/// The scratch of a method begins with the n rates at the start of the step. After a trial it also has the new state.
pub trait Method<T: Real> {
    /// Power of the step h with which the size of the error decreases.
    fn power(&self) -> u32;

    /// Number of places that the method needs in `scratch`, for `n` components.
    fn n_scratch(&self, n: usize) -> usize;

    /// Number of evaluations of the rates in the last trial step.
    fn evaluations(&self, first_is_known: bool) -> u64;

    /// Makes one trial step and returns the size of its error, in tolerances: a step of size one or less is accepted. `y` is not changed.
    ///
    /// With `first_is_known`, the first n numbers of `scratch` are already the rates at (`t`, `y`). The size is NaN or infinite when a rate
    /// is not finite.
    ///
    /// # Errors
    ///
    /// The error of the rates.
    fn trial<R: Rates<T>>(
        &mut self,
        system: &mut R,
        step: (T, T),
        y: &[T],
        first_is_known: bool,
        control: (&Options<'_, T>, &mut [T]),
    ) -> Result<T, R::Error>;

    /// The new state, of `n` components, that a trial wrote into `scratch`.
    fn new_state<'s>(&self, n: usize, scratch: &'s [T]) -> &'s [T];

    /// Copies the rates at the new state to the beginning of `scratch`. Returns `false`, and copies nothing, when the trial did not
    /// evaluate those rates.
    fn carry(&self, n: usize, scratch: &mut [T]) -> bool;

    /// True if the method requires equal steps over the remaining time. An implicit method does, since another step length costs a
    /// factorisation.
    fn shares(&self) -> bool {
        false
    }

    /// Factor for the next step, chosen by the method when the controller allows growth by `factor`. An implicit method keeps its step
    /// where the growth is not worth a factorisation.
    fn worth(&self, factor: T) -> T {
        factor
    }
}

/// Reciprocal of the tolerance of each component, by its value at the beginning of a step; zero for a component whose tolerance is zero.
#[cfg(feature = "alloc")]
pub(super) fn weights<T: Real>(y: &[T], options: &Options<'_, T>, weights: &mut [T]) {
    for (k, weight) in weights.iter_mut().enumerate() {
        let tolerance = tolerance(k, y[k].abs(), options);
        *weight = if tolerance > T::ZERO { T::ONE / tolerance } else { T::ZERO };
    }
}

/// The tolerance of component k when its absolute value is `size`.
fn tolerance<T: Real>(k: usize, size: T, options: &Options<'_, T>) -> T {
    let unit = options.sizes.get(k).copied().unwrap_or(T::ONE);
    options.absolute * unit + options.relative * size
}

/// Size of an error in tolerances: the root mean square over the components [-].
///
/// ```text
/// √(1/n Σ (errorₖ / (absolute sizeₖ + relative max(|yₖ|, |y'ₖ|)))²)
/// ```
pub(super) fn size<T: Real>(ends: (&[T], &[T]), options: &Options<'_, T>, error: &[T]) -> T {
    size_by(ends, options, |k| error[k])
}

/// Size of the difference of two states in tolerances: the root mean square over the components [-].
pub(super) fn distance<T: Real>(x: &[T], y: &[T], options: &Options<'_, T>) -> T {
    size_by((x, y), options, |k| y[k] - x[k])
}

fn size_by<T: Real>(
    (y, end): (&[T], &[T]),
    options: &Options<'_, T>,
    error: impl Fn(usize) -> T,
) -> T {
    let n = y.len();
    let mut sum = T::ZERO;
    for k in 0..n {
        let error = error(k);
        let tolerance = tolerance(k, y[k].abs().max(end[k].abs()), options);
        // An error of zero is not divided by the tolerance, which may be zero too. The second term makes the sum NaN for a state that is
        // not finite. The division by an infinite tolerance would hide such a state.
        let share = if error == T::ZERO { T::ZERO } else { error / tolerance };
        sum += share * share + end[k] * T::ZERO;
    }
    if n == 0 { T::ZERO } else { (sum / T::from_f64(n as f64)).sqrt() }
}

/// Options that the caller chooses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<'a, T> {
    /// Relative tolerance, a fraction of the value of a component [-], `≥ 0`.
    pub relative: T,
    /// Absolute tolerance, a fraction of the size of a component [-], `≥ 0`. The two tolerances are not both zero.
    pub absolute: T,
    /// Typical size of each component, in the unit of that component, `> 0`. A component without an entry has the size one.
    pub sizes: &'a [T],
    /// Length of the longest step [s], `> 0`.
    pub max_step: T,
    /// Largest number of steps that one call may try.
    pub max_steps: u32,
}

impl<T: Real> Options<'_, T> {
    /// Options with the same relative and absolute tolerance, sizes of one, steps of any length, and at most a million steps.
    pub fn new(tolerance: T) -> Self {
        Self {
            relative: tolerance,
            absolute: tolerance,
            sizes: &[],
            max_step: T::from_f64(f64::INFINITY),
            max_steps: 1_000_000,
        }
    }
}
