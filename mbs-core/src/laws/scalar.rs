//! Scalar force laws: a tension along a length or about an angle, from its value and rate.
//!
//! ```text
//! spring and damper   f = k (m - m0) + c m',   V = k (m - m0)^2 / 2,   dissipated power c m'^2
//! given torque        f = -tau(t),             power tau m'
//! ```
//!
//! A positive tension pulls the ends together: the generalised force is -f dm/dq.

use crate::Real;

/// The state of one scalar force law: a tension along a measured length or angle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Measure<T> {
    /// Length or angle [m, rad].
    pub value: T,
    /// Its rate [m/s, rad/s].
    pub rate: T,
    /// Generalised force against growth [N, N m].
    pub tension: T,
    /// d tension / d value [N/m, N m/rad].
    pub stiffness: T,
    /// d tension / d rate [N s/m, N m s/rad].
    pub damping: T,
    /// tension / length, for the turning of a line of action [N/m]; zero for angles.
    pub transverse: T,
}

/// A scalar law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law<T> {
    /// stiffness (m - free) + damping m'.
    SpringDamper {
        /// [N/m, N m/rad].
        stiffness: T,
        /// [N s/m, N m s/rad].
        damping: T,
        /// Value without tension [m, rad].
        free: T,
    },
    /// A course's first component, with the sign of growth.
    Torque {
        /// Number of the course among those of the model.
        course: u32,
    },
}

impl<T: Real> Law<T> {
    /// Tension and its tangents at a value and its rate; `courses` holds the vectors of the courses at this instant.
    ///
    /// The line of action does not turn ([`Measure::transverse`] is zero): a law along a length adds that itself.
    #[inline]
    #[must_use]
    pub fn evaluate(&self, value: T, rate: T, courses: &[[T; 3]]) -> Measure<T> {
        match *self {
            Self::Torque { course } => {
                Measure { value, rate, tension: -courses[course as usize][0], ..Measure::default() }
            }
            Self::SpringDamper { stiffness, damping, free } => {
                let tension = stiffness * (value - free) + damping * rate;
                Measure { value, rate, tension, stiffness, damping, transverse: T::ZERO }
            }
        }
    }

    /// Stored energy [J] of the elastic part at a value.
    #[inline]
    pub fn energy(&self, value: T) -> T {
        match *self {
            Self::SpringDamper { stiffness, free, .. } => {
                let stretch = value - free;
                stiffness * stretch * stretch * T::HALF
            }
            Self::Torque { .. } => T::ZERO,
        }
    }

    /// Power that is not stored: dampers take, courses give [W].
    #[inline]
    pub fn power(&self, measure: &Measure<T>) -> T {
        match *self {
            Self::SpringDamper { damping, .. } => -damping * measure.rate * measure.rate,
            Self::Torque { .. } => -measure.tension * measure.rate,
        }
    }
}
