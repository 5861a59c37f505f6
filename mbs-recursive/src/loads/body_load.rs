//! Laws that act on one body, as wrenches on its link.
//!
//! ```text
//! action (d, m, f)   force -f d at the law's point, moment -f m
//! ```

use super::{Instant, Reach};
use crate::link::ArticulatedInertia;
use crate::link::indexing::{Outside, part_mut};
use crate::space::{Numbers, Space};
use mbs_core::Real;
use mbs_core::algebra::Vector;
use mbs_core::laws::body::{BodyLaw, BodyMotion, MAX_ACTIONS, UnitWrench};

/// A law that acts on one body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyLoad<T: Real, S: Space<T>> {
    /// Index of the link on which the law acts.
    pub link: u32,
    /// Vector from the link's origin to the point of the law, in the axes of the reference configuration [m].
    pub point: S::Point,
    /// Direction of the law, in the axes of the reference configuration.
    pub axis: [T; 3],
    /// Law that acts on the body.
    pub law: BodyLaw<T>,
}

impl<T: Real, S: Space<T>> BodyLoad<T, S> {
    fn evaluate(&self, at: &Instant<'_, T, S>, out: &mut [UnitWrench<T>]) -> Result<(), Outside> {
        let placed = at.placed(self.link)?;
        let speed = at.speed(self.link, &at.arm(self.link, &self.point)?)?;
        let along = S::rotate(&placed.rotation, &S::point_from(&Vector::from(self.axis)));
        let mut axis = S::point_into(&along);
        // A direction normal to the plane does not rotate with the link.
        if S::DIMENSION == 2 {
            axis[2] = self.axis[2];
        }
        let motion = BodyMotion {
            position: S::point_into(&at.place(self.link, &self.point)?).into(),
            velocity: S::point_into(&speed).into(),
            axis: axis.into(),
            spin: S::spin_into(&S::spin(&placed.velocity)).into(),
        };
        self.law.evaluate(&motion, &at.law_inputs, out);
        Ok(())
    }

    /// Evaluates `number` for each action of the law and returns the sum.
    fn sum(
        &self,
        at: &Instant<'_, T, S>,
        of: impl Fn(usize, &UnitWrench<T>) -> T,
    ) -> Result<T, Outside> {
        let mut actions = [UnitWrench::default(); MAX_ACTIONS];
        let actions = part_mut(&mut actions, 0, self.law.n_actions())?;
        self.evaluate(at, actions)?;
        Ok(actions.iter().enumerate().fold(T::ZERO, |sum, (k, action)| sum + of(k, action)))
    }

    /// Returns the wrench of the law on its link, about the link's origin.
    pub(super) fn wrench(&self, at: &Instant<'_, T, S>) -> Result<S::Motion, Outside> {
        let mut actions = [UnitWrench::default(); MAX_ACTIONS];
        let actions = part_mut(&mut actions, 0, self.law.n_actions())?;
        self.evaluate(at, actions)?;
        let (mut force, mut moment) = (S::Point::zero(), S::Spin::zero());
        for UnitWrench { force: d, moment: m, measure } in actions.iter() {
            force -= S::point_from(&Vector::from(*d)) * measure.tension;
            moment -= S::spin_from(&Vector::from(*m)) * measure.tension;
        }
        let arm = at.arm(self.link, &self.point)?;
        Ok(S::wrench(&arm, &force) + S::motion(moment, S::Point::zero()))
    }

    /// Adds the wrench of the law, and its linear dependence on the acceleration as an inertia of the link. `a` is the acceleration for
    /// which the wrench was evaluated.
    pub(super) fn apply_ahead(
        &self,
        at: &Instant<'_, T, S>,
        (reach, a): (Reach<T>, &S::Motion),
        c: &mut ArticulatedInertia<T, S>,
    ) -> Result<(), Outside> {
        let mut actions = [UnitWrench::default(); MAX_ACTIONS];
        let actions = part_mut(&mut actions, 0, self.law.n_actions())?;
        self.evaluate(at, actions)?;
        let arm = at.arm(self.link, &self.point)?;
        for (k, UnitWrench { force, moment, measure }) in actions.iter_mut().enumerate() {
            measure.damping = self.law.secant(k, measure);
            let moment = S::spin_from(&Vector::from(*moment));
            let w = S::wrench(&arm, &S::point_from(&Vector::from(*force)))
                + S::motion(moment, S::Point::zero());
            reach.resist(c, (&w, a), measure);
        }
        Ok(())
    }

    /// Returns the energy stored by the law [J].
    pub(super) fn potential(&self, at: &Instant<'_, T, S>) -> Result<T, Outside> {
        self.sum(at, |k, action| self.law.energy(k, &action.measure))
    }

    /// Returns the power of the law that is not stored as energy, for example in a damper [W].
    pub(super) fn power(&self, at: &Instant<'_, T, S>) -> Result<T, Outside> {
        self.sum(at, |k, action| self.law.power(k, &action.measure))
    }
}
