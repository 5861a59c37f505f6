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

/// Error that stands for an iteration that did not converge, in tolerances [-]: the step control then halves the step.
const DIVERGED: f64 = 10.0;
/// Growth below which a step keeps its length, and its factors with it [-]: as published (Hairer and Wanner II, IV.8).
const WORTH_IT: f64 = 1.2;
/// Ratio of a stage's defect after a correction to that before it, above which the slopes are of another motion [-]. Chosen, not tuned.
const MAX_DEFECT_RATIO: f64 = 0.5;
/// Defect that is rounding, in units of what rounding of the state makes of the rates [-]. Chosen, not tuned.
const ROUNDINGS: f64 = 16.0;
/// Least value of a component for differences, in units of its size [-]: as in the published code RADAU5 (Hairer and Wanner).
const LEAST_VALUE: f64 = 1e-5;
/// Contraction of the iteration below which its slopes are kept for the next step [-]. Chosen, not tuned.
const FAST_CONTRACTION: f64 = 0.05;
/// Relative difference of two steps below which the factors of one serve for the other [-]. Chosen, not tuned.
const SAME_STEP: f64 = 1e-3;

/// Radau IIA with three stages (Hairer and Wanner, Solving Ordinary Differential Equations II, IV.8): order 5, L-stable.
///
/// ```text
/// zᵢ = h Σⱼ aᵢⱼ f(t + cⱼ h, y + zⱼ),   y(t + h) = y + z₃
/// error = (γ/h − J)⁻¹ (f(t, y) + Σᵢ dᵢ zᵢ / h)
/// ```
///
/// The stages are found by Newton's method with slopes J by differences, which are kept while it converges fast. In the basis
/// where A⁻¹ is diagonal its matrices are γ/h − J and (α + iβ)/h − J. The iteration begins from the polynomial of the step before.
///
/// A step is refused where slopes hide from the iteration what its stages are off by, as those of a spring do that has let go within
/// the step. What begins and ends within a step, or moves the state by less than the tolerance, is not seen: [`Options::max_step`].
/// In `f32` the rounding of positions, times the slopes of very stiff springs, keeps the iteration from small tolerances, and steps short.
///
/// All memory is made by [`Radau::new`]; nothing is allocated in a step.
#[derive(Debug, Clone, PartialEq)]
pub struct Radau<T> {
    coefficients: Coefficients<T>,
    memory: RadauHistory<T>,
    matrices: Matrices<T>,
    newton: Newton<T>,
    /// When the last trial began [s].
    begun: Option<T>,
    /// When the slopes were found [s].
    found: Option<T>,
    evaluations: u64,
}

/// History of a [`Radau`] from step to step.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RadauHistory<T> {
    /// J, row by row.
    pub jacobian: Vec<T>,
    /// Is J one that the next step may use?
    pub has_jacobian: bool,
    /// The step that the factors are of [s], if they are of these slopes.
    pub factored: Option<T>,
    /// z₁, z₂, z₃ of the last step.
    pub stages: Vec<T>,
    /// The length of that step [s], if its iteration converged.
    pub step: Option<T>,
    /// How much more than the last correction was left after it.
    pub rest: T,
}

impl<T: Real> Radau<T> {
    /// A method for systems of `n` components. The rates of the first `leading` depend little on each other, as those of positions do,
    /// which are velocities: they are eliminated without exchange of rows.
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

    /// State that the next step continues from.
    #[must_use]
    pub fn history(&self) -> RadauHistory<T> {
        self.memory.clone()
    }

    /// Restores the history of a method for as many components; returns whether it is one. Else no more is changed than that slopes
    /// are found anew.
    ///
    /// Cost: the factorisations that the history is of.
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

    /// Factors both matrices for a step; says whether they are sound.
    fn factor(&mut self, h: T) -> bool {
        let is_sound = self.matrices.factor(&self.coefficients, h, &self.memory.jacobian);
        self.memory.factored = is_sound.then_some(h);
        is_sound
    }

    /// J by differences of the rates at (t, y), column by column; zero where they are no numbers on both sides. Cost: n + 1 evaluations.
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
                // What the sum is larger by, not what was added.
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

    /// Brings slopes and factors up to what a step needs; says whether the slopes are of its very beginning, or nothing where the
    /// matrices are not regular.
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

    /// Was the last correction one? `last` are the rates at the end.
    ///
    /// Cost: 6 n products; where what is left is in doubt, n² more.
    fn judge(&self, h: T, y: &[T], last: &[T]) -> End {
        if !last.iter().all(|rate| rate.is_finite()) {
            return End::NotFinite;
        }
        let (newton, n) = (&self.newton, y.len());
        let after = newton.defect(&self.coefficients, h, last);
        if after <= T::ONE || after <= T::from_f64(MAX_DEFECT_RATIO) * newton.before {
            return End::Converged;
        }
        // What the rounding of the state makes of rates through these slopes.
        let mut sum = T::ZERO;
        for (row, &weight) in self.memory.jacobian.chunks_exact(n.max(1)).zip(&newton.weights) {
            let products = row.iter().zip(y).fold(T::ZERO, |sum, (j, y)| sum + j.abs() * y.abs());
            sum += (products * weight) * (products * weight);
        }
        let noise = h * T::EPSILON * (sum / T::from_f64(n.max(1) as f64)).sqrt();
        if after <= T::from_f64(ROUNDINGS) * noise { End::Converged } else { End::Diverged }
    }

    /// Size of the error of the stages found, in tolerances; `first` are the rates at the beginning, `end` the new state.
    ///
    /// Cost: n² products; where a step after a rejected one would be rejected as well, one evaluation and as many products again.
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
        // What a stiff system damps at once is no error: rates are taken where it has.
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
            // A trial after a rejected one begins where that began.
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
