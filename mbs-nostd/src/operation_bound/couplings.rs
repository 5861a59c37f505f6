//! Operations of couplings and sums: N numbers of a motion, d of a point, p parts of a line.
//!
//! ```text
//! joint      a coordinate                    with a curve: the function, and what its slope and its bend add
//! line       p (geometry + length, rate, bias),   once more p (geometry + 2 (wrench + N)) where it is pushed
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

/// Entries that the value of a term looks up [-]: those of a gear train on a Cortex-M7, rounded up.
const TERM_ENTRIES: u64 = 4;
/// Entries that its residual looks up [-]: as above.
const RESIDUAL_ENTRIES: u64 = 2;
/// Entries that its curve looks up [-]: those of a cam with nine knots on a Cortex-M7, rounded up.
const CURVE_ENTRIES: u64 = 24;

const fn ops(products: u64, sums: u64) -> Operations {
    Operations::new(products, sums)
}

/// Numbers of a point, and of a motion.
const fn numbers<T: Real, S: Space<T>>() -> (u64, u64) {
    (count(S::Point::N), count(S::Motion::N))
}

/// A point turned, and its product with a spin.
fn turned<T: Real, S: Space<T>>() -> [Operations; 2] {
    if S::DIMENSION == 3 { [ops(9, 6), ops(6, 3)] } else { [ops(4, 2), ops(2, 0)] }
}

/// Parts of a term's line; of a coordinate none.
fn parts<T>(term: &SumTerm<T>) -> u64 {
    match term.of {
        SumMeasure::Line { points, .. } => count(points.range().len().saturating_sub(1)),
        _ => 0,
    }
}

/// The terms of a list, and whether all are coordinates without curves.
fn terms<'a, T: Real, S: Space<T>>(
    couplings: &Couplings<'a, T, S>,
    of: Span,
) -> (&'a [SumTerm<T>], bool) {
    let terms = couplings.terms.get(of.range()).unwrap_or(&[]);
    let is_plain =
        |term: &SumTerm<T>| term.curve == NONE && matches!(term.of, SumMeasure::Joint { .. });
    (terms, terms.iter().all(is_plain))
}

/// Parts of all lines of a list of terms.
fn n_parts<T: Real, S: Space<T>>(couplings: &Couplings<'_, T, S>, of: Span) -> u64 {
    terms(couplings, of).0.iter().map(parts).sum()
}

/// A part of a line: its ends with velocities and their biases, its direction.
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

/// Value, rate, bias and gradient of a sum.
fn value<T: Real, S: Space<T>>(couplings: &Couplings<'_, T, S>, of: Span) -> Operations {
    let (terms, is_plain) = terms(couplings, of);
    let mut sum = Operations::NONE;
    for term in terms {
        sum += ops(8, 8) + Operations::entries(TERM_ENTRIES);
        if !is_plain {
            // looked at once more
            sum += ops(3, 5) + function(couplings, term.curve);
            sum += (measured::<T, S>() + pushed::<T, S>()) * parts(term);
        }
        if term.curve != NONE {
            sum += Operations::entries(CURVE_ENTRIES);
        }
    }
    sum
}

/// The row of a coupling.
pub(super) fn row<T: Real, S: Space<T>>(
    couplings: &Couplings<'_, T, S>,
    row: &CoupledRow<T>,
) -> Operations {
    value(couplings, row.terms) + ops(3, 12)
}

/// J a + bias of a coupling's row, beside what any row has.
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

/// Sides of rows that are added to the second one before an elimination.
pub(super) fn added<T: Real, S: Space<T>>(m: &TreeSlices<'_, T, S>) -> u64 {
    count(n_sides(m).saturating_sub(1))
}

/// A sum that an effect acts on, ahead; `resist` is an end's answer.
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

/// The gaps of the parts of a sum at both ends of a step.
fn gaps<T: Real, S: Space<T>>(couplings: &Couplings<'_, T, S>, of: Span) -> Operations {
    let ([turned, cross], (d, _)) = (turned::<T, S>(), numbers::<T, S>());
    let part = (turned + cross + ops(0, 2 * d)) * 4 + ops(4 * d + 6, 8 * d + 3);
    part * n_parts(couplings, of)
}

/// Whether a part of a line has collapsed in a step: with the inputs of an instant, and the places of all links.
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
        // is the law apart from it at both ends?
        if n_parts(couplings, load.terms) > 0 {
            sum += value(couplings, load.terms) * 2 + both_ends;
        }
    }
    sum
}
