//! Guided coordinate: a joint's angle or slide follows f(t). The coordinate is known, so none is added.
//!
//! ```text
//! slide:  phi = s x.y - f
//! angle:  phi = A.y,   A = cos f x2 - sin f x1,   B = sin f x2 + cos f x1
//!         phi_t = -f' B.y
//!         bias  = A_tt.y + 2 A_t.y',   A_t  = cos f x2' - sin f x1' - f' B
//!                                      A_tt = -2 f' (sin f x2' + cos f x1') - f'' B - f'^2 A
//! ```
//!
//! x1, x2 stand across the axis in the first body, y in the second. phi = sin(angle - f): regular for every angle; the
//! false root half a turn away has B.y < 0, see [`Guided::is_opposite`].

use super::combination::{Span, Term, add_gradient, combine};
use crate::Real;
use crate::algebra::Vector;

/// What is guided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GuidedMotion {
    /// An angle: x1 and x2 in the first body.
    Angle {
        /// Direction at angle zero.
        x1: Span,
        /// Direction a quarter turn further.
        x2: Span,
    },
    /// A distance along a direction.
    Slide {
        /// From the first body's point to the second's.
        x: Span,
    },
}

/// A rheonomic row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guided {
    /// Angle or slide.
    pub motion: GuidedMotion,
    /// Direction in the second body (angle), or of the slide.
    pub y: Span,
    /// Which guide value drives it.
    pub guide: u32,
    /// Row number.
    pub row: u32,
    /// The row's place in the Jacobian store.
    pub place: Span,
}

impl Guided {
    /// Value and gradient at `q`, with the guide at `f`.
    pub fn evaluate<T: Real, const D: usize>(
        &self,
        pool: &[Term<T>],
        q: &[T],
        f: T,
        store: (&mut [T], &mut [T]),
    ) {
        self.evaluate_with::<T, D>(pool, |x| combine(x.of(pool), q), f, store);
    }

    /// Value and gradient at `q + dq`.
    pub fn evaluate_at_sum<T: Real, const D: usize>(
        &self,
        pool: &[Term<T>],
        (q, dq): (&[T], &[T]),
        f: T,
        store: (&mut [T], &mut [T]),
    ) {
        let at = |x: Span| combine::<T, D>(x.of(pool), q) + combine::<T, D>(x.of(pool), dq);
        self.evaluate_with::<T, D>(pool, at, f, store);
    }

    fn evaluate_with<T: Real, const D: usize>(
        &self,
        pool: &[Term<T>],
        at: impl Fn(Span) -> Vector<T, D>,
        f: T,
        (phi, jacobian): (&mut [T], &mut [T]),
    ) {
        let y = at(self.y);
        let row = self.place.of_mut(jacobian);
        row.fill(T::ZERO);
        match self.motion {
            GuidedMotion::Slide { x } => {
                let x_value = at(x);
                phi[self.row as usize] = x_value.dot(&y) - f;
                add_gradient(row, x.of(pool), &y);
                add_gradient(row, self.y.of(pool), &x_value);
            }
            GuidedMotion::Angle { x1, x2 } => {
                let (sin, cos) = f.sin_cos();
                let a = at(x2) * cos - at(x1) * sin;
                phi[self.row as usize] = a.dot(&y);
                add_gradient(row, x2.of(pool), &(y * cos));
                add_gradient(row, x1.of(pool), &(y * -sin));
                add_gradient(row, self.y.of(pool), &a);
            }
        }
    }

    /// The partial derivative of phi with respect to time.
    pub fn phi_t<T: Real, const D: usize>(&self, pool: &[Term<T>], q: &[T], f: [T; 3]) -> T {
        match self.motion {
            GuidedMotion::Slide { .. } => -f[1],
            GuidedMotion::Angle { .. } => -f[1] * self.cosine::<T, D>(pool, q, f[0]),
        }
    }

    /// B.y, the cosine of the deviation from the guide (one on the path).
    fn cosine<T: Real, const D: usize>(&self, pool: &[Term<T>], q: &[T], f: T) -> T {
        match self.motion {
            GuidedMotion::Slide { .. } => T::ONE,
            GuidedMotion::Angle { x1, x2 } => {
                let (sin, cos) = f.sin_cos();
                let b =
                    combine::<T, D>(x2.of(pool), q) * sin + combine::<T, D>(x1.of(pool), q) * cos;
                b.dot(&combine::<T, D>(self.y.of(pool), q))
            }
        }
    }

    /// Does the angle sit at the false root, half a turn from the guide?
    pub fn is_opposite<T: Real, const D: usize>(&self, pool: &[Term<T>], q: &[T], f: T) -> bool {
        self.cosine::<T, D>(pool, q, f) < T::ZERO
    }

    /// The part of phi'' without accelerations.
    pub fn bias<T: Real, const D: usize>(
        &self,
        pool: &[Term<T>],
        (q, v): (&[T], &[T]),
        f: [T; 3],
    ) -> T {
        let yt: Vector<T, D> = combine(self.y.of(pool), v);
        match self.motion {
            GuidedMotion::Slide { x } => combine::<T, D>(x.of(pool), v).dot(&yt) * T::TWO - f[2],
            GuidedMotion::Angle { x1, x2 } => {
                let (sin, cos) = f[0].sin_cos();
                let y: Vector<T, D> = combine(self.y.of(pool), q);
                let (p1, p2) = (combine::<T, D>(x1.of(pool), q), combine::<T, D>(x2.of(pool), q));
                let (w1, w2) = (combine::<T, D>(x1.of(pool), v), combine::<T, D>(x2.of(pool), v));
                let (a, b) = (p2 * cos - p1 * sin, p2 * sin + p1 * cos);
                let a_t = w2 * cos - w1 * sin - b * f[1];
                let a_tt = (w2 * sin + w1 * cos) * (-T::TWO * f[1]) - b * f[2] - a * (f[1] * f[1]);
                a_tt.dot(&y) + a_t.dot(&yt) * T::TWO
            }
        }
    }
}
