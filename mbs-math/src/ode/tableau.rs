//! Embedded Runge-Kutta pairs with their coefficients, the stages of one trial step, and its error.

use super::{Method, Options, Rates, method};
use crate::Real;

/// The coefficients of an embedded pair with `S` stages.
///
/// The method of higher order gives the new state; its difference from the method of lower order estimates the error.
#[derive(Debug, Clone, PartialEq)]
pub struct Tableau<T, const S: usize> {
    /// Coefficients aᵢⱼ of the stages: stage i uses the rates of the stages j < i. The other entries are not read.
    pub a: [[T; S]; S],
    /// Weights bᵢ of the new state.
    pub b: [T; S],
    /// Times cᵢ of the stages, in steps.
    pub c: [T; S],
    /// Weights eᵢ = bᵢ − b̂ᵢ of the error estimate.
    pub e: [T; S],
    /// Weights of a second estimate, of lower order. Where it is large too, the first estimate may be small by accident. The size of the
    /// error is then E²/√(E² + 0.01 C²), with E from `e` and C from this estimate.
    pub coarse: Option<[T; S]>,
    /// Power of h in the size of the error: the order of the estimate plus one. With two estimates, it is twice the power of the first
    /// estimate minus the power of the second.
    pub power: u32,
    /// True if the last stage is at the new state, that is, if the last row of a equals b. Its rates are then the first rates of the next
    /// step.
    pub first_same_as_last: bool,
}

/// Numerators and denominators of a row of coefficients.
type Row<const S: usize> = ([f64; S], [f64; S]);

/// Quotients of whole numbers, so that the coefficients are rounded once in every precision.
fn ratios<T: Real, const S: usize>((over, under): Row<S>) -> [T; S] {
    core::array::from_fn(|i| T::from_f64(over[i]) / T::from_f64(under[i]))
}

impl<T: Real> Tableau<T, 7> {
    /// The pair 5(4) of Dormand and Prince (J. Comp. Appl. Math. 6 (1980) 19-26): six evaluations for a step of order 5.
    #[must_use]
    pub fn dormand_prince() -> Self {
        let b = ([35., 0., 500., 125., -2187., 11., 0.], [384., 1., 1113., 192., 6784., 84., 1.]);
        Self {
            a: [
                ratios(([0.; 7], [1.; 7])),
                ratios(([1., 0., 0., 0., 0., 0., 0.], [5., 1., 1., 1., 1., 1., 1.])),
                ratios(([3., 9., 0., 0., 0., 0., 0.], [40., 40., 1., 1., 1., 1., 1.])),
                ratios(([44., -56., 32., 0., 0., 0., 0.], [45., 15., 9., 1., 1., 1., 1.])),
                ratios((
                    [19372., -25360., 64448., -212., 0., 0., 0.],
                    [6561., 2187., 6561., 729., 1., 1., 1.],
                )),
                ratios((
                    [9017., -355., 46732., 49., -5103., 0., 0.],
                    [3168., 33., 5247., 176., 18656., 1., 1.],
                )),
                ratios(b),
            ],
            b: ratios(b),
            c: ratios(([0., 1., 3., 4., 8., 1., 1.], [1., 5., 10., 5., 9., 1., 1.])),
            e: ratios((
                [71., 0., -71., 71., -17253., 22., -1.],
                [57600., 1., 16695., 1920., 339_200., 525., 40.],
            )),
            coarse: None,
            power: 5,
            first_same_as_last: true,
        }
    }
}

impl<T: Real, const S: usize> Tableau<T, S> {
    /// Number of places in `scratch` for `n` components: the rates of the stages, one state and an error.
    #[must_use]
    pub const fn scratch(n: usize) -> usize {
        (S + 2) * n
    }

    /// Makes one trial step: computes the rates of all stages and then the new state, both in `scratch`. `y` is not changed.
    ///
    /// With `first_is_known`, the first n numbers of `scratch` are already the rates at (`t`, `y`). [`Self::end_state`] gives the new
    /// state.
    ///
    /// Cost: S evaluations, one less if the first rates are known, and about S²/2 n multiplications.
    ///
    /// # Errors
    ///
    /// The error of the rates.
    ///
    /// # Panics
    ///
    /// If `y` does not have [`Rates::n`] components or `scratch` does not have [`Self::scratch`] numbers.
    pub fn stages<R: Rates<T>>(
        &self,
        system: &mut R,
        (t, h): (T, T),
        y: &[T],
        first_is_known: bool,
        scratch: &mut [T],
    ) -> Result<(), R::Error> {
        let n = system.n();
        assert_eq!(y.len(), n, "components of the state");
        assert_eq!(scratch.len(), Self::scratch(n), "scratch of S + 2 vectors");
        let (rates, rest) = scratch.split_at_mut(S * n);
        let stage = &mut rest[..n];

        // kᵢ = f(t + cᵢ h, y + h Σⱼ aᵢⱼ kⱼ)
        for i in usize::from(first_is_known)..S {
            let (known, rest) = rates.split_at_mut(i * n);
            combine(&self.a[i][..i], h, y, known, stage);
            system.rates(t + self.c[i] * h, stage, &mut rest[..n])?;
        }

        // The new state y + h Σᵢ bᵢ kᵢ, unless the last stage is the new state.
        if !self.first_same_as_last {
            combine(&self.b, h, y, rates, stage);
        }
        Ok(())
    }

    /// The new state, of `n` components, that [`Self::stages`] wrote into `scratch`.
    #[must_use]
    pub fn end_state(n: usize, scratch: &[T]) -> &[T] {
        &scratch[S * n..][..n]
    }

    /// Size of the error h Σᵢ eᵢ kᵢ of the trial step in `scratch`, in tolerances: a step of size one or less is accepted. `system` removes
    /// components from the error by [`Rates::keep`]. A second estimate is used as described at [`Self::coarse`].
    ///
    /// The size is NaN or infinite when a number in the error or in the new state is not finite.
    ///
    /// Cost: (S + 2) n multiplications and [`Rates::keep`], twice with a second estimate; no evaluation.
    ///
    /// # Errors
    ///
    /// The error of [`Rates::keep`].
    pub fn error<R: Rates<T>>(
        &self,
        system: &mut R,
        h: T,
        y: &[T],
        (options, scratch): (&Options<'_, T>, &mut [T]),
    ) -> Result<T, R::Error> {
        /// Weight of the square of the second estimate [-]: as published (Hairer, Norsett and Wanner, II.10).
        const COARSE_WEIGHT: f64 = 0.01;
        let n = y.len();
        let (rates, rest) = scratch.split_at_mut(S * n);
        let (end, error) = rest.split_at_mut(n);
        let mut size = |weights: &[T; S]| {
            sum(weights, rates, error);
            error.iter_mut().for_each(|error| *error *= h);
            system.keep(error)?;
            Ok(method::size((y, end), options, error))
        };
        let fine = size(&self.e)?;
        let Some(coarse) = &self.coarse else { return Ok(fine) };
        let coarse = size(coarse)?;
        let both = fine * fine + T::from_f64(COARSE_WEIGHT) * coarse * coarse;
        Ok(if both > T::ZERO { fine * fine / both.sqrt() } else { both })
    }
}

impl<T: Real, const S: usize> Method<T> for Tableau<T, S> {
    fn power(&self) -> u32 {
        self.power
    }

    fn n_scratch(&self, n: usize) -> usize {
        Self::scratch(n)
    }

    fn evaluations(&self, first_is_known: bool) -> u64 {
        S as u64 - u64::from(first_is_known)
    }

    fn trial<R: Rates<T>>(
        &mut self,
        system: &mut R,
        (t, h): (T, T),
        y: &[T],
        first_is_known: bool,
        (options, scratch): (&Options<'_, T>, &mut [T]),
    ) -> Result<T, R::Error> {
        self.stages(system, (t, h), y, first_is_known, scratch)?;
        self.error(system, h, y, (options, scratch))
    }

    fn new_state<'s>(&self, n: usize, scratch: &'s [T]) -> &'s [T] {
        Self::end_state(n, scratch)
    }

    fn carry(&self, n: usize, scratch: &mut [T]) -> bool {
        if self.first_same_as_last {
            scratch.copy_within((S - 1) * n..S * n, 0);
        }
        self.first_same_as_last
    }
}

/// Writes y + h Σⱼ wⱼ kⱼ into `to`.
fn combine<T: Real>(weights: &[T], h: T, y: &[T], rates: &[T], to: &mut [T]) {
    sum(weights, rates, to);
    for (to, &y) in to.iter_mut().zip(y) {
        *to = y + h * *to;
    }
}

/// Writes Σⱼ wⱼ kⱼ into `to`.
fn sum<T: Real>(weights: &[T], rates: &[T], to: &mut [T]) {
    to.fill(T::ZERO);
    for (rates, &weight) in rates.chunks_exact(to.len().max(1)).zip(weights) {
        if weight != T::ZERO {
            for (to, &rate) in to.iter_mut().zip(rates) {
                *to += weight * rate;
            }
        }
    }
}
