//! User-defined relations: rows with a function φ of joint coordinates and lengths in place of a sum.
//!
//! ```text
//! Φ = (φ(c₁ m₁ .. cₙ mₙ) − s(t)) / c          c: its largest derivative in the reference configuration
//! Φ̈ = Σ φₖ cₖ m̈ₖ + ṁᵀ H ṁ                     head = K b + g as of a sum, with the slopes φₖ cₖ
//! ```
//!
//! A term of such a row has the index of its relation in place of the index of a curve. The derivatives of φ are stored in the list of the
//! slopes of curves.

use crate::link::indexing::{Outside, at_mut, range};
use crate::rows::coupled::{CoupledRow, CoupledValue, Couplings, Gradients, Here, NONE};
use crate::space::{Numbers, Space};
use mbs_core::Real;
use mbs_core::laws::code::NumberedRelation;
use mbs_core::laws::relation::MAX_ARGUMENTS;
use mbs_core::measure::Arguments;

/// Smallest curve index that means a relation. The index minus this constant is the index of the relation. No scene has this number of
/// curves.
pub(crate) const ARGUMENTS: u32 = 1 << 31;

impl<T: Real, S: Space<T>> Couplings<'_, T, S> {
    /// True if the row belongs to a user-defined relation.
    #[inline(always)]
    pub(crate) fn is_related(&self, row: &CoupledRow<T>) -> bool {
        let first = self.terms.get(row.terms.first as usize);
        first.is_some_and(|term| term.curve >= ARGUMENTS && term.curve != NONE)
    }

    fn relation(&self, row: &CoupledRow<T>) -> Result<NumberedRelation<'_>, Outside> {
        let first = self.terms.get(row.terms.first as usize).ok_or(Outside)?;
        Ok(self.relations.ok_or(Outside)?.relation(first.curve - ARGUMENTS))
    }

    /// Evaluates the row of a user-defined relation, and writes gradients if requested.
    #[inline(never)]
    pub(crate) fn of_relation(
        &self,
        (row, k, n_rows): (&CoupledRow<T>, usize, usize),
        here: Here<'_, T, S>,
        mut out: Option<Gradients<'_, T, S>>,
    ) -> Result<CoupledValue<T>, Outside> {
        let relation = self.relation(row)?;
        let terms = range(self.terms, row.terms.range())?;
        let mut arguments = Arguments::default();
        let mut measured = [([T::ZERO; 3], T::ZERO); MAX_ARGUMENTS];
        for (term, to) in terms.iter().zip(&mut measured) {
            *to = self.measure((&term.of, row.starts), here)?;
            let ([m, rate, _], _) = *to;
            arguments.push([term.factor * m, T::ZERO], term.factor * rate);
        }
        let value = arguments.evaluate(&relation) * row.inverse;
        let bent = arguments.curvature(&relation) * row.inverse;
        let mut sum = CoupledValue::zero();
        sum.add([value, T::ZERO, bent], T::ZERO);
        if let Some((gradient, _)) = &mut out {
            gradient.iter_mut().skip(k).step_by(n_rows.max(1)).for_each(|k| *k = S::Motion::zero());
        }
        for (number, ((i, term), of)) in row.terms.range().zip(terms).zip(measured).enumerate() {
            let ([m, rate, known], speed) = of;
            let slope = arguments.slope(number) * row.inverse * term.factor;
            sum.add([T::ZERO, slope * rate, slope * known], slope * speed);
            // the rounding error of the value is relative to its parts
            sum.parts[0] += (slope * m).abs();
            let Some((gradient, slopes)) = &mut out else { continue };
            *at_mut(slopes, i)? = slope;
            self.add_gradient((term, row.starts, slope), (k, n_rows), here.1, gradient)?;
        }
        Ok(sum)
    }
}
