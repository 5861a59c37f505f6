//! Static equilibrium by pseudo-transient continuation: steps of the flow M q' = Q - J^T lambda on the constraints, which grow
//! into Newton's method.
//!
//! ```text
//! [ M + s (K + K_geo(lambda))  J^T ] ( d          )     ( s (Q - J^T lambda) )
//! [ J                           0  ] ( s d_lambda )  =  ( -phi               ),     q += d, closed again; lambda += d_lambda
//! ```
//!
//! The matrix is that of a step of implicit Euler with h^2 = s from rest: dynamic relaxation with the velocity reset to zero
//! after every step. For s -> infinity it is that of Newton's method (C. T. Kelley, D. E. Keyes, SIAM J. Numer. Anal. 35, 1998).
//! s grows tenfold with every accepted step and shrinks after a refused one. A step is refused when
//!
//! - the matrix is not positive where J d = 0 (inertia not (n, m, 0), N. Gould 1985): towards no minimum of energy;
//! - it turns the mechanism so far that the constraints are broken by a quarter of it;
//! - the forces at its end work against it by more than half of what they did for it at its start: it went too far;
//! - they do so where two points that a law may push apart pass each other on the way: it would go through a stop.
//!
//! Work along the step takes the place of the residual's norm in the line search. On the path down from a steep or unstable place
//! forces must be allowed to grow. So the search leaves unstable places unless it starts exactly on one.
//!
//! Neutral directions, in which no force acts and K is singular, have the step s (force) / M: rounding alone. s is bounded so
//! that this moves them by at most sqrt(eps)/10 of the scene's length in each step, and they stay where they started.
//!
//! Forces are small beside the largest met on a coordinate, and beside what its stiffness makes of a displacement of the scene's
//! size. Where a spring alone holds a slide both forces vanish together.

use crate::error::EquilibriumError;
use crate::options::Options;
use crate::workspace::Workspace;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::algebra::norm_inf;
use mbs_core::model::{Model, State};
use mbs_core::step::{largest, largest_or_nan};
use mbs_core::{Real, SymmetricSolver};

/// Result of a search for an equilibrium.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Equilibrium<T> {
    /// Number of steps taken.
    pub iterations: u32,
    /// Factorisations, of refused steps and of the test of stability too.
    pub factorizations: u32,
    /// Largest force left on a coordinate [N, N m for directions].
    pub residual: T,
    /// Largest force left, by its work along the scene's length [-]. It is relative to the largest sum of absolute forces that a
    /// coordinate met, or to what its stiffness makes of a displacement of that size; 0 without forces.
    pub relative: T,
    /// Largest constraint violation [m or rad].
    pub violation: T,
    /// Largest change of a coordinate [m or -].
    pub change: T,
    /// Directions in which forces lead away from it: |omega| above [`rate`](Self::rate), omega^2 negative. An estimate by the
    /// tangent that the effects give, which may leave parts out; the eigenvalues of a linearisation are the last word.
    pub unstable: usize,
    /// Directions with |omega| below [`rate`](Self::rate), in which it may stand anywhere, by the same estimate.
    pub neutral: usize,
    /// Rate below which a direction counts as neutral [rad/s].
    pub rate: T,
}

impl<T> Equilibrium<T> {
    /// Does no force lead away from it, by the estimate?
    pub fn is_stable(&self) -> bool {
        self.unstable == 0
    }
}

/// Factor on s after a refused step [-]. Chosen, not tuned.
const SHRINK: f64 = 0.125;
/// Factor on s after an accepted step [-]. Chosen, not tuned.
const GROW: f64 = 10.0;
/// Ratio of s to its first value at which the search ends [-]: 22 refusals in a row. Chosen, not tuned.
const SMALLEST: f64 = 1e-20;
/// Balanced steps without progress after which the search ends [-]. Chosen, not tuned.
const MAX_IDLE_STEPS: u32 = 40;
/// Most sweeps that close the constraints after a step [-]. Chosen, not tuned.
const SWEEPS: u32 = 20;
/// Longest step that is rounding, in units of rounding of the scene's size [-]. Chosen, not tuned.
const NOWHERE: f64 = 8.0;
/// Largest force that is rounding, in units of rounding of its terms [-]. Chosen, not tuned.
const FORCE_ROUNDINGS: f64 = 4.0;
/// Largest constraint violation of a step, relative to its size [-]: a larger one is refused. Chosen, not tuned.
const BROKEN: f64 = 0.25;
/// Openness of the constraints at which a search may begin [-]. Chosen, not tuned.
const CLOSED: f64 = 1e-6;
/// Violation that is rounding of a row, in units of rounding [-]. Chosen, not tuned.
const FLOOR_ROUNDINGS: f64 = 8.0;
/// Violation at which stalled sweeps may end, relative to rounding of a row [-]. Chosen, not tuned.
const STALLED: f64 = 64.0;
/// Inverse of the largest move of neutral directions in a step, in roots of rounding of the scene's length [-]. Chosen, not tuned.
const NEUTRAL: f64 = 10.0;
/// Largest distance at which an equilibrium is searched, relative to the scene's length [-]. Chosen, not tuned.
const MAX_EXTENT: f64 = 1e6;

/// Moves `s` to a static equilibrium near it.
///
/// Guides keep their values of time `s.t`. Forces that depend on velocity are taken at the velocity in `s`: zero it for an
/// equilibrium at rest. Positions, multipliers (also as `reaction`) and measured angles are written, accelerations become
/// zero, velocities stay as they are and are not made consistent with the new positions.
///
/// Cost: ten to forty factorisations near an equilibrium, more on a long way down; allocates a few vectors.
///
/// # Errors
/// [`EquilibriumError`]; the state is then unchanged.
pub fn equilibrium<T: Real, M: Model<T>, S: SymmetricSolver<T>>(
    model: &M,
    options: &Options<T>,
    s: &mut State<T>,
    w: &mut Workspace<T, S>,
) -> Result<Equilibrium<T>, EquilibriumError> {
    options.validate()?;
    let mut search = Search::new(model, s, w);
    search.begin()?;
    search.descend(options)?;
    let from = s.q.clone();
    Ok(search.finish(&from, s))
}

pub(crate) struct Search<'a, T, M, S> {
    pub(crate) model: &'a M,
    pub(crate) w: &'a mut Workspace<T, S>,
    v: Vec<T>,
    /// Positions, multipliers, measured angles and J^T lambda - Q, as accepted.
    pub(crate) q: Vec<T>,
    lambda: Vec<T>,
    residual: Vec<T>,
    phi: Vec<T>,
    /// Positions, multipliers and residual of a step on trial.
    pub(crate) next: Vec<T>,
    next_lambda: Vec<T>,
    next_residual: Vec<T>,
    /// Positions at the start.
    from: Vec<T>,
    /// Largest sum of absolute forces on a coordinate, as work along its size [J]: now, and met so far.
    scale: T,
    met: T,
    /// Largest acceleration that a force would have given alone so far, in sizes [1/s^2].
    lively: T,
    /// Largest work that the matrix of the last step makes of a displacement of a coordinate's size [J].
    stiff: T,
    /// Pseudo-time step squared and its bound [s^2].
    s: T,
    bound: T,
    iterations: u32,
    factorizations: u32,
}

impl<'a, T: Real, M: Model<T>, S: SymmetricSolver<T>> Search<'a, T, M, S> {
    pub(crate) fn new(model: &'a M, s: &State<T>, w: &'a mut Workspace<T, S>) -> Self {
        let zeros = |k| vec![T::ZERO; k];
        model.set_inputs(s.t, s, &mut w.terms);
        let (n, m) = (w.n, w.m);
        Self {
            model,
            w,
            v: s.v.clone(),
            q: s.q.clone(),
            lambda: zeros(m),
            residual: zeros(n),
            phi: zeros(m),
            next: s.q.clone(),
            next_lambda: zeros(m),
            next_residual: zeros(n),
            from: s.q.clone(),
            scale: T::ZERO,
            met: T::ZERO,
            lively: T::ZERO,
            stiff: T::ZERO,
            s: T::ONE,
            bound: T::ONE,
            iterations: 0,
            factorizations: 0,
        }
    }

    /// Closes the constraints and finds the multipliers and accelerations at rest, and from them the first s.
    pub(crate) fn begin(&mut self) -> Result<(), EquilibriumError> {
        self.model.evaluate(&self.next, &mut self.w.terms);
        let has_mass = self.factor(T::ZERO);
        if has_mass {
            self.close();
        }
        if !(self.w.openness(&self.w.terms.phi) <= T::from_f64(CLOSED)) {
            let violation = norm_inf(&self.w.terms.phi);
            let row = largest_or_nan(&self.w.terms.phi);
            return Err(EquilibriumError::NotClosed { violation: violation.to_f64(), row });
        }
        self.evaluate();
        let mut acceleration = T::ZERO;
        // The second sweep removes what the regularisation of the rows left.
        for _ in 0..if has_mass { 2 } else { 0 } {
            self.load(T::ONE, &self.next_residual.clone());
            self.w.solve();
            let n = self.w.n;
            acceleration = self.w.extent(&self.w.f[..n]);
            for (l, &e) in self.next_lambda.iter_mut().zip(&self.w.f[n..]) {
                *l += e;
            }
            self.measure();
        }
        self.accept();
        self.s = if acceleration > T::ZERO { T::ONE / acceleration } else { self.bound };
        self.s = self.s.min(self.bound);
        self.check_finite()
    }

    /// Steps until the forces are balanced.
    fn descend(&mut self, options: &Options<T>) -> Result<(), EquilibriumError> {
        let (mut idle, mut was_refused) = (0, false);
        let smallest = self.s * T::from_f64(SMALLEST);
        while self.factorizations < options.max_factorizations {
            if self.scale == T::ZERO {
                return Ok(());
            }
            let before = self.w.work(&self.residual);
            let is_balanced = before <= options.tolerance * (self.scale + self.stiff);
            let Some(size) = self.step(is_balanced) else {
                self.s *= T::from_f64(SHRINK);
                was_refused = true;
                if !(self.s > smallest) {
                    break;
                }
                continue;
            };
            self.check_finite()?;
            self.check_far()?;
            let left = self.w.work(&self.residual);
            let is_progress = left < before * T::HALF;
            if left <= options.tolerance * (self.scale + self.stiff) {
                // A small s is a sign of an unstable place: what seems at rest there only begins to move.
                let is_newton = self.s >= self.bound * T::from_f64(SHRINK);
                let is_at_rest = size <= T::EPSILON.sqrt() && is_newton;
                let is_rounding = left <= self.scale * T::EPSILON * T::from_f64(FORCE_ROUNDINGS)
                    || (is_newton && size <= T::EPSILON * T::from_f64(NOWHERE));
                idle = if is_progress { 0 } else { idle + 1 };
                if is_rounding || (is_at_rest && !is_progress) || idle > MAX_IDLE_STEPS {
                    return Ok(());
                }
            } else {
                idle = 0;
            }
            if !was_refused {
                self.s = (self.s * T::from_f64(GROW)).min(self.bound);
            }
            was_refused = false;
        }
        Err(self.not_converged())
    }

    /// One step with the present s; its size, or nothing when it is refused.
    fn step(&mut self, is_balanced: bool) -> Option<T> {
        let n = self.w.n;
        self.model.evaluate(&self.q, &mut self.w.terms);
        self.model.evaluate_forces(&self.q, &self.v, &mut self.w.terms);
        if !self.factor(self.s) {
            return None;
        }
        self.load(self.s, &self.residual.clone());
        self.w.solve();
        self.stiff = norm_inf(self.w.diagonal()) / self.s;
        let size = self.w.extent(&self.w.f[..n]);
        for i in 0..n {
            self.next[i] = self.q[i] + self.w.f[i];
        }
        for k in 0..self.lambda.len() {
            self.next_lambda[k] = self.lambda[k] + self.w.f[n + k] / self.s;
        }
        if !is_balanced && (self.goes_through() || self.is_too_long_to_roll(size)) {
            return None;
        }
        self.model.evaluate(&self.next, &mut self.w.terms);
        let [broken, before] = [&self.w.terms.phi, &self.phi].map(|phi| self.w.openness(phi));
        if !(broken <= size * T::from_f64(BROKEN) + before + self.floor())
            || !self.close()
            || !self.roll()
        {
            return None;
        }
        self.evaluate();
        let (mut given, mut left) = (T::ZERO, T::ZERO);
        for i in 0..n {
            let d = self.next[i] - self.q[i];
            given -= self.residual[i] * d;
            left -= self.next_residual[i] * d;
        }
        if !is_balanced && !(left >= -given.abs() * T::HALF) {
            return None;
        }
        self.iterations += 1;
        self.accept();
        Some(size)
    }

    /// Do forces work against the straight way to `next` where points that a law may push apart pass each other?
    fn goes_through(&mut self) -> bool {
        let mut closest = Vec::new();
        self.model.approaches(&self.q, &self.next, |ratio| closest.push(ratio));
        if closest.is_empty() {
            return false;
        }
        let way: Vec<T> = self.next.iter().zip(&self.q).map(|(&to, &q)| to - q).collect();
        let work = |force: &[T]| force.iter().zip(&way).fold(T::ZERO, |sum, (&f, &d)| sum - f * d);
        let given = work(&self.residual).abs();
        let (mut there, mut force) = (self.q.clone(), self.residual.clone());
        let free = vec![T::ZERO; self.lambda.len()];
        closest.into_iter().any(|ratio| {
            for (there, (&q, &d)) in there.iter_mut().zip(self.q.iter().zip(&way)) {
                *there = q + ratio * d;
            }
            self.model.evaluate(&there, &mut self.w.terms);
            self.model.evaluate_forces(&there, &self.v, &mut self.w.terms);
            self.w.residual(self.model, None, &free, &mut force);
            !(work(&force) >= -given * T::HALF)
        })
    }

    /// Factors at the present terms; is the matrix positive where J d = 0?
    fn factor(&mut self, s: T) -> bool {
        self.factorizations += 1;
        let is_regular = self.w.factor(self.model, s, (&self.q, &self.lambda)).is_ok();
        is_regular && self.w.solver.inertia().negative == self.w.m
    }

    /// f = (-s residual, -phi).
    fn load(&mut self, s: T, residual: &[T]) {
        let (b, c) = self.w.f.split_at_mut(self.w.n);
        for (b, &r) in b.iter_mut().zip(residual) {
            *b = -s * r;
        }
        for (c, &phi) in c.iter_mut().zip(&self.w.terms.phi) {
            *c = -phi;
        }
    }

    /// Closes the constraints at `next` by sweeps with the factor at hand: the smallest changes in its metric.
    pub(crate) fn close(&mut self) -> bool {
        let n = self.w.n;
        let mut violation = self.w.openness(&self.w.terms.phi);
        for _ in 0..SWEEPS {
            if violation <= self.floor() {
                return true;
            }
            self.w.f[..n].fill(T::ZERO);
            for (c, &phi) in self.w.f[n..].iter_mut().zip(&self.w.terms.phi) {
                *c = -phi;
            }
            self.w.solve();
            for i in 0..n {
                self.next[i] += self.w.f[i];
            }
            self.model.evaluate(&self.next, &mut self.w.terms);
            let left = self.w.openness(&self.w.terms.phi);
            if !(left <= violation * T::HALF) && left <= self.floor() * T::from_f64(STALLED) {
                return true;
            }
            violation = left;
        }
        violation <= self.floor() * T::from_f64(STALLED)
    }

    /// Rounding of a constraint row, as a coordinate of its size moves it [-].
    pub(crate) fn floor(&self) -> T {
        (self.w.extent(&self.next[..self.w.n]) + T::ONE) * T::EPSILON * T::from_f64(FLOOR_ROUNDINGS)
    }

    /// Evaluates the forces at `next`.
    fn evaluate(&mut self) {
        self.model.evaluate_forces(&self.next, &self.v, &mut self.w.terms);
        self.measure();
    }

    /// Residual at `next` with `next_lambda`.
    fn measure(&mut self) {
        let lambda = &self.next_lambda;
        self.scale = self.w.residual(self.model, None, lambda, &mut self.next_residual);
    }

    /// Takes the trial over.
    fn accept(&mut self) {
        let lively = self.w.liveliness(self.model);
        self.lively = self.lively.max(lively);
        // Where all forces vanish together their rounding does so with those that were met.
        let lively = lively.max(self.lively * T::EPSILON.sqrt());
        if lively > T::ZERO {
            self.bound = T::ONE / (T::from_f64(NEUTRAL) * T::EPSILON.sqrt() * lively);
        }
        self.met = self.met.max(self.scale);
        let mut angles = self.w.terms.angles.clone();
        self.model.remember(&self.next, &self.w.terms, &mut angles);
        self.w.terms.angles = angles;
        self.q.copy_from_slice(&self.next);
        self.lambda.copy_from_slice(&self.next_lambda);
        self.residual.copy_from_slice(&self.next_residual);
        self.phi.copy_from_slice(&self.w.terms.phi);
    }

    /// Are the forces balanced where the search began?
    pub(crate) fn check_balance(&mut self, options: &Options<T>) -> Result<(), EquilibriumError> {
        self.factor(self.bound);
        self.stiff = norm_inf(self.w.diagonal()) / self.bound;
        if self.w.work(&self.residual) <= options.tolerance * (self.scale + self.stiff) {
            return Ok(());
        }
        Err(EquilibriumError::NotNear)
    }

    fn check_finite(&self) -> Result<(), EquilibriumError> {
        if norm_inf(&self.residual).is_finite() {
            return Ok(());
        }
        Err(EquilibriumError::NotFinite { unknown: largest_or_nan(&self.residual) })
    }

    fn check_far(&self) -> Result<(), EquilibriumError> {
        let gone = self.q[..self.w.n].iter().zip(&self.from).map(|(&q, &from)| q - from);
        let gone: Vec<T> = gone.collect();
        if self.w.extent(&gone) <= T::from_f64(MAX_EXTENT) {
            return Ok(());
        }
        Err(EquilibriumError::Escapes { unknown: largest(&gone) })
    }

    fn not_converged(&mut self) -> EquilibriumError {
        let unknown = self.w.solver.weakest().unknown;
        if self.w.solver.inertia().zero > 0 {
            return EquilibriumError::Undetermined { unknown };
        }
        let residual = norm_inf(&self.residual).to_f64();
        EquilibriumError::NotConverged { residual, unknown: largest(&self.residual) }
    }

    /// Writes what was found into the state.
    pub(crate) fn finish(mut self, from: &[T], s: &mut State<T>) -> Equilibrium<T> {
        let report = self.report(from);
        let Search { model, q, lambda, w, .. } = self;
        s.q.copy_from_slice(&q);
        s.q_low.fill(T::ZERO);
        s.a.fill(T::ZERO);
        s.a_aux.fill(T::ZERO);
        s.memory.copy_from_slice(&w.terms.angles);
        model.evaluate_forces(&s.q, &s.v, &mut w.terms);
        s.signals.copy_from_slice(&w.terms.signals);
        s.applied.copy_from_slice(&s.inputs);
        s.phi.copy_from_slice(&w.terms.phi);
        for to in [&mut s.lambda, &mut s.lambda_previous, &mut s.reaction] {
            to.copy_from_slice(&lambda);
        }
        report
    }

    /// Counts the signs of K + K_geo where J d = 0: s K + M has a negative direction where omega^2 < -1/s, and M - s K where
    /// omega^2 > 1/s.
    fn report(&mut self, from: &[T]) -> Equilibrium<T> {
        self.model.evaluate(&self.q, &mut self.w.terms);
        self.model.evaluate_forces(&self.q, &self.v, &mut self.w.terms);
        let bound = self.bound;
        let [unstable, stiff] = [bound, -bound].map(|s| {
            self.factor(s);
            self.w.solver.inertia().negative.saturating_sub(self.w.m)
        });
        let rank = mbs_core::start::constraint_rank(self.model, &self.w.terms);
        let neutral = (self.w.n - rank).saturating_sub(unstable + stiff);
        let residual = norm_inf(&self.residual);
        let forces = self.met.max(self.stiff);
        let change = from.iter().zip(&self.q).map(|(&a, &b)| (a - b).abs());
        Equilibrium {
            iterations: self.iterations,
            factorizations: self.factorizations,
            residual,
            relative: if forces > T::ZERO { self.w.work(&self.residual) / forces } else { T::ZERO },
            violation: norm_inf(&self.w.terms.phi),
            change: change.fold(T::ZERO, T::max),
            unstable,
            neutral,
            rate: T::ONE / bound.sqrt(),
        }
    }
}
