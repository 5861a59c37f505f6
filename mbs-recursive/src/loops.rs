//! Closed loops in general form: rows travel inward to the nearest common ancestor and are eliminated there.
//!
//! ```text
//! passing a joint     K ← K − (K b) D⁻¹ Uᵀ,   l += K d + (K b) D⁻¹ u,   Λₖₗ += (Kₖ b) D⁻¹ (Kₗ b)ᵀ
//! at the ancestor     Λ = C Cᵀ,   K̃ = C⁻¹ K,   l̃ = C⁻¹ l,   I += K̃ᵀ K̃,   p += K̃ᵀ l̃,   W = Λₗₖ C⁻ᵀ
//!                     Kₗ −= W K̃,   lₗ −= W l̃,   Λₗₗ' −= W W'ᵀ
//! outward             λ = C⁻ᵀ (K̃ a + l̃ − Σ Wᵀ λₗ),   z'' −= D⁻¹ (K b)ᵀ λ
//! ```
//!
//! K b D⁻¹ is kept for each joint on the way (`gains`). Λ is regularised by ε times its rows' own scale.

use crate::at::{Outside, at, at_mut, part, part_mut, range};
use crate::joint;
use crate::link::{Condensed, Kind, Placed};
use crate::passes::Fault;
use crate::plan::{End, Pass, Plan};
use crate::rows::{Loop, Row};
use crate::space::{Numbers, Space};
use mbs_core::Real;

/// The loops of a mechanism: constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loops<'a, T: Real, S: Space<T>> {
    /// The cut joints.
    pub loops: &'a [Loop<T, S>],
    /// Their equations.
    pub rows: &'a [Row<T, S>],
    /// Who meets whom.
    pub plan: Plan<'a>,
    /// The least scale of a row's mobility: of lengths [1/kg], of angles [1/(kg m^2)].
    pub floor: [T; 2],
}

/// What the loops need to remember during an evaluation.
#[derive(Debug)]
pub struct LoopStore<'a, T: Real, S: Space<T>> {
    /// K of both sides as they travel: all first sides, then all second ones.
    pub k: &'a mut [S::Motion],
    /// l, later l̃.
    pub l: &'a mut [T],
    /// λ.
    pub lambda: &'a mut [T],
    /// Blocks of Λ, later of its factor.
    pub blocks: &'a mut [T],
    /// K b D⁻¹ of each pass.
    pub gains: &'a mut [T],
    /// K b of each pass.
    pub heads: &'a mut [T],
    /// The rows' own mobility, Σ (K b) D⁻¹ (K b)ᵀ before any elimination.
    pub scales: &'a mut [T],
    /// Pivots of Λ relative to their rows' scale.
    pub pivots: &'a mut [T],
}

/// What is added to the diagonal of Λ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Regularisation<T> {
    /// This share of the rows' own scale.
    Scaled(T),
    /// This number on every row [1/kg].
    Fixed(T),
}

/// A row that nothing moves, or that repeats others beyond what the regularisation carries.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RankLost<T> {
    /// The row.
    pub row: u32,
    /// Its pivot, relative to its scale.
    pub pivot: T,
}

/// Carries all rows over the joint of link `i`.
#[inline]
pub(crate) fn pass<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    i: usize,
    kind: Kind,
    (p, c): (&Placed<T, S>, &Condensed<T, S>),
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let station = at(m.plan.stations, i)?;
    let n_rows = m.rows.len();
    let freedoms = kind.n_freedoms::<T, S>();
    for pass in range(m.plan.passes, station.passes.range())? {
        let lap = at(m.loops, pass.lap as usize)?;
        let mut gain = pass.gain as usize;
        for row in lap.range() {
            let h = part_mut(st.heads, gain, freedoms)?;
            let g = part_mut(st.gains, gain, freedoms)?;
            let k = at_mut(st.k, pass.side as usize * n_rows + row)?;
            let passed = joint::pass(kind, p, c, k, (h, g))?;
            *at_mut(st.l, row)? += passed.dot(&p.bias) + driven(&c.drive, g);
            *k = S::gathered(&passed, &p.arm);
            *at_mut(st.scales, row)? += inner(h, g);
            gain += freedoms;
        }
    }
    for pair in range(m.plan.pairs, station.pairs.range())? {
        let x = at(m.plan.passes, pair.row as usize)?;
        let y = at(m.plan.passes, pair.column as usize)?;
        let rows = at(m.loops, x.lap as usize)?.n as usize;
        let columns = at(m.loops, y.lap as usize)?.n as usize;
        let block = part_mut(st.blocks, pair.block as usize, rows * columns)?;
        let mut numbers = block.iter_mut();
        for r in 0..rows {
            let head = part(st.heads, x.gain as usize + r * freedoms, freedoms)?;
            for (c, number) in numbers.by_ref().take(columns).enumerate() {
                let gain = part(st.gains, y.gain as usize + c * freedoms, freedoms)?;
                *number += inner(head, gain);
            }
        }
    }
    Ok(())
}

/// Carries l alone over the joint of link `i`, whose drive changed.
#[inline]
pub(crate) fn pass_again<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    i: usize,
    kind: Kind,
    c: &Condensed<T, S>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let freedoms = kind.n_freedoms::<T, S>();
    for pass in range(m.plan.passes, at(m.plan.stations, i)?.passes.range())? {
        let lap = at(m.loops, pass.lap as usize)?;
        let mut gain = pass.gain as usize;
        for row in lap.range() {
            *at_mut(st.l, row)? += driven(&c.drive, part(st.gains, gain, freedoms)?);
            gain += freedoms;
        }
    }
    Ok(())
}

/// Eliminates the loops that end at link `i`; `a_ground` is the acceleration of the ground.
#[inline]
pub(crate) fn close<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    (i, regularisation, a_ground): (usize, Regularisation<T>, &S::Motion),
    c: &mut Condensed<T, S>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Fault<T>> {
    let ends = range(m.plan.ends, at(m.plan.stations, i)?.ends.range())?;
    let n_rows = m.rows.len();
    for end in ends {
        for row in at(m.loops, end.lap as usize)?.range() {
            // Both branches meet.
            let second = *at(st.k, n_rows + row)?;
            let both = at_mut(st.k, row)?;
            *both += second;
            if i == 0 {
                *at_mut(st.l, row)? += both.dot(a_ground);
            }
        }
    }
    for end in ends {
        let lap = at(m.loops, end.lap as usize)?;
        let (first, n) = (lap.first as usize, lap.n as usize);
        regularise(m, lap, regularisation, st)?;
        // K̃ = C⁻¹ K,   l̃ = C⁻¹ l
        let (k, l) = (part_mut(st.k, first, n)?, part_mut(st.l, first, n)?);
        for r in 0..n {
            let factor = part(st.blocks, lap.block as usize + r * n, n)?;
            let (k_before, k_here) = k.split_at_mut_checked(r).ok_or(Outside)?;
            let (l_before, l_here) = l.split_at_mut_checked(r).ok_or(Outside)?;
            let (k_r, l_r) = (at_mut(k_here, 0)?, at_mut(l_here, 0)?);
            for ((k_s, l_s), &x) in k_before.iter().zip(l_before.iter()).zip(factor) {
                *k_r -= *k_s * x;
                *l_r -= *l_s * x;
            }
            let inverse = T::ONE / *at(factor, r)?;
            *k_r = *k_r * inverse;
            *l_r *= inverse;
            if i > 0 {
                // I += K̃ᵀ K̃,   p += K̃ᵀ l̃
                S::add_square(&mut c.inertia, k_r);
                c.force += *k_r * *l_r;
            }
        }
        couple(m, end, i > 0, st)?;
    }
    Ok(())
}

/// Adds ε times the rows' scale to Λ and factors it: Λ = C Cᵀ, in place, lower triangle.
fn regularise<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    lap: &Loop<T, S>,
    regularisation: Regularisation<T>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Fault<T>> {
    let (first, n) = (lap.first as usize, lap.n as usize);
    let block = part_mut(st.blocks, lap.block as usize, n * n)?;
    let (rows, scales) = (part(m.rows, first, n)?, part(st.scales, first, n)?);
    let mut scale = m.floor;
    for (row, &own) in rows.iter().zip(scales) {
        let of = at_mut(&mut scale, usize::from(row.is_angle()))?;
        *of = of.max(own);
    }
    for (r, row) in rows.iter().enumerate() {
        let scale = *at(&scale, usize::from(row.is_angle()))?;
        let (above, here) = block.split_at_mut_checked(r * n).ok_or(Outside)?;
        let here = part_mut(here, 0, r + 1)?;
        for s in 0..r {
            let other = part(above, s * n, n)?;
            let mut x = *at(here, s)?;
            for (&a, &b) in part(here, 0, s)?.iter().zip(other) {
                x -= a * b;
            }
            *at_mut(here, s)? = x / *at(other, s)?;
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
        *at_mut(st.pivots, first + r)? = pivot / scale;
        if !(pivot > T::ZERO) {
            let row = lap.first + index(r);
            return Err(Fault::RankLost(RankLost { row, pivot: pivot / scale }));
        }
        *own = pivot.sqrt();
    }
    Ok(())
}

/// W = Λₗₖ C⁻ᵀ for every later loop l; Kₗ −= W K̃, lₗ −= W l̃, Λₗₗ' −= W W'ᵀ.
fn couple<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    end: &End,
    has_rows: bool,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let lap = at(m.loops, end.lap as usize)?;
    let (first, n, own) = (lap.first as usize, lap.n as usize, lap.block as usize);
    let n_rows = m.rows.len();
    for coupling in range(m.plan.couplings, end.couplings.range())? {
        let later = at(m.loops, coupling.lap as usize)?;
        for (r, row) in later.range().enumerate() {
            let block = coupling.block as usize + r * n;
            let place = coupling.side as usize * n_rows + row;
            for s in 0..n {
                let mut x = *at(st.blocks, block + s)?;
                for t in 0..s {
                    x -= *at(st.blocks, block + t)? * *at(st.blocks, own + s * n + t)?;
                }
                let w = x / *at(st.blocks, own + s * n + s)?;
                *at_mut(st.blocks, block + s)? = w;
                if has_rows {
                    let k = *at(st.k, first + s)?;
                    *at_mut(st.k, place)? -= k * w;
                }
                let l = *at(st.l, first + s)?;
                *at_mut(st.l, row)? -= w * l;
            }
        }
    }
    for update in range(m.plan.updates, end.updates.range())? {
        let x = at(m.plan.couplings, update.row as usize)?;
        let y = at(m.plan.couplings, update.column as usize)?;
        let rows = at(m.loops, x.lap as usize)?.n as usize;
        let columns = at(m.loops, y.lap as usize)?.n as usize;
        let mut number = update.block as usize;
        for r in 0..rows {
            for s in 0..columns {
                let w = part(st.blocks, x.block as usize + r * n, n)?;
                let v = part(st.blocks, y.block as usize + s * n, n)?;
                let change = inner(w, v);
                *at_mut(st.blocks, number)? -= change;
                number += 1;
            }
        }
    }
    Ok(())
}

/// The same elimination for l alone.
#[inline]
pub(crate) fn close_again<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    i: usize,
    c: &mut Condensed<T, S>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    for end in range(m.plan.ends, at(m.plan.stations, i)?.ends.range())? {
        let lap = at(m.loops, end.lap as usize)?;
        let (first, n) = (lap.first as usize, lap.n as usize);
        for r in 0..n {
            let factor = part(st.blocks, lap.block as usize + r * n, n)?;
            let (before, here) =
                part_mut(st.l, first, n)?.split_at_mut_checked(r).ok_or(Outside)?;
            let l = at_mut(here, 0)?;
            for (&x, &y) in factor.iter().zip(before.iter()) {
                *l -= x * y;
            }
            *l /= *at(factor, r)?;
            if i > 0 {
                c.force += *at(st.k, first + r)? * *l;
            }
        }
        for coupling in range(m.plan.couplings, end.couplings.range())? {
            for (r, row) in at(m.loops, coupling.lap as usize)?.range().enumerate() {
                let w = part(st.blocks, coupling.block as usize + r * n, n)?;
                let change = inner(w, part(st.l, first, n)?);
                *at_mut(st.l, row)? -= change;
            }
        }
    }
    Ok(())
}

/// λ of the loops that end at link `i`, whose acceleration is `a` (`None` for the ground, where it is in l already).
#[inline]
pub(crate) fn open<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    i: usize,
    a: Option<&S::Motion>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    for end in range(m.plan.ends, at(m.plan.stations, i)?.ends.range())?.iter().rev() {
        let lap = at(m.loops, end.lap as usize)?;
        let (first, n) = (lap.first as usize, lap.n as usize);
        for row in lap.range() {
            let known = match a {
                Some(a) => at(st.k, row)?.dot(a),
                None => T::ZERO,
            };
            *at_mut(st.lambda, row)? = known + *at(st.l, row)?;
        }
        for coupling in range(m.plan.couplings, end.couplings.range())? {
            for (r, row) in at(m.loops, coupling.lap as usize)?.range().enumerate() {
                let x = *at(st.lambda, row)?;
                let w = part(st.blocks, coupling.block as usize + r * n, n)?;
                for (lambda, &w) in part_mut(st.lambda, first, n)?.iter_mut().zip(w) {
                    *lambda -= w * x;
                }
            }
        }
        let factor = part(st.blocks, lap.block as usize, n * n)?;
        let lambda = part_mut(st.lambda, first, n)?;
        for r in (0..n).rev() {
            let mut x = *at(lambda, r)?;
            for s in r + 1..n {
                x -= *at(factor, s * n + r)? * *at(lambda, s)?;
            }
            *at_mut(lambda, r)? = x / *at(factor, r * n + r)?;
        }
    }
    Ok(())
}

/// D⁻¹ (K b)ᵀ λ at the joint of link `i`.
#[inline]
pub(crate) fn held<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    i: usize,
    kind: Kind,
    st: &LoopStore<'_, T, S>,
) -> Result<S::Motion, Outside> {
    let freedoms = kind.n_freedoms::<T, S>();
    let mut held = S::Motion::zero();
    for &Pass { lap, gain, .. } in range(m.plan.passes, at(m.plan.stations, i)?.passes.range())? {
        let mut gain = gain as usize;
        for row in at(m.loops, lap as usize)?.range() {
            let lambda = *at(st.lambda, row)?;
            for (f, &g) in part(st.gains, gain, freedoms)?.iter().take(S::Motion::N).enumerate() {
                held[f] += g * lambda;
            }
            gain += freedoms;
        }
    }
    Ok(held)
}

/// g·u over the joint's freedoms.
#[inline(always)]
fn driven<T: Real, M: Numbers<T>>(drive: &M, gain: &[T]) -> T {
    let mut sum = T::ZERO;
    for (f, &g) in gain.iter().take(M::N).enumerate() {
        sum += g * drive[f];
    }
    sum
}

#[inline(always)]
fn inner<T: Real>(x: &[T], y: &[T]) -> T {
    x.iter().zip(y).fold(T::ZERO, |sum, (&x, &y)| sum + x * y)
}

/// Indices of a mechanism fit 32 bits.
pub(crate) fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}
