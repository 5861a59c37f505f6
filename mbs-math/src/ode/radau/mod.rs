//! Implicit Runge-Kutta steps of order 5 for stiff systems: collocation at three Radau points.

mod coefficients;
mod complex;
mod factor;
mod newton;
#[cfg(test)]
mod tests;

use super::{Method, Options, Rates, method};
use crate::Real;
use alloc::vec;
use alloc::vec::Vec;
use coefficients::Coefficients;
use factor::Matrices;
use newton::{End, Newton};

/// Error that a trial returns when its iteration did not converge, in tolerances [-]. The step control then halves the step.
const DIVERGED: f64 = 10.0;
/// Least growth for which a step changes its length [-]: as published (Hairer and Wanner II, IV.8). A step of the same length needs no new
/// factorisation.
const WORTH_IT: f64 = 1.2;
/// Largest ratio of a stage's defect after the last correction to the defect before it [-]. Above it the slopes J do not describe the
/// present motion. Chosen, not tuned.
const MAX_DEFECT_RATIO: f64 = 0.5;
/// Defect that counts as rounding error, in units of the rounding error of the rates due to the rounding of the state [-]. Chosen, not
/// tuned.
const ROUNDINGS: f64 = 16.0;
/// Least value of a component for finite differences, in units of its size [-]: as in the published code RADAU5 (Hairer and Wanner).
const LEAST_VALUE: f64 = 1e-5;
/// Contraction of the iteration below which the slopes J are used again in the next step [-]. Chosen, not tuned.
const FAST_CONTRACTION: f64 = 0.05;
/// Relative difference of two steps below which the factors for one step are used for the other [-]. Chosen, not tuned.
const SAME_STEP: f64 = 1e-3;

/// Radau IIA with three stages (Hairer and Wanner, Solving Ordinary Differential Equations II, IV.8): order 5, L-stable.
///
/// ```text
/// zᵢ = h Σⱼ aᵢⱼ f(t + cⱼ h, y + zⱼ),   y(t + h) = y + z₃
/// error = (γ/h − J)⁻¹ (f(t, y) + Σᵢ dᵢ zᵢ / h)
/// ```
///
/// Newton's method finds the stages zᵢ. Its slopes J = ∂f/∂y come from finite differences, and are used again while the iteration converges
/// fast. In the basis where A⁻¹ is diagonal, the matrices of the iteration are γ/h − J and (α + iβ)/h − J. The iteration begins from the
/// collocation polynomial of the previous step.
///
/// A converged iteration is rejected when the slopes hide a defect of the stages. An example is a stiff spring that loses contact within the
/// step. An event that begins and ends within a step is not detected. An event that moves the state by less than the tolerance is not
/// detected either. [`Options::max_step`] limits the step for such events. In `f32`, very stiff springs amplify the rounding of positions.
/// This limits the tolerances that the iteration can reach, and keeps steps short.
///
/// [`Radau::new`] allocates all memory; a step allocates nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Radau<T> {
    coefficients: Coefficients<T>,
    memory: RadauHistory<T>,
    matrices: Matrices<T>,
    newton: Newton<T>,
    /// Time at which the last trial began [s].
    begun: Option<T>,
    /// Time at which the slopes J were evaluated [s].
    found: Option<T>,
    evaluations: u64,
}

/// History of a [`Radau`] from step to step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RadauHistory<T> {
    /// Slopes J = ∂f/∂y, row by row.
    pub jacobian: Vec<T>,
    /// True if the next step may use J.
    pub has_jacobian: bool,
    /// Step length for which the matrices are factored [s], if they are factored with the present slopes.
    pub factored: Option<T>,
    /// Stages z₁, z₂, z₃ of the last step.
    pub stages: Vec<T>,
    /// Length of the last step [s], if its iteration converged.
    pub step: Option<T>,
    /// Ratio of the error left after the last correction to that correction [-].
    pub rest: T,
}

impl<T: Real> Radau<T> {
    /// A method for systems of `n` components. The rates of the first `leading` components depend little on each other, as the rates of
    /// positions do, which are velocities. These components are eliminated without row exchanges.
    #[must_use]
    pub fn new(n: usize, leading: usize) -> Self {
        Self {
            coefficients: Coefficients::new(),
            memory: RadauHistory {
                jacobian: vec![T::ZERO; n * n],
                has_jacobian: false,
                factored: None,
                stages: vec![T::ZERO; 3 * n],
                step: None,
                rest: T::ONE,
            },
            matrices: Matrices::new(n, leading),
            newton: Newton::new(n),
            begun: None,
            found: None,
            evaluations: 0,
        }
    }

    /// History that the next step continues from.
    #[must_use]
    pub fn history(&self) -> RadauHistory<T> {
        self.memory.clone()
    }

    /// Restores the history of a method with the same number of components. Returns `false` when the number differs or the matrices are not
    /// regular. The old history then remains, except that after a singular matrix the slopes are evaluated again.
    ///
    /// Cost: the two factorisations, if the history has a factored step.
    pub fn set_history(&mut self, history: &RadauHistory<T>) -> bool {
        let lengths = |memory: &RadauHistory<T>| (memory.jacobian.len(), memory.stages.len());
        if lengths(history) != lengths(&self.memory) {
            return false;
        }
        let before = core::mem::replace(&mut self.memory, history.clone());
        (self.begun, self.found) = (None, None);
        let is_sound = history.factored.is_none_or(|h| self.factor(h));
        if !is_sound {
            self.memory = RadauHistory { has_jacobian: false, factored: None, ..before };
        }
        is_sound
    }

    /// Factors both matrices for the step `h`; returns `true` when both are regular.
    fn factor(&mut self, h: T) -> bool {
        let is_sound = self.matrices.factor(&self.coefficients, h, &self.memory.jacobian);
        self.memory.factored = is_sound.then_some(h);
        is_sound
    }

    /// Evaluates J by finite differences of the rates at (t, y), column by column. A column is zero when the rates are not finite on both
    /// sides. Cost: n + 1 evaluations, and one more for each column that needs the second side.
    fn differentiate<R: Rates<T>>(
        &mut self,
        system: &mut R,
        t: T,
        (y, options): (&[T], &Options<'_, T>),
    ) -> Result<(), R::Error> {
        let n = y.len();
        let Newton { stage, z, .. } = &mut self.newton;
        let (base, moved) = z.split_at_mut(n);
        let moved = &mut moved[..n];
        stage.copy_from_slice(y);
        system.fine_rates(t, stage, base)?;
        for k in 0..n {
            let unit = options.sizes.get(k).copied().unwrap_or(T::ONE);
            let size = y[k].abs().max(T::from_f64(LEAST_VALUE) * unit);
            let root = (T::EPSILON * size * unit).sqrt();
            for by in [root, -root] {
                // The increment after rounding of the sum, which differs from `by`.
                stage[k] = y[k] + by;
                let step = stage[k] - y[k];
                system.fine_rates(t, stage, moved)?;
                self.evaluations += 1;
                let is_finite = moved.iter().all(|rate| rate.is_finite());
                for i in 0..n {
                    let slope = if is_finite { (moved[i] - base[i]) / step } else { T::ZERO };
                    self.memory.jacobian[i * n + k] = slope;
                }
                if is_finite {
                    break;
                }
            }
            stage[k] = y[k];
        }
        self.evaluations += 1;
        self.memory.has_jacobian = true;
        (self.memory.factored, self.found) = (None, Some(t));
        Ok(())
    }

    /// Updates the slopes and the factors as the step `h` needs. Returns whether the slopes were evaluated at the beginning of this step,
    /// or `None` when the matrices are not regular.
    fn prepare<R: Rates<T>>(
        &mut self,
        system: &mut R,
        (t, h): (T, T),
        (y, options): (&[T], &Options<'_, T>),
    ) -> Result<Option<bool>, R::Error> {
        if !self.memory.has_jacobian {
            self.differentiate(system, t, (y, options))?;
        }
        let is_new = self.found == Some(t);
        let is_near = |of: T| (h - of).abs() <= T::from_f64(SAME_STEP) * h;
        let is_sound = self.memory.factored.is_some_and(is_near) || self.factor(h);
        Ok(is_sound.then_some(is_new))
    }

    /// Decides by the defect of the stages whether the last correction converged. `last` has the rates at the end of the step.
    ///
    /// Cost: 6 n products, and n² more when the defect is above one tolerance and did not fall by half.
    fn judge(&self, h: T, y: &[T], last: &[T]) -> End {
        if !last.iter().all(|rate| rate.is_finite()) {
            return End::NotFinite;
        }
        let (newton, n) = (&self.newton, y.len());
        let after = newton.defect(&self.coefficients, h, last);
        if after <= T::ONE || after <= T::from_f64(MAX_DEFECT_RATIO) * newton.before {
            return End::Converged;
        }
        // Rounding error of the rates: the slopes times the rounding error of the state.
        let mut sum = T::ZERO;
        for (row, &weight) in self.memory.jacobian.chunks_exact(n.max(1)).zip(&newton.weights) {
            let products = row.iter().zip(y).fold(T::ZERO, |sum, (j, y)| sum + j.abs() * y.abs());
            sum += (products * weight) * (products * weight);
        }
        let noise = h * T::EPSILON * (sum / T::from_f64(n.max(1) as f64)).sqrt();
        if after <= T::from_f64(ROUNDINGS) * noise { End::Converged } else { End::Diverged }
    }

    /// Size of the error of the step, in tolerances. `first` has the rates at the beginning, `end` the new state.
    ///
    /// Cost: n² products. When a step after a rejected one would be rejected too, the cost is one evaluation and n² products more.
    fn error<R: Rates<T>>(
        &mut self,
        system: &mut R,
        (t, h, is_repeated): (T, T, bool),
        (y, end): (&[T], &[T]),
        (options, first): (&Options<'_, T>, &[T]),
    ) -> Result<T, R::Error> {
        let (n, d) = (y.len(), self.coefficients.error);
        let Newton { stage, z, one, rates, .. } = &mut self.newton;
        let real = &self.matrices.real;
        let estimate = |rates: &[T], to: &mut [T]| {
            for k in 0..n {
                to[k] = rates[k] + (d[0] * z[k] + d[1] * z[n + k] + d[2] * z[2 * n + k]) / h;
            }
            real.solve(to);
        };
        estimate(first, one);
        stage.copy_from_slice(one);
        system.keep(stage)?;
        let error = method::size((y, end), options, stage);
        if error <= T::ONE || !is_repeated {
            return Ok(error);
        }
        // An error component that a stiff system damps at once does not count. The estimate is therefore repeated with the rates at y +
        // error, where such components are damped.
        for k in 0..n {
            one[k] += y[k];
        }
        let rates = &mut rates[..n];
        system.rates(t, one, rates)?;
        self.evaluations += 1;
        estimate(rates, stage);
        system.keep(stage)?;
        Ok(method::size((y, end), options, stage))
    }
}

impl<T: Real> Method<T> for Radau<T> {
    fn power(&self) -> u32 {
        4
    }

    fn n_scratch(&self, n: usize) -> usize {
        3 * n
    }

    fn evaluations(&self, _: bool) -> u64 {
        self.evaluations
    }

    fn trial<R: Rates<T>>(
        &mut self,
        system: &mut R,
        (t, h): (T, T),
        y: &[T],
        first_is_known: bool,
        (options, scratch): (&Options<'_, T>, &mut [T]),
    ) -> Result<T, R::Error> {
        let n = y.len();
        let (first, rest) = scratch.split_at_mut(n);
        let (end, last) = rest.split_at_mut(n);
        self.evaluations = 0;
        if !first_is_known {
            system.rates(t, y, first)?;
            self.evaluations += 1;
        }
        if !first.iter().all(|rate| rate.is_finite()) {
            return Ok(T::from_f64(f64::NAN));
        }
        method::weights(y, options, &mut self.newton.weights);
        let is_repeated = self.begun == Some(t);
        self.begun = Some(t);
        loop {
            let Some(is_new) = self.prepare(system, (t, h), (y, options))? else {
                self.memory.has_jacobian = false;
                self.memory.step = None;
                return Ok(T::from_f64(f64::NAN));
            };
            // A trial after a rejected trial begins at the same time and state as the rejected one.
            let from = if is_repeated { T::ZERO } else { T::ONE };
            let nodes = self.coefficients.nodes;
            let before = self.memory.step.map(|old| {
                (&self.memory.stages[..], nodes.map(|node| from + node * h / old), from)
            });
            if before.is_none() {
                self.memory.rest = T::ONE;
            }
            self.newton.begin(&self.coefficients, before);
            let solvers = (&self.coefficients, &self.matrices);
            let progress = (&mut self.memory.rest, &mut self.evaluations);
            let mut how = self.newton.solve(system, solvers, (t, h), y, progress)?;
            if how == End::Converged {
                for k in 0..n {
                    end[k] = y[k] + self.newton.z[2 * n + k];
                }
                system.rates(t + h, end, last)?;
                self.evaluations += 1;
                how = self.judge(h, y, last);
            }
            if how == End::Converged {
                break;
            }
            self.memory.step = None;
            if is_new || how == End::NotFinite {
                let size = if how == End::NotFinite { f64::NAN } else { DIVERGED };
                return Ok(T::from_f64(size));
            }
            self.memory.has_jacobian = false;
        }
        self.memory.stages.copy_from_slice(&self.newton.z);
        self.memory.step = Some(h);
        let error = self.error(system, (t, h, is_repeated), (y, end), (options, first))?;
        // A trial that is rejected is repeated with the same slopes.
        let is_fast = self.newton.contraction <= T::from_f64(FAST_CONTRACTION);
        self.memory.has_jacobian = is_fast || !(error <= T::ONE);
        Ok(error)
    }

    fn new_state<'s>(&self, n: usize, scratch: &'s [T]) -> &'s [T] {
        &scratch[n..][..n]
    }

    fn carry(&self, n: usize, scratch: &mut [T]) -> bool {
        scratch.copy_within(2 * n..3 * n, 0);
        true
    }

    fn shares(&self) -> bool {
        true
    }

    fn worth(&self, factor: T) -> T {
        let is_worth_it = factor < T::ONE || factor > T::from_f64(WORTH_IT);
        if is_worth_it { factor } else { T::ONE }
    }
}
