//! The position, velocity and acceleration problems: dependent coordinates from independent ones.
//!
//! ```text
//! phi(q) = 0:          J_d d = -phi,  q_d += d, until d is rounding
//! J v + phi_t = 0:     J_d d = -(J v + phi_t),  v_d += d
//! J a + bias = 0:      J_d d = -(J a + bias),   a_d += d
//! ```
//!
//! The last problem gives a = R z'' + R' z' [P1 (22)] without forming R', by one back-substitution. All three problems are in correction
//! form, with phi by increments. Therefore the constraints hold to machine precision in positions, velocities and accelerations.

use crate::options::{Coordinates, Options};
use crate::workspace::Workspace;
use core::cmp::Ordering;
use mbs_core::Real;
use mbs_core::algebra::norm_inf;
use mbs_core::integrator::Rule;
use mbs_core::model::{Model, State};
use mbs_core::step::{StepError, largest, largest_or_nan};

/// Largest number of iterations of the position problem [-]. With a contraction of 1/4, eight iterations leave 1e-5 of the first
/// correction. Chosen, not tuned.
const MAX_POSITIONS: u32 = 8;
/// Iterations of the position problem above which other independent coordinates are selected [-]. Chosen, not tuned.
const MANY_POSITIONS: u32 = 4;
/// Largest ratio of two successive Newton corrections [-]. Up to this ratio the solution is the one closest to the prediction. The theorem
/// of Newton and Kantorovich guarantees this up to a ratio of 1/2.
const CONTRACTION: f64 = 0.25;
/// Ratio of a pivot to its size at the selection, below which other independent coordinates are selected [-]. Chosen, not tuned.
const DECAY: f64 = 1e-2;
/// Largest entry of R above which other independent coordinates are selected [-]. The entry must also be larger than twice that at the
/// selection. Chosen, not tuned.
const LARGE_BASIS: f64 = 10.0;
/// Correction that counts as rounding error, in units of EPSILON times the displacement divided by the smallest pivot [-]. Chosen, not
/// tuned.
const LOST: f64 = 16.0;
/// Correction that counts as rounding error, in units of EPSILON times the scene's length [-]. Chosen, not tuned.
const PLACE_ROUNDINGS: f64 = 4.0;
/// Correction with which a position problem that no longer converges counts as solved, away from singular positions [EPSILON of the scene's
/// length]. It is the rounding error of a user-defined relation of angles of a thousand turns.
const STALLED: f64 = 1024.0;
/// Ratio of the smallest pivot to its usual size, below which a singular position is close [-]. Chosen, not tuned.
const NEAR_SINGULAR: f64 = 0.1;

impl<T: Real> Workspace<T> {
    /// Solves for the positions, velocities and accelerations that satisfy their constraints and have the required z, z' and z''. Leaves J
    /// factored and R evaluated at the position.
    pub(crate) fn place<M: Model<T>>(
        &mut self,
        model: &M,
        (rule, length): (&Rule<T>, T),
        options: &Options<T>,
        s: &State<T>,
    ) -> Result<(), StepError> {
        self.positions(model, length, s)?;
        self.evaluate_basis();
        let is_tangent = options.coordinates == Coordinates::Tangent;
        if is_tangent {
            self.turn_to_chart()?;
        }
        if model.has_guides() {
            model.evaluate_phi_t(&self.q, &mut self.terms);
        }
        self.velocity_rates(model);
        self.solve();
        add_dependent(self.elimination.dependent(), &self.change, &mut self.v);
        if is_tangent {
            self.meet(1, rule.velocity);
        }
        model.evaluate_bias(&self.q, &self.v, &mut self.terms);
        self.acceleration_rates(model);
        self.solve();
        add_dependent(self.elimination.dependent(), &self.change, &mut self.a);
        if is_tangent {
            self.meet(2, rule.acceleration);
        }
        Ok(())
    }

    /// Evaluates R and checks whether its entries have grown too large.
    fn evaluate_basis(&mut self) {
        let largest = self.basis.evaluate(&self.elimination);
        if self.first_basis == T::ZERO {
            self.first_basis = largest;
        }
        self.is_stale |= largest > T::from_f64(LARGE_BASIS).max(T::TWO * self.first_basis);
    }

    /// Evaluates phi and J at q_n + dq and factors J.
    pub(crate) fn move_to<M: Model<T>>(
        &mut self,
        model: &M,
        s: &State<T>,
    ) -> Result<(), StepError> {
        self.evaluate(model, s);
        self.elimination.refactor(&self.jacobian.values);
        self.counts.factorizations += 1;
        self.check_pivots()
    }

    /// Evaluates phi and J at q_n + dq.
    pub(crate) fn evaluate<M: Model<T>>(&mut self, model: &M, s: &State<T>) {
        for i in 0..model.n_unknowns() {
            self.q[i] = s.q[i] + self.dq[i];
        }
        model.advance(&s.q, &self.dq, &s.phi, &mut self.terms);
        self.jacobian.gather(model, &self.terms);
    }

    /// Checks the sizes of the pivots. Smaller pivots cause another selection, and a lost pivot fails the step.
    ///
    /// Let sigma be the smallest pivot. Rounding errors of v are EPSILON / sigma, and those of a are EPSILON / sigma^2. If sigma is below
    /// EPSILON^(1/4), accelerations have less than half of their digits.
    pub(crate) fn check_pivots(&mut self) -> Result<(), StepError> {
        self.pivots = self.elimination.pivots();
        self.is_stale |= self.pivots.decay < T::from_f64(DECAY);
        if self.rank > 0 && !(self.pivots.smallest > T::EPSILON.sqrt().sqrt() * self.usual) {
            return Err(self.rank_lost());
        }
        Ok(())
    }

    /// Chooses pivots for the last gathered J.
    ///
    /// # Errors
    /// [`StepError::RankLost`] when the rank is not that of the start.
    pub(crate) fn choose_columns(&mut self) -> Result<(), StepError> {
        let choice = self.elimination.select_pivots(&self.jacobian.values);
        self.choices += 1;
        self.counts.factorizations += 1;
        self.first_basis = T::ZERO;
        let (row, pivot) = match choice.rank.cmp(&self.rank) {
            Ordering::Less => choice.rest,
            Ordering::Equal => return Ok(()),
            Ordering::Greater => choice.last,
        };
        Err(StepError::RankLost { row, pivot: pivot.to_f64() })
    }

    fn rank_lost(&self) -> StepError {
        StepError::RankLost { row: self.pivots.row, pivot: self.pivots.smallest.to_f64() }
    }

    fn positions<M: Model<T>>(
        &mut self,
        model: &M,
        length: T,
        s: &State<T>,
    ) -> Result<(), StepError> {
        let n = model.n_unknowns();
        let mut last = T::ZERO;
        for iterations in 0..MAX_POSITIONS {
            self.move_to(model, s)?;
            self.rates.copy_from_slice(&self.terms.phi);
            self.change.fill(T::ZERO);
            self.solve();
            let size = norm_inf(&self.change);
            if !size.is_finite() {
                return Err(StepError::NotFinite { unknown: largest_or_nan(&self.change) });
            }
            let lost = T::EPSILON * T::from_f64(LOST) * norm_inf(&self.dq[..n]);
            if size
                <= T::EPSILON * T::from_f64(PLACE_ROUNDINGS) * length + lost / self.pivots.smallest
            {
                return Ok(());
            }
            self.is_stale |= iterations >= MANY_POSITIONS;
            if iterations > 0 && !(size <= last * T::from_f64(CONTRACTION)) {
                if size <= T::EPSILON * T::from_f64(STALLED) * length && !self.is_near_singular() {
                    return Ok(());
                }
                return Err(self.lost_branch(iterations + 1, size / length));
            }
            add_dependent(self.elimination.dependent(), &self.change, &mut self.dq);
            last = size;
        }
        Err(self.lost_branch(MAX_POSITIONS, last / length))
    }

    fn is_near_singular(&self) -> bool {
        self.pivots.smallest < self.usual * T::from_f64(NEAR_SINGULAR)
    }

    /// Returns the error for positions whose branch is not certain: lost rank if a singular position is close, otherwise no convergence.
    fn lost_branch(&self, iterations: u32, correction: T) -> StepError {
        if self.is_near_singular() {
            return self.rank_lost();
        }
        let (correction, unknown) = (correction.to_f64(), largest(&self.change));
        StepError::NotConverged { iterations, correction, unknown }
    }

    /// Evaluates rates = J v + phi_t. Returns the largest absolute value.
    pub(crate) fn velocity_rates<M: Model<T>>(&mut self, model: &M) -> T {
        model.multiply_jacobian(&self.terms, &self.v, &mut self.rates);
        if model.has_guides() {
            add(&self.terms.phi_t, &mut self.rates);
        }
        norm_inf(&self.rates)
    }

    /// Evaluates rates = J a + bias. Returns the largest absolute value.
    pub(crate) fn acceleration_rates<M: Model<T>>(&mut self, model: &M) -> T {
        model.multiply_jacobian(&self.terms, &self.a, &mut self.rates);
        add(&self.terms.phi_bias, &mut self.rates);
        norm_inf(&self.rates)
    }
}

fn add<T: Real>(x: &[T], y: &mut [T]) {
    for (y, &x) in y.iter_mut().zip(x) {
        *y += x;
    }
}

/// Adds x to y at the dependent unknowns.
fn add_dependent<T: Real>(dependent: &[u32], x: &[T], y: &mut [T]) {
    for &u in dependent {
        y[u as usize] += x[u as usize];
    }
}
