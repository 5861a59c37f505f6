//! A coupling with its curves and its function of time prepared.

use super::TermInput;
use crate::Real;
use crate::inputs::GuideInput;
use crate::scene::{Coupling, Motion};
use alloc::vec::Vec;

/// A coupling, prepared.
#[derive(Debug, Clone, PartialEq)]
pub struct CouplingInput<T> {
    /// Its terms whose factor is not zero.
    pub terms: Vec<TermInput<T>>,
    /// What the sum is in the course of time, where it is not always zero.
    pub sum: Option<GuideInput<T>>,
}

impl<T: Real> CouplingInput<T> {
    /// Prepares a coupling.
    #[must_use]
    pub fn new(coupling: &Coupling<T>) -> Self {
        let still = Motion::Ramp { rate: T::ZERO };
        let law = coupling.motion.as_ref().unwrap_or(&still);
        let sum = coupling.has_sum().then(|| GuideInput::new(law).shifted_by(coupling.value));
        Self { terms: TermInput::all(&coupling.terms), sum }
    }

    /// What the sum is at time `t` [s], with the values of the scene's signals there.
    #[must_use]
    pub fn sum_at(&self, t: T, signals: &[[T; 3]]) -> T {
        self.sum.as_ref().map_or(T::ZERO, |sum| sum.at(t, signals)[0])
    }

    /// The largest factor: rows divided by it are of order one.
    #[must_use]
    pub fn scale(&self) -> T {
        self.terms.iter().fold(T::ZERO, |most, term| most.max(term.factor.abs()))
    }
}
