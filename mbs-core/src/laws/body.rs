//! Laws that act on one body at a point and ask for its place, velocity and spin: each gives one or more actions, unit wrenches
//! with a tension.
//!
//! ```text
//! action   force -f d at the point, moment -f m;   rate d.v + m.w
//! ```

use super::own::OwnWrench;
use super::scalar::Measure;
use super::speed_hold::SpeedHold;
use super::tire::Tire;
use super::{Supplies, drag};
use crate::Real;
use crate::algebra::{Vector, norm};

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

/// A law on one body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BodyLaw<T> {
    /// Drag of still air: C_d A [m^2] and density [kg/m^3].
    Drag {
        /// C_d A [m^2].
        area_coefficient: T,
        /// [kg/m^3].
        density: T,
    },
    /// A drive along the law's direction.
    SpeedHold(SpeedHold<T>),
    /// A wheel about the law's direction.
    Tire(Tire<T>),
    /// A user's own law.
    Own {
        /// The law.
        law: OwnWrench<T>,
        /// Number of the course that is its input.
        course: u32,
    },
}

/// Actions that one law has at most.
pub const MOST: usize = 4;

impl<T: Real> BodyLaw<T> {
    /// Number of actions.
    pub fn n_actions(&self) -> usize {
        match self {
            Self::Drag { .. } | Self::SpeedHold(_) | Self::Own { .. } => 1,
            Self::Tire(tire) => tire.n_actions(),
        }
    }

    /// Does the law ask for the body's direction and spin, or give moments?
    pub fn needs_rotation(&self) -> bool {
        match self {
            Self::Drag { .. } => false,
            Self::SpeedHold(_) | Self::Own { .. } => true,
            Self::Tire(tire) => tire.n_actions() > 1,
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
            Self::Drag { area_coefficient, density } => {
                let velocity = Vector::<T, 3>::from(motion.velocity);
                let speed = norm(&velocity);
                // Without speed there is no drag and no direction.
                let direction =
                    if speed > T::ZERO { velocity * (T::ONE / speed) } else { Vector::zeros() };
                let (tension, damping) = drag::drag(*area_coefficient, *density, speed);
                let measure = Measure { rate: speed, tension, damping, ..Measure::default() };
                out[0] = Action { force: direction.into(), moment: [T::ZERO; 3], measure };
            }
            Self::SpeedHold(hold) => {
                let axis = Vector::<T, 3>::from(motion.axis);
                let rate = axis.dot(&Vector::from(motion.velocity));
                let (force, damping) = hold.force(rate);
                let measure = Measure { rate, tension: -force, damping, ..Measure::default() };
                out[0] = Action { force: motion.axis, moment: [T::ZERO; 3], measure };
            }
            Self::Tire(tire) => tire.evaluate(motion, supplies, out),
            Self::Own { law, course } => {
                let mut action = (law.evaluate)(motion, supplies.courses[*course as usize]);
                let [force, moment] = [action.force, action.moment].map(Vector::<T, 3>::from);
                action.measure.rate = force.dot(&Vector::from(motion.velocity))
                    + moment.dot(&Vector::from(motion.spin));
                out[0] = action;
            }
        }
    }

    /// Stored energy of an action [J].
    pub fn energy(&self, action: usize, measure: &Measure<T>) -> T {
        match self {
            Self::Tire(tire) => tire.energy(action, measure),
            _ => T::ZERO,
        }
    }

    /// Power of an action that is not stored [W].
    pub fn power(&self, action: usize, measure: &Measure<T>) -> T {
        match self {
            Self::Tire(tire) => tire.power(action, measure),
            _ => -measure.tension * measure.rate,
        }
    }
}
