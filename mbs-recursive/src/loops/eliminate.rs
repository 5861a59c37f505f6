//! Elimination of loops at the common ancestor of their two sides.

use super::fault::Fault;
use super::{LoopStore, Loops, RankLost, Regularisation, index, inner};
use crate::link::ArticulatedInertia;
use crate::link::indexing::{Outside, apart, at, at_mut, part, part_mut, range};
use crate::link::plan::{End, LoopCoupling, Update};
use crate::rows::Row;
use crate::rows::closed_loop::ClosedLoop;
use crate::space::{Numbers, Space};
use mbs_core::Real;

/// Eliminates the loops whose ancestor is link `i`. `a_ground` is the acceleration of the ground.
#[inline(always)]
pub(crate) fn close<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    (i, regularisation, a_ground): (usize, Regularisation<T>, &S::Motion),
    c: &mut ArticulatedInertia<T, S>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Fault<T>> {
    let ends = ends_at(m, i)?;
    // Most links have no loop to eliminate.
    if ends.is_empty() { Ok(()) } else { close_some(m, ends, (i, regularisation, a_ground), c, st) }
}

/// Returns the loops that are eliminated at link `i`.
#[inline(always)]
pub(crate) fn ends_at<'a, T: Real, S: Space<T>>(
    m: &Loops<'a, T, S>,
    i: usize,
) -> Result<&'a [End], Outside> {
    range(m.plan.ends, at(m.plan.stations, i)?.ends.range())
}

fn close_some<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    ends: &[End],
    (i, regularisation, a_ground): (usize, Regularisation<T>, &S::Motion),
    c: &mut ArticulatedInertia<T, S>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Fault<T>> {
    let ground = if i == 0 { Some(a_ground) } else { None };
    if m.has_coupled() {
        join(m, ends, st)?;
    }
    for end in ends {
        let lap = at(m.loops, end.lap as usize)?;
        sized!(lap.n as usize, often S::Point::N, of couplings 1, meet(m.rows.len(), lap, ground, st))?;
    }
    for end in ends {
        let lap = at(m.loops, end.lap as usize)?;
        let body = if i == 0 { None } else { Some(&mut *c) };
        sized!(lap.n as usize, often S::Point::N, of couplings 1, regularise(m, lap, regularisation, st))?;
        sized!(lap.n as usize, often S::Point::N, of couplings 1, eliminate(lap, body, st))?;
        couple_all(m, end, i > 0, st)?;
    }
    Ok(())
}

/// Adds the gradients K of the third and further sides of couplings to K of the second side. This is done for the rows that are eliminated
/// at this link.
#[inline(never)]
fn join<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    ends: &[End],
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let n_rows = m.rows.len();
    let (before, further) = st.k.split_at_mut_checked(2 * n_rows).ok_or(Outside)?;
    if further.is_empty() {
        return Ok(());
    }
    let seconds = before.get_mut(n_rows..).ok_or(Outside)?;
    for end in ends {
        for k in at(m.loops, end.lap as usize)?.range() {
            for further in further.iter().skip(k).step_by(n_rows.max(1)) {
                *at_mut(seconds, k)? += *further;
            }
        }
    }
    Ok(())
}

/// Adds the gradient K of the second side to K of the first side. At the ground the acceleration a is known, so K a is added to l instead.
#[inline(always)]
fn meet<T: Real, S: Space<T>>(
    n: usize,
    n_rows: usize,
    lap: &ClosedLoop<T, S>,
    a_ground: Option<&S::Motion>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let first = lap.first as usize;
    let (firsts, seconds) = st.k.split_at_mut_checked(n_rows).ok_or(Outside)?;
    let (both, seconds) = (part_mut(firsts, first, n)?, part(seconds, first, n)?);
    for (both, &second) in both.iter_mut().zip(seconds) {
        *both += second;
    }
    if let Some(a) = a_ground {
        for (l, both) in part_mut(st.l, first, n)?.iter_mut().zip(&*both) {
            *l += both.dot(a);
        }
    }
    Ok(())
}

/// Adds ε times the rows' scale to Λ and factors it in place: Λ = C Cᵀ. C is stored in the lower triangle, with the inverses of its
/// diagonal entries.
#[inline(always)]
fn regularise<T: Real, S: Space<T>>(
    n: usize,
    m: &Loops<'_, T, S>,
    lap: &ClosedLoop<T, S>,
    regularisation: Regularisation<T>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Fault<T>> {
    let first = lap.first as usize;
    let block = part_mut(st.blocks, lap.block as usize, n * n)?;
    let (rows, scales) = (part(m.rows, first, n)?, part(st.scales, first, n)?);
    let pivots = part_mut(st.pivots, first, n)?;
    // A loop with one row may be a coupling, and the sum of a coupling may be an angle.
    let is_angle = |row: &Row<T, S>| if n > 1 { row.is_cut_angle() } else { row.is_angle() };
    let mut scale = m.floor;
    for (row, &own) in rows.iter().zip(scales) {
        let of = at_mut(&mut scale, usize::from(is_angle(row)))?;
        *of = of.max(own);
    }
    for (r, row) in rows.iter().enumerate() {
        let scale = *at(&scale, usize::from(is_angle(row)))?;
        let (above, here) = block.split_at_mut_checked(r * n).ok_or(Outside)?;
        let here = part_mut(here, 0, r + 1)?;
        for s in 0..r {
            let other = part(above, s * n, s + 1)?;
            let mut x = *at(here, s)?;
            for (&a, &b) in part(here, 0, s)?.iter().zip(other) {
                x -= a * b;
            }
            *at_mut(here, s)? = x * *at(other, s)?;
        }
        let added = match regularisation {
            Regularisation::Scaled(share) => share * scale,
            Regularisation::Fixed(added) => added,
        };
        let (left, own) = here.split_at_mut_checked(r).ok_or(Outside)?;
        let own = at_mut(own, 0)?;
        let mut pivot = *own + added;
        for &x in left.iter() {
            pivot -= x * x;
        }
        *at_mut(pivots, r)? = pivot / scale;
        if !(pivot > T::ZERO) {
            let row = lap.first + index(r);
            return Err(Fault::RankLost(RankLost { row, pivot: pivot / scale }));
        }
        *own = T::ONE / pivot.sqrt();
    }
    Ok(())
}

/// Computes l̃ = C⁻¹ l. If the ancestor is a body, also K̃ = C⁻¹ K, I += K̃ᵀ K̃ and p += K̃ᵀ l̃.
#[inline(always)]
fn eliminate<T: Real, S: Space<T>>(
    n: usize,
    lap: &ClosedLoop<T, S>,
    body: Option<&mut ArticulatedInertia<T, S>>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let first = lap.first as usize;
    let factor = part(st.blocks, lap.block as usize, n * n)?;
    let l = part_mut(st.l, first, n)?;
    solve(n, factor, l)?;
    let Some(c) = body else { return Ok(()) };
    let k = part_mut(st.k, first, n)?;
    for r in 0..n {
        let factor = part(factor, r * n, r + 1)?;
        let (before, here) = k.split_at_mut_checked(r).ok_or(Outside)?;
        let here = at_mut(here, 0)?;
        for (&before, &x) in before.iter().zip(factor) {
            *here -= before * x;
        }
        *here = *here * *at(factor, r)?;
        S::add_square(&mut c.inertia, here);
        c.force += *here * *at(l, r)?;
    }
    Ok(())
}

/// Solves for l in place: l ← C⁻¹ l.
#[inline(always)]
fn solve<T: Real>(n: usize, factor: &[T], l: &mut [T]) -> Result<(), Outside> {
    for r in 0..n {
        let factor = part(factor, r * n, r + 1)?;
        let (before, here) = l.split_at_mut_checked(r).ok_or(Outside)?;
        let here = at_mut(here, 0)?;
        for (&before, &x) in before.iter().zip(factor) {
            *here -= before * x;
        }
        *here *= *at(factor, r)?;
    }
    Ok(())
}

/// Updates all loops that are eliminated later and are coupled with an eliminated loop.
fn couple_all<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    end: &End,
    has_body: bool,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let lap = at(m.loops, end.lap as usize)?;
    let n = lap.n as usize;
    for coupling in range(m.plan.couplings, end.couplings.range())? {
        let later = at(m.loops, coupling.lap as usize)?;
        let sizes = (later.n as usize, n);
        sized!(
            sizes,
            often (S::Point::N, S::Point::N),
            of couplings (1, 1),
            couple((m.rows.len(), has_body), [lap, later], coupling, st)
        )?;
    }
    for update in range(m.plan.updates, end.updates.range())? {
        let x = at(m.plan.couplings, update.row as usize)?;
        let y = at(m.plan.couplings, update.column as usize)?;
        let rows = at(m.loops, x.lap as usize)?.n as usize;
        let columns = at(m.loops, y.lap as usize)?.n as usize;
        sized!(
            (rows, columns, n),
            often (S::Point::N, S::Point::N, S::Point::N),
            of couplings (1, 1, 1),
            take([x, y], update, st)
        )?;
    }
    Ok(())
}

/// Computes W = Λₗₖ C⁻ᵀ, Kₗ −= W K̃ and lₗ −= W l̃ for an eliminated loop k and a later loop l.
#[inline(always)]
fn couple<T: Real, S: Space<T>>(
    (rows, n): (usize, usize),
    (n_rows, has_body): (usize, bool),
    [lap, later]: [&ClosedLoop<T, S>; 2],
    coupling: &LoopCoupling,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let (own, block) = (lap.block as usize, coupling.block as usize);
    let (factor, w) = apart(st.blocks, (own, n * n), (block, rows * n))?;
    for r in 0..rows {
        solve(n, factor, part_mut(w, r * n, n)?)?;
    }
    let (first, place) = (lap.first as usize, later.first as usize);
    let (l, l_later) = apart(st.l, (first, n), (place, rows))?;
    for (r, l_r) in l_later.iter_mut().enumerate() {
        *l_r -= inner(part(w, r * n, n)?, l);
    }
    if has_body {
        let place = coupling.side as usize * n_rows + place;
        let (k, k_later) = apart(st.k, (first, n), (place, rows))?;
        for (r, k_r) in k_later.iter_mut().enumerate() {
            for (&k, &w) in k.iter().zip(part(w, r * n, n)?) {
                *k_r -= k * w;
            }
        }
    }
    Ok(())
}

/// Updates the block of Λ for two later loops l and l': Λₗₗ' −= W W'ᵀ.
#[inline(always)]
fn take<T: Real, S: Space<T>>(
    (rows, columns, n): (usize, usize, usize),
    [x, y]: [&LoopCoupling; 2],
    update: &Update,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    for r in 0..rows {
        for s in 0..columns {
            let w = part(st.blocks, x.block as usize + r * n, n)?;
            let v = part(st.blocks, y.block as usize + s * n, n)?;
            let change = inner(w, v);
            *at_mut(st.blocks, update.block as usize + r * columns + s)? -= change;
        }
    }
    Ok(())
}

/// Repeats the elimination of the loops at a link for a new right-hand side l only.
#[inline(always)]
pub(crate) fn close_again<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    i: usize,
    c: &mut ArticulatedInertia<T, S>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let ends = ends_at(m, i)?;
    if ends.is_empty() { Ok(()) } else { close_some_again(m, (ends, i), c, st) }
}

fn close_some_again<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    (ends, i): (&[End], usize),
    c: &mut ArticulatedInertia<T, S>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    for end in ends {
        let lap = at(m.loops, end.lap as usize)?;
        let body = if i == 0 { None } else { Some(&mut *c) };
        sized!(lap.n as usize, often S::Point::N, of couplings 1, eliminate_again(lap, body, st))?;
        for coupling in range(m.plan.couplings, end.couplings.range())? {
            let later = at(m.loops, coupling.lap as usize)?;
            let sizes = (later.n as usize, lap.n as usize);
            sized!(
                sizes,
                often (S::Point::N, S::Point::N), of couplings (1, 1),
                couple_again([lap, later], coupling, st)
            )?;
        }
    }
    Ok(())
}

#[inline(always)]
fn eliminate_again<T: Real, S: Space<T>>(
    n: usize,
    lap: &ClosedLoop<T, S>,
    body: Option<&mut ArticulatedInertia<T, S>>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let first = lap.first as usize;
    let l = part_mut(st.l, first, n)?;
    solve(n, part(st.blocks, lap.block as usize, n * n)?, l)?;
    if let Some(c) = body {
        for (&k, &l) in part(st.k, first, n)?.iter().zip(&*l) {
            c.force += k * l;
        }
    }
    Ok(())
}

#[inline(always)]
fn couple_again<T: Real, S: Space<T>>(
    (rows, n): (usize, usize),
    [lap, later]: [&ClosedLoop<T, S>; 2],
    coupling: &LoopCoupling,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let w = part(st.blocks, coupling.block as usize, rows * n)?;
    let (l, later) = apart(st.l, (lap.first as usize, n), (later.first as usize, rows))?;
    for (r, l_r) in later.iter_mut().enumerate() {
        *l_r -= inner(part(w, r * n, n)?, l);
    }
    Ok(())
}
