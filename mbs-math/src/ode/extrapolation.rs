//! Extrapolation of the explicit midpoint rule (Gragg 1965; Bulirsch and Stoer 1966): steps of any even order.

use super::{Method, Options, Rates, method};
use crate::Real;

/// Least and most columns [-]: orders 6 to 32, as rounding grows with the sum of the weights, to 12,600 for 14 columns.
const COLUMNS: (usize, usize) = (3, 16);

/// The midpoint rule over a step in 2, 4, 6, ... 2k parts, extrapolated in h² to parts of no length.
///
/// ```text
/// d₀ = 0,   d₁ = η f(t, y),   dₘ₊₁ = dₘ₋₁ + 2 η f(t + m η, y + dₘ),   η = h/nⱼ
/// Tⱼ₁ = (dₙ + dₙ₋₁ + η f(t + h, y + dₙ))/2
/// Tⱼ,ₗ₊₁ = Tⱼₗ + (Tⱼₗ − Tⱼ₋₁,ₗ) / ((nⱼ/nⱼ₋ₗ)² − 1),   y(t + h) = y + Tₖₖ,   error = Tₖₖ − Tₖ,ₖ₋₁
/// ```
///
/// The rates at the end are in every column: where forces set in just before it, columns differ, and the estimate sees them.
///
/// k columns give order 2k, of which the estimate is h^(2k−1). For reference runs in [`DoubleDouble`](crate::real::DoubleDouble):
/// the higher the order, the fewer evaluations the last digits take. Increments are extrapolated, not states, for the weights
/// sum to 26 in size for 6 columns, to 12,600 for 14, and rounding grows with them.
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

    /// Extrapolation with as many columns as a tolerance is worth: nine for twenty digits, and two more.
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

    /// Numbers of scratch for `n` components, whatever the columns.
    #[must_use]
    pub const fn most_scratch(n: usize) -> usize {
        (COLUMNS.1 + 5) * n
    }

    /// The midpoint rule in `parts` parts; the increment is left in `now`.
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

/// 1 / ((nⱼ/nᵢ)² − 1) for nⱼ = 2 (j + 1), from whole numbers.
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

    /// k (k + 1) parts with the rates at the end of each; all columns begin with the same ones.
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
            // The row above gives way to this one, entry by entry.
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
