//! Inverse dynamics: efforts from accelerations, and forces through joints.
//!
//! ```text
//! outward   Ż = Żₚ + b z̈ + d
//! inward    f = M Ż − Q + Σ children,   τ = bᵀ f
//! ```
//!
//! Z is the velocity of a link, Zₚ the velocity of its parent carried to the link's origin. b is the motion of the link for unit rate ż of
//! its joint, d are the velocity products. M is the inertia of the link and Q the force on it. f is the force through the joint and τ the
//! effort along it.

use crate::link::indexing::{Outside, at, at_mut};
use crate::link::joint::{read, write};
use crate::link::{ArticulatedInertia, Link, LinkKind, LinkMotion};
use crate::passes;
use crate::passes::coupled_rows;
use crate::passes::slices::{Store, TreeSlices};
use crate::space::{Numbers, Space};
use mbs_core::Real;

/// Computes the accelerations `a` of the links from given joint accelerations. The acceleration `a[0]` of the ground is an input.
///
/// # Errors
/// [`Outside`] if the tables are inconsistent.
pub fn spread<T: Real, S: Space<T>>(
    links: &[Link<T, S>],
    placed: &[LinkMotion<T, S>],
    zdd: &[T],
    a: &mut [S::Motion],
) -> Result<(), Outside> {
    spread_each(links, (placed, true), zdd, a)
}

/// Computes the motions of the links from given joint motions. Velocity products are added if the motions are accelerations. The motion
/// `a[0]` of the ground is an input.
#[inline(always)]
pub(crate) fn spread_each<T: Real, S: Space<T>>(
    links: &[Link<T, S>],
    (placed, has_bias): (&[LinkMotion<T, S>], bool),
    zdd: &[T],
    a: &mut [S::Motion],
) -> Result<(), Outside> {
    let ground = *at(a, 0)?;
    for (i, link) in links.iter().enumerate().skip(1) {
        let (p, first) = (at(placed, i)?, link.v as usize);
        // acceleration of the link: Ż = Żₚ + b z̈ + d   [P3 (27)]
        let mut carried = match link.kind {
            LinkKind::Free => ground,
            _ => S::carried(at(a, link.parent as usize)?, &p.arm),
        };
        if has_bias {
            carried += p.bias;
        }
        let own = match link.kind {
            LinkKind::Revolute | LinkKind::Prismatic => p.freedom * *at(zdd, first)?,
            LinkKind::Ball => {
                S::motion(S::rotate_spin(&p.rotation, &read(zdd, first)?), S::Point::zero())
            }
            LinkKind::Free => S::motion(
                S::rotate_spin(&p.rotation, &read(zdd, first)?),
                read(zdd, first + S::Spin::N)?,
            ),
            LinkKind::GuidedRevolute | LinkKind::GuidedPrismatic | LinkKind::GuidedBall => {
                S::Motion::zero()
            }
        };
        *at_mut(a, i)? = carried + own;
    }
    Ok(())
}

/// Writes the force through every joint into the `force` of the link that the joint carries. It is the force on the link about the link's
/// origin, at the accelerations and multipliers of the store. The force includes the effects along the joint, which are also in `effort`.
/// The factored inertias are not changed.
pub(crate) fn forces<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    s: &mut Store<'_, T, S>,
) -> Result<(), Outside> {
    let moving = s.placed.iter().zip(&*s.a);
    for ((link, (p, a)), c) in m.links.iter().zip(moving).zip(&mut *s.condensed).skip(1) {
        let (inertia, products) = passes::body(link, p);
        (c.force, c.effort) = (products + S::times(&inertia, a), T::ZERO);
    }
    let mut condensed = core::mem::take(&mut s.condensed);
    for load in m.loads {
        load.apply(&s.instant(m), condensed)?;
    }
    core::mem::swap(&mut s.condensed, &mut condensed);
    let n = m.loops.rows.len();
    for lap in m.loops.cut() {
        for k in lap.range() {
            // forces of the multipliers: p += Kᵀ λ
            for (side, &link) in lap.links.iter().enumerate() {
                let push = *at(s.gradient, side * n + k)? * *at(s.lambda, k)?;
                at_mut(s.condensed, link as usize)?.force += push;
            }
        }
    }
    if m.loops.has_coupled() {
        coupled_rows::add_forces(m, s)?;
    }
    for (i, link) in m.links.iter().enumerate().skip(1).rev() {
        if link.parent > 0 {
            let (force, arm) = (at(s.condensed, i)?.force, &at(s.placed, i)?.arm);
            at_mut(s.condensed, link.parent as usize)?.force += S::gathered(&force, arm);
        }
    }
    Ok(())
}

/// Writes the effort bᵀ f that a link's joint must apply. Efforts of effects along the joint are not included. For a guided ball the effort
/// is a power.
pub(crate) fn effort<T: Real, S: Space<T>>(
    link: &Link<T, S>,
    p: &LinkMotion<T, S>,
    c: &ArticulatedInertia<T, S>,
    out: &mut [T],
) -> Result<(), Outside> {
    match link.kind {
        LinkKind::Revolute
        | LinkKind::Prismatic
        | LinkKind::GuidedRevolute
        | LinkKind::GuidedPrismatic
        | LinkKind::GuidedBall => {
            *at_mut(out, 0)? = p.freedom.dot(&c.force) - c.effort;
            Ok(())
        }
        LinkKind::Ball => write(&S::unrotate_spin(&p.rotation, &S::spin(&c.force)), out, 0),
        LinkKind::Free => {
            write(&S::unrotate_spin(&p.rotation, &S::spin(&c.force)), out, 0)?;
            write(&S::point(&c.force), out, S::Spin::N)
        }
    }
}
