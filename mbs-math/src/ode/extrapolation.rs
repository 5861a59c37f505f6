//! Extrapolation of the explicit midpoint rule (Gragg 1965; Bulirsch and Stoer 1966): steps of any even order.

use super::{Method, Options, Rates, method};
use crate::Real;

/// Least and largest number of columns [-], for orders 6 to 32. The limit is due to rounding, which grows with the sum of the weights:
/// 12,600 for 14 columns.
const COLUMNS: (usize, usize) = (3, 16);

/// The midpoint rule over a step in nⱼ = 2 j parts, j from 1 to k. The results are extrapolated in h² to parts of length zero.
///
/// ```text
/// d₀ = 0,   d₁ = η f(t, y),   dₘ₊₁ = dₘ₋₁ + 2 η f(t + m η, y + dₘ),   η = h/nⱼ
/// Tⱼ₁ = (dₙ + dₙ₋₁ + η f(t + h, y + dₙ))/2
/// Tⱼ,ₗ₊₁ = Tⱼₗ + (Tⱼₗ − Tⱼ₋₁,ₗ) / ((nⱼ/nⱼ₋ₗ)² − 1),   y(t + h) = y + Tₖₖ,   error = Tₖₖ − Tₖ,ₖ₋₁
/// ```
///
/// Every column uses the rates at the end of the step. When a force begins just before the end, the columns therefore differ, and the error
/// estimate becomes large.
/// With k columns the method has order 2k, and its error estimate is proportional to h^(2k−1). The method is for reference runs in
/// [`DoubleDouble`](crate::real::DoubleDouble): a higher order needs fewer evaluations for the last digits. The increments are
/// extrapolated, not the states. The reason is that rounding errors grow with the sum of the weights: 26 for 6 columns, 12,600 for 14.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Extrapolation {
    columns: usize,
}

impl Extrapolation {
    /// The method with this number of columns, from 3 to 16.
    #[must_use]
    pub fn new(columns: usize) -> Self {
        Self { columns: columns.clamp(COLUMNS.0, COLUMNS.1) }
    }

    /// Extrapolation with the number of columns for a tolerance: two, plus 0.45 for each digit of the tolerance. Twenty digits take eleven
    /// columns.
    #[must_use]
    pub fn for_tolerance<T: Real>(tolerance: T) -> Self {
        /// Columns for each digit [-]. Chosen, not tuned.
        const PER_DIGIT: f64 = 0.45;
        let digits = -libm::log10(tolerance.to_f64());
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "digits of a positive number, and no sense in others"
        )]
        Self::new(libm::round(2.0 + PER_DIGIT * digits.clamp(0.0, 40.0)) as usize)
    }

    /// Number of places in `scratch` for `n` components and any number of columns.
    #[must_use]
    pub const fn most_scratch(n: usize) -> usize {
        (COLUMNS.1 + 5) * n
    }

    /// Integrates by the midpoint rule in `parts` parts; writes the increment of the state into `now`.
    fn midpoint<T: Real, R: Rates<T>>(
        system: &mut R,
        (t, h, parts): (T, T, usize),
        (y, first): (&[T], &[T]),
        [before, now, stage, rates]: [&mut [T]; 4],
    ) -> Result<(), R::Error> {
        let n = y.len();
        let part = h / T::from_f64(parts as f64);
        before.fill(T::ZERO);
        for i in 0..n {
            now[i] = part * first[i];
        }
        for m in 1..parts {
            for i in 0..n {
                stage[i] = y[i] + now[i];
            }
            system.rates(t + T::from_f64(m as f64) * part, stage, rates)?;
            for i in 0..n {
                let next = before[i] + T::TWO * part * rates[i];
                before[i] = now[i];
                now[i] = next;
            }
        }
        for i in 0..n {
            stage[i] = y[i] + now[i];
        }
        system.rates(t + h, stage, rates)?;
        for i in 0..n {
            now[i] = T::HALF * (now[i] + before[i] + part * rates[i]);
        }
        Ok(())
    }
}

/// The weight 1 / ((nⱼ/nᵢ)² − 1) for nⱼ = 2 (j + 1), computed from whole numbers.
fn share<T: Real>(j: usize, i: usize) -> T {
    let square = |j: usize| ((j + 1) * (j + 1)) as f64;
    T::from_f64(square(i)) / T::from_f64(square(j) - square(i))
}

impl<T: Real> Method<T> for Extrapolation {
    fn power(&self) -> u32 {
        2 * self.columns as u32 - 1
    }

    fn n_scratch(&self, n: usize) -> usize {
        (self.columns + 5) * n
    }

    /// A trial has k (k + 1) parts, with an evaluation at the end of each. The first rates serve all columns.
    fn evaluations(&self, first_is_known: bool) -> u64 {
        (self.columns * (self.columns + 1)) as u64 + u64::from(!first_is_known)
    }

    fn trial<R: Rates<T>>(
        &mut self,
        system: &mut R,
        (t, h): (T, T),
        y: &[T],
        first_is_known: bool,
        (options, scratch): (&Options<'_, T>, &mut [T]),
    ) -> Result<T, R::Error> {
        let (n, k) = (y.len(), self.columns);
        let (first, rest) = scratch.split_at_mut(n);
        let (row, rest) = rest.split_at_mut(k * n);
        let (before, rest) = rest.split_at_mut(n);
        let (now, rest) = rest.split_at_mut(n);
        let (stage, rates) = rest.split_at_mut(n);
        if !first_is_known {
            system.rates(t, y, first)?;
        }
        for j in 0..k {
            let memory = [&mut *before, &mut *now, &mut *stage, &mut *rates];
            Self::midpoint(system, (t, h, 2 * (j + 1)), (y, first), memory)?;
            // The new row overwrites the previous row of the table, entry by entry.
            for l in 0..j {
                let share = share(j, j - 1 - l);
                for i in 0..n {
                    let next = now[i] + (now[i] - row[l * n + i]) * share;
                    row[l * n + i] = now[i];
                    now[i] = next;
                }
            }
            row[j * n..][..n].copy_from_slice(now);
        }
        let (lower, last) = row[(k - 2) * n..].split_at(n);
        for i in 0..n {
            stage[i] = y[i] + last[i];
            now[i] = last[i] - lower[i];
        }
        system.keep(now)?;
        Ok(method::size((y, stage), options, now))
    }

    fn new_state<'s>(&self, n: usize, scratch: &'s [T]) -> &'s [T] {
        &scratch[(self.columns + 3) * n..][..n]
    }

    fn carry(&self, _: usize, _: &mut [T]) -> bool {
        false
    }
}
