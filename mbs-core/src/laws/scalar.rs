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

use super::Supplies;
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
    #[cfg(feature = "polynomial")]
    Polynomial {
        /// Its pieces.
        pieces: super::Part,
        /// Of the rate: a damper.
        of_rate: bool,
    },
    /// Pushes where the value has fallen below `touch`.
    #[cfg(feature = "bumper")]
    Bumper {
        /// [N/m] and [N s/m].
        law: [T; 2],
        /// Value at which contact begins [m].
        touch: T,
    },
    /// Elastic stops.
    #[cfg(feature = "limit")]
    Limit(super::limit::Limit<T>),
    /// Friction.
    #[cfg(feature = "friction")]
    Friction(super::friction::Friction<T>),
    /// A user's own law.
    #[cfg(feature = "own-laws")]
    Own {
        /// The law.
        law: super::own::UserScalarLaw<T>,
        /// Number of the course that is its input.
        course: u32,
    },
}

#[cfg_attr(
    not(feature = "effects"),
    allow(unused_variables, reason = "not every law asks for everything")
)]
impl<T: Real> Law<T> {
    /// Tension and its tangents at a value and its rate.
    ///
    /// The line of action does not turn ([`Measure::transverse`] is zero): a law along a length adds that itself.
    #[inline]
    #[must_use]
    pub fn evaluate(&self, value: T, rate: T, supplies: &Supplies<'_, T>) -> Measure<T> {
        let plain = Measure { value, rate, ..Measure::default() };
        match self {
            Self::Torque { course } => Measure { tension: -supplies.course(*course)[0], ..plain },
            Self::SpringDamper { stiffness, damping, free } => Measure {
                tension: *stiffness * (value - *free) + *damping * rate,
                stiffness: *stiffness,
                damping: *damping,
                ..plain
            },
            #[cfg(feature = "polynomial")]
            Self::Polynomial { pieces, of_rate } => {
                let pieces = pieces.of(supplies.pieces);
                if *of_rate {
                    let (tension, slope) = super::polynomial::value(pieces, rate);
                    Measure { tension, damping: slope.max(T::ZERO), ..plain }
                } else {
                    let (tension, slope) = super::polynomial::value(pieces, value);
                    Measure { tension, stiffness: slope.max(T::ZERO), ..plain }
                }
            }
            #[cfg(feature = "bumper")]
            Self::Bumper { law, touch } => {
                let contact = super::bumper::contact(*law, *touch - value, -rate);
                Measure {
                    tension: -contact.force,
                    stiffness: contact.stiffness,
                    damping: contact.damping,
                    ..plain
                }
            }
            #[cfg(feature = "limit")]
            Self::Limit(limit) => {
                let contact = limit.tension(value, rate);
                Measure {
                    tension: contact.force,
                    stiffness: contact.stiffness,
                    damping: contact.damping,
                    ..plain
                }
            }
            #[cfg(feature = "friction")]
            Self::Friction(friction) => {
                let (tension, damping) = friction.force(rate);
                Measure { tension, damping, ..plain }
            }
            #[cfg(feature = "own-laws")]
            Self::Own { law, course } => {
                let told = (law.evaluate)(value, rate, supplies.course(*course));
                Measure { value, rate, transverse: T::ZERO, drift: T::ZERO, ..told }
            }
        }
    }

    /// May it stand in the way like a wall, with a force that begins somewhere?
    #[must_use]
    pub fn may_push(&self) -> bool {
        match self {
            #[cfg(feature = "bumper")]
            Self::Bumper { .. } => true,
            #[cfg(feature = "polynomial")]
            Self::Polynomial { of_rate, .. } => !of_rate,
            #[cfg(feature = "own-laws")]
            Self::Own { .. } => true,
            _ => false,
        }
    }

    /// The slope of friction by what the iterate `before` foresaw of its force: see [`Friction::slope`](super::friction::Friction::slope).
    /// By the tangents at the ends alone, which know nothing of the rise between them, an iteration across rest goes to and fro. An iterate
    /// without a rate is none: the first one of a step has the tangent.
    #[inline]
    pub fn look_back(&self, measure: &mut Measure<T>, before: &Measure<T>) {
        #[cfg(feature = "friction")]
        if let Self::Friction(friction) = self
            && before.rate != T::ZERO
        {
            let last = (before.rate, before.tension, before.damping);
            let foreseen = friction.foreseen(measure.rate, last);
            measure.damping = friction.slope(measure.rate, foreseen);
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
            #[cfg(feature = "polynomial")]
            Self::Polynomial { pieces, of_rate: false } => {
                super::polynomial::energy(pieces.of(supplies.pieces), value)
            }
            #[cfg(feature = "bumper")]
            Self::Bumper { law, touch } => super::bumper::energy(law[0], *touch - value),
            #[cfg(feature = "limit")]
            Self::Limit(limit) => limit.energy(value),
            #[cfg(feature = "own-laws")]
            Self::Own { law, course } => (law.energy)(value, supplies.course(*course)),
            #[cfg(feature = "polynomial")]
            Self::Polynomial { .. } => T::ZERO,
            #[cfg(feature = "friction")]
            Self::Friction(_) => T::ZERO,
            Self::Torque { .. } => T::ZERO,
        }
    }

    /// Power that is not stored: dampers take, courses give [W].
    #[inline]
    pub fn power(&self, measure: &Measure<T>, supplies: &Supplies<'_, T>) -> T {
        let Measure { value, rate, tension, .. } = *measure;
        // What of the tension is elastic.
        let elastic = match self {
            Self::SpringDamper { damping, .. } => return -*damping * rate * rate,
            #[cfg(feature = "polynomial")]
            Self::Polynomial { of_rate: false, .. } => return T::ZERO,
            #[cfg(feature = "bumper")]
            Self::Bumper { law, touch } => -law[0] * (*touch - value).max(T::ZERO),
            #[cfg(feature = "limit")]
            Self::Limit(limit) => {
                let above = (value - limit.upper).max(T::ZERO);
                limit.stiffness * (above - (limit.lower - value).max(T::ZERO))
            }
            #[cfg(feature = "own-laws")]
            Self::Own { law, course } => (law.elastic)(value, supplies.course(*course)),
            #[cfg(feature = "polynomial")]
            Self::Polynomial { .. } => T::ZERO,
            #[cfg(feature = "friction")]
            Self::Friction(_) => T::ZERO,
            Self::Torque { .. } => T::ZERO,
        };
        (elastic - tension) * rate
    }
}
