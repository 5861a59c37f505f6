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

use crate::joint;
use crate::link::{Condensed, Kind, Placed};
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
) {
    let station = m.plan.stations[i];
    let n_rows = m.rows.len();
    let freedoms = kind.n_freedoms::<T, S>();
    for pass in &m.plan.passes[station.passes.range()] {
        let lap = &m.loops[pass.lap as usize];
        let mut at = pass.gain as usize;
        for row in lap.first as usize..(lap.first + lap.n) as usize {
            let place = pass.side as usize * n_rows + row;
            let (h, g) = (&mut st.heads[at..at + freedoms], &mut st.gains[at..at + freedoms]);
            let k = joint::pass(kind, p, c, &st.k[place], (h, g));
            st.l[row] += k.dot(&p.bias) + driven(&c.drive, g);
            st.k[place] = S::gathered(&k, &p.arm);
            st.scales[row] += inner(h, g);
            at += freedoms;
        }
    }
    for pair in &m.plan.pairs[station.pairs.range()] {
        let [x, y] = [pair.row, pair.column].map(|j| m.plan.passes[j as usize]);
        let [rows, columns] = [x, y].map(|q| m.loops[q.lap as usize].n as usize);
        let mut at = pair.block as usize;
        for r in 0..rows {
            let head = &st.heads[x.gain as usize + r * freedoms..][..freedoms];
            for c in 0..columns {
                let gain = &st.gains[y.gain as usize + c * freedoms..][..freedoms];
                st.blocks[at] += inner(head, gain);
                at += 1;
            }
        }
    }
}

/// Carries l alone over the joint of link `i`, whose drive changed.
#[inline]
pub(crate) fn pass_again<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    i: usize,
    kind: Kind,
    c: &Condensed<T, S>,
    st: &mut LoopStore<'_, T, S>,
) {
    let freedoms = kind.n_freedoms::<T, S>();
    for pass in &m.plan.passes[m.plan.stations[i].passes.range()] {
        let lap = &m.loops[pass.lap as usize];
        let mut at = pass.gain as usize;
        for row in lap.first as usize..(lap.first + lap.n) as usize {
            st.l[row] += driven(&c.drive, &st.gains[at..at + freedoms]);
            at += freedoms;
        }
    }
}

/// Eliminates the loops that end at link `i`; `a_ground` is the acceleration of the ground.
#[inline]
pub(crate) fn close<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    (i, regularisation, a_ground): (usize, Regularisation<T>, &S::Motion),
    c: &mut Condensed<T, S>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), RankLost<T>> {
    let ends = &m.plan.ends[m.plan.stations[i].ends.range()];
    let n_rows = m.rows.len();
    for end in ends {
        let lap = &m.loops[end.lap as usize];
        for row in lap.first as usize..(lap.first + lap.n) as usize {
            // Both branches meet.
            let both = st.k[row] + st.k[n_rows + row];
            st.k[row] = both;
            if i == 0 {
                st.l[row] += both.dot(a_ground);
            }
        }
    }
    for end in ends {
        let lap = &m.loops[end.lap as usize];
        let (first, n) = (lap.first as usize, lap.n as usize);
        regularise(m, lap, regularisation, st)?;
        // K̃ = C⁻¹ K,   l̃ = C⁻¹ l
        let block = &st.blocks[lap.block as usize..];
        for r in 0..n {
            for s in 0..r {
                let (k_s, l_s) = (st.k[first + s], st.l[first + s]);
                st.k[first + r] -= k_s * block[r * n + s];
                st.l[first + r] -= l_s * block[r * n + s];
            }
            let inverse = T::ONE / block[r * n + r];
            st.k[first + r] = st.k[first + r] * inverse;
            st.l[first + r] *= inverse;
            if i > 0 {
                // I += K̃ᵀ K̃,   p += K̃ᵀ l̃
                S::add_square(&mut c.inertia, &st.k[first + r]);
                c.force += st.k[first + r] * st.l[first + r];
            }
        }
        couple(m, end, i > 0, st);
    }
    Ok(())
}

/// Adds ε times the rows' scale to Λ and factors it: Λ = C Cᵀ, in place, lower triangle.
fn regularise<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    lap: &Loop<T, S>,
    regularisation: Regularisation<T>,
    st: &mut LoopStore<'_, T, S>,
) -> Result<(), RankLost<T>> {
    let (first, n) = (lap.first as usize, lap.n as usize);
    let block = &mut st.blocks[lap.block as usize..][..n * n];
    let mut scale = m.floor;
    for r in 0..n {
        let of = usize::from(m.rows[first + r].is_angle());
        scale[of] = scale[of].max(st.scales[first + r]);
    }
    for r in 0..n {
        let scale = scale[usize::from(m.rows[first + r].is_angle())];
        for s in 0..r {
            let mut x = block[r * n + s];
            for t in 0..s {
                x -= block[r * n + t] * block[s * n + t];
            }
            block[r * n + s] = x / block[s * n + s];
        }
        let added = match regularisation {
            Regularisation::Scaled(share) => share * scale,
            Regularisation::Fixed(added) => added,
        };
        let mut pivot = block[r * n + r] + added;
        for t in 0..r {
            pivot -= block[r * n + t] * block[r * n + t];
        }
        st.pivots[first + r] = pivot / scale;
        if !(pivot > T::ZERO) {
            return Err(RankLost { row: lap.first + index(r), pivot: pivot / scale });
        }
        block[r * n + r] = pivot.sqrt();
    }
    Ok(())
}

/// W = Λₗₖ C⁻ᵀ for every later loop l; Kₗ −= W K̃, lₗ −= W l̃, Λₗₗ' −= W W'ᵀ.
fn couple<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    end: &End,
    has_rows: bool,
    st: &mut LoopStore<'_, T, S>,
) {
    let lap = &m.loops[end.lap as usize];
    let (first, n, own) = (lap.first as usize, lap.n as usize, lap.block as usize);
    let n_rows = m.rows.len();
    for coupling in &m.plan.couplings[end.couplings.range()] {
        let later = &m.loops[coupling.lap as usize];
        for r in 0..later.n as usize {
            let (row, at) = (later.first as usize + r, coupling.block as usize + r * n);
            let place = coupling.side as usize * n_rows + row;
            for s in 0..n {
                let mut x = st.blocks[at + s];
                for t in 0..s {
                    x -= st.blocks[at + t] * st.blocks[own + s * n + t];
                }
                let w = x / st.blocks[own + s * n + s];
                st.blocks[at + s] = w;
                if has_rows {
                    let k = st.k[first + s];
                    st.k[place] -= k * w;
                }
                st.l[row] -= w * st.l[first + s];
            }
        }
    }
    for update in &m.plan.updates[end.updates.range()] {
        let [x, y] = [update.row, update.column].map(|j| m.plan.couplings[j as usize]);
        let [rows, columns] = [x, y].map(|q| m.loops[q.lap as usize].n as usize);
        let mut at = update.block as usize;
        for r in 0..rows {
            for s in 0..columns {
                let [w, v] = [x.block as usize + r * n, y.block as usize + s * n];
                let change = inner(&st.blocks[w..w + n], &st.blocks[v..v + n]);
                st.blocks[at] -= change;
                at += 1;
            }
        }
    }
}

/// The same elimination for l alone.
#[inline]
pub(crate) fn close_again<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    i: usize,
    c: &mut Condensed<T, S>,
    st: &mut LoopStore<'_, T, S>,
) {
    for end in &m.plan.ends[m.plan.stations[i].ends.range()] {
        let lap = &m.loops[end.lap as usize];
        let (first, n) = (lap.first as usize, lap.n as usize);
        for r in 0..n {
            let at = lap.block as usize + r * n;
            for s in 0..r {
                st.l[first + r] -= st.blocks[at + s] * st.l[first + s];
            }
            st.l[first + r] /= st.blocks[at + r];
            if i > 0 {
                c.force += st.k[first + r] * st.l[first + r];
            }
        }
        for coupling in &m.plan.couplings[end.couplings.range()] {
            let later = &m.loops[coupling.lap as usize];
            for r in 0..later.n as usize {
                let w = &st.blocks[coupling.block as usize + r * n..][..n];
                let change = inner(w, &st.l[first..first + n]);
                st.l[later.first as usize + r] -= change;
            }
        }
    }
}

/// λ of the loops that end at link `i`, whose acceleration is `a` (`None` for the ground, where it is in l already).
#[inline]
pub(crate) fn open<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    i: usize,
    a: Option<&S::Motion>,
    st: &mut LoopStore<'_, T, S>,
) {
    for end in m.plan.ends[m.plan.stations[i].ends.range()].iter().rev() {
        let lap = &m.loops[end.lap as usize];
        let (first, n) = (lap.first as usize, lap.n as usize);
        for r in 0..n {
            let known = a.map_or(T::ZERO, |a| st.k[first + r].dot(a));
            st.lambda[first + r] = known + st.l[first + r];
        }
        for coupling in &m.plan.couplings[end.couplings.range()] {
            let later = &m.loops[coupling.lap as usize];
            for r in 0..later.n as usize {
                let x = st.lambda[later.first as usize + r];
                for s in 0..n {
                    st.lambda[first + s] -= st.blocks[coupling.block as usize + r * n + s] * x;
                }
            }
        }
        for r in (0..n).rev() {
            let mut x = st.lambda[first + r];
            for s in r + 1..n {
                x -= st.blocks[lap.block as usize + s * n + r] * st.lambda[first + s];
            }
            st.lambda[first + r] = x / st.blocks[lap.block as usize + r * n + r];
        }
    }
}

/// D⁻¹ (K b)ᵀ λ at the joint of link `i`.
#[inline]
pub(crate) fn held<T: Real, S: Space<T>>(
    m: &Loops<'_, T, S>,
    i: usize,
    kind: Kind,
    st: &LoopStore<'_, T, S>,
) -> S::Motion {
    let freedoms = kind.n_freedoms::<T, S>();
    let mut held = S::Motion::zero();
    for &Pass { lap, gain, .. } in &m.plan.passes[m.plan.stations[i].passes.range()] {
        let lap = &m.loops[lap as usize];
        let mut at = gain as usize;
        for row in lap.first as usize..(lap.first + lap.n) as usize {
            for f in 0..freedoms {
                held[f] += st.gains[at + f] * st.lambda[row];
            }
            at += freedoms;
        }
    }
    held
}

/// g·u over the joint's freedoms.
#[inline(always)]
fn driven<T: Real, M: Numbers<T>>(drive: &M, gain: &[T]) -> T {
    let mut sum = T::ZERO;
    for (f, &g) in gain.iter().enumerate() {
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
