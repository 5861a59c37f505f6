//! The three passes of the fully recursive formulation [P3 2.3], over links sorted parent first.
//!
//! ```text
//! 1  outward   Zᵢ = Zₚ + bᵢ żᵢ,   dᵢ                                                        [P3 (26)]
//! 2  inward    K = 1 − M̂ b (bᵀ M̂ b)⁻¹ bᵀ,   M̂ₚ += K M̂,   Q̂ₚ += K (Q̂ − M̂ d)                [P3 (36)–(38)]
//! 3  outward   z̈ = (bᵀ M̂ b)⁻¹ [bᵀ (Q̂ − M̂ d) − bᵀ M̂ Żₚ],   Ż = Żₚ + b z̈ + d                  [P3 (27), (35)]
//! ```
//!
//! Z = (ω, v) is the velocity of a link, Zₚ the velocity of its parent carried to the link's origin. b is the motion of a link for unit
//! rate ż of its joint, d are the velocity products. M̂ and Q̂ are the articulated inertia and force.
//!
//! Differences from the source: the quantities of a link are in world axes and refer to the link's origin, a point of the body near its
//! joint. Inertias and forces are shifted to the parent's origin in the inward pass. The code stores p = −Q̂. The equations of a loop are
//! eliminated at the common ancestor of its bodies (`loops`). The source derives the equations of loops by hand for each mechanism.

use crate::link::indexing::{Outside, at, at_mut};
use crate::link::joint::{self, NoInertia};
use crate::link::{ArticulatedInertia, Link, LinkKind, LinkMotion};
use crate::loops::{self, Fault, LoopStore, Loops, Regularisation, index};
use crate::space::{Numbers, Space};
use mbs_core::Real;

/// First pass of an evaluation, outward: places, velocities and velocity products.
///
/// Cost: for each link about 50 multiplications in the plane or 150 in space, and a sine and cosine.
///
/// # Errors
/// [`Outside`] if the tables are inconsistent.
#[inline]
pub fn kinematics<T: Real, S: Space<T>>(
    links: &[Link<T, S>],
    (z, v, guides): (&[T], &[T], &[[T; 3]]),
    placed: &mut [LinkMotion<T, S>],
) -> Result<(), Outside> {
    for (i, link) in links.iter().enumerate().skip(1) {
        // velocity of the link: Zᵢ = Zₚ + bᵢ żᵢ   [P3 (26)]
        let here =
            joint::place::<T, S, true>(link, at(placed, link.parent as usize)?, z, v, guides)?;
        *at_mut(placed, i)? = here;
    }
    Ok(())
}

/// Returns the inertia M of a body about its link's origin, and its velocity-dependent forces −Q without effects [P3 (24)–(25)].
#[inline(always)]
pub(crate) fn body<T: Real, S: Space<T>>(
    link: &Link<T, S>,
    p: &LinkMotion<T, S>,
) -> (S::Inertia, S::Motion) {
    let inertia = S::body_inertia(link.mass, &p.center, &link.tensor, &p.rotation);
    let spin = S::spin(&p.velocity);
    // velocity-dependent force: p = (ω × J ω, m ω × (ω × r_G))
    let turning = S::cross_spin(&spin, &S::turning_block(&inertia, &spin));
    (inertia, S::motion(turning, S::centrifugal(&spin, &p.center) * link.mass))
}

/// Sets the inertia and the velocity-dependent forces of each body.
#[inline]
pub fn inertias<T: Real, S: Space<T>>(
    links: &[Link<T, S>],
    placed: &[LinkMotion<T, S>],
    condensed: &mut [ArticulatedInertia<T, S>],
) {
    for ((link, p), c) in links.iter().zip(placed).zip(condensed).skip(1) {
        (c.inertia, c.force) = body(link, p);
        (c.effort, c.resistance) = (T::ZERO, T::ZERO);
    }
}

/// Second pass of an evaluation, inward: articulated inertias and forces. Each loop is eliminated at the common ancestor of its bodies.
///
/// # Errors
/// [`Fault`] names the link or row.
#[inline]
pub fn condense<T: Real, S: Space<T>>(
    links: &[Link<T, S>],
    placed: &[LinkMotion<T, S>],
    (m, regularisation, a_ground): (&Loops<'_, T, S>, Regularisation<T>, &S::Motion),
    condensed: &mut [ArticulatedInertia<T, S>],
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Fault<T>> {
    let has_loops = !m.loops.is_empty();
    for i in (1..links.len()).rev() {
        let (link, p) = (at(links, i)?, at(placed, i)?);
        let (before, from) = condensed.split_at_mut_checked(i).ok_or(Outside)?;
        let c = at_mut(from, 0)?;
        if has_loops {
            loops::close(m, (i, regularisation, a_ground), c, st)?;
        }
        // inertia and force of the parent: M̂ₚ += K M̂,   Q̂ₚ += K (Q̂ − M̂ d)   [P3 (37)–(38)]
        let (inertia, force) = joint::eliminate(link.kind, p, c)
            .map_err(|pivot| Fault::NoInertia(NoInertia { link: index(i), pivot }))?;
        if has_loops {
            loops::pass(m, (i, (link.kind, p, c)), st)?;
        }
        if link.parent > 0 {
            let parent = at_mut(before, link.parent as usize)?;
            S::add_shifted(&mut parent.inertia, &inertia, &p.arm);
            parent.force += S::gathered(&force, &p.arm);
        }
    }
    if has_loops {
        loops::close(m, (0, regularisation, a_ground), at_mut(condensed, 0)?, st)?;
    }
    Ok(())
}

/// Repeats the second pass for other forces and other right-hand sides l, with the factored inertias. There are no velocity products, and
/// the ground is at rest.
///
/// Cost: about a fifth of [`condense`].
///
/// # Errors
/// [`Outside`] if the tables are inconsistent.
#[inline]
pub fn condense_again<T: Real, S: Space<T>>(
    links: &[Link<T, S>],
    placed: &[LinkMotion<T, S>],
    m: &Loops<'_, T, S>,
    condensed: &mut [ArticulatedInertia<T, S>],
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    for i in (1..links.len()).rev() {
        let (link, p) = (at(links, i)?, at(placed, i)?);
        let (before, from) = condensed.split_at_mut_checked(i).ok_or(Outside)?;
        let c = at_mut(from, 0)?;
        loops::close_again(m, i, c, st)?;
        let force = joint::impulse(link.kind, p, c);
        loops::pass_again(m, (i, link.kind), c, st)?;
        if link.parent > 0 {
            at_mut(before, link.parent as usize)?.force += S::gathered(&force, &p.arm);
        }
    }
    loops::close_again(m, 0, at_mut(condensed, 0)?, st)
}

/// Motions and articulated inertias of the links, as computed by the first two passes.
pub type Factors<'a, T, S> = (&'a [LinkMotion<T, S>], &'a [ArticulatedInertia<T, S>]);

/// Third pass of an evaluation, outward: accelerations of joints and links, and the multipliers λ. `a[0]` is an input: minus gravity, or
/// zero for a response. A response (`has_bias` false) has no velocity products.
///
/// # Errors
/// [`Outside`] if the tables are inconsistent.
#[inline]
pub fn accelerate<T: Real, S: Space<T>>(
    links: &[Link<T, S>],
    (placed, condensed): Factors<'_, T, S>,
    (m, has_bias): (&Loops<'_, T, S>, bool),
    st: &mut LoopStore<'_, T, S>,
    (zdd, a): (&mut [T], &mut [S::Motion]),
) -> Result<(), Outside> {
    let has_loops = !m.loops.is_empty();
    if has_loops {
        loops::open(m, 0, None, st)?;
    }
    let ground = *at(a, 0)?;
    for (i, link) in links.iter().enumerate().skip(1) {
        let (p, c) = (at(placed, i)?, at(condensed, i)?);
        let held = if has_loops { loops::held(m, (i, link.kind), st)? } else { S::Motion::zero() };
        // acceleration of the link: Ż = Żₚ + b z̈ + d   [P3 (27)],   z̈ as in [P3 (35)]
        let mut carried = match link.kind {
            LinkKind::Free => ground,
            _ => S::carried(at(a, link.parent as usize)?, &p.arm),
        };
        if has_bias {
            carried += p.bias;
        }
        let here = joint::advance(link, p, c, (carried, &held), zdd)?;
        *at_mut(a, i)? = here;
        if has_loops {
            loops::open(m, i, Some(&here), st)?;
        }
    }
    Ok(())
}
