//! Effects as forces on links.
//!
//! ```text
//! spring and damper   −f n on the second body's point, f n on the first's      f = k (L − L₀) + c L'
//! along a joint       τ = −f on its coordinate
//! force, torque       on one link; a constant force in fixed directions has the potential −F·r
//! ```

use crate::link::{Condensed, Kind, Link, Placed};
use crate::space::{Numbers, Space};
use mbs_core::Real;
use mbs_core::algebra::Vector;
use mbs_core::laws::scalar::{Law, Measure};

/// An effect on one or two links.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Load<T: Real, S: Space<T>> {
    /// A law along the line of two points, from their links' origins, reference axes.
    Length {
        /// The links.
        links: [u32; 2],
        /// The points.
        points: [S::Point; 2],
        /// The law.
        law: Law<T>,
    },
    /// A law about the axis of a revolute joint.
    Angle {
        /// The link behind the joint.
        link: u32,
        /// The law.
        law: Law<T>,
    },
    /// A constant force in fixed directions.
    Constant {
        /// The link.
        link: u32,
        /// The point, from the link's origin, reference axes.
        point: S::Point,
        /// The force, global axes [N].
        force: S::Point,
    },
    /// A force that follows a course.
    Force {
        /// The link.
        link: u32,
        /// The point, from the link's origin, reference axes.
        point: S::Point,
        /// The course's number.
        course: u32,
        /// Does it turn with the body?
        turns: bool,
    },
    /// A torque that follows a course: global axes, in the plane its first component.
    Torque {
        /// The link.
        link: u32,
        /// The course's number.
        course: u32,
    },
}

/// What loads are evaluated from.
#[derive(Debug, Clone, Copy)]
pub struct Instant<'a, T: Real, S: Space<T>> {
    /// The links.
    pub links: &'a [Link<T, S>],
    /// Where they are.
    pub placed: &'a [Placed<T, S>],
    /// Coordinates, velocities, guides.
    pub coordinates: (&'a [T], &'a [T], &'a [[T; 3]]),
    /// Vectors of the courses.
    pub courses: &'a [[T; 3]],
}

impl<T: Real, S: Space<T>> Instant<'_, T, S> {
    /// Angle or slide of a joint with one coordinate, and its rate.
    pub(crate) fn coordinate(&self, link: u32) -> [T; 2] {
        let (link, (z, v, guides)) = (&self.links[link as usize], self.coordinates);
        match link.kind {
            Kind::GuidedRevolute | Kind::GuidedPrismatic => {
                let [value, rate, _] = guides[link.v as usize];
                [value, rate]
            }
            _ => [z[link.z as usize], v[link.v as usize]],
        }
    }

    fn arm(&self, link: u32, point: &S::Point) -> S::Point {
        S::rotate(&self.placed[link as usize].rotation, point)
    }

    fn speed(&self, link: u32, arm: &S::Point) -> S::Point {
        S::point(&S::carried(&self.placed[link as usize].velocity, arm))
    }

    /// The arms of a law's points, the unit vector from the first to the second, and what the law measures.
    fn length(
        &self,
        links: [u32; 2],
        points: &[S::Point; 2],
        law: &Law<T>,
    ) -> ([S::Point; 2], S::Point, Measure<T>) {
        let arms = [0, 1].map(|i| self.arm(links[i], &points[i]));
        let at = [0, 1].map(|i| self.placed[links[i] as usize].position + arms[i]);
        let gap = at[1] - at[0];
        let value = gap.dot(&gap).sqrt();
        // At length zero the line has no direction.
        let n = if value > T::ZERO { gap * (T::ONE / value) } else { S::Point::zero() };
        let rate = n.dot(&(self.speed(links[1], &arms[1]) - self.speed(links[0], &arms[0])));
        (arms, n, law.evaluate(value, rate, self.courses))
    }

    fn force(&self, link: u32, course: u32, turns: bool) -> S::Point {
        let f = S::point_from(&Vector::from(self.courses[course as usize]));
        if turns { S::rotate(&self.placed[link as usize].rotation, &f) } else { f }
    }

    fn torque(&self, course: u32) -> S::Spin {
        let c = self.courses[course as usize];
        let c = if S::DIMENSION == 2 { [T::ZERO, T::ZERO, c[0]] } else { c };
        S::spin_from(&Vector::from(c))
    }
}

impl<T: Real, S: Space<T>> Load<T, S> {
    /// Adds the load's forces: p −= (τ, f).
    #[inline]
    pub fn apply(&self, at: &Instant<'_, T, S>, condensed: &mut [Condensed<T, S>]) {
        match self {
            Self::Length { links, points, law } => {
                let (arms, n, measure) = at.length(*links, points, law);
                let f = n * measure.tension;
                condensed[links[0] as usize].force -= S::wrench(&arms[0], &f);
                condensed[links[1] as usize].force += S::wrench(&arms[1], &f);
            }
            Self::Angle { link, law } => {
                let [value, rate] = at.coordinate(*link);
                let measure = law.evaluate(value, rate, at.courses);
                condensed[*link as usize].effort -= measure.tension;
            }
            Self::Constant { link, point, force } => {
                let arm = at.arm(*link, point);
                condensed[*link as usize].force -= S::wrench(&arm, force);
            }
            Self::Force { link, point, course, turns } => {
                let arm = at.arm(*link, point);
                let force = at.force(*link, *course, *turns);
                condensed[*link as usize].force -= S::wrench(&arm, &force);
            }
            Self::Torque { link, course } => {
                condensed[*link as usize].force -= S::motion(at.torque(*course), S::Point::zero());
            }
        }
    }

    /// Stored energy [J]; positions counted from `base`.
    pub fn potential(&self, at: &Instant<'_, T, S>, base: &S::Point) -> T {
        match self {
            Self::Length { links, points, law } => {
                law.energy(at.length(*links, points, law).2.value)
            }
            Self::Angle { link, law } => law.energy(at.coordinate(*link)[0]),
            Self::Constant { link, point, force } => {
                let r = at.placed[*link as usize].position + at.arm(*link, point) + *base;
                -force.dot(&r)
            }
            Self::Force { .. } | Self::Torque { .. } => T::ZERO,
        }
    }

    /// Power that is not stored [W].
    pub fn power(&self, at: &Instant<'_, T, S>) -> T {
        match self {
            Self::Length { links, points, law } => law.power(&at.length(*links, points, law).2),
            Self::Angle { link, law } => {
                let [value, rate] = at.coordinate(*link);
                law.power(&law.evaluate(value, rate, at.courses))
            }
            Self::Constant { .. } => T::ZERO,
            Self::Force { link, point, course, turns } => {
                let speed = at.speed(*link, &at.arm(*link, point));
                at.force(*link, *course, *turns).dot(&speed)
            }
            Self::Torque { link, course } => {
                at.torque(*course).dot(&S::spin(&at.placed[*link as usize].velocity))
            }
        }
    }
}
