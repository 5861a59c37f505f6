//! Rolling elements: the rows of a disc, a ball or a blade on a plane.
//!
//! ```text
//! c, d_i    centre and directions of the body            p, e_i, n    a point, directions and the normal of the plane's body
//! r = c + rho                                             the lowest point; x_i = d_i.rho, y_i = e_i.(r - p), held fixed in s
//! s = c' + sum_i d_i' x_i - p' - sum_i e_i' y_i           its velocity as a point of the body, less that as a point of the plane's body
//! height    n.(r - p) = 0                                 rate n.s
//! no slip   t_k.s = 0                                     velocity rows: t_1, t_2 along the plane, fixed in it
//! blade     (n x d).s = 0                                 d the direction along which it may move
//! bias      u.(sum_i d_i' x_i' - sum_i e_i' y_i') + u'.s
//! ```
//!
//! The gradient of the height is that of n.s, up to multiples of the rows that keep d_i and e_i of unit length. The lowest point
//! moves along the rim, perpendicular to n.

use super::combination::{Span, Term, add_gradient, combine};
use crate::Real;
use crate::algebra::{Vector, cross, lowered, raised, unit};
use crate::measure::{Moving, lies_flat, lowest_point};

/// Rolling in natural coordinates, with one row or more.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollingRows<T: Real> {
    /// Radius of a disc or ball [m].
    pub radius: T,
    /// True if the element is a blade.
    pub is_blade: bool,
    /// Frame of the rolling body: its centre, or the point of a blade, and its directions along the global axes of the reference
    /// configuration.
    pub body: RollingFrame,
    /// Frame of the plane's body: a point of the plane, and directions.
    pub on: RollingFrame,
    /// Axis of a disc, or direction of a blade, in the rolling body.
    pub axis: Vector<T, 3>,
    /// Normal, then two directions along the plane, in the plane's body.
    pub plane: [Vector<T, 3>; 3],
    /// Number of the first row.
    pub row: u32,
    /// Number of the element's rows. The height is the first row, unless the element is a blade.
    pub n: u32,
    /// Place of the rows in the Jacobian store.
    pub place: Span,
}

/// Point and directions that are fixed in a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RollingFrame {
    /// Point of the frame.
    pub point: Span,
    /// Directions of the frame. In the plane only two are used.
    pub axes: [Span; 3],
}

/// Frame with the rates of its point and directions.
struct Placed<T: Real> {
    point: Moving<T>,
    axes: [Moving<T>; 3],
}

impl<T: Real> Placed<T> {
    /// Vector that is fixed in the frame, with its rate.
    fn turned(&self, x: &Vector<T, 3>) -> Moving<T> {
        let mut sum = [Vector::zeros(); 2];
        for (axis, &x) in self.axes.iter().zip(x.iter()) {
            sum = [sum[0] + axis[0] * x, sum[1] + axis[1] * x];
        }
        sum
    }

    /// Components of a vector along the directions, and their rates.
    fn components(&self, x: &Moving<T>) -> [[T; 2]; 3] {
        self.axes.map(|[e, e_t]| [e.dot(&x[0]), e_t.dot(&x[0]) + e.dot(&x[1])])
    }

    /// Velocity of a point that is fixed in the frame, given by its components x_i along the directions e_i.
    fn velocity(&self, x: &[[T; 2]; 3]) -> Vector<T, 3> {
        let parts = self.axes.iter().zip(x);
        parts.fold(self.point[1], |sum, ([_, e_t], [x, _])| sum + e_t * *x)
    }

    /// Sum of ė_i ẋ_i: part of the point's acceleration from the rates ẋ_i of its components along the moving directions e_i.
    fn drift(&self, x: &[[T; 2]; 3]) -> Vector<T, 3> {
        let parts = self.axes.iter().zip(x);
        parts.fold(Vector::zeros(), |sum, ([_, e_t], [_, x_t])| sum + e_t * *x_t)
    }
}

/// Rolling body and plane at one instant.
struct Instant<T: Real> {
    body: Placed<T>,
    on: Placed<T>,
    normal: Moving<T>,
    /// Vector from the point of the plane to the lowest point.
    gap: Moving<T>,
    /// Components of the lowest point, each with its rate. First: from the centre of the body, along the body's directions. Second:
    /// from the point of the plane, along the directions of the plane's body.
    parts: [[[T; 2]; 3]; 2],
}

impl<T: Real> RollingRows<T> {
    /// Numbers of the velocity rows.
    pub fn slip_rows(&self) -> core::ops::Range<usize> {
        let held = u32::from(!self.is_blade);
        (self.row + held) as usize..(self.row + self.n) as usize
    }

    fn instant<const D: usize>(&self, at: impl Fn(Span) -> Moving<T>) -> Instant<T> {
        let placed = |frame: &RollingFrame| {
            let axis = |i: usize| {
                if i < D { at(frame.axes[i]) } else { [unit(i), Vector::zeros()] }
            };
            Placed { point: at(frame.point), axes: [axis(0), axis(1), axis(2)] }
        };
        let (body, on) = (placed(&self.body), placed(&self.on));
        let normal = on.turned(&self.plane[0]);
        let arm = if self.is_blade {
            [Vector::zeros(); 2]
        } else {
            lowest_point(self.radius, &normal, &body.turned(&self.axis))
        };
        let gap = [0, 1].map(|i| body.point[i] + arm[i] - on.point[i]);
        let parts = [body.components(&arm), on.components(&gap)];
        Instant { body, on, normal, gap, parts }
    }

    /// Direction u of a row, which constrains the velocity u.s. Row 0 is the first row.
    fn direction(&self, row: usize, now: &Instant<T>) -> Moving<T> {
        if self.is_blade {
            let ([n, n_t], [d, d_t]) = (now.normal, now.body.turned(&self.axis));
            return [cross(&n, &d), cross(&n_t, &d) + cross(&n, &d_t)];
        }
        now.on.turned(&self.plane[row])
    }

    /// Writes heights and gradients at `q`. Velocity rows have the value zero.
    pub fn evaluate<const D: usize>(&self, pool: &[Term<T>], q: &[T], out: (&mut [T], &mut [T])) {
        self.evaluate_with::<D>(pool, |x| [value::<T, D>(pool, x, q), Vector::zeros()], out);
    }

    /// Writes heights and gradients at `q + dq`. Velocity rows have the value zero.
    pub fn advance<const D: usize>(
        &self,
        pool: &[Term<T>],
        (q, dq): (&[T], &[T]),
        out: (&mut [T], &mut [T]),
    ) {
        let at = |x| value::<T, D>(pool, x, q) + value::<T, D>(pool, x, dq);
        self.evaluate_with::<D>(pool, |x| [at(x), Vector::zeros()], out);
    }

    fn evaluate_with<const D: usize>(
        &self,
        pool: &[Term<T>],
        at: impl Fn(Span) -> Moving<T>,
        (phi, jacobian): (&mut [T], &mut [T]),
    ) {
        let now = self.instant::<D>(at);
        let rows = self.place.of_mut(jacobian);
        rows.fill(T::ZERO);
        let width = rows.len() / (self.n as usize).max(1);
        for (k, row) in rows.chunks_exact_mut(width.max(1)).enumerate() {
            let [u, _] = self.direction(k, &now);
            let is_height = k == 0 && !self.is_blade;
            phi[self.row as usize + k] = if is_height { u.dot(&now.gap[0]) } else { T::ZERO };
            let frames = [(&self.body, T::ONE), (&self.on, -T::ONE)];
            for ((frame, sign), parts) in frames.into_iter().zip(&now.parts) {
                let u = lowered::<T, D>(&(u * sign));
                add_gradient(row, frame.point.of(pool), &u);
                for (axis, [x, _]) in frame.axes.iter().zip(parts).take(D) {
                    add_gradient(row, axis.of(pool), &(u * *x));
                }
            }
        }
    }

    /// Writes the parts of the rows' second derivatives without accelerations, row after row.
    pub fn bias<const D: usize>(&self, pool: &[Term<T>], (q, v): (&[T], &[T]), bias: &mut [T]) {
        let now = self.instant::<D>(|x| [q, v].map(|e| value::<T, D>(pool, x, e)));
        let [own, of_plane] = &now.parts;
        let slip = now.body.velocity(own) - now.on.velocity(of_plane);
        let drift = now.body.drift(own) - now.on.drift(of_plane);
        for (k, bias) in bias.iter_mut().enumerate().take(self.n as usize) {
            let [u, u_t] = self.direction(k, &now);
            *bias = u.dot(&drift) + u_t.dot(&slip);
        }
    }

    /// True if the disc is flat on the plane at `q`, or the blade is along the normal of the plane.
    pub fn is_flat<const D: usize>(&self, pool: &[Term<T>], q: &[T]) -> bool {
        let now = self.instant::<D>(|x| [value::<T, D>(pool, x, q), Vector::zeros()]);
        lies_flat(&now.normal[0], &now.body.turned(&self.axis)[0])
    }
}

/// Value of a combination, as a vector with three components.
fn value<T: Real, const D: usize>(pool: &[Term<T>], x: Span, e: &[T]) -> Vector<T, 3> {
    raised(&combine::<T, D>(x.of(pool), e))
}
