//! Mass-orthogonal projection of velocities and accelerations, in correction form.
//!
//! ```text
//! min (x - x*)^T M (x - x*)  subject to  J x + b = 0
//!
//! exact:   W d = -[M (x - x*) + J^T (sigma + s r)],   x += d,   sigma += s (J x + b),       W = M + J^T s J,   r = J x + b
//! reused:  T' d = -J'^T s r,                          x += d,   sigma += s (r + J' d),      T' = M + J'^T s J'
//! ```
//!
//! The published projections [P1 (11)-(14), (17)-(19)] solve for x itself and lose cond(W) EPSILON of x in each step. The correction form
//! solves for x - x*. It loses no such digits, because the correction is small.
//!
//! A sweep is one solution with one correction. In a direction in which J has the singular value c, it reduces a violation to the
//! fraction 1 / (1 + s c^2 / m). Sweeps are repeated until the violation is below the limit of the level. A factored matrix close to W
//! serves as well, because the fixed point of the sweeps does not depend on the matrix.
//!
//! A reused sweep uses the rows J' of the factor, which was made before the last small correction. With J^T on the right-hand side, d would
//! have the part s (J - J')^T r / m along free directions. The penalty s amplifies that part, and only a second sweep would remove it. With
//! J'^T on the right-hand side d has no such part. The sweep then leaves two parts of the violation r. The first is the fraction that the
//! penalties leave. The second is a fraction as large as the rotation of the rows since the factorisation. The same rotation is the error
//! of the directions to which d is mass-orthogonal. Therefore only a small correction may separate the factor from the present positions.

use crate::equations::Equations;
use crate::penalty::PenaltyScale;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::implicit::{ConstraintLevel, ResidualLimits};
use mbs_core::model::Model;
use mbs_core::step::StepError;
use mbs_core::team::{add_product, norm_inf, on_stretches, set_product, set_sum, subtract, sum};
use mbs_core::{Real, SpdSolver};

/// Violation of velocities, and of accelerations, that a projection within a step may leave [EPSILON of the size of the vector]. The values
/// are 2^13 for velocities and 2^21 for accelerations. Accelerations may be less exact, because they are multiplied by the square of the
/// step in the motion.
const LEFT: [f64; 2] = [8_192.0, 2_097_152.0];
/// Largest contraction with which a reused sweep is repeated [-]. After a slower sweep, sweeps with the present rows follow. Their
/// residuals cost as much as a factorisation, but their contraction does not depend on the rotation of the rows.
const SLOW_REUSED: f64 = 0.01;
/// Smallest and largest contraction of a sweep whose correction is scaled to reduce the violation further [-]. Below the first value
/// scaling has no benefit. Above the second one, the contraction differs too much between directions for one common scale.
const SCALED: [f64; 2] = [0.01, 0.7];
/// Contraction above which a sweep is slow and penalties are raised [-]. At this contraction ten sweeps reduce a violation by ten digits.
const SLOW_CONTRACTION: f64 = 0.1;

/// Matrix and constraint rows with which velocities and accelerations are projected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ProjectionStrategy {
    /// Constraint rows at the present positions, with a matrix that is factored from these rows.
    Exact,
    /// The last factor of the step, with the rows from which it was made.
    Reused,
}

impl ProjectionStrategy {
    /// Returns the limits of a step's projection. Only where no effect acts, sweeps are repeated down to machine precision.
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
    /// Sum of the corrections, x - x*; an extended vector, which includes known coordinates.
    pub(crate) change: Vec<T>,
    /// Multipliers sigma of the projection, one for each row.
    pub(crate) sigma: Vec<T>,
    /// Violation r = J x + b, one number for each row.
    pub(crate) rates: Vec<T>,
}

impl<T: Real> Projection<T> {
    pub(crate) fn new(model: &impl Model<T>) -> Self {
        let (e, m) = (model.n_extended(), model.n_constraints());
        let zeros = |n| vec![T::ZERO; n];
        Self { change: zeros(e), sigma: zeros(m), rates: zeros(m) }
    }
}

/// Projection of x onto its constraint level, with the equations and penalties of the step.
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
    /// Projects x with the present rows and leaves the multipliers in `sigma`. Returns the remaining violation.
    ///
    /// At least one sweep is made, unless the violation is at most `goal` from the start. Sweeps end when the violation is at most `enough`,
    /// or when it is below `limit` and stops shrinking.
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

    /// Projects x with the rows of the factor. No sweep is made if the violation is at most `goal` at the start.
    ///
    /// Sweeps are repeated until the violation is at most `enough`. After a slow sweep, sweeps with the present rows follow. The multipliers
    /// of accelerations are left in `sigma`. Returns the remaining violation.
    ///
    /// Cost: a solve and three products of the Jacobian for each sweep. Usually one sweep is enough.
    pub(crate) fn project_reused(
        mut self,
        limits: ResidualLimits<T>,
        max_sweeps: u32,
    ) -> Result<T, StepError> {
        let ResidualLimits { goal, enough, .. } = limits;
        self.begin();
        let mut violation = self.violation();
        let (mut sweeps, mut most) = (0, goal);
        // written with `!`, so that a violation of NaN is not accepted
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

    /// Begins a projection: sigma = 0, x = x*.
    pub(crate) fn begin(&mut self) {
        self.scratch.sigma.fill(T::ZERO);
        self.scratch.change.fill(T::ZERO);
    }

    /// Makes sweeps with the present rows, after `done` sweeps of the other kind.
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

    /// Evaluates r = J x + b. Returns its largest absolute value.
    #[inline(always)]
    pub(crate) fn violation(&mut self) -> T {
        let (terms, rates) = (&self.equations.terms, &mut self.scratch.rates);
        self.level.violation(self.model, terms, self.x, rates)
    }

    /// Makes one sweep with the present rows. The right-hand side contains the mass only if x already differs from x* (`is_changed`).
    pub(crate) fn sweep(&mut self, is_changed: bool) {
        let Projection { change, sigma, rates } = &*self.scratch;
        set_sum(self.model.team(), &mut self.equations.mu, sigma, (&self.scale.weights, rates));
        self.equations.assemble(self.model, is_changed.then_some(&change[..]), T::ZERO);
        self.equations.solve();
        self.take();
    }

    /// Makes one sweep with the rows of the factor.
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

    /// Applies the last correction d = -f: x += d and change += d.
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

    /// Scales the last sweep with the present rows by 1 + k: x += k d, sigma += k s r. Returns the remaining violation.
    ///
    /// With the factor of W, d and the multipliers are in balance, M d + J^T s r = 0, for every k. With another factor there is a small
    /// imbalance. A first sweep scales it by 1 + k, and later sweeps leave a fraction k of it. Needs the violation before the sweep in
    /// `mu`.
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

    /// Scales the first sweep with the rows of the factor by 1 + k with the best k: x += k d, sigma += k sigma. Returns the remaining
    /// violation.
    ///
    /// The scaling helps because d is too short by nearly the same fraction in all rows. Needs the last `f` = -d, and for accelerations J'
    /// f in `mu`.
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

    /// Applies a scaled correction: x += k d, r += k J d. Needs `f` = -d, which it overwrites, and J f in `mu`. Returns the remaining
    /// violation.
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

/// Returns the factor k of a further correction k d that leaves the smallest violation |r + k J d|. Returns zero where J d = 0.
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
