//! Scalar force laws: a tension along a length or a torque about an angle, as a function of value and rate.
//!
//! A positive tension pulls the ends together: the generalised force is -f dm/dq, with tension f and measured value m.

pub use crate::effects::Law;

use super::LawInputs;
use super::corner::LawCorner;
use super::entry::Entry;
use super::operations::Operations;
use crate::Real;

/// State of a scalar force law: a tension along a measured length or angle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ScalarForce<T> {
    /// Length or angle [m, rad].
    pub value: T,
    /// Rate of the value [m/s, rad/s].
    pub rate: T,
    /// Generalised force against growth of the value [N, N m].
    pub tension: T,
    /// Derivative of the tension by the value [N/m, N m/rad]. For polynomials it is not negative, so that the tangent matrix stays
    /// definite.
    pub stiffness: T,
    /// Derivative of the tension by the rate [N s/m, N m s/rad].
    pub damping: T,
    /// Tension over length, for the rotation of the line of action [N/m]; zero for angles.
    pub transverse: T,
    /// Rate of the row while the measured value is constant, on a moving road [m/s]; zero elsewhere.
    pub drift: T,
}

impl<T: Real> ScalarForce<T> {
    /// Slope of the secant from rest to the current tension, at least the tangent. For forces such as friction and slip, the
    /// tangent vanishes at high rates. Newton iterations with that tangent would oscillate across rest.
    #[inline]
    #[must_use]
    pub fn secant(&self) -> T {
        if self.rate.is_zero() {
            return self.damping;
        }
        (self.tension / self.rate).max(self.damping)
    }
}

/// Law along a length or about an angle. The enum [`Law`] contains all built-in ones.
pub trait TensionLaw<T: Real>: Entry<T> + Copy {
    /// Tension and its tangents, for a value and its rate.
    fn evaluate(&self, value: T, rate: T, law_inputs: &LawInputs<'_, T>) -> ScalarForce<T>;

    /// Upper bound of the operations of [`evaluate`](Self::evaluate), for the branch with the highest cost.
    fn operations(&self) -> Operations;

    /// Energy that the elastic part stores at a value [J].
    #[inline]
    fn energy(&self, _value: T, _supplies: &LawInputs<'_, T>) -> T {
        T::ZERO
    }

    /// Elastic part of the tension: the derivative of the energy by the value.
    #[inline]
    fn elastic(&self, _value: T, _supplies: &LawInputs<'_, T>) -> T {
        T::ZERO
    }

    /// Power that is not stored [W]: dampers dissipate it, signals supply it.
    #[inline]
    fn power(&self, measure: &ScalarForce<T>, law_inputs: &LawInputs<'_, T>) -> T {
        (self.elastic(measure.value, law_inputs) - measure.tension) * measure.rate
    }

    /// Improves the slope with the iterate `_before`. In the first iterate of a step, `_before` has no rate.
    #[inline]
    fn look_back(
        &self,
        _measure: &mut ScalarForce<T>,
        _before: &ScalarForce<T>,
        _supplies: &LawInputs<'_, T>,
    ) {
    }

    /// Slope by the rate, for iterations that do not use the iterate before. It is at least the tangent.
    #[inline]
    fn secant(&self, measure: &ScalarForce<T>) -> T {
        measure.damping
    }

    /// True if the law can act like a wall, with a force that begins at some value.
    fn may_push(&self) -> bool {
        false
    }

    /// Number of gaps of the law; zero for a law that always acts.
    fn n_gaps(&self) -> usize {
        0
    }

    /// True if the damper of the law's contact fades in over [`FADE`](super::bumper::FADE).
    fn has_fade(&self) -> bool {
        false
    }

    /// Gaps of the law and their rates, for a value and its rate.
    fn gaps(&self, _value: T, _rate: T) -> [[T; 2]; 2] {
        [[T::ZERO; 2]; 2]
    }

    /// True if the law can have kinks besides those of its gaps.
    fn may_have_kinks(&self) -> bool {
        false
    }

    /// Passes the kinks of the law to `_take`, in any order.
    fn kinks(&self, _supplies: &LawInputs<'_, T>, _take: &mut dyn FnMut(LawCorner<T>)) {}

    /// True if every signal and table entry exists to which the law refers by number.
    fn fits(&self, _supplies: &LawInputs<'_, T>, _n_courses: usize) -> bool {
        true
    }
}
