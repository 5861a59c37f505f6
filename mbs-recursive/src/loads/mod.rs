//! Effects as forces on links.
//!
//! ```text
//! law of a measure m    Q = -f dm/dq, on two links or along a joint's coordinate
//! force, torque         on one link; a constant force in fixed directions has the potential -F.r
//! law on one body       its unit wrenches times their tensions
//! ```

mod body_load;
mod instant;
mod measure;
mod reach;
mod rotation;
pub mod sum;
mod tangent;

pub use body_load::BodyLoad;
pub use instant::Instant;
pub use measure::Measure;
pub use reach::Reach;
pub use sum::SumLoad;

use crate::link::ArticulatedInertia;
use crate::link::indexing::{Outside, at_mut};
use crate::space::{Numbers, Space};
use mbs_core::Real;
use mbs_core::laws::scalar::Law;

/// An effect on one or two links.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Load<T: Real, S: Space<T>> {
    /// A law of a number that is measured between two links.
    Between {
        /// Indices of the two links.
        links: [u32; 2],
        /// Measured number on which the law depends.
        gauge: Measure<T, S>,
        /// Law of the measured number.
        law: Law<T>,
    },
    /// A law of the coordinate of a link with one freedom.
    Angle {
        /// Index of the link.
        link: u32,
        /// Law of the coordinate.
        law: Law<T>,
    },
    /// A constant force in fixed directions.
    Constant {
        /// Index of the link.
        link: u32,
        /// Vector from the link's origin to the point of application, in the axes of the reference configuration [m].
        point: S::Point,
        /// The force in global axes [N].
        force: S::Point,
    },
    /// A force that follows a signal.
    Force {
        /// Index of the link.
        link: u32,
        /// Vector from the link's origin to the point of application, in the axes of the reference configuration [m].
        point: S::Point,
        /// Index of the signal that gives the force.
        course: u32,
        /// True if the direction of the force rotates with the body.
        turns: bool,
    },
    /// A torque that follows a signal. In space the signal gives the torque in global axes; in the plane the torque is the signal's first
    /// component.
    Torque {
        /// Index of the link.
        link: u32,
        /// Index of the signal that gives the torque.
        course: u32,
    },
    /// A law that acts on one body.
    BodyLoad(BodyLoad<T, S>),
    /// A law of a sum of coordinates and lengths.
    Sum(SumLoad<T>),
}

impl<T: Real, S: Space<T>> Load<T, S> {
    /// Adds the load's moment τ and force f to the bias forces p of links: p −= (τ, f).
    ///
    /// # Errors
    /// [`Outside`] if the tables are inconsistent.
    #[inline]
    pub fn apply(
        &self,
        at: &Instant<'_, T, S>,
        condensed: &mut [ArticulatedInertia<T, S>],
    ) -> Result<(), Outside> {
        let mut push = |link: u32, force: S::Motion| {
            at_mut(condensed, link as usize)?.force -= force;
            Ok(())
        };
        match self {
            Self::Between { links, gauge, law } => {
                let (measure, [first, second]) = gauge.evaluate(at, *links, law)?;
                push(links[0], first * -measure.tension)?;
                push(links[1], second * -measure.tension)
            }
            Self::Angle { link, law } => {
                let [value, rate] = at.coordinate(*link)?;
                let measure = law.evaluate(value, rate, &at.law_inputs);
                at_mut(condensed, *link as usize)?.effort -= measure.tension;
                Ok(())
            }
            Self::Constant { link, point, force } => {
                push(*link, S::wrench(&at.arm(*link, point)?, force))
            }
            Self::Force { link, point, course, turns } => {
                let arm = at.arm(*link, point)?;
                push(*link, S::wrench(&arm, &at.force(*link, *course, *turns)?))
            }
            Self::Torque { link, course } => {
                push(*link, S::motion(at.torque(*course)?, S::Point::zero()))
            }
            Self::BodyLoad(load) => push(load.link, load.wrench(at)?),
            Self::Sum(load) => load.apply(at, condensed),
        }
    }

    /// Returns the energy stored by the load [J].
    ///
    /// # Errors
    /// [`Outside`] if the tables are inconsistent.
    pub fn potential(&self, at: &Instant<'_, T, S>) -> Result<T, Outside> {
        Ok(match self {
            Self::Between { links, gauge, law } => {
                law.energy(gauge.evaluate(at, *links, law)?.0.value, &at.law_inputs)
            }
            Self::Angle { link, law } => law.energy(at.coordinate(*link)?[0], &at.law_inputs),
            Self::Constant { link, point, force } => -force.dot(&at.place(*link, point)?),
            Self::Force { .. } | Self::Torque { .. } => T::ZERO,
            Self::BodyLoad(load) => load.potential(at)?,
            Self::Sum(load) => load.potential(at)?,
        })
    }

    /// Returns the power of the load that is not stored as energy, for example in a damper [W].
    ///
    /// # Errors
    /// [`Outside`] if the tables are inconsistent.
    pub fn power(&self, at: &Instant<'_, T, S>) -> Result<T, Outside> {
        Ok(match self {
            Self::Between { links, gauge, law } => {
                law.power(&gauge.evaluate(at, *links, law)?.0, &at.law_inputs)
            }
            Self::Angle { link, law } => {
                let [value, rate] = at.coordinate(*link)?;
                law.power(&law.evaluate(value, rate, &at.law_inputs), &at.law_inputs)
            }
            Self::Constant { .. } => T::ZERO,
            Self::Force { link, point, course, turns } => {
                let speed = at.speed(*link, &at.arm(*link, point)?)?;
                at.force(*link, *course, *turns)?.dot(&speed)
            }
            Self::Torque { link, course } => {
                at.torque(*course)?.dot(&S::spin(&at.placed(*link)?.velocity))
            }
            Self::BodyLoad(load) => load.power(at)?,
            Self::Sum(load) => load.power(at)?,
        })
    }
}
