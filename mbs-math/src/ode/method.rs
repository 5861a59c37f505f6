//! Method as the control of the step sees it, options of its caller, and the size of an error.

use super::Rates;
use crate::Real;

/// A one-step method that estimates its own error: an embedded pair, or an extrapolation.
///
/// Its scratch begins with the rates at the start of the step, n numbers, and holds the new state after a trial.
pub trait Method<T: Real> {
    /// Power of h in the size of the error.
    fn power(&self) -> u32;

    /// Numbers of scratch for `n` components.
    fn n_scratch(&self, n: usize) -> usize;

    /// Evaluations of the last trial step.
    fn evaluations(&self, first_is_known: bool) -> u64;

    /// Makes one trial step and returns the size of its error: at most one is within the tolerance. `y` is not changed.
    ///
    /// With `first_is_known` the rates at (`t`, `y`) stand at the beginning of `scratch` already. A number that is not finite
    /// gives NaN or infinity.
    ///
    /// # Errors
    ///
    /// What the rates say.
    fn trial<R: Rates<T>>(
        &mut self,
        system: &mut R,
        step: (T, T),
        y: &[T],
        first_is_known: bool,
        control: (&Options<'_, T>, &mut [T]),
    ) -> Result<T, R::Error>;

    /// The new state that a trial left in `scratch`, for `n` components.
    fn new_state<'s>(&self, n: usize, scratch: &'s [T]) -> &'s [T];

    /// Brings the rates at the new state to the beginning of `scratch`, if the trial found them; says whether it did.
    fn carry(&self, n: usize, scratch: &mut [T]) -> bool;

    /// Does the method want what is left of a length of time in steps of one length, since a step of another costs it a factorisation?
    fn shares(&self) -> bool {
        false
    }

    /// Factor for the next step, which may be longer by `factor`, as the method wants it: a change may not be worth its cost.
    fn worth(&self, factor: T) -> T {
        factor
    }
}

/// One over the tolerance of each component by its value at the beginning of a step; zero where there is none yet.
#[cfg(feature = "alloc")]
pub(super) fn weights<T: Real>(y: &[T], options: &Options<'_, T>, weights: &mut [T]) {
    for (k, weight) in weights.iter_mut().enumerate() {
        let tolerance = tolerance(k, y[k].abs(), options);
        *weight = if tolerance > T::ZERO { T::ONE / tolerance } else { T::ZERO };
    }
}

/// The tolerance of component k of this size.
fn tolerance<T: Real>(k: usize, size: T, options: &Options<'_, T>) -> T {
    let unit = options.sizes.get(k).copied().unwrap_or(T::ONE);
    options.absolute * unit + options.relative * size
}

/// Size of an error beside the tolerance.
///
/// ```text
/// √(1/n Σ (errorₖ / (absolute sizeₖ + relative max(|yₖ|, |y'ₖ|)))²)
/// ```
pub(super) fn size<T: Real>(ends: (&[T], &[T]), options: &Options<'_, T>, error: &[T]) -> T {
    size_by(ends, options, |k| error[k])
}

/// Size of the difference of two states beside the tolerance.
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
        // No error needs no tolerance; a state that is not finite must not hide in the denominator.
        let share = if error == T::ZERO { T::ZERO } else { error / tolerance };
        sum += share * share + end[k] * T::ZERO;
    }
    if n == 0 { T::ZERO } else { (sum / T::from_f64(n as f64)).sqrt() }
}

/// Options that the caller chooses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options<'a, T> {
    /// Tolerance as a share of a component's value. `≥ 0`.
    pub relative: T,
    /// Tolerance as a share of a component's size. `≥ 0`; not both zero.
    pub absolute: T,
    /// Size of each component, in its own unit `> 0`; one for those that are not given.
    pub sizes: &'a [T],
    /// No step is longer [s]. `> 0`.
    pub max_step: T,
    /// Steps that one call may try.
    pub max_steps: u32,
}

impl<T: Real> Options<'_, T> {
    /// Options with the same relative and absolute tolerance, sizes of one, steps of any length, a million of them.
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
