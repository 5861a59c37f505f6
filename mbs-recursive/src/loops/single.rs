//! Rows that stand alone and joints with one freedom, as couplings mostly have: the same passes with numbers in place of blocks.

use super::{LoopStore, Loops};
use crate::closed_loop::ClosedLoop;
use crate::coupled::CoupledRow;
use crate::indexing::{Outside, at, at_mut};
use crate::link::{ArticulatedInertia, LinkMotion};
use crate::plan::{LoopCoupling, Pair, Pass, Update};
use crate::space::{Numbers, Space};
use mbs_core::Real;

/// Carries one side of a coupling's row over the joint of link `i`, where it may have g.
#[inline(always)]
pub(super) fn carry<T: Real, S: Space<T>>(
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

/// Adds the mobility that a joint gives the rows of two passes.
#[inline(always)]
pub(super) fn meet_at_joint<T: Real, S: Space<T>>(
    [x, y]: [&Pass; 2],
    pair: &Pair,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let head = *at(st.heads, x.gain as usize)?;
    *at_mut(st.blocks, pair.block as usize)? += head * *at(st.gains, y.gain as usize)?;
    Ok(())
}

/// D⁻¹ (K b + g) λ at a joint.
#[inline(always)]
pub(super) fn hold<T: Real, S: Space<T>>(
    (lap, pass): (&ClosedLoop<T, S>, &Pass),
    st: &LoopStore<'_, T, S>,
    held: &mut S::Motion,
) -> Result<(), Outside> {
    held[0] += *at(st.gains, pass.gain as usize)? * *at(st.lambda, lap.first as usize)?;
    Ok(())
}

/// W = Λₗₖ/C, lₗ −= W l̃ for a later row l, and Kₗ −= W K̃ on a body.
#[inline(always)]
pub(super) fn couple<T: Real, S: Space<T>>(
    (n_rows, has_body): (usize, bool),
    [lap, later]: [&ClosedLoop<T, S>; 2],
    coupling: &LoopCoupling,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let (first, place) = (lap.first as usize, later.first as usize);
    let w = *at(st.blocks, coupling.block as usize)? * *at(st.blocks, lap.block as usize)?;
    *at_mut(st.blocks, coupling.block as usize)? = w;
    let l = *at(st.l, first)?;
    *at_mut(st.l, place)? -= w * l;
    if has_body {
        let k = *at(st.k, first)?;
        *at_mut(st.k, coupling.side as usize * n_rows + place)? -= k * w;
    }
    Ok(())
}

/// Λₗₗ' −= W W'.
#[inline(always)]
pub(super) fn take<T: Real, S: Space<T>>(
    [x, y]: [&LoopCoupling; 2],
    update: &Update,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let change = *at(st.blocks, x.block as usize)? * *at(st.blocks, y.block as usize)?;
    *at_mut(st.blocks, update.block as usize)? -= change;
    Ok(())
}
