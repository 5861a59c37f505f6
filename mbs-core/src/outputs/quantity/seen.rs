//! Material point relative to a body that moves and rotates.
//!
//! ```text
//! r = p - o,   x = R^T r,   x' = R^T (r' - w x r),   x'' = R^T (r'' - w' x r - w x (w x r) - 2 w x (r' - w x r))
//! ```
//!
//! p is the point and o the origin on the body. R is the rotation matrix of the body, w its angular velocity. x is the position of the
//! point in axes of the body.

use super::super::frame::Frame;
use super::kind::Maker;
use crate::Real;
use crate::algebra::{Vector, cross, norm, raised};
use crate::model::State;
use crate::natural::Affine;
use crate::scene::RelativePoint;

/// Material point, and the body to which it is relative.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct SeenPoint<T: Real, const D: usize> {
    /// Vector from the origin to the point.
    gap: Affine<T, D>,
    frame: Frame<T, D>,
}

impl<T: Real, const D: usize> SeenPoint<T, D> {
    /// Prepares the point of a quantity.
    pub(super) fn new(of: &RelativePoint<T>, from: &Maker<'_, T, D>) -> Self {
        let (point, origin) =
            (from.model.point(of.body, of.at), from.model.point(of.relative_to, of.origin));
        let frame = Frame::new(from.model, of.relative_to);
        Self { gap: point.minus(&origin), frame }
    }

    /// Vector r, and its rate relative to the body, in global axes.
    fn motion(&self, state: &State<T>) -> [Vector<T, 3>; 2] {
        let r = raised(&self.gap.value(&state.q));
        let spin = self.frame.turning(&state.q, &state.v);
        [r, raised(&self.gap.rate(&state.v)) - cross(&spin, &r)]
    }

    /// Distance of the point from the origin [m].
    pub(super) fn distance(&self, state: &State<T>) -> T {
        norm(&self.gap.value(&state.q))
    }

    /// Writes the position of the point, in axes of the body.
    pub(super) fn position(&self, state: &State<T>, out: &mut [T]) {
        self.write(state, raised(&self.gap.value(&state.q)), out);
    }

    /// Writes the velocity of the point relative to the body, in axes of the body.
    pub(super) fn velocity(&self, state: &State<T>, out: &mut [T]) {
        self.write(state, self.motion(state)[1], out);
    }

    /// Writes the acceleration of the point relative to the body, in axes of the body.
    pub(super) fn acceleration(&self, state: &State<T>, out: &mut [T]) {
        let [r, rate] = self.motion(state);
        let [spin, spin_t] = [&state.v, &state.a].map(|x| self.frame.turning(&state.q, x));
        let carried = cross(&spin_t, &r) + cross(&spin, &cross(&spin, &r));
        let turning = cross(&spin, &rate) * T::TWO;
        self.write(state, raised(&self.gap.rate(&state.a)) - carried - turning, out);
    }

    fn write(&self, state: &State<T>, x: Vector<T, 3>, out: &mut [T]) {
        let x = self.frame.rotation(&state.q).transpose() * x;
        out.copy_from_slice(&x.as_slice()[..D]);
    }
}
