//! The position, velocity and acceleration problems: dependent coordinates from independent ones.
//!
//! ```text
//! phi(q) = 0:          J_d d = -phi,  q_d += d, until d is rounding
//! J v + phi_t = 0:     J_d d = -(J v + phi_t),  v_d += d
//! J a + bias = 0:      J_d d = -(J a + bias),   a_d += d
//! ```
//!
//! The last is a = R z'' + R' z' [P1 (22)] without R': one back-substitution. All are in correction form, with phi by increments, so
//! that all three levels hold to rounding.

use crate::options::{Coordinates, Options};
use crate::workspace::Workspace;
use core::cmp::Ordering;
use mbs_core::Real;
use mbs_core::algebra::norm_inf;
use mbs_core::integrator::Rule;
use mbs_core::model::{Model, State};
use mbs_core::step::{StepError, largest, largest_or_nan};

/// Most iterations of the position problem [-]: with a contraction of 1/4 eight leave 1e-5 of the first correction. Chosen, not tuned.
const MAX_POSITIONS: u32 = 8;
/// Iterations beyond which other independent coordinates are selected [-]. Chosen, not tuned.
const MANY_POSITIONS: u32 = 4;
/// Largest ratio of two Newton corrections [-], at which the solution is the one that belongs to the prediction (Newton and Kantorovich: the
/// branch is certain up to 1/2).
const CONTRACTION: f64 = 0.25;
/// Ratio of a pivot to itself at the selection, below which other independent coordinates are selected [-]. Chosen, not tuned.
const DECAY: f64 = 1e-2;
/// Largest entry of R, above which, and above twice that at the selection, other independent coordinates are selected [-]. Chosen, not tuned.
const LARGE_BASIS: f64 = 10.0;
/// Correction that is rounding, in units of rounding of the displacement over the smallest pivot [-]. Chosen, not tuned.
const LOST: f64 = 16.0;
/// Correction that is rounding, in units of rounding of the scene's length [-]. Chosen, not tuned.
const PLACE_ROUNDINGS: f64 = 4.0;
/// Correction at which positions that come no nearer have arrived away from singular positions, in units of rounding of the scene's length
/// [-]: rounding of a user-defined relation of angles of a thousand turns.
const STALLED: f64 = 1024.0;
/// Ratio of the smallest pivot to its usual size, below which a singular position is near [-]. Chosen, not tuned.
const NEAR_SINGULAR: f64 = 0.1;

impl<T: Real> Workspace<T> {
    /// Positions, velocities and accelerations on their constraints that have the wanted z, z', z''; J is left factored and
    /// R evaluated at the position.
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

    /// R, and whether it has grown.
    fn evaluate_basis(&mut self) {
        let largest = self.basis.evaluate(&self.elimination);
        if self.first_basis == T::ZERO {
            self.first_basis = largest;
        }
        self.is_stale |= largest > T::from_f64(LARGE_BASIS).max(T::TWO * self.first_basis);
    }

    /// phi, J and its factors at q_n + dq.
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

    /// phi and J at q_n + dq.
    pub(crate) fn evaluate<M: Model<T>>(&mut self, model: &M, s: &State<T>) {
        for i in 0..model.n_unknowns() {
            self.q[i] = s.q[i] + self.dq[i];
        }
        model.advance(&s.q, &self.dq, &s.phi, &mut self.terms);
        self.jacobian.gather(model, &self.terms);
    }

    /// Looks at the pivots: decayed ones ask for another choice, lost ones stop the step.
    ///
    /// On the branch, rounding of v is eps / sigma and that of a is eps / sigma^2 where sigma is the smallest pivot. Below
    /// eps^(1/4) accelerations would keep less than half of their digits.
    pub(crate) fn check_pivots(&mut self) -> Result<(), StepError> {
        self.pivots = self.elimination.pivots();
        self.is_stale |= self.pivots.decay < T::from_f64(DECAY);
        if self.rank > 0 && !(self.pivots.smallest > T::EPSILON.sqrt().sqrt() * self.usual) {
            return Err(self.rank_lost());
        }
        Ok(())
    }

    /// Chooses pivots for J as it was gathered last.
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

    /// Positions that are not certain: near a singular position for its sake, elsewhere for the length of the step.
    fn lost_branch(&self, iterations: u32, correction: T) -> StepError {
        if self.is_near_singular() {
            return self.rank_lost();
        }
        let (correction, unknown) = (correction.to_f64(), largest(&self.change));
        StepError::NotConverged { iterations, correction, unknown }
    }

    /// rates = J v + phi_t; returns the largest.
    pub(crate) fn velocity_rates<M: Model<T>>(&mut self, model: &M) -> T {
        model.multiply_jacobian(&self.terms, &self.v, &mut self.rates);
        if model.has_guides() {
            add(&self.terms.phi_t, &mut self.rates);
        }
        norm_inf(&self.rates)
    }

    /// rates = J a + bias; returns the largest.
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

/// y += x over the dependent unknowns.
fn add_dependent<T: Real>(dependent: &[u32], x: &[T], y: &mut [T]) {
    for &u in dependent {
        y[u as usize] += x[u as usize];
    }
}
