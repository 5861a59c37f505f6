//! Laws that act on one body at a point and ask for its place, velocity and spin: each gives one or more actions, unit wrenches
//! with a tension.
//!
//! ```text
//! action   force -f d at the point, moment -f m;   rate d.v + m.w
//! ```

use super::Supplies;
use super::scalar::Measure;
use crate::Real;
use core::convert::Infallible;
use core::marker::PhantomData;

/// What a law sees of its body, global axes. In the plane z components of places are zero, and spin is about z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyMotion<T> {
    /// The law's point [m].
    pub position: [T; 3],
    /// Its velocity [m/s].
    pub velocity: [T; 3],
    /// The law's direction as it has turned with the body.
    pub axis: [T; 3],
    /// Angular velocity [rad/s].
    pub spin: [T; 3],
}

/// A unit wrench on a body with its tension.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Action<T> {
    /// d, at the law's point [-].
    pub force: [T; 3],
    /// m, about the law's point [m, or - for a pure moment].
    pub moment: [T; 3],
    /// Its tension and tangents; `rate` is d.v + m.w less `drift`.
    pub measure: Measure<T>,
}

/// A law on one body. Where no feature brings one there is no value of this type, and the compiler drops what would act on one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BodyLaw<T> {
    /// Nothing: cannot be made.
    #[doc(hidden)]
    Never(Infallible, PhantomData<T>),
    /// Drag of still air: C_d A [m^2] and density [kg/m^3].
    #[cfg(feature = "drag")]
    Drag {
        /// C_d A [m^2].
        area_coefficient: T,
        /// [kg/m^3].
        density: T,
    },
    /// A drive along the law's direction.
    #[cfg(feature = "speed-hold")]
    SpeedHold(super::speed_hold::SpeedHold<T>),
    /// A wheel about the law's direction.
    #[cfg(feature = "tire")]
    Tire(super::tire::Tire<T>),
    /// A user's own law.
    #[cfg(feature = "own-laws")]
    Own {
        /// The law.
        law: super::own::UserBodyLaw<T>,
        /// Number of the course that is its input.
        course: u32,
    },
}

/// Writes an action to its place, where there is one.
#[inline(always)]
#[cfg(any(feature = "drag", feature = "speed-hold", feature = "tire", feature = "own-laws"))]
pub(super) fn put<T>(out: &mut [Action<T>], place: usize, action: Action<T>) {
    if let Some(to) = out.get_mut(place) {
        *to = action;
    }
}

/// Largest number of actions of a law on a body: a tire has four.
pub const MAX_ACTIONS: usize = 4;

#[cfg_attr(
    not(feature = "effects"),
    allow(unused_variables, reason = "not every law asks for everything")
)]
impl<T: Real> BodyLaw<T> {
    /// Number of actions.
    pub fn n_actions(&self) -> usize {
        match self {
            Self::Never(never, _) => match *never {},
            #[cfg(feature = "tire")]
            Self::Tire(tire) => tire.n_actions(),
            #[cfg(any(feature = "drag", feature = "speed-hold", feature = "own-laws"))]
            _ => 1,
        }
    }

    /// Does the law ask for the body's direction and spin, or give moments?
    pub fn needs_rotation(&self) -> bool {
        match self {
            Self::Never(never, _) => match *never {},
            #[cfg(feature = "drag")]
            Self::Drag { .. } => false,
            #[cfg(feature = "tire")]
            Self::Tire(tire) => tire.leans || tire.n_actions() > 1,
            #[cfg(any(feature = "speed-hold", feature = "own-laws"))]
            _ => true,
        }
    }

    /// Writes the actions at a motion into `out`, [`n_actions`](Self::n_actions) long.
    pub fn evaluate(
        &self,
        motion: &BodyMotion<T>,
        supplies: &Supplies<'_, T>,
        out: &mut [Action<T>],
    ) {
        match self {
            Self::Never(never, _) => match *never {},
            #[cfg(feature = "drag")]
            Self::Drag { area_coefficient, density } => {
                put(out, 0, super::drag::action(*area_coefficient, *density, motion));
            }
            #[cfg(feature = "speed-hold")]
            Self::SpeedHold(hold) => put(out, 0, hold.action(motion)),
            #[cfg(feature = "tire")]
            Self::Tire(tire) => tire.evaluate(motion, supplies, out),
            #[cfg(feature = "own-laws")]
            Self::Own { law, course } => {
                put(out, 0, law.action(motion, supplies.course(*course)));
            }
        }
    }

    /// The slope of an action by the iterate `before`; the first one of a step has no rate.
    #[inline]
    pub fn look_back(&self, action: usize, measure: &mut Measure<T>, before: &Measure<T>) {
        match self {
            #[cfg(feature = "tire")]
            Self::Tire(_) if before.rate != T::ZERO => {
                super::tire::look_back(action, measure, before);
            }
            _ => {}
        }
    }

    /// Stored energy of an action [J].
    pub fn energy(&self, action: usize, measure: &Measure<T>) -> T {
        match self {
            #[cfg(feature = "tire")]
            Self::Tire(tire) => tire.energy(action, measure),
            _ => T::ZERO,
        }
    }

    /// Power of an action that is not stored [W].
    pub fn power(&self, action: usize, measure: &Measure<T>) -> T {
        match self {
            #[cfg(feature = "tire")]
            Self::Tire(tire) => tire.power(action, measure),
            _ => -measure.tension * measure.rate,
        }
    }
}
