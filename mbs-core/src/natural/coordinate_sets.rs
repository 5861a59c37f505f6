//! Entities of a group that a row uses. Most rows use one or two points or directions. Their products g g^T then fill a small part
//! of a block; g is the gradient, and w a weight.
//!
//! ```text
//! block += w g g^T,   g = [0 .. g_a .. 0 .. g_b .. 0]          21 numbers of 78 for two of four points in space
//! ```

use super::group::{add_squares, packed};
use crate::Real;

/// Set of the entities that a row uses: one or two entities, each given by its first column, or any entities of its group.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CoordinateSet {
    first: u8,
    second: u8,
}

impl CoordinateSet {
    /// Set of a row that may use any unknown of its group.
    pub const ANY: Self = Self { first: u8::MAX, second: u8::MAX };

    /// Set of a row that uses the entities `touched`, given by their places among the `n` unknown entities of its group.
    pub fn of(touched: impl Iterator<Item = usize>, n: usize, dimension: usize) -> Self {
        let (mut least, mut most, mut between) = (usize::MAX, 0, false);
        let mut seen = [usize::MAX; 2];
        for at in touched {
            between |= !seen.contains(&at) && seen[1] != usize::MAX;
            if !seen.contains(&at) {
                seen = if seen[0] == usize::MAX { [at, seen[1]] } else { [seen[0], at] };
            }
            (least, most) = (least.min(at), most.max(at));
        }
        let column =
            |at: usize| u8::try_from(at.saturating_mul(dimension)).ok().filter(|&c| c < u8::MAX);
        match (column(least), column(most)) {
            (Some(first), Some(second)) if !between && n > 2 => Self { first, second },
            _ => Self::ANY,
        }
    }

    /// First columns of the two entities, the lower one first. Both are equal if the row uses one entity. `None` if the row may use
    /// any.
    #[inline(always)]
    pub fn pair(self) -> Option<[usize; 2]> {
        (self != Self::ANY).then_some([self.first as usize, self.second as usize])
    }
}

/// Adds sum_r w_r g_r g_r^T to the block over the rows of a group, whose gradients are `width` long. A row without an entry in
/// `reach` may use all columns.
#[inline(always)]
pub(crate) fn add_rows<T: Real, const D: usize>(
    block: &mut [T],
    k: usize,
    (mut g, width): (&[T], usize),
    (mut weights, mut reach): (&[T], &[CoordinateSet]),
) {
    while let ([w, others @ ..], [row, rows @ ..]) = (weights, reach) {
        if let Some(pair) = row.pair() {
            add_pair_square::<T, D>(block, k, g, pair, *w);
        } else if let (
            [_, w2, w3, others @ ..],
            [CoordinateSet::ANY, CoordinateSet::ANY, rows @ ..],
        ) = (weights, rows)
        {
            add_squares(block, k, [g, &g[width..], &g[2 * width..]], [*w, *w2, *w3]);
            (g, weights, reach) = (&g[3 * width..], others, rows);
            continue;
        } else {
            add_squares(block, k, [g], [*w]);
        }
        (g, weights, reach) = (&g[width..], others, rows);
    }
    while let [w1, w2, w3, others @ ..] = weights {
        add_squares(block, k, [g, &g[width..], &g[2 * width..]], [*w1, *w2, *w3]);
        (g, weights) = (&g[3 * width..], others);
    }
    for &w in weights {
        add_squares(block, k, [g], [w]);
        g = &g[width..];
    }
}

/// Adds w g g^T to a block of `k` unknowns, for a gradient g that uses only the entities at columns `a` <= `b`.
#[inline(always)]
pub fn add_pair_square<T: Real, const D: usize>(
    block: &mut [T],
    k: usize,
    g: &[T],
    [a, b]: [usize; 2],
    w: T,
) {
    let (ga, gb) = (&g[a..a + D], &g[b..b + D]);
    for c in 0..D {
        let (at, wa) = (packed(k, a + c, a + c), ga[c] * w);
        let column = &mut block[at..at + D - c];
        for i in c..D {
            column[i - c] += ga[i] * wa;
        }
        if a == b {
            continue;
        }
        let column = &mut block[at + b - a - c..][..D];
        for i in 0..D {
            column[i] += gb[i] * wa;
        }
        let (at, wb) = (packed(k, b + c, b + c), gb[c] * w);
        let column = &mut block[at..at + D - c];
        for i in c..D {
            column[i - c] += gb[i] * wb;
        }
    }
}
