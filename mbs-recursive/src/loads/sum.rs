//! A law of a sum of coordinates and lengths, for example a spring, a stop or a clutch between several joints.
//!
//! ```text
//! m = Σ cₖ fₖ(mₖ)        the terms are stored in the table of terms of couplings
//! joint                  τ = −g f,    g = c f'          along its coordinate
//! line                   −g f n at the end of a part, its opposite at the beginning
//! ball                   the moment −g f d on the second body, its opposite on the first
//! inertia of an end      κ n/2 w wᵀ for the dependence of f on accelerations, with n ends that move
//! ```
//!
//! With the inertia of the last line the iteration contracts, because (Σ xₖ)² is at most n Σ xₖ². For a single moving end n is set to two,
//! so that the weight κ n/2 equals κ.

use super::{Instant, Reach};
use crate::link::ArticulatedInertia;
use crate::link::indexing::{Outside, at, at_mut};
use crate::link::plan::Span;
use crate::rows::coupled::{CoupledRow, Couplings, Here, NONE, SumEnd};
use crate::space::Space;
use mbs_core::Real;
use mbs_core::laws::apart::is_apart;
use mbs_core::laws::scalar::{Law, ScalarForce};

/// True if this build supports effects on sums.
pub const IS_BUILT: bool = cfg!(feature = "sums");

/// A law of a sum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SumLoad<T> {
    /// Terms of the sum.
    pub terms: Span,
    /// Links that carry points of the sum's lines.
    pub starts: Span,
    /// Law of the sum.
    pub law: Law<T>,
}

impl<T: Real> SumLoad<T> {
    /// Returns the sum in the form of a coupling's row, for its evaluation.
    pub(crate) fn row(&self) -> CoupledRow<T> {
        CoupledRow {
            terms: self.terms,
            starts: self.starts,
            guide: NONE,
            value: T::ZERO,
            inverse: T::ONE,
            is_angle: false,
        }
    }

    /// True if the law is one-sided and has no force at the present sum.
    pub(crate) fn is_apart<S: Space<T>>(
        &self,
        couplings: &Couplings<'_, T, S>,
        here: Here<'_, T, S>,
    ) -> Result<bool, Outside> {
        let value = couplings.evaluate((&self.row(), 0, 1), here, None)?;
        Ok(is_apart(&self.law, value.row[0]))
    }

    /// Returns the tension at the present sum, and at a sum that is larger by `more`.
    pub(crate) fn at_twists<S: Space<T>>(
        &self,
        here: &Instant<'_, T, S>,
        more: T,
    ) -> Result<[T; 2], Outside> {
        let ScalarForce { value, rate, tension, .. } = self.evaluate(here)?;
        Ok([tension, self.law.evaluate(value + more, rate, &here.law_inputs).tension])
    }

    /// Evaluates the law at the present sum.
    pub(super) fn evaluate<S: Space<T>>(
        &self,
        here: &Instant<'_, T, S>,
    ) -> Result<ScalarForce<T>, Outside> {
        // This build does not support sums. A model with sums is refused when it is loaded.
        if !IS_BUILT {
            return Err(Outside);
        }
        let value = here.couplings.evaluate((&self.row(), 0, 1), here.mechanism(), None)?;
        let [sum, rate, _] = value.row;
        Ok(self.law.evaluate(sum, rate, &here.law_inputs))
    }

    /// Adds the forces of the law to links and joints.
    #[inline(never)]
    pub(super) fn apply<S: Space<T>>(
        &self,
        here: &Instant<'_, T, S>,
        condensed: &mut [ArticulatedInertia<T, S>],
    ) -> Result<(), Outside> {
        let tension = self.evaluate(here)?.tension;
        here.couplings.each_end(&self.row(), here.mechanism(), |end| {
            match end {
                SumEnd::Joint { link, slope } => {
                    at_mut(condensed, link as usize)?.effort -= slope * tension;
                }
                SumEnd::Link { link, wrench } => {
                    at_mut(condensed, link as usize)?.force += wrench * tension;
                }
            }
            Ok(())
        })
    }

    /// Adds the forces of the law, and their linear dependence on accelerations.
    #[inline(never)]
    pub(super) fn apply_ahead<S: Space<T>>(
        &self,
        here: &Instant<'_, T, S>,
        (reach, zdd, a): (Reach<T>, &[T], &[S::Motion]),
        condensed: &mut [ArticulatedInertia<T, S>],
    ) -> Result<(), Outside> {
        let mut measure = self.evaluate(here)?;
        measure.damping = self.law.secant(&measure);
        let (row, mut ends) = (self.row(), T::ZERO);
        let moves = |end: &SumEnd<T, S>| match end {
            SumEnd::Joint { link, .. } => Ok(!at(here.links, *link as usize)?.kind.is_guided()),
            SumEnd::Link { link, .. } => Ok(*link > 0),
        };
        here.couplings.each_end(&row, here.mechanism(), |end| {
            if moves(&end)? {
                ends += T::ONE;
            }
            Ok(())
        })?;
        let ends = ends.max(T::TWO) * T::HALF;
        here.couplings.each_end(&row, here.mechanism(), |end| {
            match end {
                SumEnd::Joint { link, slope } => {
                    at_mut(condensed, link as usize)?.effort -= slope * measure.tension;
                    let weight = reach.weight(&measure) * ends * slope * slope;
                    here.resist_joint(link, (weight, zdd), condensed)?;
                }
                SumEnd::Link { link, wrench } => {
                    let measure = ScalarForce {
                        stiffness: measure.stiffness * ends,
                        damping: measure.damping * ends,
                        ..measure
                    };
                    if link > 0 {
                        let a = at(a, link as usize)?;
                        reach.resist(at_mut(condensed, link as usize)?, (&wrench, a), &measure);
                    }
                }
            }
            Ok(())
        })
    }

    /// Returns the energy stored by the law [J].
    pub(super) fn potential<S: Space<T>>(&self, here: &Instant<'_, T, S>) -> Result<T, Outside> {
        Ok(self.law.energy(self.evaluate(here)?.value, &here.law_inputs))
    }

    /// Returns the power of the law that is not stored as energy, for example in a damper [W].
    pub(super) fn power<S: Space<T>>(&self, here: &Instant<'_, T, S>) -> Result<T, Outside> {
        Ok(self.law.power(&self.evaluate(here)?, &here.law_inputs))
    }
}
