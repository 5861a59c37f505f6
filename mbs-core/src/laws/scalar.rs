//! Scalar force laws: a tension along a length or about an angle, from its value and rate.
//!
//! A positive tension pulls the ends together: the generalised force is -f dm/dq.

pub use crate::effects::Law;

use super::LawInputs;
use super::corner::LawCorner;
use super::entry::Entry;
use super::operations::Operations;
use crate::Real;

/// The state of one scalar force law: a tension along a measured length or angle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ScalarForce<T> {
    /// Length or angle [m, rad].
    pub value: T,
    /// Rate of the value [m/s, rad/s].
    pub rate: T,
    /// Generalised force against growth [N, N m].
    pub tension: T,
    /// d tension / d value [N/m, N m/rad]; of polynomials not below zero, so that a tangent stays definite.
    pub stiffness: T,
    /// d tension / d rate [N s/m, N m s/rad].
    pub damping: T,
    /// tension / length, for the turning of a line of action [N/m]; zero for angles.
    pub transverse: T,
    /// Rate that the row has where the measure rests, on a road that moves [m/s]; zero elsewhere.
    pub drift: T,
}

impl<T: Real> ScalarForce<T> {
    /// The slope of the tension to its zero at rest, not below the tangent: what falls with the rate, as friction and slip do, has a tangent
    /// that vanishes where the motion is fast, and an iteration across rest by it would go to and fro.
    #[inline]
    #[must_use]
    pub fn secant(&self) -> T {
        if self.rate.is_zero() {
            return self.damping;
        }
        (self.tension / self.rate).max(self.damping)
    }
}

/// A law along a length or about an angle. [`Law`] is one of all that there are.
pub trait TensionLaw<T: Real>: Entry<T> + Copy {
    /// Tension and its tangents at a value and its rate.
    fn evaluate(&self, value: T, rate: T, law_inputs: &LawInputs<'_, T>) -> ScalarForce<T>;

    /// A bound of the operations of [`evaluate`](Self::evaluate): of the branch that costs most.
    fn operations(&self) -> Operations;

    /// Stored energy [J] of the elastic part at a value.
    #[inline]
    fn energy(&self, _value: T, _supplies: &LawInputs<'_, T>) -> T {
        T::ZERO
    }

    /// The elastic part of the tension, the derivative of the energy by the value.
    #[inline]
    fn elastic(&self, _value: T, _supplies: &LawInputs<'_, T>) -> T {
        T::ZERO
    }

    /// Power that is not stored: dampers take, signals give [W].
    #[inline]
    fn power(&self, measure: &ScalarForce<T>, law_inputs: &LawInputs<'_, T>) -> T {
        (self.elastic(measure.value, law_inputs) - measure.tension) * measure.rate
    }

    /// The slope at an iterate, with the iterate `before`; the first one of a step has no rate.
    #[inline]
    fn look_back(
        &self,
        _measure: &mut ScalarForce<T>,
        _before: &ScalarForce<T>,
        _supplies: &LawInputs<'_, T>,
    ) {
    }

    /// The slope by the rate for an iteration that does not look back; not below the tangent.
    #[inline]
    fn secant(&self, measure: &ScalarForce<T>) -> T {
        measure.damping
    }

    /// May it stand in the way like a wall, with a force that begins somewhere?
    fn may_push(&self) -> bool {
        false
    }

    /// Number of gaps of the law; none where it acts always.
    fn n_gaps(&self) -> usize {
        0
    }

    /// Does the damper of its contact fade in over [`FADE`](super::bumper::FADE)?
    fn has_fade(&self) -> bool {
        false
    }

    /// Gaps of the law and their rates, at a value and its rate.
    fn gaps(&self, _value: T, _rate: T) -> [[T; 2]; 2] {
        [[T::ZERO; 2]; 2]
    }

    /// Can it have kinks besides those of its gaps?
    fn may_have_kinks(&self) -> bool {
        false
    }

    /// Hands out its kinks, in no order.
    fn kinks(&self, _supplies: &LawInputs<'_, T>, _take: &mut dyn FnMut(LawCorner<T>)) {}

    /// Is all that it refers to by number there?
    fn fits(&self, _supplies: &LawInputs<'_, T>, _n_courses: usize) -> bool {
        true
    }
}
