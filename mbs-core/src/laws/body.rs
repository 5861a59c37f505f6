//! Laws that act on one body at a point, and depend on the motion of the body. Each gives one or more actions, which are unit
//! wrenches with a tension.
//!
//! ```text
//! action   force -f d at the point, moment -f m;   rate d.v + m.w          f: tension, (d, m): unit wrench, w: angular velocity
//! ```

pub use crate::effects::BodyLaw;

use super::LawInputs;
use super::corner::LawCorner;
use super::entry::{Entry, EntryReader, EntryWriter};
use super::operations::Operations;
use super::scalar::ScalarForce;
use crate::Real;
use core::convert::Infallible;
use core::marker::PhantomData;

/// Motion of a body as a law receives it, in global axes. In the plane the z components of positions are zero, and the spin is
/// about z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMotion<T> {
    /// Point of the body at which the law acts [m].
    pub position: [T; 3],
    /// Velocity of the law's point [m/s].
    pub velocity: [T; 3],
    /// Direction of the law, which rotates with the body.
    pub axis: [T; 3],
    /// Angular velocity of the body [rad/s].
    pub spin: [T; 3],
}

/// Unit wrench on a body, with its tension.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct UnitWrench<T> {
    /// Direction d of the force at the law's point [-].
    pub force: [T; 3],
    /// Moment m about the law's point [m, or - for a pure moment].
    pub moment: [T; 3],
    /// Tension of the wrench with its tangents; `rate` is d.v + m.w less `drift`.
    pub measure: ScalarForce<T>,
}

/// Writes an action to its place in a list. Nothing is written if the list is too short.
#[inline(always)]
pub(crate) fn put<T>(out: &mut [UnitWrench<T>], place: usize, action: UnitWrench<T>) {
    if let Some(to) = out.get_mut(place) {
        *to = action;
    }
}

/// Forces of the road on a tire.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TireForces<T> {
    /// Force along the road's normal [N].
    pub load: T,
    /// Force across the tire's plane, along its axis [N].
    pub side: T,
    /// Force along the plane, in the direction of axis times normal [N].
    pub longitudinal: T,
    /// Moment about the normal [N m].
    pub aligning: T,
    /// Angle between the tire's velocity and its plane, if the tire has a side force [rad].
    pub slip_angle: T,
    /// Point of the tire nearest to the road, in global axes [m].
    pub contact: [T; 3],
}

/// Largest number of unit wrenches of a law on a body [-]: a tire has five.
pub const MAX_ACTIONS: usize = 5;

/// Law on one body. The enum [`BodyLaw`] contains all built-in ones.
pub trait WrenchesLaw<T: Real>: Entry<T> + Copy {
    /// Writes the actions for a motion into `out`, which is [`n_actions`](Self::n_actions) long.
    fn evaluate(
        &self,
        motion: &BodyMotion<T>,
        law_inputs: &LawInputs<'_, T>,
        out: &mut [UnitWrench<T>],
    );

    /// Upper bound of the operations of [`evaluate`](Self::evaluate), for the branch with the highest cost.
    fn operations(&self, law_inputs: &LawInputs<'_, T>) -> Operations;

    /// Number of actions of the law.
    fn n_actions(&self) -> usize {
        1
    }

    /// True if the law uses the body's direction and spin, or gives moments.
    fn needs_rotation(&self) -> bool {
        true
    }

    /// Improves the slope of an action with the iterate `before`. In the first iterate of a step, `before` has no rate.
    #[inline]
    fn look_back(&self, _action: usize, _measure: &mut ScalarForce<T>, _before: &ScalarForce<T>) {}

    /// Slope of an action by its rate, for iterations that do not use the iterate before. It is at least the tangent.
    #[inline]
    fn secant(&self, _action: usize, measure: &ScalarForce<T>) -> T {
        measure.damping
    }

    /// Energy that an action stores [J].
    fn energy(&self, _action: usize, _measure: &ScalarForce<T>) -> T {
        T::ZERO
    }

    /// Power of an action that is not stored as energy [W].
    fn power(&self, _action: usize, measure: &ScalarForce<T>) -> T {
        -measure.tension * measure.rate
    }

    /// Number of gaps of the law; zero for a law that always acts.
    fn n_gaps(&self) -> usize {
        0
    }

    /// True if the damper of the law's contact fades in over [`FADE`](super::bumper::FADE).
    fn has_fade(&self) -> bool {
        false
    }

    /// Returns three pairs: the gap and its rate; position and velocity along the road; height and upward velocity.
    fn watch(&self, _motion: &BodyMotion<T>, _supplies: &LawInputs<'_, T>) -> [[T; 2]; 3] {
        [[T::ZERO; 2]; 3]
    }

    /// Forces of the road on a tire; `None` for other laws.
    fn tire(&self, _motion: &BodyMotion<T>, _inputs: &LawInputs<'_, T>) -> Option<TireForces<T>> {
        None
    }

    /// True if the law can have kinks besides those of its gaps.
    fn may_have_kinks(&self) -> bool {
        false
    }

    /// Passes the kinks of the law to `_take`, in any order.
    fn kinks(&self, _supplies: &LawInputs<'_, T>, _take: &mut dyn FnMut(LawCorner<T>)) {}

    /// Largest distance from its place at which a kink has an effect [m].
    fn reach(&self) -> T {
        T::ZERO
    }

    /// True if every signal and table entry exists to which the law refers by number.
    fn fits(&self, _supplies: &LawInputs<'_, T>, _n_courses: usize) -> bool {
        true
    }
}

/// Type without values, in place of a law that is not compiled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NeverLaw<T>(Infallible, PhantomData<T>);

impl<T> Entry<T> for NeverLaw<T> {
    fn of<R: EntryReader<T>>(from: &mut R) -> Result<Self, R::Error> {
        Err(from.fault())
    }
    fn numbers<W: EntryWriter<T>>(&self, _: &mut W) -> bool {
        match self.0 {}
    }
}

#[cfg(not(feature = "alloc"))]
impl<T: Real> super::scalar::TensionLaw<T> for NeverLaw<T> {
    fn evaluate(&self, _: T, _: T, _: &LawInputs<'_, T>) -> ScalarForce<T> {
        match self.0 {}
    }
    fn operations(&self) -> Operations {
        match self.0 {}
    }
}

impl<T: Real> WrenchesLaw<T> for NeverLaw<T> {
    fn evaluate(&self, _: &BodyMotion<T>, _: &LawInputs<'_, T>, _: &mut [UnitWrench<T>]) {
        match self.0 {}
    }
    fn operations(&self, _: &LawInputs<'_, T>) -> Operations {
        match self.0 {}
    }
}
