//! Coordinates, velocities and accelerations at the end of a step: their prediction and their corrections. `unit` is the factor a' of the
//! integration rule, d a correction; x and y are factors of the correction in position and velocity. The index p denotes the prediction, n
//! the beginning of the step.
//!
//! ```text
//! dq = dq_p,      v = v_p,      a = unit a_p
//! dq <- dq + x d,   v <- v + y d,   a <- a + d,   q = q_n + dq
//! ```

use crate::Real;
use crate::integrator::Rule;
use crate::model::{Model, State, Terms};
use crate::team::on_stretches;
use alloc::vec;
use alloc::vec::Vec;

/// End of a step during its iteration. All vectors have the length of the coordinates, constants included.
#[derive(Debug, Clone)]
pub struct StepEnd<T> {
    /// Increments of the coordinates in the step [m or -].
    pub dq: Vec<T>,
    /// Coordinates [m or -].
    pub q: Vec<T>,
    /// Velocities of the coordinates.
    pub v: Vec<T>,
    /// Accelerations, in the unit of the prediction.
    pub a: Vec<T>,
    n: usize,
}

impl<T: Real> StepEnd<T> {
    /// End of a step without motion, in the reference configuration.
    pub fn new(model: &impl Model<T>) -> Self {
        let zeros = || vec![T::ZERO; model.n_extended()];
        let mut q = zeros();
        model.write_reference(&mut q);
        Self { dq: zeros(), q, v: zeros(), a: zeros(), n: model.n_unknowns() }
    }

    /// Predicts increments, velocities and accelerations, the latter times `unit`. If `is_far`, accelerations alone would displace the
    /// coordinates far, and the prediction assumes constant velocity.
    #[inline]
    pub fn predict<M: Model<T>>(
        &mut self,
        model: &M,
        (rule, unit, is_far): (&Rule<T>, T, bool),
        s: &State<T>,
    ) {
        let n = self.n;
        let vectors = [&mut self.dq[..n], &mut self.v[..n], &mut self.a[..n]];
        on_stretches(model.team(), vectors, |first, [dq, v, a]| {
            for k in 0..dq.len() {
                let i = first + k;
                let predicted = rule.predict(s.v[i], s.a[i], s.a_aux[i]);
                (dq[k], v[k], a[k]) = (predicted.0, predicted.1, predicted.2 * unit);
            }
        });
        if is_far {
            rule.hold_back(unit, [&mut self.dq[..n], &mut self.v, &mut self.a], &s.a_aux);
        }
    }

    /// Applies the correction -`f`: dq -= x f, v -= y f, a -= f. Cost: proportional to the number of unknowns.
    #[inline]
    pub fn correct<M: Model<T>>(&mut self, model: &M, (x, y): (T, T), f: &[T]) {
        let n = self.n;
        let vectors = [&mut self.dq[..n], &mut self.v[..n], &mut self.a[..n]];
        on_stretches(model.team(), vectors, |first, [dq, v, a]| {
            let f = &f[first..][..dq.len()];
            for k in 0..dq.len() {
                dq[k] -= x * f[k];
                v[k] -= y * f[k];
                a[k] -= f[k];
            }
        });
    }

    /// Computes q = q_n + dq, with phi and J there. If `compensated`, phi is updated by its increment, without cancellation of digits.
    /// Cost: one evaluation.
    #[inline]
    pub fn evaluate<M: Model<T>>(
        &mut self,
        model: &M,
        compensated: bool,
        s: &State<T>,
        terms: &mut Terms<T>,
    ) {
        let (n, dq) = (self.n, &self.dq);
        on_stretches(model.team(), [&mut self.q[..n]], |first, [q]| {
            let (q_n, dq) = (&s.q[first..][..q.len()], &dq[first..][..q.len()]);
            for k in 0..q.len() {
                q[k] = q_n[k] + dq[k];
            }
        });
        if compensated {
            model.advance(&s.q, &self.dq, &s.phi, terms);
        } else {
            model.evaluate(&self.q, terms);
        }
    }

    /// Sets phi = (dq/dv) J v in the velocity rows, if there are any: their residual in the step.
    #[inline]
    pub fn evaluate_rates<M: Model<T>>(&self, model: &M, rule: &Rule<T>, terms: &mut Terms<T>) {
        if model.has_velocity_rows() {
            model.evaluate_rates(&self.v, T::ONE / rule.velocity, terms);
        }
    }

    /// Evaluates applied forces and their tangents, if there are any.
    #[inline]
    pub fn evaluate_forces<M: Model<T>>(&self, model: &M, terms: &mut Terms<T>) {
        if model.has_forces() {
            model.evaluate_forces(&self.q, &self.v, terms);
        }
    }

    /// Scales accelerations from the unit of the iteration: a *= factor.
    #[inline]
    pub fn scale_accelerations<M: Model<T>>(&mut self, model: &M, factor: T) {
        on_stretches(model.team(), [&mut self.a], |_, [a]| {
            a.iter_mut().for_each(|a| *a *= factor);
        });
    }

    /// Increments of the unknowns [m or -].
    #[inline]
    pub fn moved(&self) -> &[T] {
        &self.dq[..self.n]
    }
}
