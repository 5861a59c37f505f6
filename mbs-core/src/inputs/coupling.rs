//! Couplings with prepared curves and functions of time.

use super::GuideInput;
use crate::Real;
use crate::laws::code::Code;
use crate::laws::relation::Relation;
use crate::measure::{Arguments, TermInput};
use crate::scene::{Coupling, Motion};
use alloc::vec::Vec;

/// Coupling with prepared curves and function of time.
#[derive(Debug, Clone, PartialEq)]
pub struct CouplingInput<T> {
    /// Terms of the coupling with a factor other than zero.
    pub terms: Vec<TermInput<T>>,
    /// Relation of the terms that is constrained; `None`: their sum is constrained.
    pub relation: Option<Code<dyn Relation>>,
    /// Function of time that the sum follows; `None` if the sum is always zero.
    pub sum: Option<GuideInput<T>>,
}

impl<T: Real> CouplingInput<T> {
    /// Prepares the curves and the function of time of a coupling.
    #[must_use]
    pub fn new(coupling: &Coupling<T>) -> Self {
        let still = Motion::Ramp { rate: T::ZERO };
        let law = coupling.motion.as_ref().unwrap_or(&still);
        let sum = coupling.has_sum().then(|| GuideInput::new(law).shifted_by(coupling.value));
        Self { terms: TermInput::all(&coupling.terms), relation: coupling.relation.clone(), sum }
    }

    /// Value of the sum at time `t` [s]; `signals` are the values of the scene's signals at this time.
    #[must_use]
    pub fn sum_at(&self, t: T, signals: &[[T; 3]]) -> T {
        self.sum.as_ref().map_or(T::ZERO, |sum| sum.at(t, signals)[0])
    }

    /// Largest factor; for a relation, the largest derivative in the reference configuration. Rows divided by it are of order one.
    #[must_use]
    pub fn scale(&self) -> T {
        let slopes = (0..self.terms.len()).map(|k| self.reference_slope(k).abs());
        slopes.fold(T::ZERO, T::max)
    }

    /// Factor of a term. In a relation it is multiplied by the derivative of the relation by the term, in the reference
    /// configuration. If all these derivatives are zero, the factor alone is returned.
    #[must_use]
    pub fn reference_slope(&self, term: usize) -> T {
        let factor = self.terms.get(term).map_or(T::ZERO, |term| term.factor);
        let Some(relation) = &self.relation else { return factor };
        let mut arguments = Arguments::<T>::default();
        self.terms.iter().for_each(|_| arguments.push([T::ZERO; 2], T::ZERO));
        let value = arguments.evaluate(&**relation);
        let slopes = (0..self.terms.len()).map(|k| arguments.slope(k));
        let is_usable = value.is_finite() && slopes.clone().any(|slope| !slope.is_zero());
        if is_usable { factor * arguments.slope(term) } else { factor }
    }

    /// Value of the sum or relation for these values of the terms without their factors, and the largest of its parts.
    #[must_use]
    pub fn value_at(&self, values: &[T]) -> [T; 2] {
        let mut arguments = Arguments::<T>::default();
        let (mut sum, mut size) = (T::ZERO, T::ZERO);
        for (term, &value) in self.terms.iter().zip(values) {
            let part = term.factor * term.curve.at(value)[0];
            arguments.push([part, T::ZERO], T::ZERO);
            (sum, size) = (sum + part, size.max(part.abs()));
        }
        match &self.relation {
            None => [sum, size],
            Some(relation) => {
                let value = arguments.evaluate(&**relation);
                [value, value.abs()]
            }
        }
    }
}
