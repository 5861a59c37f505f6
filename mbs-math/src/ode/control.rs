//! The choice of the next step from the error of the last one: a proportional-integral controller.

use crate::Real;

/// Safety factor on the step that the estimate allows [-], from the usual range of 0.8 to 0.9 (Hairer, Norsett and Wanner II.4).
const SAFETY: f64 = 0.9;
/// Exponent of the error of the last step, multiplied by the power p of h in the estimate [-]: as published (Gustafsson).
const INTEGRAL: f64 = 0.7;
/// Exponent of the error of the step before the last, multiplied by the power p of h in the estimate [-]: as published (Gustafsson).
const PROPORTIONAL: f64 = 0.4;
/// Bounds of the ratio of a step to the previous step [-]. An estimate far from the tolerance is not in the asymptotic range. Chosen, not
/// tuned.
const FACTORS: (f64, f64) = (0.2, 5.0);
/// Least error, in tolerances, that the controller stores [-]. A smaller error may be accidental, and would shorten the next step too much.
/// Chosen, not tuned.
const SMALLEST_MEMORY: f64 = 1e-4;

/// A proportional-integral controller of the step (Gustafsson, ACM Trans. Math. Softw. 17 (1991) 533-554).
///
/// ```text
/// accepted:  h ← h · 0.9 errorₙ^(−0.7/p) errorₙ₋₁^(0.4/p),   not larger right after a rejection
/// rejected:  h ← h · 0.9 error^(−1/p)
/// ```
///
/// Errors are in tolerances, and p is the power of h in the estimate. The factor stays between 0.2 and 5. After the first step there is no
/// earlier error, and the factor is 0.9 error^(−1/p).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepControl<T> {
    power: f64,
    memory: Option<f64>,
    was_rejected: bool,
    scalar: core::marker::PhantomData<T>,
}

impl<T: Real> StepControl<T> {
    /// A controller for an error estimate that is proportional to h to the `power`.
    #[must_use]
    pub fn new(power: u32) -> Self {
        Self {
            power: f64::from(power),
            memory: None,
            was_rejected: false,
            scalar: core::marker::PhantomData,
        }
    }

    /// History of the control: the error of the last accepted step, if there was one, and whether the last trial was rejected.
    #[must_use]
    pub fn history(&self) -> (Option<f64>, bool) {
        (self.memory, self.was_rejected)
    }

    /// Restores the control from a [`history`](Self::history).
    pub fn set_history(&mut self, (memory, was_rejected): (Option<f64>, bool)) {
        (self.memory, self.was_rejected) = (memory, was_rejected);
    }

    /// Factor for the step after an accepted step with this `error`, in tolerances. The controller stores the error.
    ///
    /// Cost: two powers, in `f64` for every scalar.
    pub fn accepted(&mut self, error: T) -> T {
        let error = error.to_f64();
        let wish = match self.memory {
            None => libm::pow(error, -1.0 / self.power),
            Some(memory) => {
                libm::pow(error, -INTEGRAL / self.power)
                    * libm::pow(memory, PROPORTIONAL / self.power)
            }
        };
        let most = if self.was_rejected { 1.0 } else { FACTORS.1 };
        self.memory = Some(error.max(SMALLEST_MEMORY));
        self.was_rejected = false;
        T::from_f64((SAFETY * wish).clamp(FACTORS.0, most))
    }

    /// Factor for the next trial after a rejected trial with this `error`, in tolerances, which may be NaN.
    ///
    /// Cost: one power, in `f64` for every scalar.
    pub fn rejected(&mut self, error: T) -> T {
        self.was_rejected = true;
        let wish = SAFETY * libm::pow(error.to_f64(), -1.0 / self.power);
        T::from_f64(if wish > FACTORS.0 { wish.min(1.0) } else { FACTORS.0 })
    }
}
