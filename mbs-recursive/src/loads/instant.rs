//! Data of an instant from which loads are evaluated: places, velocities and inputs.

use crate::link::indexing::{Outside, at, at_mut};
use crate::link::{ArticulatedInertia, Link, LinkKind, LinkMotion};
use crate::rows::coupled::{Couplings, Here};
use crate::space::Space;
use mbs_core::Real;
use mbs_core::algebra::Vector;
use mbs_core::laws::LawInputs;

/// Data of the mechanism at one instant from which loads are evaluated.
#[derive(Debug, Clone, Copy)]
pub struct Instant<'a, T: Real, S: Space<T>> {
    /// Links of the tree.
    pub links: &'a [Link<T, S>],
    /// Place and motion of each link.
    pub placed: &'a [LinkMotion<T, S>],
    /// Coordinates, velocities and guides, in this order. A guide has value, rate and acceleration.
    pub coordinates: (&'a [T], &'a [T], &'a [[T; 3]]),
    /// Tables of couplings and sums.
    pub couplings: &'a Couplings<'a, T, S>,
    /// Vectors of the signals, and tables of the laws.
    pub law_inputs: LawInputs<'a, T>,
    /// Point from which the positions of links are measured, in global axes [m].
    pub base: S::Point,
}

impl<T: Real, S: Space<T>> Instant<'_, T, S> {
    /// Returns links, motions and coordinates as the tuple that the evaluation of sums takes.
    pub(super) fn mechanism(&self) -> Here<'_, T, S> {
        (self.links, self.placed, self.coordinates)
    }

    /// Returns the angle or slide of a joint with one coordinate, and the rate of this coordinate.
    pub(crate) fn coordinate(&self, link: u32) -> Result<[T; 2], Outside> {
        let [value, rate, _] = at(self.links, link as usize)?.coordinate(self.coordinates)?;
        Ok([value, rate])
    }

    /// Returns the angle of a link relative to the ground in the plane [rad]. It is the sum of the angles of the joints between ground and
    /// link.
    pub(crate) fn turn(&self, link: u32) -> Result<T, Outside> {
        let (mut sum, mut number) = (T::ZERO, link);
        while number > 0 {
            let link = at(self.links, number as usize)?;
            sum += link.turn(self.coordinate(number)?[0]);
            // The first coordinate of a free link is its angle relative to the ground.
            number = if link.kind == LinkKind::Free { 0 } else { link.parent };
        }
        Ok(sum)
    }

    /// Adds an inertia to a joint with one freedom. Adds an effort that cancels the force of this inertia at the accelerations `zdd`. A
    /// guided joint has no freedom and is skipped.
    pub(super) fn resist_joint(
        &self,
        link: u32,
        (weight, zdd): (T, &[T]),
        condensed: &mut [ArticulatedInertia<T, S>],
    ) -> Result<(), Outside> {
        let joint = at(self.links, link as usize)?;
        if matches!(joint.kind, LinkKind::Revolute | LinkKind::Prismatic) {
            let c = at_mut(condensed, link as usize)?;
            c.resistance += weight;
            c.effort += weight * *at(zdd, joint.v as usize)?;
        }
        Ok(())
    }

    /// Returns place and motion of a link.
    #[inline(always)]
    pub(super) fn placed(&self, link: u32) -> Result<&LinkMotion<T, S>, Outside> {
        at(self.placed, link as usize)
    }

    /// Returns the vector from a link's origin to one of its points, world axes [m].
    pub(super) fn arm(&self, link: u32, point: &S::Point) -> Result<S::Point, Outside> {
        Ok(S::rotate(&self.placed(link)?.rotation, point))
    }

    /// Returns the position of a link's point in global axes [m].
    pub(super) fn place(&self, link: u32, point: &S::Point) -> Result<S::Point, Outside> {
        Ok(self.placed(link)?.position + self.arm(link, point)? + self.base)
    }

    /// Returns the velocity of the link's point at the vector `arm` from the link's origin [m/s].
    pub(super) fn speed(&self, link: u32, arm: &S::Point) -> Result<S::Point, Outside> {
        Ok(S::point(&S::carried(&self.placed(link)?.velocity, arm)))
    }

    /// Returns the force of a signal, world axes [N].
    pub(super) fn force(&self, link: u32, course: u32, turns: bool) -> Result<S::Point, Outside> {
        let course = *at(self.law_inputs.courses, course as usize)?;
        let f = S::point_from(&Vector::from(course));
        Ok(if turns { S::rotate(&self.placed(link)?.rotation, &f) } else { f })
    }

    /// Returns the torque of a signal, world axes [N m].
    pub(super) fn torque(&self, course: u32) -> Result<S::Spin, Outside> {
        let c = *at(self.law_inputs.courses, course as usize)?;
        let c = if S::DIMENSION == 2 { [T::ZERO, T::ZERO, c[0]] } else { c };
        Ok(S::spin_from(&Vector::from(c)))
    }
}
