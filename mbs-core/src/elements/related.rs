//! Relation element: a user-defined function of joint coordinates and lengths that is constrained.
//!
//! ```text
//! phi  = (phi(m_1 .. m_n) - s(t)) / c          c: its largest derivative in the reference configuration;  a_k = c_k m_k
//! grad = sum_k phi_k grad a_k                  bias = sum_k phi_k bias(a_k) + a'^T H a' - s''
//! ```
//!
//! Here a_k is term k, phi_k is the derivative of phi by it, and H is the matrix of second derivatives. The row has the form of a
//! [coupling](super::coupled) row: measures, their gradients and biases are the same.

use super::combination::combine;
use super::coupled::{
    Coupled, CoupledTables, Curves, add_measure_gradient, base_and_change, rate_and_bias,
};
use super::{Span, measured_value};
use crate::Real;
use crate::algebra::Vector;
use crate::laws::relation::Relation;
use crate::measure::Arguments;

impl<T: Real> Coupled<T> {
    /// Writes value and gradient of the row. The closure `at` gives the values of combinations of coordinates.
    #[inline(never)]
    pub fn evaluate_relation<const D: usize>(
        &self,
        (tables, relation): (&CoupledTables<'_, T, impl Curves<T>>, &impl Relation),
        at: impl Fn(Span) -> Vector<T, D> + Copy,
        (memory, sum): (&[T], T),
        (phi, jacobian): (&mut [T], &mut [T]),
    ) {
        let terms = self.terms.of(tables.terms);
        let mut arguments = Arguments::default();
        for term in terms {
            let mut number = [T::ZERO; 2];
            for measure in term.measures.of(tables.measures) {
                let parts = base_and_change(&measure.of, at, memory);
                let weight = term.factor * measure.sign;
                number = [number[0] + weight * parts[0], number[1] + weight * parts[1]];
            }
            arguments.push(number, T::ZERO);
        }
        phi[self.row as usize] = (arguments.evaluate(relation) - sum) * self.inverse;
        let row = self.place.of_mut(jacobian);
        row.fill(T::ZERO);
        for (k, term) in terms.iter().enumerate() {
            let slope = arguments.slope(k) * self.inverse * term.factor;
            for measure in term.measures.of(tables.measures) {
                add_measure_gradient(&measure.of, tables.pool, at, slope * measure.sign, row);
            }
        }
    }

    /// The part of phi'' without accelerations; `sum` is the prescribed sum with its derivatives.
    #[inline(never)]
    pub fn relation_bias<const D: usize>(
        &self,
        (tables, relation): (&CoupledTables<'_, T, impl Curves<T>>, &impl Relation),
        (q, v, memory): (&[T], &[T], &[T]),
        sum: [T; 3],
    ) -> T {
        let at = |x: Span| combine::<T, D>(x.of(tables.pool), q);
        let moving = |x: Span| combine::<T, D>(x.of(tables.pool), v);
        let terms = self.terms.of(tables.terms);
        let mut arguments = Arguments::default();
        for term in terms {
            let (mut m, mut rate) = (T::ZERO, T::ZERO);
            for measure in term.measures.of(tables.measures) {
                m += measure.sign * measured_value(&measure.of, at, memory);
                rate += measure.sign * rate_and_bias(&measure.of, at, moving)[0];
            }
            arguments.push([term.factor * m, T::ZERO], term.factor * rate);
        }
        arguments.evaluate(relation);
        let mut bias = arguments.curvature(relation) - sum[2];
        for (k, term) in terms.iter().enumerate() {
            for measure in term.measures.of(tables.measures) {
                let known = rate_and_bias(&measure.of, at, moving)[1];
                bias += arguments.slope(k) * term.factor * measure.sign * known;
            }
        }
        bias * self.inverse
    }
}
