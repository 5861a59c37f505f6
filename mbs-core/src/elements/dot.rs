//! Constant dot product of two combinations of entities. With x = y it is a constant distance of two body points.
//!
//! ```text
//! phi = s x.y - c,   x = sum a_k e_k,  y = sum b_k e_k
//! ```

use super::combination::{Span, Term, add_gradient, combine};
use crate::Real;

/// Row of a constant dot product of two combinations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dot<T> {
    /// First combination x of entities.
    pub x: Span,
    /// Second combination y of entities.
    pub y: Span,
    /// Scale s of the dot product.
    pub scale: T,
    /// Constant c: the required value of the scaled dot product.
    pub constant: T,
    /// Number of the row, its place in `phi`.
    pub row: u32,
    /// Place of the row in the Jacobian store.
    pub place: Span,
}

impl<T: Real> Dot<T> {
    /// Writes value s x.y - c and gradient at `q`.
    #[inline(always)]
    pub fn evaluate<const D: usize>(
        &self,
        pool: &[Term<T>],
        q: &[T],
        phi: &mut [T],
        jacobian: &mut [T],
    ) {
        let (x, y) = (combine::<T, D>(self.x.of(pool), q), combine::<T, D>(self.y.of(pool), q));
        phi[self.row as usize] = x.dot(&y) * self.scale - self.constant;
        self.write_gradient(pool, &x, &y, jacobian);
    }

    /// Writes value and gradient at `q + dq`, from the value at `q`. The form phi = phi_n + s ((x + dx/2).dy + (y + dy/2).dx) is
    /// exact.
    #[inline(always)]
    pub fn advance<const D: usize>(
        &self,
        pool: &[Term<T>],
        (q, dq): (&[T], &[T]),
        phi_n: &[T],
        (phi, jacobian): (&mut [T], &mut [T]),
    ) {
        let (tx, ty) = (self.x.of(pool), self.y.of(pool));
        let (x, y) = (combine::<T, D>(tx, q), combine::<T, D>(ty, q));
        let (dx, dy) = (combine::<T, D>(tx, dq), combine::<T, D>(ty, dq));
        let row = self.row as usize;
        let change = (x + dx * T::HALF).dot(&dy) + (y + dy * T::HALF).dot(&dx);
        phi[row] = phi_n[row] + change * self.scale;
        self.write_gradient(pool, &(x + dx), &(y + dy), jacobian);
    }

    #[inline(always)]
    fn write_gradient<const D: usize>(
        &self,
        pool: &[Term<T>],
        x: &crate::algebra::Vector<T, D>,
        y: &crate::algebra::Vector<T, D>,
        jacobian: &mut [T],
    ) {
        let row = self.place.of_mut(jacobian);
        row.fill(T::ZERO);
        add_gradient(row, self.x.of(pool), &(y * self.scale));
        add_gradient(row, self.y.of(pool), &(x * self.scale));
    }

    /// The part of phi'' without accelerations: 2 s x'.y'.
    #[inline(always)]
    pub fn bias<const D: usize>(&self, pool: &[Term<T>], v: &[T]) -> T {
        let (x, y) = (combine::<T, D>(self.x.of(pool), v), combine::<T, D>(self.y.of(pool), v));
        x.dot(&y) * self.scale * T::TWO
    }
}
