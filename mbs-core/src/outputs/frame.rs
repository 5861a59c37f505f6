//! Rotation and angular velocity of a body, computed from its directions.
//!
//! ```text
//! R = [u1 u2 u3],   omega = 1/2 sum u_k x u_k',   omega' = 1/2 sum u_k x u_k''      u_k: direction that was axis k in the reference
//! rod (d: unit vector along the rod, d0: d in the reference configuration):
//!     R = the smallest rotation that carries d0 to d,   omega = d x d',   omega' = d x d''
//! ```

use crate::Real;
use crate::algebra::{Matrix, Vector, across, cross, norm, raised, rotation, unit};
use crate::natural::{Affine, NaturalModel, Shape};
use crate::scene::BodyId;
use alloc::boxed::Box;

/// Directions from which the rotation of a body follows.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Frame<T: Real, const D: usize> {
    /// Direction in the plane that was the x axis in the reference configuration.
    Planar(Affine<T, D>),
    /// Directions in space that were the three axes in the reference configuration.
    Full(Box<[Affine<T, D>; 3]>),
    /// Spatial rod of two points: the vector between its end points, now and in the reference configuration.
    Rod { along: Affine<T, D>, reference: Vector<T, 3> },
    /// Point mass, which has no orientation.
    Point,
}

impl<T: Real, const D: usize> Frame<T, D> {
    /// Frame of a body or of the ground.
    pub(super) fn new(model: &NaturalModel<T, D>, body: BodyId) -> Self {
        match model.shape(body) {
            Shape::Point => Self::Point,
            Shape::Full if D == 2 => Self::Planar(model.direction(body, unit(0).into())),
            Shape::Full => {
                Self::Full(Box::new([0, 1, 2].map(|i| model.direction(body, unit(i).into()))))
            }
            Shape::Rod([from, to]) => {
                let along = model.point(body, to.into()).minus(&model.point(body, from.into()));
                Self::Rod { along, reference: normalised(&(to - from)) }
            }
        }
    }

    /// Rotation matrix R from the reference configuration. Its columns are the present directions of the body-fixed axes that coincide with
    /// the global axes in the reference configuration.
    pub(super) fn rotation(&self, q: &[T]) -> Matrix<T, 3> {
        match self {
            Self::Planar(x) => {
                let u = x.value(q);
                let mut r = Matrix::<T, 3>::identity();
                (r[(0, 0)], r[(1, 1)], r[(1, 0)], r[(0, 1)]) = (u[0], u[0], u[1], -u[1]);
                r
            }
            Self::Full(axes) => Matrix::from_columns(&[0, 1, 2].map(|i| raised(&axes[i].value(q)))),
            Self::Rod { along, reference } => {
                carry(reference, &normalised(&raised(&along.value(q))))
            }
            Self::Point => Matrix::identity(),
        }
    }

    /// Angular velocity if `x` are velocities; angular acceleration if `x` are accelerations.
    pub(super) fn turning(&self, q: &[T], x: &[T]) -> Vector<T, 3> {
        let arm = |u: &Affine<T, D>| cross(&raised(&u.value(q)), &raised(&u.rate(x)));
        match self {
            Self::Planar(u) => arm(u),
            Self::Full(axes) => (arm(&axes[0]) + arm(&axes[1]) + arm(&axes[2])) * T::HALF,
            Self::Rod { along, .. } => {
                let d = along.value(q);
                arm(along) * (T::ONE / d.dot(&d))
            }
            Self::Point => Vector::zeros(),
        }
    }
}

/// Smallest rotation that turns unit vector `a` into unit vector `b`. If they are opposite, it is half a turn about one perpendicular axis.
///
/// ```text
/// R = 1 + [w] + [w]^2 / (1 + a.b),   w = a x b
/// ```
pub fn carry<T: Real>(a: &Vector<T, 3>, b: &Vector<T, 3>) -> Matrix<T, 3> {
    let (w, share) = (cross(a, b), T::ONE + a.dot(b));
    if share <= T::EPSILON {
        return rotation(&(across(a) * T::PI));
    }
    let columns = [0, 1, 2].map(|i| {
        let e = unit(i);
        let turned = cross(&w, &e);
        e + turned + cross(&w, &turned) * (T::ONE / share)
    });
    Matrix::from_columns(&columns)
}

/// Unit vector x / |x|; the zero vector does not change.
pub fn normalised<T: Real>(x: &Vector<T, 3>) -> Vector<T, 3> {
    let length = norm(x);
    if length > T::ZERO { x * (T::ONE / length) } else { *x }
}
