//! Newton's method for the three stages of a step.

use super::coefficients::Coefficients;
use super::complex::Complex;
use super::factor::Matrices;
use crate::Real;
use crate::ode::Rates;
use alloc::vec;
use alloc::vec::Vec;

/// Largest number of iterations in a step [-]: from the published range of 7 to 10 (Hairer and Wanner II, IV.8).
const MAX_ITERATIONS: i32 = 8;
/// Largest remaining error of the iteration, in tolerances of the step [-]: from the published range of 0.01 to 0.1 (IV.8).
const MAX_REMAINDER: f64 = 0.03;
/// Contraction above which an iteration ends without success [-]. Chosen, not tuned.
const TOO_SLOW: f64 = 0.9;
/// Least assumed ratio of the remaining error to the first correction [-]. It applies even if the last step converged faster, since the
/// contraction of the new step is not known yet. Chosen, not tuned.
const UNSEEN: f64 = 1e-3;
/// Exponent on the last step's ratio of remaining error to correction [-]: as published (IV.8). The exponent makes the ratio larger, since
/// it is less certain in the next step.
const REST_EXPONENT: f64 = 0.8;

/// Result of an iteration of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    Converged,
    Diverged,
    NotFinite,
}

/// Stages of a step, n numbers each, and the work vectors of the iteration.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Newton<T> {
    /// Stages z₁, z₂, z₃: differences from the state at the beginning of the step.
    pub(super) z: Vec<T>,
    /// Stages w = T⁻¹ z in the basis of the eigenvectors.
    w: Vec<T>,
    pub(super) rates: Vec<T>,
    pub(super) stage: Vec<T>,
    pub(super) one: Vec<T>,
    pair: Vec<Complex<T>>,
    /// Reciprocal of the tolerance of each component.
    pub(super) weights: Vec<T>,
    /// Ratio of the error after the last iteration to the error before it [-].
    pub(super) contraction: T,
    /// Defect of the third stage before the last correction, see [`Self::defect`].
    pub(super) before: T,
}

impl<T: Real> Newton<T> {
    pub(super) fn new(n: usize) -> Self {
        let zeros = |n| vec![T::ZERO; n];
        Self {
            z: zeros(3 * n),
            w: zeros(3 * n),
            rates: zeros(3 * n),
            stage: zeros(n),
            one: zeros(n),
            pair: vec![Complex::new(T::ZERO, T::ZERO); n],
            weights: zeros(n),
            contraction: T::ZERO,
            before: T::ZERO,
        }
    }

    /// Defect of the third stage with these `rates` at it, h f − (A⁻¹ z)₃, in tolerances.
    ///
    /// Corrections are small where the slopes are steep, whatever the rates are. A spring may have lost contact although the slopes still
    /// contain it. Small corrections then hide the error of the stages, and the defect shows it.
    pub(super) fn defect(&self, coefficients: &Coefficients<T>, h: T, rates: &[T]) -> T {
        let n = self.one.len();
        let (gamma, Complex { re, im }) = (coefficients.real, coefficients.complex);
        let row = &coefficients.basis[2];
        let mut sum = T::ZERO;
        for k in 0..n {
            let [w1, w2, w3] = core::array::from_fn(|i| self.w[i * n + k]);
            let slope = product(row, &[gamma * w1, re * w2 - im * w3, im * w2 + re * w3]);
            let share = (h * rates[k] - slope) * self.weights[k];
            sum += share * share;
        }
        (sum / T::from_f64(n.max(1) as f64)).sqrt()
    }

    /// Begins from stages of zero, or from the collocation polynomial of the previous step. `places` has the nodes of the new step, in
    /// lengths of the previous one. `from` is one when the new step begins at the end of the previous one, and zero when both begin at the
    /// same time.
    pub(super) fn begin(
        &mut self,
        coefficients: &Coefficients<T>,
        before: Option<(&[T], [T; 3], T)>,
    ) {
        let n = self.one.len();
        let Some((known, places, from)) = before else {
            self.z.fill(T::ZERO);
            self.w.fill(T::ZERO);
            return;
        };
        let weights = places.map(|place| coefficients.at(place));
        for k in 0..n {
            let old: [T; 3] = core::array::from_fn(|i| known[i * n + k]);
            for (i, weights) in weights.iter().enumerate() {
                self.z[i * n + k] = product(weights, &old) - from * old[2];
            }
        }
        for k in 0..n {
            let z: [T; 3] = core::array::from_fn(|i| self.z[i * n + k]);
            for (i, row) in coefficients.inverse.iter().enumerate() {
                self.w[i * n + k] = product(row, &z);
            }
        }
    }

    /// Finds the stages of the step `h` from `t` and `y`. `rest` is the ratio of the error left after the last correction to that
    /// correction; it is updated on convergence.
    ///
    /// Cost: three evaluations and 5 n² products for each iteration.
    pub(super) fn solve<R: Rates<T>>(
        &mut self,
        system: &mut R,
        (coefficients, matrices): (&Coefficients<T>, &Matrices<T>),
        (t, h): (T, T),
        y: &[T],
        (rest, evaluations): (&mut T, &mut u64),
    ) -> Result<End, R::Error> {
        let n = y.len();
        let mut last = T::ZERO;
        let mut left = T::from_f64(libm::pow(rest.to_f64(), REST_EXPONENT).max(UNSEEN));
        self.contraction = T::ZERO;
        for iteration in 0..MAX_ITERATIONS {
            for (i, &node) in coefficients.nodes.iter().enumerate() {
                for (k, stage) in self.stage.iter_mut().enumerate() {
                    *stage = y[k] + self.z[i * n + k];
                }
                let rates = &mut self.rates[i * n..][..n];
                system.rates(t + node * h, &self.stage, rates)?;
                *evaluations += 1;
                if !rates.iter().all(|rate| rate.is_finite()) {
                    return Ok(End::NotFinite);
                }
            }
            self.before = self.defect(coefficients, h, &self.rates[2 * n..]);
            self.correct((coefficients, matrices), h);
            let size = self.take(coefficients);
            if !size.is_finite() {
                return Ok(End::NotFinite);
            }
            if iteration > 0 {
                let ratio = size / last;
                self.contraction =
                    if iteration > 1 { (ratio * self.contraction).sqrt() } else { ratio };
                let share = self.contraction;
                if !(share < T::from_f64(TOO_SLOW)) {
                    return Ok(End::Diverged);
                }
                left = share / (T::ONE - share);
                let ahead = libm::pow(share.to_f64(), f64::from(MAX_ITERATIONS - 1 - iteration));
                if !(left * size * T::from_f64(ahead) <= T::from_f64(MAX_REMAINDER)) {
                    return Ok(End::Diverged);
                }
            }
            if left * size <= T::from_f64(MAX_REMAINDER) {
                *rest = left;
                return Ok(End::Converged);
            }
            last = size;
        }
        Ok(End::Diverged)
    }

    /// Solves (Λ/h − J) Δw = T⁻¹ f − Λ/h w for Δw, where Λ = T⁻¹ A⁻¹ T has the eigenvalues of A⁻¹. The first component of Δw is written to
    /// `one`, the others as a complex number to `pair`.
    fn correct(&mut self, (coefficients, matrices): (&Coefficients<T>, &Matrices<T>), h: T) {
        let n = self.one.len();
        let (gamma, alpha) = (coefficients.real / h, coefficients.complex.re / h);
        let beta = coefficients.complex.im / h;
        for k in 0..n {
            let f: [T; 3] = core::array::from_fn(|i| self.rates[i * n + k]);
            let [w1, w2, w3] = core::array::from_fn(|i| self.w[i * n + k]);
            let [f1, f2, f3] = coefficients.inverse.map(|row| product(&row, &f));
            self.one[k] = f1 - gamma * w1;
            self.pair[k] =
                Complex::new(f2 - (alpha * w2 - beta * w3), f3 - (beta * w2 + alpha * w3));
        }
        matrices.real.solve(&mut self.one);
        matrices.complex.solve(&mut self.pair);
    }

    /// Adds Δw to w, sets z = T w, and returns the size of Δw in tolerances.
    fn take(&mut self, coefficients: &Coefficients<T>) -> T {
        let n = self.one.len();
        let mut sum = T::ZERO;
        for k in 0..n {
            let change = [self.one[k], self.pair[k].re, self.pair[k].im];
            let mut w = [T::ZERO; 3];
            for i in 0..3 {
                let share = change[i] * self.weights[k];
                sum += share * share;
                self.w[i * n + k] += change[i];
                w[i] = self.w[i * n + k];
            }
            for (i, row) in coefficients.basis.iter().enumerate() {
                self.z[i * n + k] = product(row, &w);
            }
        }
        (sum / T::from_f64((3 * n.max(1)) as f64)).sqrt()
    }
}

fn product<T: Real>(a: &[T; 3], b: &[T; 3]) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
