//! Laws of a user's own: a plain function behind a small trait, so that nothing is looked up or allocated in a step.
//!
//! ```text
//! along a length, about an angle   (m, m', u) -> f, df/dm, df/dm'
//! on a body                        (motion, u) -> unit wrenches with tensions
//! ```
//!
//! u are the three numbers of the effect's course: constant, a table, or set between steps. The output of a
//! controller, a driver or a machine is set so.

use super::body::{BodyMotion, UnitWrench};
use super::scalar::ScalarForce;

/// A law along a length or about an angle.
pub trait ScalarLaw<T> {
    /// Tension with those derivatives by value and rate that stiffen. Derivatives that are left at zero only cost iterations.
    fn evaluate(value: T, rate: T, input: [T; 3]) -> ScalarForce<T>;

    /// Energy that the law stores [J]; what is not stored counts as power given or taken.
    fn energy(value: T, input: [T; 3]) -> T;

    /// The elastic part of the tension, dV/dm.
    fn elastic(value: T, input: [T; 3]) -> T;
}

/// A law on one body.
pub trait WrenchLaw<T> {
    /// The unit wrench and its tension at a motion; `rate` of its measure is filled in by the caller. No energy is stored.
    fn evaluate(motion: &BodyMotion<T>, input: [T; 3]) -> UnitWrench<T>;
}

/// A [`ScalarLaw`] as a value.
#[derive(Clone, Copy)]
pub struct UserScalarLaw<T> {
    pub(crate) evaluate: fn(T, T, [T; 3]) -> ScalarForce<T>,
    pub(crate) energy: fn(T, [T; 3]) -> T,
    pub(crate) elastic: fn(T, [T; 3]) -> T,
}

impl<T> UserScalarLaw<T> {
    /// Returns the law `L` as a value.
    #[must_use]
    pub fn of<L: ScalarLaw<T>>() -> Self {
        Self { evaluate: L::evaluate, energy: L::energy, elastic: L::elastic }
    }
}

impl<T> PartialEq for UserScalarLaw<T> {
    fn eq(&self, other: &Self) -> bool {
        core::ptr::fn_addr_eq(self.evaluate, other.evaluate)
            && core::ptr::fn_addr_eq(self.energy, other.energy)
            && core::ptr::fn_addr_eq(self.elastic, other.elastic)
    }
}

impl<T> core::fmt::Debug for UserScalarLaw<T> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("UserScalarLaw")
    }
}

/// A [`WrenchLaw`] as a value.
#[derive(Clone, Copy)]
pub struct UserBodyLaw<T> {
    pub(crate) evaluate: fn(&BodyMotion<T>, [T; 3]) -> UnitWrench<T>,
}

impl<T> UserBodyLaw<T> {
    /// Returns the law `L` as a value.
    #[must_use]
    pub fn of<L: WrenchLaw<T>>() -> Self {
        Self { evaluate: L::evaluate }
    }
}

impl<T> PartialEq for UserBodyLaw<T> {
    fn eq(&self, other: &Self) -> bool {
        core::ptr::fn_addr_eq(self.evaluate, other.evaluate)
    }
}

impl<T> core::fmt::Debug for UserBodyLaw<T> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("UserBodyLaw")
    }
}
