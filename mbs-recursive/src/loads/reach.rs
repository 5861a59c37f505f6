//! Effects that answer to accelerations: how far these reach within a step.

use crate::link::ArticulatedInertia;
use crate::space::{Numbers, Space};
use mbs_core::Real;
use mbs_core::laws::scalar::ScalarForce;

/// Reach of accelerations to places and rates within a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach<T> {
    /// Reach of accelerations to places, β h² [s^2].
    pub place: T,
    /// Reach of accelerations to rates, γ h [s].
    pub speed: T,
}

impl<T: Real> Reach<T> {
    /// κ, not below zero.
    #[inline]
    pub(super) fn weight(self, measure: &ScalarForce<T>) -> T {
        (self.place * measure.stiffness + self.speed * measure.damping).max(T::ZERO)
    }

    /// A tension with the unit wrench `w` on a link that was to have the acceleration `a`. Images for controllers keep one copy.
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
