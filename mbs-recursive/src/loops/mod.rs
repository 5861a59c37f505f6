//! Closed loops in general form: rows travel inward to the nearest common ancestor and are eliminated there.
//!
//! ```text
//! passing a joint     K ← K − (K b) D⁻¹ Uᵀ,   l += K d + (K b) D⁻¹ u,   Λₖₗ += (Kₖ b) D⁻¹ (Kₗ b)ᵀ
//! that is coupled     the same with K b + g in place of K b
//! at the ancestor     Λ = C Cᵀ,   K̃ = C⁻¹ K,   l̃ = C⁻¹ l,   I += K̃ᵀ K̃,   p += K̃ᵀ l̃,   W = Λₗₖ C⁻ᵀ
//!                     Kₗ −= W K̃,   lₗ −= W l̃,   Λₗₗ' −= W W'ᵀ
//! outward             λ = C⁻ᵀ (K̃ a + l̃ − Σ Wᵀ λₗ),   z'' −= D⁻¹ (K b)ᵀ λ
//! ```
//!
//! K b D⁻¹ is kept for each joint on the way (`gains`). Λ is regularised by ε times its rows' own scale. C is kept with the inverses
//! of its diagonal.
//!
//! Most loops have as many rows as a point has coordinates, couplings have one, and most joints have one freedom: `sized` gives these the
//! passes that know it.

/// Runs a function of sizes, the common ones as constants.
///
/// The function is inlined: with constants its loops are unrolled, and its checks of lengths fall away.
macro_rules! sized {
    ($sizes:expr, often $common:expr, of couplings $single:expr, $function:ident($($argument:expr),*)) => {{
        let sizes = $sizes;
        if sizes == $common {
            $function($common, $($argument),*)
        } else if crate::rows::coupled::IS_BUILT && sizes == $single {
            $function($single, $($argument),*)
        } else {
            $function(sizes, $($argument),*)
        }
    }};
}

mod carry;
mod eliminate;
mod fault;
mod release;

pub(crate) use carry::{held, pass, pass_again};
pub(crate) use eliminate::{close, close_again};
pub use fault::Fault;
pub(crate) use release::open;

use crate::link::plan::Plan;
use crate::rows::Row;
use crate::rows::closed_loop::ClosedLoop;
use crate::rows::coupled::{self, CoupledRow, Couplings};
use crate::space::Space;
use mbs_core::Real;

/// The loops of a mechanism: constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loops<'a, T: Real, S: Space<T>> {
    /// Loops of the cut joints; those of couplings behind them.
    pub loops: &'a [ClosedLoop<T, S>],
    /// Rows of all loops, one for each equation.
    pub rows: &'a [Row<T, S>],
    /// Order of the passes: which loops meet, and where they are eliminated.
    pub plan: Plan<'a>,
    /// The least scale of a row's mobility: of lengths [1/kg], of angles [1/(kg m^2)].
    pub floor: [T; 2],
    /// Tables that the rows of couplings refer to.
    pub couplings: Couplings<'a, T, S>,
}

impl<'a, T: Real, S: Space<T>> Loops<'a, T, S> {
    /// The loops that are cut joints.
    pub(crate) fn cut(&self) -> &'a [ClosedLoop<T, S>] {
        self.loops.get(..self.couplings.n_cut as usize).unwrap_or(self.loops)
    }

    /// Are there couplings? Passes over all rows ask this once.
    #[inline(always)]
    pub(crate) fn has_coupled(&self) -> bool {
        coupled::IS_BUILT && (self.couplings.n_cut as usize) < self.loops.len()
    }

    /// The rows of couplings: each with its number and the number of rows.
    pub(crate) fn coupled(&self) -> impl Iterator<Item = (&'a CoupledRow<T>, usize, usize)> + 'a {
        let rows = self.rows;
        let first = if coupled::IS_BUILT { self.couplings.n_cut as usize } else { usize::MAX };
        let coupled = self.loops.get(first..).unwrap_or(&[]);
        coupled.iter().filter_map(move |lap| {
            let k = lap.first as usize;
            let Some(Row::Coupled(row)) = rows.get(k) else { return None };
            Some((row, k, rows.len()))
        })
    }
}

/// Memory that the loops need during an evaluation.
#[derive(Debug)]
pub struct LoopStore<'a, T: Real, S: Space<T>> {
    /// K of all sides as they travel: all first sides, then all second ones, and so on.
    pub k: &'a mut [S::Motion],
    /// The slopes of the terms of couplings that have curves, by the number of the term.
    pub slopes: &'a mut [T],
    /// Numbers l of the rows, later l̃.
    pub l: &'a mut [T],
    /// Multipliers λ of the rows.
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

/// Numbers that are added to the diagonal of Λ.
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
    /// Number of the row.
    pub row: u32,
    /// Pivot of the row, relative to its scale.
    pub pivot: T,
}

#[inline(always)]
fn inner<T: Real>(x: &[T], y: &[T]) -> T {
    x.iter().zip(y).fold(T::ZERO, |sum, (&x, &y)| sum + x * y)
}

/// Indices of a mechanism fit 32 bits.
pub(crate) fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}
