//! Mass-orthogonal projection of velocities and accelerations, in correction form.
//!
//! ```text
//! min (x - x*)^T M (x - x*)  subject to  J x + b = 0
//!
//! exact:   W d = -[M (x - x*) + J^T (sigma + s r)],   x += d,   sigma += s (J x + b),       W = M + J^T s J,   r = J x + b
//! reused:  T' d = -J'^T s r,                          x += d,   sigma += s (r + J' d),      T' = M + J'^T s J'
//! ```
//!
//! [P1 (11)-(14), (17)-(19)] solve for x itself, which loses cond(W) eps at every step; the correction does not. A sweep leaves
//! 1 / (1 + s sigma^2 / m) of a violation in a direction with singular value sigma; it is repeated until the level is reached. Any factored
//! matrix near W will do: the fixed point does not depend on it.
//!
//! Reused are the rows J' of a factor that was made nearby. With J^T on the right d has a part s (J - J')^T r / m along free directions,
//! which s multiplies and only a second sweep takes back. With J'^T it has none. What is left is r times what the penalties leave and times
//! the turn of the rows, and d is orthogonal to directions that are off by the turn. So the factor has to be from before a small correction.

use crate::equations::Equations;
use crate::penalty::PenaltyScale;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::implicit::{ConstraintLevel, ResidualLimits};
use mbs_core::model::Model;
use mbs_core::step::StepError;
use mbs_core::team::{add_product, norm_inf, on_stretches, set_product, set_sum, subtract, sum};
use mbs_core::{Real, SpdSolver};

/// Violation of velocities, and of accelerations, that a projection within a step may leave [EPSILON of what it is compared with]. It is
/// 2^13, and 2^21 for accelerations, which enter the motion times the square of the step.
const LEFT: [f64; 2] = [8_192.0, 2_097_152.0];
/// Part of a violation up to which a reused sweep is repeated [-]. Slower ones are followed by sweeps with the rows of now, which cost a
/// factorisation's worth of residuals but lose nothing to the turn of the rows.
const SLOW_REUSED: f64 = 0.01;
/// Parts of a violation between which what a sweep leaves is shortened by scaling its correction [-]. Below the first there is nothing to
/// gain; above the second directions differ too much in what is left of them.
const SCALED: [f64; 2] = [0.01, 0.7];
/// Part of a violation above which a sweep is slow, so that penalties are raised for it [-]: ten sweeps would make ten digits.
const SLOW_CONTRACTION: f64 = 0.1;

/// With which matrix and rows velocities and accelerations are projected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ProjectionStrategy {
    /// Constraint rows at the present positions, with a matrix that is factored from them.
    Exact,
    /// The factor that there is, with the rows that it was made with.
    Reused,
}

impl ProjectionStrategy {
    /// The limits of a step's projection: sweeps are repeated down to rounding only where constraints act alone.
    pub(crate) fn limits<T: Real, M: Model<T>>(
        self,
        model: &M,
        level: ConstraintLevel,
        limits: ResidualLimits<T>,
    ) -> ResidualLimits<T> {
        if self == Self::Exact && !model.has_forces() {
            return limits;
        }
        let left = LEFT[usize::from(level == ConstraintLevel::Acceleration)];
        let enough = (limits.size * T::EPSILON * T::from_f64(left)).min(limits.limit);
        ResidualLimits { enough, ..limits }
    }
}

/// Scratch memory of projections.
#[derive(Debug, Clone)]
pub(crate) struct Projection<T> {
    /// x - x*, extended.
    pub(crate) change: Vec<T>,
    /// Multipliers of the projection, m.
    pub(crate) sigma: Vec<T>,
    /// r = J x + b, m.
    pub(crate) rates: Vec<T>,
}

impl<T: Real> Projection<T> {
    pub(crate) fn new(model: &impl Model<T>) -> Self {
        let (e, m) = (model.n_extended(), model.n_constraints());
        let zeros = |n| vec![T::ZERO; n];
        Self { change: zeros(e), sigma: zeros(m), rates: zeros(m) }
    }
}

/// Projection of x on its level, with the equations and penalties of the step.
#[derive(Debug)]
pub(crate) struct Projector<'a, T, M, S> {
    pub(crate) model: &'a M,
    pub(crate) level: ConstraintLevel,
    pub(crate) x: &'a mut [T],
    pub(crate) equations: &'a mut Equations<T, S>,
    pub(crate) scale: &'a mut PenaltyScale<T>,
    pub(crate) scratch: &'a mut Projection<T>,
}

impl<T: Real, M: Model<T>, S: SpdSolver<T>> Projector<'_, T, M, S> {
    /// Projects x by the rows of now; the multipliers are left in `sigma`. Returns the violation left.
    ///
    /// Sweeps at least once unless the level holds already, until the violation is `enough`, or stops shrinking below `limit`.
    ///
    /// Cost: a solve, a residual and a product of the Jacobian for each sweep.
    pub(crate) fn project(
        mut self,
        limits: ResidualLimits<T>,
        max_sweeps: u32,
    ) -> Result<T, StepError> {
        self.begin();
        self.continue_from(0, limits, max_sweeps)
    }

    /// Projects x by the rows of the factor, once unless the violation is at most `goal`. Repeats while sweeps of this kind shrink it until
    /// it is `enough`, else goes by the rows of now. The multipliers of accelerations are left in `sigma`. Returns the violation left.
    ///
    /// Cost: a solve and three products of the Jacobian for each sweep, of which there is mostly one.
    pub(crate) fn project_reused(
        mut self,
        limits: ResidualLimits<T>,
        max_sweeps: u32,
    ) -> Result<T, StepError> {
        let ResidualLimits { goal, enough, .. } = limits;
        self.begin();
        let mut violation = self.violation();
        let (mut sweeps, mut most) = (0, goal);
        // a NaN is no violation that may be left
        while !(violation <= most) {
            most = enough;
            self.sweep_reused();
            sweeps += 1;
            let mut left = self.violation();
            if left > enough && sweeps == 1 {
                left = self.scale_first();
            }
            let is_slow = !(left <= violation * T::from_f64(SLOW_REUSED));
            if is_slow && !(left <= enough) {
                return self.continue_from(sweeps, limits, max_sweeps);
            }
            violation = left;
        }
        Ok(violation)
    }

    /// sigma = 0, x = x*.
    pub(crate) fn begin(&mut self) {
        self.scratch.sigma.fill(T::ZERO);
        self.scratch.change.fill(T::ZERO);
    }

    /// Sweeps by the rows of now, after `done` others.
    fn continue_from(
        &mut self,
        done: u32,
        ResidualLimits { goal, enough, limit, .. }: ResidualLimits<T>,
        max_sweeps: u32,
    ) -> Result<T, StepError> {
        let mut violation = self.violation();
        for sweeps in done..max_sweeps {
            if violation <= if sweeps == 0 { goal } else { enough } {
                return Ok(violation);
            }
            self.sweep(sweeps > 0);
            self.equations.mu.copy_from_slice(&self.scratch.rates);
            let mut left = self.violation();
            let Projection { sigma, rates, .. } = &mut *self.scratch;
            add_product(self.model.team(), sigma, (&self.scale.weights, rates));
            let [least, most] = SCALED.map(|part| violation * T::from_f64(part));
            if left > least && left > enough && left < most {
                left = self.scale_last();
            }
            let contraction = left / violation;
            violation = left;
            if contraction > T::HALF && violation <= limit {
                return Ok(violation);
            }
            let is_slow = contraction > T::from_f64(SLOW_CONTRACTION) && violation > limit;
            if is_slow && self.scale.raise(contraction) {
                self.scale.factor(self.model, self.equations)?;
            }
        }
        if violation <= limit {
            return Ok(violation);
        }
        Err(self.level.violated(violation, &self.scratch.rates))
    }

    /// r = J x + b; returns its largest absolute value.
    #[inline(always)]
    pub(crate) fn violation(&mut self) -> T {
        let (terms, rates) = (&self.equations.terms, &mut self.scratch.rates);
        self.level.violation(self.model, terms, self.x, rates)
    }

    /// One sweep by the rows of now; as long as nothing `is_changed` the mass has no part in it.
    pub(crate) fn sweep(&mut self, is_changed: bool) {
        let Projection { change, sigma, rates } = &*self.scratch;
        set_sum(self.model.team(), &mut self.equations.mu, sigma, (&self.scale.weights, rates));
        self.equations.assemble(self.model, is_changed.then_some(&change[..]), T::ZERO);
        self.equations.solve();
        self.take();
    }

    /// One sweep by the rows of the factor.
    fn sweep_reused(&mut self) {
        let (model, team, s) = (self.model, self.model.team(), &self.scale.weights);
        let Projection { sigma, rates, .. } = &mut *self.scratch;
        set_product(team, &mut self.equations.mu, (s, rates));
        self.equations.with_factored_rows(|eq| eq.assemble(model, None, T::ZERO));
        self.equations.solve();
        if self.level == ConstraintLevel::Acceleration {
            self.equations.with_factored_rows(|eq| eq.multiply_correction(model));
            subtract(team, rates, &self.equations.mu);
            add_product(team, sigma, (s, rates));
        }
        self.take();
    }

    /// x += d and change += d with d = -f.
    fn take(&mut self) {
        let (n, f) = (self.equations.f.len(), &self.equations.f);
        let vectors = [&mut self.x[..n], &mut self.scratch.change[..n]];
        on_stretches(self.model.team(), vectors, |first, [x, change]| {
            let f = &f[first..][..x.len()];
            for i in 0..x.len() {
                x[i] -= f[i];
                change[i] -= f[i];
            }
        });
    }

    /// x += k d, sigma += k s r for the last sweep by the rows of now. With the factor of W, and in balance before it, they are in balance,
    /// M d + J^T s r = 0, and stay so. With a factor from nearby what is off grows by 1 + k in a first sweep, and what a later one found
    /// stays by k. Needs the violation before it in `mu`. Returns the violation left.
    fn scale_last(&mut self) -> T {
        let Projection { sigma, rates, .. } = &mut *self.scratch;
        subtract(self.model.team(), &mut self.equations.mu, rates);
        let k = best_scale(self.model, rates, &self.equations.mu);
        let s = &self.scale.weights;
        on_stretches(self.model.team(), [sigma], |first, [sigma]| {
            for (i, sigma) in sigma.iter_mut().enumerate() {
                *sigma += k * s[first + i] * rates[first + i];
            }
        });
        self.scale_correction(k)
    }

    /// After the first sweep by the rows of the factor x += k d, sigma += k sigma with the best k. d is short by what the penalties leave,
    /// much the same part in all rows. Needs the last `f` = -d, of accelerations with J' f in `mu`. Returns the violation left.
    fn scale_first(&mut self) -> T {
        if self.level == ConstraintLevel::Velocity {
            self.equations.multiply_correction(self.model);
        }
        let k = best_scale(self.model, &self.scratch.rates, &self.equations.mu);
        let by = T::ONE + k;
        on_stretches(self.model.team(), [&mut self.scratch.sigma], |_, [sigma]| {
            sigma.iter_mut().for_each(|sigma| *sigma *= by);
        });
        self.scale_correction(k)
    }

    /// x += k d, r += k J d for the last sweep. Needs `f` = -d, which is lost, and J f in `mu`. Returns the violation left.
    fn scale_correction(&mut self, k: T) -> T {
        let (team, mu) = (self.model.team(), &self.equations.mu);
        on_stretches(team, [&mut self.scratch.rates], |first, [rates]| {
            for (i, rates) in rates.iter_mut().enumerate() {
                *rates -= k * mu[first + i];
            }
        });
        on_stretches(team, [&mut self.equations.f], |_, [f]| f.iter_mut().for_each(|f| *f *= k));
        self.take();
        norm_inf(self.model.team(), &self.scratch.rates)
    }
}

/// The k with which a further k d leaves least of a violation r; zero where d does nothing.
///
/// ```text
/// k = -(r . J d) / (J d . J d),      mu = -J d
/// ```
fn best_scale<T: Real, M: Model<T>>(model: &M, rates: &[T], mu: &[T]) -> T {
    let dot = |x: &[T]| {
        sum(model.team(), mu.len(), |from, to| {
            let pairs = x[from..to].iter().zip(&mu[from..to]);
            pairs.fold(T::ZERO, |sum, (&x, &y)| sum + x * y)
        })
    };
    let k = dot(rates) / dot(mu);
    if k.is_finite() { k } else { T::ZERO }
}
