//! Group: the mass and the rows of one body, the rows of one joint, or one effect. Linear algebra sees a group as an *element*,
//! whose block is dense over the group's coordinates.

use crate::Real;
use crate::algebra::Coef;
use crate::elements::Span;
use crate::model::Owner;

/// Element of the model, given by its ranges in the tables.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Group {
    /// Entities of the group in the slot table (extended coordinates): unknown ones first, then constants.
    pub(crate) slots: Span,
    /// Number of the unknown entities.
    pub(crate) n_unknown: u32,
    /// Unknowns of the group in the clique table. Their number is k = n_unknown * D.
    pub(crate) clique: Span,
    /// Constraint rows of the group.
    pub(crate) rows: Span,
    /// Start of the group's rows in the Jacobian store. Each row is `width` long and begins with the unknowns.
    pub(crate) jacobian: u32,
    /// Columns of a row: entities times D.
    pub(crate) width: u32,
    /// Matrix G of the group's mass in the coefficient table (n_unknown squared numbers); empty without mass.
    pub(crate) mass: Span,
    /// True if a coefficient of G is complex, because the mass is not on the line of two basis points.
    pub(crate) is_mass_turned: bool,
    /// Constant mass block of the group in the block table (packed, k (k + 1) / 2 numbers); empty without mass.
    pub(crate) block: Span,
    /// Force vector of the group in the force store, k long; empty if no force acts.
    pub(crate) force: Span,
    /// Distance rows of the group, in their table.
    pub(crate) distances: Span,
    /// Dot-product rows of the group, in their table.
    pub(crate) dots: Span,
    /// Scalar laws of the group in the measure table; their gradients follow the constraint rows.
    pub(crate) measures: Span,
    /// True if the measures of the group belong to a law on one body.
    pub(crate) has_body_law: bool,
    /// Owner of the group. For merged bodies and joints, the owner of the first one.
    pub(crate) owner: Owner,
}

/// Adds G x to y over the entities of a group; y is local. The imaginary parts of G are skipped where `is_turned` is false.
#[inline(always)]
pub(crate) fn add_mass_product<T: Real, const D: usize>(
    (g, is_turned): (&[Coef<T>], bool),
    clique: &[u32],
    x: &[T],
    y: &mut [T],
) {
    let nb = clique.len() / D;
    let g = &g[..nb * nb];
    let y = &mut y[..nb * D];
    for j in 0..nb {
        let at = clique[j * D] as usize;
        let x = &x[at..at + D];
        for i in 0..nb {
            // The matrix G is Hermitian: column j is the conjugate of row j, which is contiguous.
            let c = g[j * nb + i];
            for a in 0..D {
                y[i * D + a] += c.re * x[a];
            }
            if D == 2 && is_turned {
                y[i * D] += c.im * x[1];
                y[i * D + 1] -= c.im * x[0];
            }
        }
    }
}

/// Place of the entry (row, column), row >= column, in a packed lower triangle of size k.
#[inline(always)]
pub(crate) fn packed(k: usize, row: usize, column: usize) -> usize {
    column * k - column * (column + 1) / 2 + row
}

/// Adds sum_r w_r g_r g_r^T to a block, over the first k entries of each g_r.
#[inline(always)]
pub fn add_squares<T: Real, const R: usize>(block: &mut [T], k: usize, g: [&[T]; R], w: [T; R]) {
    // No closures over arrays: the number of codegen units decides whether they are inlined.
    let mut g = g;
    for g in &mut g {
        *g = &g[..k];
    }
    let mut rest = block;
    for c in 0..k {
        let (column, next) = rest.split_at_mut(k - c);
        rest = next;
        let (mut g, mut t) = (g, w);
        for r in 0..R {
            g[r] = &g[r][c..];
            t[r] = g[r][0] * w[r];
        }
        for i in 0..k - c {
            let mut sum = column[i];
            for r in 0..R {
                sum += g[r][i] * t[r];
            }
            column[i] = sum;
        }
    }
}

/// Writes w g g^T to a block, over the first k entries of g.
#[inline(always)]
pub(crate) fn write_square<T: Real>(block: &mut [T], k: usize, g: &[T], w: T) {
    let g = &g[..k];
    let mut rest = block;
    for c in 0..k {
        let (column, next) = rest.split_at_mut(k - c);
        rest = next;
        let (g, t) = (&g[c..], g[c] * w);
        for i in 0..k - c {
            column[i] = g[i] * t;
        }
    }
}

/// Adds sum_r w_r g_r to y, over the first k entries of each g_r.
#[inline(always)]
pub(crate) fn add_multiples<T: Real, const R: usize>(y: &mut [T], g: [&[T]; R], w: [T; R]) {
    let mut g = g;
    for g in &mut g {
        *g = &g[..y.len()];
    }
    for i in 0..y.len() {
        let mut sum = y[i];
        for r in 0..R {
            sum += g[r][i] * w[r];
        }
        y[i] = sum;
    }
}

/// Adds s C_i^T C_j at the entity columns (i, j) of a packed block of size k, symmetrically. Columns of constants (>= k) are
/// skipped.
///
/// The sum over all ordered pairs (i, j) of two term lists adds the Hessian of s x.y.
#[inline(always)]
pub(crate) fn add_curvature<T: Real, const D: usize>(
    block: &mut [T],
    k: usize,
    (i, ci): (usize, Coef<T>),
    (j, cj): (usize, Coef<T>),
    s: T,
) {
    if i >= k || j >= k {
        return;
    }
    let c = if i >= j { ci.conj().times(cj) } else { cj.conj().times(ci) }.scaled(s);
    let (i, j) = if i >= j { (i, j) } else { (j, i) };
    if i == j {
        for a in 0..D {
            block[packed(k, i + a, i + a)] += c.re * T::TWO;
        }
        return;
    }
    for a in 0..D {
        block[packed(k, i + a, j + a)] += c.re;
    }
    if D == 2 {
        block[packed(k, i + 1, j)] += c.im;
        block[packed(k, i, j + 1)] -= c.im;
    }
}

/// Index as stored in tables, in 32 bits. A model with four thousand million entries does not fit into memory.
#[allow(clippy::cast_possible_truncation, reason = "tables are shorter than 2^32")]
pub(crate) fn index(i: usize) -> u32 {
    debug_assert!(u32::try_from(i).is_ok());
    i as u32
}
