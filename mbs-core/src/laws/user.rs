//! User-defined laws as plain functions behind a small trait. A step looks up and allocates nothing for them.
//!
//! ```text
//! along a length, about an angle   (m, m', u) -> f, df/dm, df/dm'
//! on a body                        (motion, u) -> unit wrenches with tensions
//! ```
//!
//! The input u has the three numbers of the effect's signal: a constant, a table, or an input. An input is set between steps, such
//! as the output of a controller, a driver or a machine.

use super::body::{BodyMotion, UnitWrench};
use super::scalar::ScalarForce;

/// User-defined law along a length or about an angle.
pub trait ScalarLaw<T> {
    /// Returns tension and tangents. Only derivatives that stiffen are needed; derivatives left at zero just cost iterations.
    fn evaluate(value: T, rate: T, input: [T; 3]) -> ScalarForce<T>;

    /// Energy that the law stores [J]. The rest of the force's work counts as power that the law supplies or dissipates.
    fn energy(value: T, input: [T; 3]) -> T;

    /// Elastic part of the tension: dV/dm, the derivative of the energy V by the value m.
    fn elastic(value: T, input: [T; 3]) -> T;
}

/// User-defined law on one body.
pub trait WrenchLaw<T> {
    /// Returns the unit wrench and its tension for a motion. The caller sets the `rate` of its measure. No energy is stored.
    fn evaluate(motion: &BodyMotion<T>, input: [T; 3]) -> UnitWrench<T>;
}

/// Value that contains the functions of a [`ScalarLaw`].
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

/// Value that contains the function of a [`WrenchLaw`].
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
