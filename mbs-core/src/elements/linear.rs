//! Linear dependence of entities: an additional point or direction of a body, as a combination of its basis.
//!
//! ```text
//! phi = sum_k a_k e_k - c          D rows with a constant gradient
//! ```

use super::combination::{Span, Term, combine};
use crate::Real;
use crate::algebra::Vector;

/// Element with D rows of linear dependence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Linear {
    /// Combination that the rows constrain to zero. Constant parts are also entities of the combination.
    pub x: Span,
    /// First of the D row numbers.
    pub row: u32,
    /// Place of the D rows, all of the same width, in the Jacobian store.
    pub place: Span,
}

impl Linear {
    /// Writes the values of the rows at `q`.
    #[inline(always)]
    pub fn evaluate<T: Real, const D: usize>(&self, pool: &[Term<T>], q: &[T], phi: &mut [T]) {
        let x: Vector<T, D> = combine(self.x.of(pool), q);
        for i in 0..D {
            phi[self.row as usize + i] = x[i];
        }
    }

    /// Writes the values at `q + dq`, from those at `q`.
    #[inline(always)]
    pub fn advance<T: Real, const D: usize>(
        &self,
        pool: &[Term<T>],
        dq: &[T],
        phi_n: &[T],
        phi: &mut [T],
    ) {
        let dx: Vector<T, D> = combine(self.x.of(pool), dq);
        for i in 0..D {
            let row = self.row as usize + i;
            phi[row] = phi_n[row] + dx[i];
        }
    }

    /// Writes the gradient, which is constant.
    pub fn write_gradient<T: Real, const D: usize>(&self, pool: &[Term<T>], jacobian: &mut [T]) {
        let rows = self.place.of_mut(jacobian);
        rows.fill(T::ZERO);
        let width = rows.len() / D;
        for term in self.x.of(pool) {
            for j in 0..D {
                let mut unit = Vector::<T, D>::zeros();
                unit[j] = T::ONE;
                let column = term.coef.apply(&unit);
                for i in 0..D {
                    rows[i * width + term.column as usize + j] += column[i];
                }
            }
        }
    }
}
