//! Rows of loops at a joint. The inward pass carries the rows over the joint and stores their gains. The outward pass computes the response
//! of the joint to the multipliers.

use super::{LoopStore, Loops, inner};
use crate::link::indexing::{Outside, at, at_mut, part, part_mut, range};
use crate::link::plan::{Pair, Pass};
use crate::link::{ArticulatedInertia, LinkKind, LinkMotion, joint};
use crate::rows::Row;
use crate::rows::closed_loop::ClosedLoop;
use crate::rows::coupled::{self, CoupledRow};
use crate::space::{Numbers, Space};
use mbs_core::Real;

/// A joint over which rows are carried: its kind, the motion of its link, and the result of its elimination.
type Joint<'s, T, S> = (LinkKind, &'s LinkMotion<T, S>, &'s ArticulatedInertia<T, S>);

/// Carries all rows inward over the joint of link `i`.
#[inline]
pub(crate) fn pass<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    (i, joint): (usize, Joint<'_, T, S>),
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let station = at(m.plan.stations, i)?;
    let n_rows = m.rows.len();
    let freedoms = joint.0.n_freedoms::<T, S>();
    for pass in range(m.plan.passes, station.passes.range())? {
        let lap = at(m.loops, pass.lap as usize)?;
        if (lap.n as usize, freedoms) == (S::Point::N, 1) {
            carry((S::Point::N, 1), n_rows, (lap, pass), joint, st)?;
        } else if coupled::IS_BUILT
            && freedoms == 1
            && let Row::Coupled(row) = at(m.rows, lap.first as usize)?
        {
            carry_coupled((m, row), (i, lap, pass), (joint.1, joint.2), st)?;
        } else {
            carry((lap.n as usize, freedoms), n_rows, (lap, pass), joint, st)?;
        }
    }
    for pair in range(m.plan.pairs, station.pairs.range())? {
        let x = at(m.plan.passes, pair.row as usize)?;
        let y = at(m.plan.passes, pair.column as usize)?;
        let rows = at(m.loops, x.lap as usize)?.n as usize;
        let columns = at(m.loops, y.lap as usize)?.n as usize;
        sized!(
            (rows, columns, freedoms),
            often (S::Point::N, S::Point::N, 1),
            of couplings (1, 1, 1),
            meet([x, y], pair, st)
        )?;
    }
    Ok(())
}

/// Carries the rows of one side of a loop inward over a joint.
#[inline(always)]
fn carry<T: Real, S: Space<T>>(
    (n, freedoms): (usize, usize),
    n_rows: usize,
    (lap, pass): (&ClosedLoop<T, S>, &Pass),
    (kind, p, c): Joint<'_, T, S>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let (first, gain) = (lap.first as usize, pass.gain as usize);
    let k = part_mut(st.k, pass.side as usize * n_rows + first, n)?;
    let (l, scales) = (part_mut(st.l, first, n)?, part_mut(st.scales, first, n)?);
    let heads = part_mut(st.heads, gain, n * freedoms)?;
    let gains = part_mut(st.gains, gain, n * freedoms)?;
    for r in 0..n {
        let h = part_mut(heads, r * freedoms, freedoms)?;
        let g = part_mut(gains, r * freedoms, freedoms)?;
        let k = at_mut(k, r)?;
        let passed = joint::pass(kind, p, c, k, (h, g))?;
        *at_mut(l, r)? += passed.dot(&p.bias) + driven(&c.drive, g);
        *k = S::gathered(&passed, &p.arm);
        *at_mut(scales, r)? += inner(h, g);
    }
    Ok(())
}

/// Carries one side of a coupling's row inward over the joint of link `i`. The coordinate of the joint may be a term of the row; g is then
/// the slope of this term.
#[inline(always)]
fn carry_coupled<T: Real, S: Space<T>>(
    (m, row): (&Loops<'_, T, S>, &CoupledRow<T>),
    (i, lap, pass): (usize, &ClosedLoop<T, S>, &Pass),
    (p, c): (&LinkMotion<T, S>, &ArticulatedInertia<T, S>),
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let (first, gain) = (lap.first as usize, pass.gain as usize);
    let k = at_mut(st.k, pass.side as usize * m.rows.len() + first)?;
    let head = p.freedom.dot(k) + m.couplings.slope(row, (i, pass.side), st.slopes)?;
    let own = c.inverse * head;
    (*at_mut(st.heads, gain)?, *at_mut(st.gains, gain)?) = (head, own);
    let passed = *k - c.column * own;
    *at_mut(st.l, first)? += passed.dot(&p.bias) + own * c.drive[0];
    *k = S::gathered(&passed, &p.arm);
    *at_mut(st.scales, first)? += head * own;
    Ok(())
}

/// Adds the mobility (K b) D⁻¹ (K b)ᵀ of a joint to the block of Λ that belongs to two passes through the joint.
#[inline(always)]
fn meet<T: Real, S: Space<T>>(
    (rows, columns, freedoms): (usize, usize, usize),
    [x, y]: [&Pass; 2],
    pair: &Pair,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let block = part_mut(st.blocks, pair.block as usize, rows * columns)?;
    let heads = part(st.heads, x.gain as usize, rows * freedoms)?;
    let gains = part(st.gains, y.gain as usize, columns * freedoms)?;
    for r in 0..rows {
        let head = part(heads, r * freedoms, freedoms)?;
        for s in 0..columns {
            *at_mut(block, r * columns + s)? += inner(head, part(gains, s * freedoms, freedoms)?);
        }
    }
    Ok(())
}

/// Carries only the right-hand side l over the joint of link `i`, after the force u along the joint has changed.
#[inline]
pub(crate) fn pass_again<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    (i, kind): (usize, LinkKind),
    c: &ArticulatedInertia<T, S>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let freedoms = kind.n_freedoms::<T, S>();
    for pass in range(m.plan.passes, at(m.plan.stations, i)?.passes.range())? {
        let lap = at(m.loops, pass.lap as usize)?;
        sized!((lap.n as usize, freedoms), often (S::Point::N, 1), of couplings (1, 1), carry_again((lap, pass), c, st))?;
    }
    Ok(())
}

#[inline(always)]
fn carry_again<T: Real, S: Space<T>>(
    (n, freedoms): (usize, usize),
    (lap, pass): (&ClosedLoop<T, S>, &Pass),
    c: &ArticulatedInertia<T, S>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let l = part_mut(st.l, lap.first as usize, n)?;
    let gains = part(st.gains, pass.gain as usize, n * freedoms)?;
    for r in 0..n {
        *at_mut(l, r)? += driven(&c.drive, part(gains, r * freedoms, freedoms)?);
    }
    Ok(())
}

/// Returns the response D⁻¹ (K b)ᵀ λ of the joint of link `i` to the multipliers λ.
#[inline]
pub(crate) fn held<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    (i, kind): (usize, LinkKind),
    st: &LoopStore<'_, T, S>,
) -> Result<S::Motion, Outside> {
    let freedoms = kind.n_freedoms::<T, S>();
    let mut held = S::Motion::zero();
    for pass in range(m.plan.passes, at(m.plan.stations, i)?.passes.range())? {
        let lap = at(m.loops, pass.lap as usize)?;
        sized!(
            (lap.n as usize, freedoms),
            often (S::Point::N, 1),
            of couplings (1, 1),
            hold((lap, pass), st, &mut held)
        )?;
    }
    Ok(held)
}

#[inline(always)]
fn hold<T: Real, S: Space<T>>(
    (n, freedoms): (usize, usize),
    (lap, pass): (&ClosedLoop<T, S>, &Pass),
    st: &LoopStore<'_, T, S>,
    held: &mut S::Motion,
) -> Result<(), Outside> {
    let lambda = part(st.lambda, lap.first as usize, n)?;
    let gains = part(st.gains, pass.gain as usize, n * freedoms)?;
    for (r, &lambda) in lambda.iter().enumerate() {
        let gain = part(gains, r * freedoms, freedoms)?;
        for (f, &g) in gain.iter().take(S::Motion::N).enumerate() {
            held[f] += g * lambda;
        }
    }
    Ok(())
}

/// Returns the inner product of a row's gain and the force u along the joint's freedoms.
#[inline(always)]
fn driven<T: Real, M: Numbers<T>>(drive: &M, gain: &[T]) -> T {
    let mut sum = T::ZERO;
    for (f, &g) in gain.iter().take(M::N).enumerate() {
        sum += g * drive[f];
    }
    sum
}
