//! Mass-orthogonal projection of velocities and accelerations, in correction form.
//!
//! ```text
//! min (x - x*)^T M (x - x*)  subject to  J x + b = 0
//!
//! W d = -[M (x - x*) + J^T (sigma + s (J x + b))],   x += d,   sigma += s (J x + b),     W = M + J^T s J
//! ```
//!
//! [P1 (11)-(14), (17)-(19)] solve for x itself, which loses cond(W) eps at every step; the correction does not.
//! One sweep leaves 1 / (1 + s sigma^2 / m) of a violation in a direction with singular value sigma; it is swept until
//! the level is reached. Any factored matrix near W will do: the fixed point does not depend on it.

use crate::workspace::{Mass, Workspace};
use alloc::vec::Vec;
use mbs_core::model::Model;
use mbs_core::step::{StepError, largest};
use mbs_core::team::{add, add_product, norm_inf, on_stretches, set_sum, subtract, sum};
use mbs_core::{FactorError, Real, SpdSolver};

/// What one correction may leave of the multiplier of the least felt combination of constraints.
const FELT: f64 = 0.003;
/// Where less than this was left of the combination that is followed, others are added to it, so that none is overlooked.
const FOLLOWED: f64 = 0.001;
/// Most that penalties may be, in effective masses times EPSILON: above, rounding of T^-1 looks like a lost direction.
const MOST: f64 = 0.2;
/// By how much penalties that are too large are lowered at a time.
const LOWERED: f64 = 1.0 / 16.0;

/// A sweep that leaves more than the first of these shares of a violation, and less than the second, has met combinations of constraints
/// that are felt little, of which it takes in the same share each: it is lengthened.
const SHORT: [f64; 2] = [0.01, 0.7];

/// How much of a violation may be left by a projection.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ResidualLimits<T> {
    /// A violation that is not swept at all.
    pub(crate) goal: T,
    /// What sweeps may leave.
    pub(crate) enough: T,
    /// What they may leave where they no longer shrink it.
    pub(crate) limit: T,
}

/// Which vector is projected, with its right-hand side b.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Level {
    /// J v + phi_t = 0.
    Velocity,
    /// J a + bias = 0.
    Acceleration,
}

impl<T: Real, S: SpdSolver<T>> Workspace<T, S> {
    /// rates = J x + b of the level; returns their largest absolute value.
    pub(crate) fn violation<M: Model<T>>(&mut self, model: &M, level: Level) -> T {
        let (x, b) = match level {
            Level::Velocity => (&self.v, &self.terms.phi_t),
            Level::Acceleration => (&self.a, &self.terms.phi_bias),
        };
        model.multiply_jacobian(&self.terms, x, &mut self.rates);
        if level == Level::Acceleration || model.has_guides() {
            on_stretches(model.team(), [&mut self.rates], |first, [rates]| {
                for (r, &b) in rates.iter_mut().zip(&b[first..]) {
                    *r += b;
                }
            });
        }
        norm_inf(model.team(), &self.rates)
    }

    /// Projects v or a with the factored matrix; the multipliers are left in `sigma`. Returns the violation left.
    ///
    /// Sweeps at least once unless the level holds already, until the violation is `enough`, or stops shrinking below `limit`.
    pub(crate) fn project<M: Model<T>>(
        &mut self,
        model: &M,
        level: Level,
        left: ResidualLimits<T>,
        max_sweeps: u32,
    ) -> Result<T, StepError> {
        self.begin();
        self.project_on(model, level, left, (0, max_sweeps))
    }

    /// sigma = 0, x = x*.
    pub(crate) fn begin(&mut self) {
        self.sigma.fill(T::ZERO);
        self.change.fill(T::ZERO);
    }

    /// Goes on with a projection after so many sweeps.
    pub(crate) fn project_on<M: Model<T>>(
        &mut self,
        model: &M,
        level: Level,
        ResidualLimits { goal, enough, limit }: ResidualLimits<T>,
        (done, max_sweeps): (u32, u32),
    ) -> Result<T, StepError> {
        let mut violation = self.violation(model, level);
        for sweeps in done..max_sweeps {
            if violation <= if sweeps == 0 { goal } else { enough } {
                return Ok(violation);
            }
            self.sweep(model, level, sweeps > 0);
            self.mu.copy_from_slice(&self.rates);
            let mut left = self.violation(model, level);
            add_product(model.team(), &mut self.sigma, (&self.penalty, &self.rates));
            let is_short = left > violation * T::from_f64(SHORT[0]);
            if is_short && left > enough && left < violation * T::from_f64(SHORT[1]) {
                left = self.lengthen_last(model, level);
            }
            let contraction = left / violation;
            violation = left;
            if contraction > T::HALF && violation <= limit {
                return Ok(violation);
            }
            let is_slow = contraction > T::from_f64(0.1) && violation > limit;
            if is_slow && self.raise_penalties(contraction) {
                self.factor_raised(model)?;
            }
        }
        if violation <= limit {
            return Ok(violation);
        }
        let level = if level == Level::Velocity { 1 } else { 2 };
        let row = largest(&self.rates);
        Err(StepError::Violated { level, violation: violation.to_f64(), row })
    }

    /// As printed, with W = M + J^T alpha J factored [P1 (13), (19)]:
    ///
    /// ```text
    /// W x <- M x - J^T alpha b,   a fixed number of times
    /// ```
    ///
    /// Solves for x itself and so loses cond(W) eps each time. Returns the violation left, whatever it is.
    pub(crate) fn project_as_printed<M: Model<T>>(
        &mut self,
        model: &M,
        level: Level,
        sweeps: u32,
    ) -> T {
        self.sigma.fill(T::ZERO);
        let mut violation = self.violation(model, level);
        for _ in 0..sweeps {
            let (b, mass) = match level {
                Level::Velocity => (&self.terms.phi_t, Mass::Velocity),
                Level::Acceleration => (&self.terms.phi_bias, Mass::Acceleration),
            };
            for k in 0..self.mu.len() {
                self.mu[k] = -self.penalty[k] * b[k];
            }
            self.assemble(model, mass, T::ZERO);
            self.solve();
            let x = match level {
                Level::Velocity => &mut self.v,
                Level::Acceleration => &mut self.a,
            };
            x[..self.f.len()].copy_from_slice(&self.f);
            violation = self.violation(model, level);
            for k in 0..self.sigma.len() {
                self.sigma[k] += self.penalty[k] * self.rates[k];
            }
        }
        violation
    }

    /// One sweep with the tangent as the iteration left it [P3 (11), (12)]:
    ///
    /// ```text
    /// T x = (T - J^T s J) x* - J^T s b,   that is   T (x - x*) = -J^T s (J x* + b)
    /// ```
    ///
    /// Returns the violation left, whatever it is.
    pub(crate) fn project_with_tangent<M: Model<T>>(&mut self, model: &M, level: Level) -> T {
        self.sigma.fill(T::ZERO);
        self.change.fill(T::ZERO);
        self.violation(model, level);
        self.sweep(model, level, false);
        let violation = self.violation(model, level);
        for k in 0..self.sigma.len() {
            self.sigma[k] = self.penalty[k] * self.rates[k];
        }
        violation
    }

    /// Chooses the penalties of a step: follows the least felt combination u of constraints by one power iteration, from the last
    /// step's, or where that was felt well from it and a part of all,
    ///
    /// ```text
    /// u <- (1 + s H)^-1 u = u - s J T^-1 J^T u,   H = J M^-1 J^T,   rho = |u_new| / |u|
    /// ```
    ///
    /// and raises s until rho is at most [`FELT`]. A combination that no allowed penalty makes felt is redundant and left.
    /// Returns whether the penalties changed, so that T must be factored anew. Needs T factored. Cost: one solve.
    pub(crate) fn adapt<M: Model<T>>(&mut self, model: &M) -> bool {
        let size = norm_inf(model.team(), &self.probe);
        if size > T::ZERO {
            let inverse = T::ONE / size;
            self.probe.iter_mut().for_each(|u| *u *= inverse);
        }
        if !(self.rho > T::from_f64(FOLLOWED)) {
            add(model.team(), &mut self.probe, &self.spread);
        }
        let size = norm_inf(model.team(), &self.probe);
        self.mu.copy_from_slice(&self.probe);
        self.assemble(model, Mass::None, T::ZERO);
        self.solve();
        self.multiply_correction(model);
        let (penalty, mu) = (&self.penalty, &self.mu);
        on_stretches(model.team(), [&mut self.probe], |first, [probe]| {
            for k in 0..probe.len() {
                probe[k] -= penalty[first + k] * mu[first + k];
            }
        });
        let rho = norm_inf(model.team(), &self.probe) / size;
        self.rho = rho;
        if !rho.is_finite() {
            self.rho = T::ZERO;
            self.probe.fill(T::ZERO);
        }
        if !(rho > T::from_f64(FELT)) {
            return false;
        }
        let room = self.room();
        // What even the largest penalty cannot make felt is redundant, or so near a singular position that nothing is lost.
        rho / (T::ONE - rho).max(T::EPSILON) < room * T::from_f64(FELT) && self.stiffen(rho, room)
    }

    /// Do the constraints feed every combination of multipliers, so that there is nothing to filter?
    pub(crate) fn is_all_felt(&self) -> bool {
        self.boost <= T::ONE && self.rho <= T::from_f64(FOLLOWED)
    }

    /// What a step begins with: raised penalties fall by a factor of four where the last step felt all combinations well.
    pub(crate) fn kept_boost(&self) -> T {
        let is_felt = self.rho < T::from_f64(0.1 * FELT);
        if is_felt { (self.boost * T::from_f64(0.25)).max(T::ONE) } else { self.boost }
    }

    /// Raises the penalties so that corrections that leave `rho` leave [`FELT`], by rho / (1 - rho) / FELT, at most `room`.
    /// Returns whether they changed.
    fn stiffen(&mut self, rho: T, room: T) -> bool {
        let growth = rho / (T::ONE - rho).max(T::EPSILON) / T::from_f64(FELT);
        let growth = growth.min(room);
        if growth > T::ONE {
            self.scale_penalties(growth);
        }
        growth > T::ONE
    }

    /// Raises the penalties after a slow sweep; returns whether they changed.
    pub(crate) fn raise_penalties(&mut self, contraction: T) -> bool {
        self.stiffen(contraction.min(T::ONE), self.room())
    }

    /// Factors W, whose penalties may have been raised. Where they are too large for the digits there are, that the mass is lost beside them,
    /// they are lowered until W is positive definite.
    pub(crate) fn factor_raised<M: Model<T>>(&mut self, model: &M) -> Result<(), FactorError> {
        loop {
            match self.factor(model, (T::ZERO, T::ZERO), false) {
                Err(_) if self.boost > T::ONE => {
                    self.scale_penalties((T::ONE / self.boost).max(T::from_f64(LOWERED)));
                }
                result => return result,
            }
        }
    }

    /// Takes raised penalties back; returns whether there were any.
    pub(crate) fn restore_penalties(&mut self) -> bool {
        let was_raised = self.boost > T::ONE;
        if was_raised {
            self.scale_penalties(T::ONE / self.boost);
        }
        was_raised
    }

    /// By how much penalties may still be raised.
    fn room(&self) -> T {
        T::from_f64(MOST) / T::EPSILON / (self.boost * self.base)
    }

    /// Multiplies all penalties.
    pub(crate) fn scale_penalties(&mut self, factor: T) {
        for p in &mut self.penalty {
            *p *= factor;
        }
        self.boost *= factor;
    }

    /// x += k d, sigma += k s (J x + b), and the violation with them, for the last sweep: with the factor of W, and in balance before it, they
    /// are in balance, M d + J^T s (J x + b) = 0, and stay so. With a nearby factor what is off grows by 1 + k in a first sweep, and what a
    /// later one found stays by k. Needs the violation before it in `mu`. Returns the violation left.
    fn lengthen_last<M: Model<T>>(&mut self, model: &M, level: Level) -> T {
        subtract(model.team(), &mut self.mu, &self.rates);
        let k = self.best_length(model);
        let (penalty, rates) = (&self.penalty, &self.rates);
        on_stretches(model.team(), [&mut self.sigma], |first, [sigma]| {
            for (i, sigma) in sigma.iter_mut().enumerate() {
                *sigma += k * penalty[first + i] * rates[first + i];
            }
        });
        self.lengthen(model, level, k)
    }

    /// The k with which a further k d leaves least of a violation; zero where d does nothing. Needs J f = -J d in `mu`.
    ///
    /// ```text
    /// k = -(r . J d) / (J d . J d)
    /// ```
    pub(crate) fn best_length<M: Model<T>>(&self, model: &M) -> T {
        let (mu, rates) = (&self.mu, &self.rates);
        let dot = |x: &[T]| {
            sum(model.team(), mu.len(), |from, to| {
                let pairs = x[from..to].iter().zip(&mu[from..to]);
                pairs.fold(T::ZERO, |sum, (&x, &y)| sum + x * y)
            })
        };
        let k = dot(rates) / dot(mu);
        if k.is_finite() { k } else { T::ZERO }
    }

    /// x += k d, r += k J d for the last sweep. Needs `f` = -d, which is lost, and J f in `mu`. Returns the violation left.
    pub(crate) fn lengthen<M: Model<T>>(&mut self, model: &M, level: Level, k: T) -> T {
        let mu = &self.mu;
        on_stretches(model.team(), [&mut self.rates], |first, [rates]| {
            for (i, rates) in rates.iter_mut().enumerate() {
                *rates -= k * mu[first + i];
            }
        });
        on_stretches(model.team(), [&mut self.f], |_, [f]| f.iter_mut().for_each(|f| *f *= k));
        self.take(model, level);
        norm_inf(model.team(), &self.rates)
    }

    /// One sweep; as long as nothing `is_changed` the mass has no part in it.
    fn sweep<M: Model<T>>(&mut self, model: &M, level: Level, is_changed: bool) {
        set_sum(model.team(), &mut self.mu, &self.sigma, (&self.penalty, &self.rates));
        self.assemble(model, if is_changed { Mass::Change } else { Mass::None }, T::ZERO);
        self.solve();
        self.take(model, level);
    }

    /// x += d and change += d with d = -f.
    pub(crate) fn take<M: Model<T>>(&mut self, model: &M, level: Level) {
        let x = match level {
            Level::Velocity => &mut self.v,
            Level::Acceleration => &mut self.a,
        };
        let (n, f) = (self.f.len(), &self.f);
        let vectors = [&mut x[..n], &mut self.change[..n]];
        on_stretches(model.team(), vectors, |first, [x, change]| {
            let f = &f[first..][..x.len()];
            for i in 0..x.len() {
                x[i] -= f[i];
                change[i] -= f[i];
            }
        });
    }
}

/// A part of all, up to a half, always the same: with it no combination of constraints is out of sight by symmetry.
pub(crate) fn spread<T: Real>(m: usize) -> Vec<T> {
    let mut seed = 1_u32;
    let next = |_| {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        T::from_f64(f64::from(seed) / f64::from(u32::MAX) - 0.5)
    };
    (0..m).map(next).collect()
}
