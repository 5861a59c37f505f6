//! Multipliers of the loops, computed outward.

use super::eliminate::ends_at;
use super::{LoopStore, Loops};
use crate::link::indexing::{Outside, apart, at, at_mut, part, part_mut, range};
use crate::link::plan::{End, LoopCoupling};
use crate::rows::closed_loop::ClosedLoop;
use crate::space::{Numbers, Space};
use mbs_core::Real;

/// Computes λ of the loops that are eliminated at link `i`. `a` is the acceleration of the link. It is `None` for the ground, because l
/// already contains the acceleration of the ground.
#[inline(always)]
pub(crate) fn open<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    i: usize,
    a: Option<&S::Motion>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let ends = ends_at(m, i)?;
    // Most links have no loop to eliminate.
    if ends.is_empty() { Ok(()) } else { open_some(m, ends, a, st) }
}

fn open_some<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    ends: &[End],
    a: Option<&S::Motion>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    for end in ends.iter().rev() {
        let lap = at(m.loops, end.lap as usize)?;
        sized!(lap.n as usize, often S::Point::N, of couplings 1, begin(lap, a, st))?;
        for coupling in range(m.plan.couplings, end.couplings.range())? {
            let later = at(m.loops, coupling.lap as usize)?;
            let sizes = (later.n as usize, lap.n as usize);
            sized!(sizes, often (S::Point::N, S::Point::N), of couplings (1, 1), take([lap, later], coupling, st))?;
        }
        sized!(lap.n as usize, often S::Point::N, of couplings 1, solve_back(lap, st))?;
    }
    Ok(())
}

/// Sets λ to K̃ a + l̃.
#[inline(always)]
fn begin<T: Real, S: Space<T>>(
    n: usize,
    lap: &ClosedLoop<T, S>,
    a: Option<&S::Motion>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let first = lap.first as usize;
    let lambda = part_mut(st.lambda, first, n)?;
    for (lambda, &l) in lambda.iter_mut().zip(part(st.l, first, n)?) {
        *lambda = l;
    }
    if let Some(a) = a {
        for (lambda, k) in lambda.iter_mut().zip(part(st.k, first, n)?) {
            *lambda += k.dot(a);
        }
    }
    Ok(())
}

/// Subtracts Wᵀ λ of a loop that was eliminated later.
#[inline(always)]
fn take<T: Real, S: Space<T>>(
    (rows, n): (usize, usize),
    [lap, later]: [&ClosedLoop<T, S>; 2],
    coupling: &LoopCoupling,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let w = part(st.blocks, coupling.block as usize, rows * n)?;
    let places = ((later.first as usize, rows), (lap.first as usize, n));
    let (known, lambda) = apart(st.lambda, places.0, places.1)?;
    for (r, &x) in known.iter().enumerate() {
        for (lambda, &w) in lambda.iter_mut().zip(part(w, r * n, n)?) {
            *lambda -= w * x;
        }
    }
    Ok(())
}

/// Solves for λ in place: λ ← C⁻ᵀ λ.
#[inline(always)]
fn solve_back<T: Real, S: Space<T>>(
    n: usize,
    lap: &ClosedLoop<T, S>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), Outside> {
    let factor = part(st.blocks, lap.block as usize, n * n)?;
    let lambda = part_mut(st.lambda, lap.first as usize, n)?;
    for r in (0..n).rev() {
        let mut x = *at(lambda, r)?;
        for s in r + 1..n {
            x -= *at(factor, s * n + r)? * *at(lambda, s)?;
        }
        *at_mut(lambda, r)? = x * *at(factor, r * n + r)?;
    }
    Ok(())
}
