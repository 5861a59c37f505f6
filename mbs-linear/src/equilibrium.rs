//! Static equilibrium by pseudo-transient continuation. Small steps follow the flow M q' = Q - J^T lambda on the constraints. Large steps
//! are those of Newton's method.
//!
//! ```text
//! [ M + s (K + K_geo(lambda))  J^T ] ( d          )     ( s (Q - J^T lambda) )
//! [ J                           0  ] ( s d_lambda )  =  ( -phi               ),     q += d, closed again; lambda += d_lambda
//! ```
//!
//! The matrix is that of a step of implicit Euler from rest with the step size h, where h^2 = s. So the method is dynamic relaxation with
//! the velocity reset to zero after every step. For s -> infinity the matrix is that of Newton's method (C. T. Kelley, D. E. Keyes, SIAM J.
//! Numer. Anal. 35, 1998). s grows tenfold with every accepted step and shrinks after a refused one. A step d is refused in four cases:
//!
//! - The matrix is not positive definite where J d = 0 (its inertia is not (n, m, 0), N. Gould 1985). The step then leads to no minimum of
//!   energy.
//! - The step rotates the mechanism so far that it violates the constraints by a quarter of its size.
//! - The forces at the end of the step do negative work along it, more than half of the positive work of the forces at its start. The step
//!   is then too long.
//! - The forces do that much negative work at a place where two points pass each other and a law may push them apart. The step would pass
//!   through a stop.
//!
//! The line search compares work along the step rather than norms of residuals. Forces may grow while the mechanism falls from a steep or
//! unstable position. So the search leaves an unstable position unless it starts exactly there.
//!
//! In neutral directions no force acts and K is singular. There the step, s times force divided by mass, consists of rounding errors. The
//! bound on s limits the displacement of a neutral direction in each step to sqrt(EPSILON)/10 of the scene's length. Such directions stay
//! where they started.
//!
//! Forces are balanced if they are small relative to the sum of two forces. The first is the largest sum of absolute forces on a coordinate
//! at the position. The second is the force that the stiffness gives for a displacement of the scene's size. The second matters for a slide
//! that a single spring holds, because there all forces vanish together.

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
    /// Number of factorisations, including those of refused steps and of the test of stability.
    pub factorizations: u32,
    /// Largest remaining force on a coordinate [N; N m for directions].
    pub residual: T,
    /// Largest remaining force, relative to a reference force [-]. Each force is measured by its work along the scene's length. One
    /// candidate for the reference is the largest sum of absolute forces on a coordinate during the search. The other is the force that the
    /// stiffness gives for a displacement of that length. The larger one is used. Zero without forces.
    pub relative: T,
    /// Largest constraint violation [m or rad].
    pub violation: T,
    /// Largest change of a coordinate during the search [m or -].
    pub change: T,
    /// Number of unstable directions: their squared frequency omega^2 is negative, and |omega| is above [`rate`](Self::rate).
    ///
    /// The number is an estimate from the effects' tangents, which may leave out terms. The eigenvalues of a linearisation are decisive.
    pub unstable: usize,
    /// Number of neutral directions, with |omega| below [`rate`](Self::rate), by the same estimate. The mechanism may be anywhere along them.
    pub neutral: usize,
    /// Rate below which a direction counts as neutral [rad/s].
    pub rate: T,
}

impl<T> Equilibrium<T> {
    /// True if no direction is unstable, by the estimate in `unstable`.
    pub fn is_stable(&self) -> bool {
        self.unstable == 0
    }
}

/// Factor on s after a refused step [-]. Chosen, not tuned.
const SHRINK: f64 = 0.125;
/// Factor on s after an accepted step [-]. Chosen, not tuned.
const GROW: f64 = 10.0;
/// The search ends if s falls below its first value times this factor [-]. This happens after 23 refused steps in a row. Chosen, not tuned.
const SMALLEST: f64 = 1e-20;
/// Number of steps with balanced forces but without progress after which the search ends [-]. Chosen, not tuned.
const MAX_IDLE_STEPS: u32 = 40;
/// Largest number of sweeps that close the constraints after a step [-]. Chosen, not tuned.
const SWEEPS: u32 = 20;
/// Longest step that counts as rounding error, in units of EPSILON times the scene's size [-]. Chosen, not tuned.
const NOWHERE: f64 = 8.0;
/// Largest force that counts as rounding error, in units of EPSILON times its terms [-]. Chosen, not tuned.
const FORCE_ROUNDINGS: f64 = 4.0;
/// Constraint violation of a step, relative to its size, above which the step is refused [-]. Chosen, not tuned.
const BROKEN: f64 = 0.25;
/// Constraint violation at which a search may begin, in sizes of coordinates [-]. Chosen, not tuned.
const CLOSED: f64 = 1e-6;
/// Constraint violation that counts as rounding error of a row, in units of EPSILON [-]. Chosen, not tuned.
const FLOOR_ROUNDINGS: f64 = 8.0;
/// Constraint violation at which sweeps without progress may end, relative to the rounding error of a row [-]. Chosen, not tuned.
const STALLED: f64 = 64.0;
/// The largest displacement of a neutral direction in a step is sqrt(EPSILON) of the scene's length divided by this number [-]. Chosen, not
/// tuned.
const NEUTRAL: f64 = 10.0;
/// Largest displacement from the start in a search, relative to the scene's length [-]. Chosen, not tuned.
const MAX_EXTENT: f64 = 1e6;

/// Moves `s` to a static equilibrium close to it.
///
/// Guides keep their values at the time `s.t`. Forces that depend on velocity are evaluated at the velocity in `s`: set it to zero for an
/// equilibrium at rest. The function writes positions, multipliers (also as `reaction`) and measured angles. Accelerations become zero.
/// Velocities keep their values, and are not made consistent with the new positions.
///
/// Cost: ten to forty factorisations close to an equilibrium, and more from a distant start. Allocates a few vectors.
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
    /// Accepted positions, multipliers, residual J^T lambda - Q and violation of constraints.
    pub(crate) q: Vec<T>,
    lambda: Vec<T>,
    residual: Vec<T>,
    phi: Vec<T>,
    /// Positions, multipliers and residual of a trial step.
    pub(crate) next: Vec<T>,
    next_lambda: Vec<T>,
    next_residual: Vec<T>,
    /// Positions at the start.
    from: Vec<T>,
    /// Largest sum of absolute forces on a coordinate, as work along the coordinate's size [J]: at the present position, and during the
    /// search.
    scale: T,
    met: T,
    /// Largest acceleration that a single force would have caused during the search, in sizes of coordinates [1/s^2].
    lively: T,
    /// Largest work of the matrix of the last step for a displacement by a coordinate's size [J].
    stiff: T,
    /// Pseudo-time step squared and its upper bound [s^2].
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

    /// Closes the constraints, solves for multipliers and accelerations at rest, and chooses the first s.
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
        // The second sweep removes the error that the regularisation of the rows leaves.
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

    /// Makes steps until the forces are balanced.
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
                // A small s indicates an unstable position. There a small step does not show an equilibrium, but only the beginning of a
                // motion.
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

    /// Makes one step with the present s. Returns its size, or `None` if it is refused.
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

    /// True if forces work against the straight path to `next` at a place where two points pass each other and a law may push them apart.
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

    /// Factors the matrix at the present terms. Returns whether the matrix is positive definite where J d = 0.
    fn factor(&mut self, s: T) -> bool {
        self.factorizations += 1;
        let is_regular = self.w.factor(self.model, s, (&self.q, &self.lambda)).is_ok();
        is_regular && self.w.solver.inertia().negative == self.w.m
    }

    /// Sets the right-hand side f = (-s residual, -phi).
    fn load(&mut self, s: T, residual: &[T]) {
        let (b, c) = self.w.f.split_at_mut(self.w.n);
        for (b, &r) in b.iter_mut().zip(residual) {
            *b = -s * r;
        }
        for (c, &phi) in c.iter_mut().zip(&self.w.terms.phi) {
            *c = -phi;
        }
    }

    /// Closes the constraints at `next` by sweeps with the present factor. Their changes are the smallest in the metric of the factored
    /// matrix.
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

    /// Rounding error of a constraint row, expressed as the displacement of a coordinate relative to its size [-].
    pub(crate) fn floor(&self) -> T {
        (self.w.extent(&self.next[..self.w.n]) + T::ONE) * T::EPSILON * T::from_f64(FLOOR_ROUNDINGS)
    }

    /// Evaluates the forces at `next`.
    fn evaluate(&mut self) {
        self.model.evaluate_forces(&self.next, &self.v, &mut self.w.terms);
        self.measure();
    }

    /// Evaluates the residual at `next` with `next_lambda`.
    fn measure(&mut self) {
        let lambda = &self.next_lambda;
        self.scale = self.w.residual(self.model, None, lambda, &mut self.next_residual);
    }

    /// Accepts the trial step.
    fn accept(&mut self) {
        let lively = self.w.liveliness(self.model);
        self.lively = self.lively.max(lively);
        // Where all forces vanish together, their rounding errors are relative to the forces at earlier positions of the search.
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

    /// Checks that the forces are balanced at the position where the search started.
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

    /// Writes the equilibrium into the state.
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

    /// Counts the negative directions of K + K_geo where J d = 0. The number of negative directions of M + s K is that of the omega^2 <
    /// -1/s. The number of negative directions of M - s K is that of the omega^2 > 1/s.
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
