//! A number that a mechanism has, with a factor and a curve, prepared.

use super::PreparedCurve;
use crate::Real;
use crate::algebra::{Vector, norm};
use crate::scene::{BodyId, CouplingMeasure, CouplingTerm};
use alloc::vec::Vec;

/// A term of a coupling, prepared.
#[derive(Debug, Clone, PartialEq)]
pub struct TermInput<T> {
    /// Factor of the term.
    pub factor: T,
    /// Number that is measured.
    pub of: CouplingMeasure<T>,
    /// Joint and number of a coordinate; `None` of a length.
    pub coordinate: Option<(usize, usize)>,
    /// The function of the measured number.
    pub curve: PreparedCurve<T>,
    /// Does a length count whole, and not from the reference configuration?
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

    /// A number by itself; a length counts whole.
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

    /// The whole length of a line over points.
    #[must_use]
    pub fn line(points: &[(BodyId, [T; 3])]) -> Self {
        Self::measured(&CouplingMeasure::Length { points: points.to_vec() })
    }

    /// Length from which a measured length over these points counts [m]: that in the reference configuration, or zero where it counts whole.
    #[must_use]
    pub fn reference_of(&self, points: &[[T; 3]; 2]) -> T {
        let [p, q] = points.map(Vector::<T, 3>::from);
        if self.is_whole { T::ZERO } else { norm(&(q - p)) }
    }
}
