//! The classical Runge-Kutta method of order 4 with a fixed step.

use super::Rates;
use crate::Real;

/// Number of places that [`rk4_step`] needs in `scratch` for `n` components: three vectors.
#[must_use]
pub const fn rk4_scratch(n: usize) -> usize {
    3 * n
}

/// Advances `y` from `t` by one step `h` [s] of the classical method of order 4.
///
/// ```text
/// k₁ = f(t, y),   k₂ = f(t + h/2, y + h/2 k₁),   k₃ = f(t + h/2, y + h/2 k₂),   k₄ = f(t + h, y + h k₃)
/// y ← y + h (k₁ + 2 k₂ + 2 k₃ + k₄)/6
/// ```
///
/// Cost: 4 evaluations of the rates and 10 n multiplications; no allocation.
///
/// # Errors
///
/// The error of the rates; `y` is then not changed.
///
/// # Panics
///
/// If `y` does not have [`Rates::n`] components or `scratch` has fewer than [`rk4_scratch`] numbers.
pub fn rk4_step<T: Real, S: Rates<T>>(
    system: &mut S,
    t: T,
    h: T,
    y: &mut [T],
    scratch: &mut [T],
) -> Result<(), S::Error> {
    let n = system.n();
    assert_eq!(y.len(), n, "components of the state");
    assert!(scratch.len() >= rk4_scratch(n), "scratch of three vectors");
    let (k, rest) = scratch.split_at_mut(n);
    let (sum, rest) = rest.split_at_mut(n);
    let stage = &mut rest[..n];
    let half = h * T::HALF;

    // k₁ = f(t, y)
    system.rates(t, y, k)?;
    sum.copy_from_slice(k);

    // Rates k₂ and k₃ at t + h/2 and k₄ at t + h, each from the previous rates.
    for (reach, weight) in [(half, T::TWO), (half, T::TWO), (h, T::ONE)] {
        for i in 0..n {
            stage[i] = y[i] + reach * k[i];
        }
        system.rates(t + reach, stage, k)?;
        for i in 0..n {
            sum[i] += weight * k[i];
        }
    }

    // New state y ← y + h/6 Σ.
    let sixth = h / T::from_f64(6.0);
    for i in 0..n {
        y[i] += sixth * sum[i];
    }
    Ok(())
}
