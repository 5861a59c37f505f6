//! Entities of its group that a row touches: most rows say something about one point or direction, or two.
//!
//! ```text
//! block += w g g^T,   g = [0 .. g_a .. 0 .. g_b .. 0]          21 numbers of 78 for two of four points in space
//! ```

use super::group::{add_squares, packed};
use crate::Real;

/// The columns of the first unknowns that a row touches: of one entity or two in a group that has more, or of any.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CoordinateSet {
    first: u8,
    second: u8,
}

impl CoordinateSet {
    /// A row that touches any unknown of its group.
    pub const ANY: Self = Self { first: u8::MAX, second: u8::MAX };

    /// Set of a row that touches these entities, by their places among the unknown ones of a group of `n`.
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

    /// The first columns of the two entities, the lower one first; equal where there is one.
    #[inline(always)]
    pub fn pair(self) -> Option<[usize; 2]> {
        (self != Self::ANY).then_some([self.first as usize, self.second as usize])
    }
}

/// block += sum_r w_r g_r g_r^T over the rows of a group, whose gradients are `width` long; without `reach` any may touch all.
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

/// block += w g g^T for a gradient that touches the entities at columns `a` <= `b` alone; the block has `k` unknowns.
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
