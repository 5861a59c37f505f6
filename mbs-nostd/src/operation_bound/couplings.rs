//! Operation counts of couplings and sums. N is the number of components of a motion, d the number of components of a point, p the number
//! of parts of a line.
//!
//! ```text
//! joint      a coordinate                    with a curve: the function, and the products with its first and second derivatives
//! line       p (geometry + length, rate, bias),   in addition p (geometry + 2 (wrench + N)) for its forces
//! step       where there are lines: all links placed at its start, and the gaps of all parts at both ends
//! ```

use super::curves::function;
use super::{Operations, count};
use crate::check::n_sides;
use mbs_core::Real;
use mbs_recursive::link::plan::Span;
use mbs_recursive::loads::{Load, SumLoad};
use mbs_recursive::passes::slices::TreeSlices;
use mbs_recursive::rows::Row;
use mbs_recursive::rows::coupled::{CoupledRow, Couplings, NONE, SumMeasure, SumTerm};
use mbs_recursive::space::{Numbers, Space};

/// Number of table entries that are read for the value of a term [-]. Counted for a gear train on a Cortex-M7, rounded up.
const TERM_ENTRIES: u64 = 4;
/// Number of table entries that are read for the residual of a term [-]. Counted for a gear train on a Cortex-M7, rounded up.
const RESIDUAL_ENTRIES: u64 = 2;
/// Number of table entries that are read for the curve of a term [-]. Counted for a cam with nine knots on a Cortex-M7, rounded up.
const CURVE_ENTRIES: u64 = 24;

const fn ops(products: u64, sums: u64) -> Operations {
    Operations::new(products, sums)
}

/// Returns the numbers of components of a point and of a motion.
const fn numbers<T: Real, S: Space<T>>() -> (u64, u64) {
    (count(S::Point::N), count(S::Motion::N))
}

/// Operations to rotate a point, and operations for the cross product of an angular velocity and a vector.
fn turned<T: Real, S: Space<T>>() -> [Operations; 2] {
    if S::DIMENSION == 3 { [ops(9, 6), ops(6, 3)] } else { [ops(4, 2), ops(2, 0)] }
}

/// Returns the number of parts of a term's line; zero for other terms.
fn parts<T>(term: &SumTerm<T>) -> u64 {
    match term.of {
        SumMeasure::Line { points, .. } => count(points.range().len().saturating_sub(1)),
        _ => 0,
    }
}

/// Returns the terms of a range, and whether all of them are coordinates without curves.
fn terms<'a, T: Real, S: Space<T>>(
    couplings: &Couplings<'a, T, S>,
    of: Span,
) -> (&'a [SumTerm<T>], bool) {
    let terms = couplings.terms.get(of.range()).unwrap_or(&[]);
    let is_plain =
        |term: &SumTerm<T>| term.curve == NONE && matches!(term.of, SumMeasure::Joint { .. });
    (terms, terms.iter().all(is_plain))
}

/// Returns the number of parts of all lines of a range of terms.
fn n_parts<T: Real, S: Space<T>>(couplings: &Couplings<'_, T, S>, of: Span) -> u64 {
    terms(couplings, of).0.iter().map(parts).sum()
}

/// Operations for the geometry of a part of a line: its two ends with velocities and biases, and its direction.
fn geometry<T: Real, S: Space<T>>() -> Operations {
    let ([turned, cross], (d, _)) = (turned::<T, S>(), numbers::<T, S>());
    (turned + cross * 3 + ops(0, 2 * d)) * 2 + ops(2 * d, 4 * d).and(1, 1, 0)
}

/// Operations for the length, the rate and the bias of a part of a line.
fn measured<T: Real, S: Space<T>>() -> Operations {
    let (d, _) = numbers::<T, S>();
    geometry::<T, S>() + ops(4 * d + 1, 4 * d + 4).and(1, 1, 0)
}

/// Operations for the wrenches at the two ends of a part of a line.
fn pushed<T: Real, S: Space<T>>() -> Operations {
    let ([_, cross], (_, n)) = (turned::<T, S>(), numbers::<T, S>());
    geometry::<T, S>() + (cross + ops(n, n)) * 2
}

/// Operations for value, rate, bias and gradient of a sum.
fn value<T: Real, S: Space<T>>(couplings: &Couplings<'_, T, S>, of: Span) -> Operations {
    let (terms, is_plain) = terms(couplings, of);
    let mut sum = Operations::NONE;
    for term in terms {
        sum += ops(8, 8) + Operations::entries(TERM_ENTRIES);
        if !is_plain {
            // other terms need a second pass over the terms
            sum += ops(3, 5) + function(couplings, term.curve);
            sum += (measured::<T, S>() + pushed::<T, S>()) * parts(term);
        }
        if term.curve != NONE {
            sum += Operations::entries(CURVE_ENTRIES);
        }
    }
    sum
}

/// Operations for the row of a coupling.
pub(super) fn row<T: Real, S: Space<T>>(
    couplings: &Couplings<'_, T, S>,
    row: &CoupledRow<T>,
) -> Operations {
    value(couplings, row.terms) + ops(3, 12)
}

/// Operations for J a + bias of a coupling's row, in addition to the operations that every row needs.
pub(super) fn residual<T: Real, S: Space<T>>(row: &Row<T, S>) -> Operations {
    let (_, n) = numbers::<T, S>();
    match row {
        Row::Coupled(row) => {
            let terms = Operations::entries(RESIDUAL_ENTRIES) * count(row.terms.range().len());
            ops(2 * n, 2 * n + 2) * count(row.starts.range().len()) + terms
        }
        _ => Operations::NONE,
    }
}

/// Returns the number of gradients that are added when the gradients of all sides are summed before an elimination.
pub(super) fn added<T: Real, S: Space<T>>(m: &TreeSlices<'_, T, S>) -> u64 {
    count(n_sides(m).saturating_sub(1))
}

/// Operations for an effect on a sum, with its dependence on accelerations. `resist` is the count for one end.
pub(super) fn sum<T: Real, S: Space<T>>(
    couplings: &Couplings<'_, T, S>,
    sum: &SumLoad<T>,
    resist: Operations,
) -> Operations {
    let (terms, is_plain) = terms(couplings, sum.terms);
    let mut total = ops(5, 5) + sum.law.operations();
    if is_plain {
        return total + ops(15, 16) * count(terms.len());
    }
    total += value(couplings, sum.terms);
    for term in terms {
        let p = parts(term);
        let again = function(couplings, term.curve) + measured::<T, S>() * p + ops(1, 0);
        total += again * 2 + ops(15, 16) + (pushed::<T, S>() + (resist + ops(2, 1)) * 2) * p;
    }
    total
}

/// Operations for the vectors along all line parts of a sum, at the start and at the end of a step.
fn gaps<T: Real, S: Space<T>>(couplings: &Couplings<'_, T, S>, of: Span) -> Operations {
    let ([turned, cross], (d, _)) = (turned::<T, S>(), numbers::<T, S>());
    let part = (turned + cross + ops(0, 2 * d)) * 4 + ops(4 * d + 6, 8 * d + 3);
    part * n_parts(couplings, of)
}

/// Operations to check whether a part of a line has collapsed to zero length in a step. The arguments are the counts for the inputs at an
/// instant and for the places of all links.
pub(super) fn collapse<T: Real, S: Space<T>>(
    m: &TreeSlices<'_, T, S>,
    [inputs, places]: [Operations; 2],
) -> Operations {
    let couplings = &m.loops.couplings;
    if couplings.points.is_empty() {
        return Operations::NONE;
    }
    let both_ends = (inputs + ops(0, 1)) * 2;
    let mut sum = both_ends + places;
    for row in m.loops.rows {
        if let Row::Coupled(row) = row {
            sum += gaps(couplings, row.terms);
        }
    }
    for load in m.loads {
        let Load::Sum(load) = load else { continue };
        sum += gaps(couplings, load.terms);
        // operations to check whether the law has no force at the start and at the end of the step
        if n_parts(couplings, load.terms) > 0 {
            sum += value(couplings, load.terms) * 2 + both_ends;
        }
    }
    sum
}
