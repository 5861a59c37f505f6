//! Work of the three passes at one joint, for each kind of joint.
//!
//! ```text
//! place      R, ω, v of the link from the parent's     [P3 (26)]
//! eliminate  U = I b, D = bᵀ U, u = τ − bᵀ p           [P3 (36)–(38)]
//! advance    z'' = D⁻¹ (u − Uᵀ a')                      [P3 (35)]
//! pass       rows K of loops: K ← K − (K b) D⁻¹ Uᵀ
//! ```
//!
//! I and p are the articulated inertia and the bias force of the link. b is the motion of the link for unit rate z' of the joint, τ the
//! effort along the joint. a' is the acceleration of the link for z'' = 0.

use crate::link::indexing::{Outside, at, at_mut, part, part_mut};
use crate::link::{ArticulatedInertia, Link, LinkKind, LinkMotion};
use crate::space::{Numbers, Space};
use mbs_core::Real;
use mbs_core::algebra::{Vector, norm};
use mbs_core::laws::spin::spin;

/// Error: the links beyond a joint have no inertia along the freedom of the joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoInertia<T> {
    /// Index of the link that the joint carries.
    pub link: u32,
    /// Pivot bᵀ I b that was computed.
    pub pivot: T,
}

/// Returns place and motion of a link from its parent and its joint's coordinates. Without `MOVES` all velocities are zero.
#[inline(always)]
pub(crate) fn place<T: Real, S: Space<T>, const MOVES: bool>(
    link: &Link<T, S>,
    parent: &LinkMotion<T, S>,
    z: &[T],
    v: &[T],
    guides: &[[T; 3]],
) -> Result<LinkMotion<T, S>, Outside> {
    let still =
        |freedom, rotation, arm| carried::<T, S, MOVES>(link, parent, (freedom, rotation, arm));
    let number = || link.coordinate((z, v, guides));
    Ok(match link.kind {
        LinkKind::Revolute | LinkKind::GuidedRevolute => {
            let [angle, rate, second] = number()?;
            // revolute joint: ω = ω_p + n z',   d = (ω_p × n z', ω_p × (ω_p × r))
            let axis = S::rotate_spin(&parent.rotation, &link.axis);
            let rotation = S::turned(&parent.rotation, &link.axis, angle);
            let arm = S::rotate(&parent.rotation, &link.offset);
            let mut p = still(S::motion(axis, S::Point::zero()), rotation, arm);
            if MOVES {
                let spin = S::spin(&parent.velocity);
                let turning = S::cross_spin(&spin, &axis) * rate + axis * second;
                p.velocity += S::motion(axis * rate, S::Point::zero());
                p.bias += S::motion(turning, S::Point::zero());
            }
            p
        }
        LinkKind::Prismatic | LinkKind::GuidedPrismatic => {
            let [slide, rate, second] = number()?;
            // prismatic joint: v = v_p + ω_p × r + e z',   d = (0, ω_p × (ω_p × r) + 2 ω_p × e z')
            let along = S::rotate(&parent.rotation, &link.direction);
            let arm = S::rotate(&parent.rotation, &link.offset) + along * slide;
            let mut p = still(S::motion(S::Spin::zero(), along), parent.rotation, arm);
            if MOVES {
                let turning = S::cross(&S::spin(&parent.velocity), &along) * (T::TWO * rate);
                p.velocity += S::motion(S::Spin::zero(), along * rate);
                p.bias += S::motion(S::Spin::zero(), turning + along * second);
            }
            p
        }
        LinkKind::Ball => ball::<T, S, MOVES>(link, parent, z, v)?,
        LinkKind::GuidedBall => guided_ball::<T, S, MOVES>(link, parent, guides)?,
        LinkKind::Free => free::<T, S, MOVES>(link, parent, z, v)?,
    })
}

/// Returns place and motion of a link at the present position of its joint, as if the rate of the joint were zero. The caller adds the rate
/// of the joint to velocity and bias.
#[inline(always)]
fn carried<T: Real, S: Space<T>, const MOVES: bool>(
    link: &Link<T, S>,
    parent: &LinkMotion<T, S>,
    (freedom, rotation, arm): (S::Motion, S::Rotation, S::Point),
) -> LinkMotion<T, S> {
    let (velocity, bias) = if MOVES {
        let spin = S::spin(&parent.velocity);
        let bias = S::motion(S::Spin::zero(), S::centrifugal(&spin, &arm));
        (S::carried(&parent.velocity, &arm), bias)
    } else {
        (S::Motion::zero(), S::Motion::zero())
    };
    let center = S::rotate(&rotation, &link.center);
    let position = parent.position + arm;
    LinkMotion { rotation, position, arm, freedom, velocity, bias, center }
}

#[inline(always)]
fn ball<T: Real, S: Space<T>, const MOVES: bool>(
    link: &Link<T, S>,
    parent: &LinkMotion<T, S>,
    z: &[T],
    v: &[T],
) -> Result<LinkMotion<T, S>, Outside> {
    // ball joint: ω = ω_p + w, w = R v,   d = (ω_p × w, ω_p × (ω_p × r))
    let arm = S::rotate(&parent.rotation, &link.offset);
    let turn = part(z, link.z as usize, S::FREE - S::Point::N)?;
    let rotation = S::turned_by(&parent.rotation, turn);
    let mut p = carried::<T, S, MOVES>(link, parent, (S::Motion::zero(), rotation, arm));
    if MOVES {
        let w = S::rotate_spin(&rotation, &read(v, link.v as usize)?);
        p.velocity += S::motion(w, S::Point::zero());
        p.bias += S::motion(S::cross_spin(&S::spin(&parent.velocity), &w), S::Point::zero());
    }
    Ok(p)
}

#[inline(always)]
fn free<T: Real, S: Space<T>, const MOVES: bool>(
    link: &Link<T, S>,
    parent: &LinkMotion<T, S>,
    z: &[T],
    v: &[T],
) -> Result<LinkMotion<T, S>, Outside> {
    let (zi, vi) = (link.z as usize, link.v as usize);
    let turn = part(z, zi, S::FREE - S::Point::N)?;
    let rotation = S::turned_by(&S::identity(), turn);
    let position: S::Point = read(z, zi + S::FREE - S::Point::N)?;
    let mut p = carried::<T, S, MOVES>(link, parent, (S::Motion::zero(), rotation, position));
    if MOVES {
        let w = S::rotate_spin(&rotation, &read(v, vi)?);
        p.velocity = S::motion(w, read(v, vi + S::Spin::N)?);
    }
    Ok(p)
}

/// True if this build supports guided balls. Tables for controllers have no guided balls.
pub(crate) const HAS_GUIDED_BALLS: bool = cfg!(feature = "alloc");

/// Returns place and motion of a link whose rotation relative to its parent is prescribed by a guided ball.
#[inline(never)]
fn guided_ball<T: Real, S: Space<T>, const MOVES: bool>(
    link: &Link<T, S>,
    parent: &LinkMotion<T, S>,
    guides: &[[T; 3]],
) -> Result<LinkMotion<T, S>, Outside> {
    if !HAS_GUIDED_BALLS {
        return Err(Outside);
    }
    let f = guided_vector(link, guides)?;
    let angle = norm(&f[0]);
    // if the angle is zero, any axis gives the identity
    let axis = if angle > T::ZERO { f[0] * (T::ONE / angle) } else { f[0] };
    let rotation = S::turned(&parent.rotation, &S::spin_from(&axis), angle);
    // guided ball: ω = ω_p + w,   d = (ω_p × w + R_p ω'(f), ω_p × (ω_p × r)),   w = R_p ω(f)
    let [w, second] = spin(f).map(|w| S::rotate_spin(&parent.rotation, &S::spin_from(&w)));
    let arm = S::rotate(&parent.rotation, &link.offset);
    let freedom = S::motion(w, S::Point::zero());
    let mut p = carried::<T, S, MOVES>(link, parent, (freedom, rotation, arm));
    if MOVES {
        let turning = S::cross_spin(&S::spin(&parent.velocity), &w) + second;
        p.velocity += freedom;
        p.bias += S::motion(turning, S::Point::zero());
    }
    Ok(p)
}

/// Returns the rotation vector of a guided ball's link relative to its parent, with its first two derivatives.
pub(crate) fn guided_vector<T: Real, S: Space<T>>(
    link: &Link<T, S>,
    guides: &[[T; 3]],
) -> Result<[Vector<T, 3>; 3], Outside> {
    let mut f = [Vector::<T, 3>::zeros(); 3];
    for i in 0..3 {
        let guide = at(guides, link.v as usize + i)?;
        for (vector, &number) in f.iter_mut().zip(guide) {
            vector[i] = number * link.axis[0];
        }
    }
    Ok(f)
}

/// Reads consecutive numbers of a slice, beginning at index `first`.
#[inline(always)]
pub(crate) fn read<T: Real, X: Numbers<T>>(from: &[T], first: usize) -> Result<X, Outside> {
    let mut x = X::zero();
    for (i, &from) in part(from, first, X::N)?.iter().enumerate() {
        x[i] = from;
    }
    Ok(x)
}

/// Writes numbers into a slice, beginning at index `first`.
#[inline(always)]
pub(crate) fn write<T: Real, X: Numbers<T>>(
    x: &X,
    to: &mut [T],
    first: usize,
) -> Result<(), Outside> {
    for (i, to) in part_mut(to, first, X::N)?.iter_mut().enumerate() {
        *to = x[i];
    }
    Ok(())
}

/// Eliminates the joint: factors its inertia, and returns the articulated inertia and force (I^a, p^a) that act on the parent.
#[inline(always)]
pub(crate) fn eliminate<T: Real, S: Space<T>>(
    kind: LinkKind,
    p: &LinkMotion<T, S>,
    c: &mut ArticulatedInertia<T, S>,
) -> Result<(S::Inertia, S::Motion), T> {
    /// Largest pivot that counts as no inertia, relative to the magnitude of the inertia and in units of machine precision [-]. Chosen, not
    /// tuned.
    const ROUNDINGS: f64 = 64.0;
    let rounding = T::EPSILON * T::from_f64(ROUNDINGS);
    match kind {
        LinkKind::Revolute | LinkKind::Prismatic => {
            let (turning, moving) = S::size(&c.inertia);
            let (column, pivot, size) = if kind == LinkKind::Revolute {
                let n = S::spin(&p.freedom);
                let column = S::times_spin(&c.inertia, &n);
                (column, S::spin(&column).dot(&n), turning)
            } else {
                let d = S::point(&p.freedom);
                let column = S::times_point(&c.inertia, &d);
                (column, S::point(&column).dot(&d), moving)
            };
            if !(pivot > rounding * size) {
                return Err(pivot);
            }
            // articulated inertia on the parent's side: K I = I − U D⁻¹ Uᵀ   [P3 (36)–(37)]
            (c.column, c.inverse) = (column, T::ONE / (pivot + c.resistance));
            let left = S::reduced(&c.inertia, &c.column, c.inverse);
            // bias force on the parent's side: p + I^a d + U D⁻¹ u   [P3 (38)]
            let force = impulse(kind, p, c) + S::times(&left, &p.bias);
            Ok((left, force))
        }
        LinkKind::Ball => {
            if !S::invert_turning(&mut c.inertia) {
                return Err(S::size(&c.inertia).0);
            }
            let left = S::ball_reduced(&c.inertia);
            let force = impulse(kind, p, c) + S::times(&left, &p.bias);
            Ok((left, force))
        }
        LinkKind::Free => {
            if !S::factor(&mut c.inertia) {
                return Err(S::size(&c.inertia).0);
            }
            Ok((S::no_inertia(), impulse(kind, p, c)))
        }
        LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic | LinkKind::GuidedBall => {
            Ok((c.inertia, c.force + S::times(&c.inertia, &p.bias)))
        }
    }
}

/// Computes u = τ − bᵀ p, and the part of p that acts on the parent without the bias: p + U D⁻¹ u.
#[inline(always)]
pub(crate) fn impulse<T: Real, S: Space<T>>(
    kind: LinkKind,
    p: &LinkMotion<T, S>,
    c: &mut ArticulatedInertia<T, S>,
) -> S::Motion {
    match kind {
        LinkKind::Revolute => {
            c.drive[0] = c.effort - S::spin(&p.freedom).dot(&S::spin(&c.force));
            c.force + c.column * (c.drive[0] * c.inverse)
        }
        LinkKind::Prismatic => {
            c.drive[0] = c.effort - S::point(&p.freedom).dot(&S::point(&c.force));
            c.force + c.column * (c.drive[0] * c.inverse)
        }
        LinkKind::Ball => {
            let u = -S::spin(&c.force);
            c.drive = S::motion(u, S::Point::zero());
            let turned = S::ball_solve(&c.inertia, &u);
            S::motion(S::Spin::zero(), S::point(&c.force) + S::ball_column(&c.inertia, &turned))
        }
        LinkKind::Free => {
            c.drive = -c.force;
            S::Motion::zero()
        }
        LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic | LinkKind::GuidedBall => c.force,
    }
}

/// Computes z'' = D⁻¹ (u − Uᵀ a') in world axes, minus the response to the multipliers of loops. Returns the link's acceleration.
#[inline(always)]
pub(crate) fn advance<T: Real, S: Space<T>>(
    link: &Link<T, S>,
    p: &LinkMotion<T, S>,
    c: &ArticulatedInertia<T, S>,
    (carried, held): (S::Motion, &S::Motion),
    zdd: &mut [T],
) -> Result<S::Motion, Outside> {
    let first = link.v as usize;
    Ok(match link.kind {
        LinkKind::Revolute | LinkKind::Prismatic => {
            let x = c.inverse * (c.drive[0] - c.column.dot(&carried)) - held[0];
            *at_mut(zdd, first)? = x;
            carried + p.freedom * x
        }
        LinkKind::Ball => {
            // acceleration of the ball joint: A⁻¹ (u − A ω'' − H a)
            let rest = S::spin(&c.drive) - S::ball_row(&c.inertia, &S::point(&carried));
            let turn = S::ball_solve(&c.inertia, &rest) - S::spin(&carried) - S::spin(held);
            write(&S::unrotate_spin(&p.rotation, &turn), zdd, first)?;
            carried + S::motion(turn, S::Point::zero())
        }
        LinkKind::Free => {
            let a = S::solve(&c.inertia, &c.drive) - *held;
            let x = a - carried;
            write(&S::unrotate_spin(&p.rotation, &S::spin(&x)), zdd, first)?;
            write(&S::point(&x), zdd, first + S::Spin::N)?;
            a
        }
        LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic | LinkKind::GuidedBall => carried,
    })
}

/// Passes the row k of a loop through the joint: h = bᵀ k, g = D⁻¹ h, then k − U g on the parent's side. h and g have one number for each
/// freedom of the joint.
#[inline(always)]
pub(crate) fn pass<T: Real, S: Space<T>>(
    kind: LinkKind,
    p: &LinkMotion<T, S>,
    c: &ArticulatedInertia<T, S>,
    k: &S::Motion,
    (h, g): (&mut [T], &mut [T]),
) -> Result<S::Motion, Outside> {
    Ok(match kind {
        LinkKind::Revolute | LinkKind::Prismatic => {
            let head = if kind == LinkKind::Revolute {
                S::spin(&p.freedom).dot(&S::spin(k))
            } else {
                S::point(&p.freedom).dot(&S::point(k))
            };
            let gain = c.inverse * head;
            (*at_mut(h, 0)?, *at_mut(g, 0)?) = (head, gain);
            *k - c.column * gain
        }
        LinkKind::Ball => {
            let spin = S::spin(k);
            let turn = S::ball_solve(&c.inertia, &spin);
            write(&spin, h, 0)?;
            write(&turn, g, 0)?;
            S::motion(S::Spin::zero(), S::point(k) - S::ball_column(&c.inertia, &turn))
        }
        LinkKind::Free => {
            write(k, h, 0)?;
            write(&S::solve(&c.inertia, k), g, 0)?;
            S::Motion::zero()
        }
        LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic | LinkKind::GuidedBall => *k,
    })
}
