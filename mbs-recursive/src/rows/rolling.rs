//! The rows of a disc, a ball or a blade on a plane; see [`RollingRows`](mbs_core::elements::RollingRows).
//!
//! ```text
//! r = c + rho       the lowest point;  r_1, r_2 from the origins of the body's link and of the plane's
//! u                 the plane's normal (height), a direction along it (no slip), n x d (blade)
//! K1 = (r_1 x u, u),   K2 = -(r_2 x u, u)
//! bias = u.(w_1 x (r' - v_1) - w_2 x (r' - v_2)) + u'.(v_1 + w_1 x r_1 - v_2 - w_2 x r_2)
//! ```
//!
//! c is the centre of the body and rho the vector from c to the lowest point. n is the normal of the plane and d the direction of the
//! blade. v and w are the velocity and angular velocity of the links, with 1 for the rolling body and 2 for the plane.

use crate::link::LinkMotion;
use crate::link::indexing::{Outside, at};
use crate::rows::{Row, RowValue};
use crate::space::Space;
use mbs_core::Real;
use mbs_core::algebra::{Vector, cross, unit};
use mbs_core::measure::{Moving, lies_flat, lowest_point};

/// True if this build supports rows of rolling bodies.
pub const IS_BUILT: bool = cfg!(feature = "rolling");

/// Motion of the rolling body, or of the body with the plane, as three-dimensional vectors.
struct Carrier<T: Real> {
    origin: Moving<T>,
    spin: Vector<T, 3>,
    /// Centre of the rolling body or a point of the plane, with the velocity of this point.
    point: Moving<T>,
}

impl<T: Real> Carrier<T> {
    fn new<S: Space<T>>(link: &LinkMotion<T, S>, point: &S::Point) -> Self {
        let spin = S::spin_into(&S::spin(&link.velocity));
        let origin = [S::point_into(&link.position), S::point_into(&S::point(&link.velocity))];
        let arm = S::point_into(&S::rotate(&link.rotation, point));
        let point = [origin[0] + arm, origin[1] + cross(&spin, &arm)];
        Self { origin, spin, point }
    }

    /// Returns the direction `x`, which is fixed in the body, with its rate.
    fn turning(&self, x: Vector<T, 3>) -> Moving<T> {
        [x, cross(&self.spin, &x)]
    }

    /// Returns the vector from the body's origin to a point, and the velocity of the body at this point. The third result is the part of
    /// the acceleration that is due to the motion of the point relative to the origin.
    fn carries(&self, [r, r_t]: &Moving<T>) -> [Vector<T, 3>; 3] {
        let arm = *r - self.origin[0];
        let velocity = self.origin[1] + cross(&self.spin, &arm);
        [arm, velocity, cross(&self.spin, &(*r_t - self.origin[1]))]
    }
}

/// Returns the normal of the plane, and the axis of the disc or the direction of the blade, from the first row of a rolling.
fn directions<T: Real, S: Space<T>>(
    first: &Row<T, S>,
    [body, on]: [&LinkMotion<T, S>; 2],
) -> Result<(Vector<T, 3>, Vector<T, 3>), Outside> {
    let (normal, axis) = match first {
        Row::Height { normal, axis, .. } => (normal, axis),
        Row::Blade { normal, direction } => (normal, direction),
        _ => return Err(Outside),
    };
    let is_across_plane = S::DIMENSION == 2 && matches!(first, Row::Blade { .. });
    let normal = S::point_into(&S::rotate(&on.rotation, normal));
    let normal = if is_across_plane { unit(2) } else { normal };
    Ok((normal, S::point_into(&S::rotate(&body.rotation, axis))))
}

/// Evaluates the rows of a rolling and passes each one to `take`, in order. The first row has the index `k`.
pub(crate) fn evaluate<T: Real, S: Space<T>>(
    (own, mut k): (&[Row<T, S>], usize),
    (links, points): ([&LinkMotion<T, S>; 2], &[S::Point; 2]),
    mut take: impl FnMut(usize, RowValue<T, S>) -> Result<(), Outside>,
) -> Result<(), Outside> {
    let first = at(own, 0)?;
    let (normal, axis) = directions(first, links)?;
    let [body, on] = [0, 1].map(|i| Carrier::new(links[i], &points[i]));
    let (normal, axis) = (on.turning(normal), body.turning(axis));
    let arm = match first {
        Row::Height { radius, .. } => lowest_point(*radius, &normal, &axis),
        _ => [Vector::zeros(); 2],
    };
    let lowest = [0, 1].map(|i| body.point[i] + arm[i]);
    let ([arm_1, velocity_1, drift_1], [arm_2, velocity_2, drift_2]) =
        (body.carries(&lowest), on.carries(&lowest));
    let (slip, drift) = (velocity_1 - velocity_2, drift_1 - drift_2);
    for row in own {
        let mut value = T::ZERO;
        let [u, u_t] = match row {
            Row::Height { .. } => {
                value = normal[0].dot(&(lowest[0] - on.point[0]));
                normal
            }
            Row::NoSlip { direction } => {
                on.turning(S::point_into(&S::rotate(&links[1].rotation, direction)))
            }
            Row::Blade { .. } => {
                let [n, n_t] = normal;
                [cross(&n, &axis[0]), cross(&n_t, &axis[0]) + cross(&n, &axis[1])]
            }
            _ => return Err(Outside),
        };
        let push = S::point_from(&u);
        let [first, second] = [&arm_1, &arm_2].map(|arm| S::wrench(&S::point_from(arm), &push));
        let bias = u.dot(&drift) + u_t.dot(&slip);
        take(k, RowValue { gradient: [first, -second], value, rate: u.dot(&slip), bias })?;
        k += 1;
    }
    Ok(())
}

/// True if the disc of this row lies flat on the plane, or if the direction of the blade is parallel to the normal of the plane.
pub(crate) fn is_flat<T: Real, S: Space<T>>(
    first: &Row<T, S>,
    links: [&LinkMotion<T, S>; 2],
) -> Result<bool, Outside> {
    let (normal, axis) = directions(first, links)?;
    Ok(lies_flat(&normal, &axis))
}
