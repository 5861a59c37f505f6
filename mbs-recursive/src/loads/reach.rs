//! Coefficients by which accelerations change positions and velocities within a step. The forces of effects depend on accelerations through
//! these changes.

use crate::link::ArticulatedInertia;
use crate::space::{Numbers, Space};
use mbs_core::Real;
use mbs_core::laws::scalar::ScalarForce;

/// Coefficients by which accelerations change positions and velocities at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach<T> {
    /// Coefficient of positions, β h², with the integrator's β and the step length h [s^2].
    pub place: T,
    /// Coefficient of velocities, γ h, with the integrator's γ and the step length h [s].
    pub speed: T,
}

impl<T: Real> Reach<T> {
    /// Returns the weight κ = β h² stiffness + γ h damping. A negative weight is replaced by zero.
    #[inline]
    pub(super) fn weight(self, measure: &ScalarForce<T>) -> T {
        (self.place * measure.stiffness + self.speed * measure.damping).max(T::ZERO)
    }

    /// Adds a tension with the unit wrench `w` on a link, and the linear dependence of the tension on the acceleration. The tension was
    /// evaluated for the acceleration `a`. Builds for controllers do not inline this function, so that its code exists once.
    #[cfg_attr(feature = "alloc", inline)]
    #[cfg_attr(not(feature = "alloc"), inline(never))]
    pub(super) fn resist<S: Space<T>>(
        self,
        c: &mut ArticulatedInertia<T, S>,
        (w, a): (&S::Motion, &S::Motion),
        measure: &ScalarForce<T>,
    ) {
        let weight = self.weight(measure);
        c.force += *w * (measure.tension - weight * w.dot(a));
        if weight > T::ZERO {
            c.inertia = S::reduced(&c.inertia, w, -weight);
        }
    }
}
