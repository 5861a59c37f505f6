//! Prepared term of a sum: a measured number with a factor and a curve.

use super::PreparedCurve;
use crate::Real;
use crate::algebra::{Vector, norm};
use crate::scene::{BodyId, CouplingMeasure, CouplingTerm};
use alloc::vec::Vec;

/// Term of a coupling, prepared for evaluation.
#[derive(Debug, Clone, PartialEq)]
pub struct TermInput<T> {
    /// Factor of the term.
    pub factor: T,
    /// Coordinate or length that is measured.
    pub of: CouplingMeasure<T>,
    /// Joint and number of the coordinate; `None` for a length.
    pub coordinate: Option<(usize, usize)>,
    /// Function of the measured number.
    pub curve: PreparedCurve<T>,
    /// True if a length counts in full. Otherwise the length in the reference configuration is subtracted.
    pub is_whole: bool,
}

impl<T: Real> TermInput<T> {
    /// Prepares the terms whose factor is not zero.
    #[must_use]
    pub fn all(terms: &[CouplingTerm<T>]) -> Vec<Self> {
        let terms = terms.iter().filter(|term| !term.factor.is_zero());
        let prepared = terms.map(|term| Self {
            factor: term.factor,
            curve: PreparedCurve::new(term.curve.as_ref()),
            is_whole: false,
            ..Self::measured(&term.of)
        });
        prepared.collect()
    }

    /// Term that is a measured number without factor and curve; a length counts in full.
    #[must_use]
    pub fn measured(of: &CouplingMeasure<T>) -> Self {
        Self {
            factor: T::ONE,
            of: of.clone(),
            coordinate: of.coordinate().map(|(joint, number)| (joint.index(), number)),
            curve: PreparedCurve::Identity,
            is_whole: true,
        }
    }

    /// Term that is the full length of a line over points.
    #[must_use]
    pub fn line(points: &[(BodyId, [T; 3])]) -> Self {
        Self::measured(&CouplingMeasure::Length { points: points.to_vec() })
    }

    /// Length that is subtracted from a measured length over these points [m]. It is the length in the reference configuration, or zero if the
    /// length counts in full.
    #[must_use]
    pub fn reference_of(&self, points: &[[T; 3]; 2]) -> T {
        let [p, q] = points.map(Vector::<T, 3>::from);
        if self.is_whole { T::ZERO } else { norm(&(q - p)) }
    }
}
