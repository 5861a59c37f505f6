//! Linear combinations of entities: x = sum_k (alpha_k + beta_k J) e_k, J the quarter turn in the plane.

use crate::Real;
use crate::algebra::{Coef, Vector, add_to, load};

/// Entity in a combination, with its coefficient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Term<T> {
    /// Start of the entity in the extended coordinates.
    pub entity: u32,
    /// Start of the entity's columns in the Jacobian row of the element.
    pub column: u32,
    /// Coefficient of the entity in the combination.
    pub coef: Coef<T>,
}

/// Range of terms in a shared pool.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Span {
    /// Index of the first term.
    pub start: u32,
    /// Index after the last term.
    pub end: u32,
}

impl Span {
    /// Terms of the span in `pool`.
    #[inline(always)]
    #[must_use]
    pub fn of<T>(self, pool: &[T]) -> &[T] {
        &pool[self.start as usize..self.end as usize]
    }
    /// Terms of the span in `pool`, mutable.
    #[inline(always)]
    #[must_use]
    pub fn of_mut<T>(self, pool: &mut [T]) -> &mut [T] {
        &mut pool[self.start as usize..self.end as usize]
    }
    /// Number of terms in the span.
    #[must_use]
    pub fn len(self) -> usize {
        (self.end - self.start) as usize
    }
    /// True if the span has no terms.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.start == self.end
    }
    /// Span as a range of indices.
    #[must_use]
    pub fn range(self) -> core::ops::Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// Value of a combination of entities.
#[inline(always)]
pub fn combine<T: Real, const D: usize>(terms: &[Term<T>], e: &[T]) -> Vector<T, D> {
    let mut x = Vector::<T, D>::zeros();
    for term in terms {
        x += term.coef.apply(&load(e, term.entity));
    }
    x
}

/// Adds A^T y to a Jacobian row, where A is the matrix of the combination x. This is the gradient of x.y with respect to the
/// entities of x.
#[inline(always)]
pub(crate) fn add_gradient<T: Real, const D: usize>(
    row: &mut [T],
    terms: &[Term<T>],
    y: &Vector<T, D>,
) {
    for term in terms {
        add_to(row, term.column as usize, &term.coef.apply_transposed(y));
    }
}
