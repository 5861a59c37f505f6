//! Rolling contacts in a search for an equilibrium: the slip of each step is removed.
//!
//! ```text
//! slip = integral of J dq over the rows of velocities:   S_1 = J(q_1/2) (q_1 - q_0),   S_2 the same over both halves,   (4 S_2 - S_1) / 3
//! ```
//!
//! The constraints are closed at the midpoints. If a wheel rotates by an angle a in a step, the error of the computed slip is 1.3e-4 a^5
//! times the wheel's radius.

use crate::equilibrium::Search;
use alloc::vec;
use alloc::vec::Vec;
use mbs_core::model::Model;
use mbs_core::{Real, SymmetricSolver};

/// Longest step with rolling contacts, in sizes of coordinates [-]. The computed slip then has an error of 2e-7 of the step.
const LONGEST: f64 = 0.2;
/// Largest number of sweeps that remove slip [-]. Each sweep leaves a tenth of the slip or less. Chosen, not tuned.
const SWEEPS: u32 = 20;
/// Slip that counts as rounding error, in units of the rounding error of a row [-]. Chosen, not tuned.
const ROUNDINGS: f64 = 64.0;

impl<T: Real, M: Model<T>, S: SymmetricSolver<T>> Search<'_, T, M, S> {
    /// True if a step of this `size` is too long for a rolling contact.
    pub(crate) fn is_too_long_to_roll(&self, size: T) -> bool {
        self.model.has_velocity_rows() && size > T::from_f64(LONGEST)
    }

    /// Moves `next` so that the path from `q` has no slip. Returns whether it succeeded. Both ends must satisfy the constraints, and the
    /// terms must be those at `next`.
    pub(crate) fn roll(&mut self) -> bool {
        if !self.model.has_velocity_rows() {
            return true;
        }
        let n = self.w.n;
        for _ in 0..SWEEPS {
            let Some(slip) = self.slip() else { return false };
            if self.w.openness(&slip) <= self.floor() * T::from_f64(ROUNDINGS) {
                return true;
            }
            self.w.f[..n].fill(T::ZERO);
            for (c, &slip) in self.w.f[n..].iter_mut().zip(&slip) {
                *c = -slip;
            }
            self.w.solve();
            for (next, &d) in self.next.iter_mut().zip(&self.w.f[..n]) {
                *next += d;
            }
            self.model.evaluate(&self.next, &mut self.w.terms);
            if !self.close() {
                return false;
            }
        }
        false
    }

    /// Returns the slip along the path from `q` to `next`, row by row. Rows of positions have no slip. Returns `None` if the constraints
    /// cannot be closed at a midpoint.
    fn slip(&mut self) -> Option<Vec<T>> {
        let (from, to) = (self.q.clone(), self.next.clone());
        let middle = self.between(&from, &to)?;
        let whole = self.along(&from, &to);
        let first = self.between(&from, &middle).map(|_| self.along(&from, &middle))?;
        let second = self.between(&middle, &to).map(|_| self.along(&middle, &to))?;
        self.next.copy_from_slice(&to);
        self.model.evaluate(&self.next, &mut self.w.terms);
        let (third, four) = (T::ONE / T::from_f64(3.0), T::from_f64(4.0));
        let parts = whole.iter().zip(first.iter().zip(&second)).enumerate();
        let slip = parts.map(|(row, (&whole, (&first, &second)))| {
            let is_slip = self.model.is_velocity_row(row);
            if is_slip { ((first + second) * four - whole) * third } else { T::ZERO }
        });
        Some(slip.collect())
    }

    /// Returns the middle between two positions, with the constraints closed, and evaluates the terms there.
    fn between(&mut self, from: &[T], to: &[T]) -> Option<Vec<T>> {
        for (middle, (&from, &to)) in self.next.iter_mut().zip(from.iter().zip(to)) {
            *middle = (from + to) * T::HALF;
        }
        self.model.evaluate(&self.next, &mut self.w.terms);
        self.close().then(|| self.next.clone())
    }

    /// Returns J (to - from), with the rows of the last evaluated terms.
    fn along(&self, from: &[T], to: &[T]) -> Vec<T> {
        let way: Vec<T> = to.iter().zip(from).map(|(&to, &from)| to - from).collect();
        let mut rates = vec![T::ZERO; self.w.m];
        self.model.multiply_jacobian(&self.w.terms, &way, &mut rates);
        rates
    }
}
