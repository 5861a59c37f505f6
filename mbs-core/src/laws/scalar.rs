//! Scalar force laws: a tension along a length or about an angle, from its value and rate.
//!
//! ```text
//! spring and damper   f = k (m - m0) + c m',   V = k (m - m0)^2 / 2,   dissipated power c m'^2
//! given torque        f = -tau(t),             power tau m'
//! polynomial          f = p(m), or f = p(m')
//! bumper              f = -contact(touch - m, -m')
//! limit, friction     see their files
//! ```
//!
//! A positive tension pulls the ends together: the generalised force is -f dm/dq.

use super::friction::Friction;
use super::limit::Limit;
use super::own::OwnScalar;
use super::{Part, Supplies, bumper, polynomial};
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
    /// d tension / d value [N/m, N m/rad]; of polynomials not below zero, so that a tangent stays definite.
    pub stiffness: T,
    /// d tension / d rate [N s/m, N m s/rad].
    pub damping: T,
    /// tension / length, for the turning of a line of action [N/m]; zero for angles.
    pub transverse: T,
    /// Rate that the row has where the measure rests, on a road that moves [m/s]; zero elsewhere.
    pub drift: T,
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
    /// A piecewise polynomial of the value or of the rate.
    Polynomial {
        /// Its pieces.
        pieces: Part,
        /// Of the rate: a damper.
        of_rate: bool,
    },
    /// Pushes where the value has fallen below `touch`.
    Bumper {
        /// [N/m] and [N s/m].
        law: [T; 2],
        /// Value at which contact begins [m].
        touch: T,
    },
    /// Elastic stops.
    Limit(Limit<T>),
    /// Friction.
    Friction(Friction<T>),
    /// A user's own law.
    Own {
        /// The law.
        law: OwnScalar<T>,
        /// Number of the course that is its input.
        course: u32,
    },
}

impl<T: Real> Law<T> {
    /// Tension and its tangents at a value and its rate.
    ///
    /// The line of action does not turn ([`Measure::transverse`] is zero): a law along a length adds that itself.
    #[inline]
    #[must_use]
    pub fn evaluate(&self, value: T, rate: T, supplies: &Supplies<'_, T>) -> Measure<T> {
        let plain = Measure { value, rate, ..Measure::default() };
        match self {
            Self::Torque { course } => {
                Measure { tension: -supplies.courses[*course as usize][0], ..plain }
            }
            Self::SpringDamper { stiffness, damping, free } => Measure {
                tension: *stiffness * (value - *free) + *damping * rate,
                stiffness: *stiffness,
                damping: *damping,
                ..plain
            },
            Self::Polynomial { pieces, of_rate } => {
                let pieces = pieces.of(supplies.pieces);
                if *of_rate {
                    let (tension, slope) = polynomial::value(pieces, rate);
                    Measure { tension, damping: slope.max(T::ZERO), ..plain }
                } else {
                    let (tension, slope) = polynomial::value(pieces, value);
                    Measure { tension, stiffness: slope.max(T::ZERO), ..plain }
                }
            }
            Self::Bumper { law, touch } => {
                let contact = bumper::contact(*law, *touch - value, -rate);
                Measure {
                    tension: -contact.force,
                    stiffness: contact.stiffness,
                    damping: contact.damping,
                    ..plain
                }
            }
            Self::Limit(limit) => {
                let contact = limit.tension(value, rate);
                Measure {
                    tension: contact.force,
                    stiffness: contact.stiffness,
                    damping: contact.damping,
                    ..plain
                }
            }
            Self::Friction(friction) => {
                let (tension, damping) = friction.force(rate);
                Measure { tension, damping, ..plain }
            }
            Self::Own { law, course } => {
                let told = (law.evaluate)(value, rate, supplies.courses[*course as usize]);
                Measure { value, rate, transverse: T::ZERO, drift: T::ZERO, ..told }
            }
        }
    }

    /// Stored energy [J] of the elastic part at a value.
    #[inline]
    pub fn energy(&self, value: T, supplies: &Supplies<'_, T>) -> T {
        match self {
            Self::SpringDamper { stiffness, free, .. } => {
                let stretch = value - *free;
                *stiffness * stretch * stretch * T::HALF
            }
            Self::Polynomial { pieces, of_rate: false } => {
                polynomial::energy(pieces.of(supplies.pieces), value)
            }
            Self::Bumper { law, touch } => bumper::energy(law[0], *touch - value),
            Self::Limit(limit) => limit.energy(value),
            Self::Own { law, course } => (law.energy)(value, supplies.courses[*course as usize]),
            Self::Torque { .. } | Self::Polynomial { .. } | Self::Friction(_) => T::ZERO,
        }
    }

    /// Power that is not stored: dampers take, courses give [W].
    #[inline]
    pub fn power(&self, measure: &Measure<T>, supplies: &Supplies<'_, T>) -> T {
        let Measure { value, rate, tension, .. } = *measure;
        // What of the tension is elastic.
        let elastic = match self {
            Self::SpringDamper { damping, .. } => return -*damping * rate * rate,
            Self::Polynomial { of_rate: false, .. } => return T::ZERO,
            Self::Bumper { law, touch } => -law[0] * (*touch - value).max(T::ZERO),
            Self::Limit(limit) => {
                let above = (value - limit.upper).max(T::ZERO);
                limit.stiffness * (above - (limit.lower - value).max(T::ZERO))
            }
            Self::Own { law, course } => (law.elastic)(value, supplies.courses[*course as usize]),
            Self::Torque { .. } | Self::Polynomial { .. } | Self::Friction(_) => T::ZERO,
        };
        (elastic - tension) * rate
    }
}
