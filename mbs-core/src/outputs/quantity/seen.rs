//! A point as seen from a body that moves and turns.
//!
//! ```text
//! r = p - o,   x = R^T r,   x' = R^T (r' - w x r),   x'' = R^T (r'' - w' x r - w x (w x r) - 2 w x (r' - w x r))
//! ```

use super::super::frame::Frame;
use super::kind::Maker;
use crate::Real;
use crate::algebra::{Vector, cross, norm, raised};
use crate::model::State;
use crate::natural::Affine;
use crate::scene::RelativePoint;

/// A point, and the body that it is seen from.
#[derive(Debug, Clone)]
pub(in crate::outputs) struct SeenPoint<T: Real, const D: usize> {
    /// From the origin to the point.
    gap: Affine<T, D>,
    frame: Frame<T, D>,
}

impl<T: Real, const D: usize> SeenPoint<T, D> {
    /// The point of a quantity.
    pub(super) fn new(of: &RelativePoint<T>, from: &Maker<'_, T, D>) -> Self {
        let (point, origin) =
            (from.model.point(of.body, of.at), from.model.point(of.relative_to, of.origin));
        let frame = Frame::new(from.model, of.relative_to);
        Self { gap: point.minus(&origin), frame }
    }

    /// r, and r' without the turning of the body, global axes.
    fn motion(&self, state: &State<T>) -> [Vector<T, 3>; 2] {
        let r = raised(&self.gap.value(&state.q));
        let spin = self.frame.turning(&state.q, &state.v);
        [r, raised(&self.gap.rate(&state.v)) - cross(&spin, &r)]
    }

    /// Its distance from the origin.
    pub(super) fn distance(&self, state: &State<T>) -> T {
        norm(&self.gap.value(&state.q))
    }

    /// Its position, in the body's axes.
    pub(super) fn position(&self, state: &State<T>, out: &mut [T]) {
        self.write(state, raised(&self.gap.value(&state.q)), out);
    }

    /// Its velocity against the body, in the body's axes.
    pub(super) fn velocity(&self, state: &State<T>, out: &mut [T]) {
        self.write(state, self.motion(state)[1], out);
    }

    /// Its acceleration against the body, in the body's axes.
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
