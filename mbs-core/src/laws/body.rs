//! Laws that act on one body at a point and ask for its place, velocity and spin: each gives one or more actions, unit wrenches
//! with a tension.
//!
//! ```text
//! action   force -f d at the point, moment -f m;   rate d.v + m.w
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

/// Motion of a body that a law sees, global axes. In the plane z components of places are zero, and spin is about z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMotion<T> {
    /// The law's point [m].
    pub position: [T; 3],
    /// Velocity of the law's point [m/s].
    pub velocity: [T; 3],
    /// The law's direction as it has turned with the body.
    pub axis: [T; 3],
    /// Angular velocity of the body [rad/s].
    pub spin: [T; 3],
}

/// A unit wrench on a body with its tension.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct UnitWrench<T> {
    /// d, at the law's point [-].
    pub force: [T; 3],
    /// m, about the law's point [m, or - for a pure moment].
    pub moment: [T; 3],
    /// Tension of the wrench with its tangents; `rate` is d.v + m.w less `drift`.
    pub measure: ScalarForce<T>,
}

/// Writes an action to its place, where there is one.
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
    /// Angle between motion and plane where there is a side force [rad].
    pub slip_angle: T,
    /// The point of the tire that is nearest to the road [m], global axes.
    pub contact: [T; 3],
}

/// Most unit wrenches of a law on a body [-]: a tire has five.
pub const MAX_ACTIONS: usize = 5;

/// A law on one body. [`BodyLaw`] is one of all that there are.
pub trait WrenchesLaw<T: Real>: Entry<T> + Copy {
    /// Writes the actions at a motion into `out`, [`n_actions`](Self::n_actions) long.
    fn evaluate(
        &self,
        motion: &BodyMotion<T>,
        law_inputs: &LawInputs<'_, T>,
        out: &mut [UnitWrench<T>],
    );

    /// A bound of the operations of [`evaluate`](Self::evaluate): of the branch that costs most.
    fn operations(&self, law_inputs: &LawInputs<'_, T>) -> Operations;

    /// Number of actions of the law.
    fn n_actions(&self) -> usize {
        1
    }

    /// Does the law ask for the body's direction and spin, or give moments?
    fn needs_rotation(&self) -> bool {
        true
    }

    /// The slope of an action by the iterate `before`; the first one of a step has no rate.
    #[inline]
    fn look_back(&self, _action: usize, _measure: &mut ScalarForce<T>, _before: &ScalarForce<T>) {}

    /// The slope of an action by its rate for an iteration that does not look back; not below the tangent.
    #[inline]
    fn secant(&self, _action: usize, measure: &ScalarForce<T>) -> T {
        measure.damping
    }

    /// Stored energy of an action [J].
    fn energy(&self, _action: usize, _measure: &ScalarForce<T>) -> T {
        T::ZERO
    }

    /// Power of an action that is not stored [W].
    fn power(&self, _action: usize, measure: &ScalarForce<T>) -> T {
        -measure.tension * measure.rate
    }

    /// Number of gaps of the law; none where it acts always.
    fn n_gaps(&self) -> usize {
        0
    }

    /// Does the damper of its contact fade in over [`FADE`](super::bumper::FADE)?
    fn has_fade(&self) -> bool {
        false
    }

    /// Gap of the law with its rate, then its place over the road and its speed, each along and up.
    fn watch(&self, _motion: &BodyMotion<T>, _supplies: &LawInputs<'_, T>) -> [[T; 2]; 3] {
        [[T::ZERO; 2]; 3]
    }

    /// Forces of the road on a tire; `None` of other laws.
    fn tire(&self, _motion: &BodyMotion<T>, _inputs: &LawInputs<'_, T>) -> Option<TireForces<T>> {
        None
    }

    /// Can it have kinks besides those of its gaps?
    fn may_have_kinks(&self) -> bool {
        false
    }

    /// Hands out its kinks, in no order.
    fn kinks(&self, _supplies: &LawInputs<'_, T>, _take: &mut dyn FnMut(LawCorner<T>)) {}

    /// Largest distance from its place at which a kink may be passed [m].
    fn reach(&self) -> T {
        T::ZERO
    }

    /// Is all that it refers to by number there?
    fn fits(&self, _supplies: &LawInputs<'_, T>, _n_courses: usize) -> bool {
        true
    }
}

/// A law that there is none of.
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
