//! Constant distance of two entities. With the zero vector at one end it is the constant length of a direction.
//!
//! ```text
//! phi = (d.d - L^2) / 2L,   d = e_b - e_a          [P1 2.1], scaled so that the gradient has length one
//! ```

use crate::Real;
use crate::algebra::{Vector, load, store};

/// Row of a constant distance of two entities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distance<T> {
    /// Extended coordinates of the ends a and b.
    pub ends: [u32; 2],
    /// Places of the gradients of a and b in the Jacobian store.
    pub places: [u32; 2],
    /// Number of the row, its place in `phi`.
    pub row: u32,
    /// Length L of the distance [m or -].
    pub length: T,
    /// Inverse of the length, 1 / L [1/m or -].
    pub inverse: T,
}

impl<T: Real> Distance<T> {
    #[inline(always)]
    fn difference<const D: usize>(&self, e: &[T]) -> Vector<T, D> {
        load::<T, D>(e, self.ends[1]) - load::<T, D>(e, self.ends[0])
    }

    #[inline(always)]
    fn write_gradient<const D: usize>(&self, d: &Vector<T, D>, jacobian: &mut [T]) {
        let g = d * self.inverse;
        let [a, b] = self.places;
        store(jacobian, a, &-g);
        store(jacobian, b, &g);
    }

    /// Writes value and gradient at `q`.
    #[inline(always)]
    pub fn evaluate<const D: usize>(&self, q: &[T], phi: &mut [T], jacobian: &mut [T]) {
        let d = self.difference::<D>(q);
        phi[self.row as usize] = (d.dot(&d) * self.inverse - self.length) * T::HALF;
        self.write_gradient(&d, jacobian);
    }

    /// Writes value and gradient at `q + dq`, from the value at `q`: phi = phi_n + (d_n + dd/2).dd / L. This is exact because phi
    /// is quadratic, and avoids the cancellation in d.d - L^2.
    #[inline(always)]
    pub fn advance<const D: usize>(
        &self,
        (q, dq): (&[T], &[T]),
        phi_n: &[T],
        phi: &mut [T],
        jacobian: &mut [T],
    ) {
        let (d, dd) = (self.difference::<D>(q), self.difference::<D>(dq));
        let row = self.row as usize;
        phi[row] = phi_n[row] + (d + dd * T::HALF).dot(&dd) * self.inverse;
        self.write_gradient(&(d + dd), jacobian);
    }

    /// The part of phi'' without accelerations.
    #[inline(always)]
    pub fn bias<const D: usize>(&self, v: &[T]) -> T {
        let w = self.difference::<D>(v);
        w.dot(&w) * self.inverse
    }
}
