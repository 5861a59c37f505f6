//! Closed loops in general form. Rows are carried inward to the nearest common ancestor of the loop's bodies and eliminated there.
//!
//! ```text
//! passing a joint     K ← K − (K b) D⁻¹ Uᵀ,   l += K d + (K b) D⁻¹ u,   Λₖₗ += (Kₖ b) D⁻¹ (Kₗ b)ᵀ
//! joint with slope g  the same with K b + g in place of K b
//! at the ancestor     Λ = C Cᵀ,   K̃ = C⁻¹ K,   l̃ = C⁻¹ l,   I += K̃ᵀ K̃,   p += K̃ᵀ l̃,   W = Λₗₖ C⁻ᵀ
//!                     Kₗ −= W K̃,   lₗ −= W l̃,   Λₗₗ' −= W W'ᵀ
//! outward             λ = C⁻ᵀ (K̃ a + l̃ − Σ Wᵀ λₗ),   z'' −= D⁻¹ (K b)ᵀ λ
//! ```
//!
//! K is the gradient of the rows, l their right-hand side. b is the motion of a joint for unit rate, D its pivot, u the force along it. K b
//! D⁻¹ is stored for each joint that the rows pass (`gains`). ε times the scale of the rows is added to the diagonal of Λ. C is stored with
//! the inverses of its diagonal entries.
//!
//! Most loops have one row for each coordinate of a point, couplings have one row, and most joints have one freedom. For these sizes the
//! macro `sized` passes the sizes as constants.

/// Calls a function with its sizes. Common sizes are passed as constants.
///
/// The function is inlined. With constants the compiler unrolls its loops and removes its checks of lengths.
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

/// The loops of a mechanism; their data are constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Loops<'a, T: Real, S: Space<T>> {
    /// Loops of cut joints and rollings, then loops of couplings.
    pub loops: &'a [ClosedLoop<T, S>],
    /// Rows of all loops, one for each equation.
    pub rows: &'a [Row<T, S>],
    /// Order of the passes: which loops are coupled, and where each loop is eliminated.
    pub plan: Plan<'a>,
    /// Smallest scale of a row's mobility: first for rows that are lengths [1/kg], then for rows that are angles [1/(kg m^2)].
    pub floor: [T; 2],
    /// Tables to which the rows of couplings refer.
    pub couplings: Couplings<'a, T, S>,
}

impl<'a, T: Real, S: Space<T>> Loops<'a, T, S> {
    /// Returns the loops that belong to cut joints or rollings.
    pub(crate) fn cut(&self) -> &'a [ClosedLoop<T, S>] {
        self.loops.get(..self.couplings.n_cut as usize).unwrap_or(self.loops)
    }

    /// True if there are couplings among the loops. Passes over all rows check this once.
    #[inline(always)]
    pub(crate) fn has_coupled(&self) -> bool {
        coupled::IS_BUILT && (self.couplings.n_cut as usize) < self.loops.len()
    }

    /// Returns the rows of couplings. Each row comes with its index and the total number of rows.
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
    /// Gradients K of all sides as carried inward: all first sides, then all second sides, and so on.
    pub k: &'a mut [S::Motion],
    /// Slopes of the terms of couplings that have curves, by the index of the term.
    pub slopes: &'a mut [T],
    /// Right-hand sides l of the rows. The elimination replaces l by l̃.
    pub l: &'a mut [T],
    /// Multipliers λ of the rows.
    pub lambda: &'a mut [T],
    /// Blocks of the matrix Λ. The elimination replaces them by blocks of the factor of Λ.
    pub blocks: &'a mut [T],
    /// Products K b D⁻¹ of each pass.
    pub gains: &'a mut [T],
    /// Products K b of each pass, with the slope g added if the joint is a term of the row.
    pub heads: &'a mut [T],
    /// Mobility of each row, Σ (K b) D⁻¹ (K b)ᵀ, before any elimination.
    pub scales: &'a mut [T],
    /// Pivots of Λ, each relative to the scale of its row [-].
    pub pivots: &'a mut [T],
}

/// Regularisation: a number that is added to the diagonal of Λ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Regularisation<T> {
    /// Fraction of the rows' scale [-].
    Scaled(T),
    /// Equal number for every row [1/kg].
    Fixed(T),
}

/// A row has no effect on any freedom, or a row is redundant and the regularisation is too small to factor Λ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RankLost<T> {
    /// Index of the row.
    pub row: u32,
    /// Pivot of the row, relative to its scale.
    pub pivot: T,
}

#[inline(always)]
fn inner<T: Real>(x: &[T], y: &[T]) -> T {
    x.iter().zip(y).fold(T::ZERO, |sum, (&x, &y)| sum + x * y)
}

/// Converts an index of a mechanism to 32 bits. A larger index becomes the largest number of 32 bits.
pub(crate) fn index(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}
