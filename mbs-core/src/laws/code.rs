//! User-defined laws with data: objects behind traits. They compute in doubles in every precision of a run.
//!
//! ```text
//! along a line, about or along a joint   (t, m, m', u) -> f, df/dm, df/dm', V
//! on a body                              (t, place, velocity, direction, angular velocity, u) -> force, moment
//! ```
//!
//! [Relations](Relation) of couplings are objects too. The input u has three numbers, which are set between steps. On targets
//! without allocation or without atomic pointers, laws are functions: [`user`](super::user).

use super::relation::Relation;
use alloc::vec::Vec;
use core::fmt::{self, Debug, Formatter};
use core::ops::Deref;
use core::sync::atomic::{AtomicU32, Ordering};

/// Measured numbers that a [`ForceLaw`] gets.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Measured {
    /// Time [s].
    pub time: f64,
    /// Length of the line, or coordinate of the joint relative to the reference configuration [m, rad].
    pub value: f64,
    /// Rate of the value [m/s, rad/s].
    pub rate: f64,
    /// Input of the effect, zero until it is set between steps.
    pub input: [f64; 3],
}

/// Result of a [`ForceLaw`]: force, its derivatives, and energy. In steps the derivatives only control the iterations. With
/// derivatives left at zero, stiff laws need more iterations or smaller steps. The search for an equilibrium takes them as exact.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Force {
    /// Force or torque [N, N m]. Positive values pull the ends together, or drive a joint's second body backwards.
    pub force: f64,
    /// Derivative of the force by the value [N/m, N m/rad].
    pub stiffness: f64,
    /// Derivative of the force by the rate [N s/m, N m s/rad].
    pub damping: f64,
    /// Energy that the law stores [J], evaluated at rate zero. The rest of the force's work counts as work of the law. With zero
    /// energy all of it does.
    pub energy: f64,
}

/// Force law with data, along the line of two points or on the coordinate of a joint.
///
/// The law computes in doubles: in a run of 32 digits it has 16. An infinite or NaN result ends the step with
/// [`StepError::Law`](crate::step::StepError::Law). For the energy the law is also evaluated at rate zero, a little beside the
/// value and the time. Its results must be finite there too.
///
/// # Examples
/// ```
/// use mbs_core::laws::code::{Force, ForceLaw, Measured};
/// /// A bag of gas between two plates: p V^n stays.
/// #[derive(Debug)]
/// struct AirSpring { area: f64, pressure: f64, length: f64, exponent: f64 }
///
/// impl ForceLaw for AirSpring {
///     fn evaluate(&self, at: &Measured) -> Force {
///         let ratio = (self.length / at.value).powf(self.exponent);
///         let push = self.pressure * self.area * ratio;
///         let energy = push * at.value / (self.exponent - 1.0);
///         Force { force: -push, stiffness: self.exponent * push / at.value, energy, ..Force::default() }
///     }
/// }
/// let spring = AirSpring { area: 0.01, pressure: 6e5, length: 0.2, exponent: 1.3 };
/// let mut at = Measured::default();
/// at.value = 0.2;
/// assert_eq!(spring.evaluate(&at).force, -6000.0);
/// ```
pub trait ForceLaw: Send + Sync + Debug {
    /// Returns force, tangents and energy. They must depend on `at` only: calls come at trial states, in any order and from several
    /// threads.
    fn evaluate(&self, at: &Measured) -> Force;
}

/// Motion of a body that a [`BodyLaw`] gets, in global axes. In the plane the third components of places are zero, and the angular
/// velocity is about z.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct MeasuredBody {
    /// Time [s].
    pub time: f64,
    /// Point of the body at which the law acts [m].
    pub position: [f64; 3],
    /// Velocity of the law's point [m/s].
    pub velocity: [f64; 3],
    /// Direction of the law, which rotates with the body; a unit vector.
    pub axis: [f64; 3],
    /// Angular velocity of the body [rad/s].
    pub angular_velocity: [f64; 3],
    /// Input of the effect, zero until it is set between steps.
    pub input: [f64; 3],
}

/// Force and moment on a body, in global axes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wrench {
    /// Force on the body [N].
    pub force: [f64; 3],
    /// Moment on the body [N m].
    pub moment: [f64; 3],
}

/// Law with data on one body. Everything it does counts as work: nothing is stored.
///
/// The law computes in doubles. An infinite or NaN result ends the step with [`StepError::Law`](crate::step::StepError::Law). The
/// law has no tangent, so that stiff laws need small steps.
///
/// # Examples
/// ```
/// use mbs_core::laws::code::{BodyLaw, MeasuredBody, Wrench};
/// /// A thruster along the law's direction, as strong as its input says.
/// #[derive(Debug)]
/// struct Thruster { most: f64 }
///
/// impl BodyLaw for Thruster {
///     fn evaluate(&self, at: &MeasuredBody) -> Wrench {
///         let thrust = at.input[0].clamp(0.0, self.most);
///         Wrench { force: at.axis.map(|x| thrust * x), ..Wrench::default() }
///     }
/// }
/// let mut at = MeasuredBody::default();
/// (at.axis, at.input) = ([0.0, 1.0, 0.0], [30.0, 0.0, 0.0]);
/// assert_eq!(Thruster { most: 20.0 }.evaluate(&at).force, [0.0, 20.0, 0.0]);
/// ```
pub trait BodyLaw: Send + Sync + Debug {
    /// Returns force and moment on the body at the law's point. They must depend on `at` only: calls come at trial states, in any
    /// order and from several threads.
    fn evaluate(&self, at: &MeasuredBody) -> Wrench;
}

/// Pointer by which the copies of a law share it.
#[cfg(target_has_atomic = "ptr")]
type Shared<L> = alloc::sync::Arc<L>;
/// Reference by which the copies of a law share it. Targets without atomic pointers cannot count copies, so that the law is never
/// freed.
#[cfg(not(target_has_atomic = "ptr"))]
type Shared<L> = &'static L;

/// Law that copies share. Two laws are equal if they are the same object.
pub struct Code<L: ?Sized + 'static>(Shared<L>);

/// Implements the conversion of a law to a [`Code`].
macro_rules! code {
    ($Law:ident) => {
        impl<L: $Law + 'static> From<L> for Code<dyn $Law> {
            fn from(law: L) -> Self {
                #[cfg(target_has_atomic = "ptr")]
                return Self(alloc::sync::Arc::new(law));
                #[cfg(not(target_has_atomic = "ptr"))]
                Self(alloc::boxed::Box::leak(alloc::boxed::Box::new(law)))
            }
        }
    };
}
code!(ForceLaw);
code!(BodyLaw);
code!(Relation);

impl<L: ?Sized> Clone for Code<L> {
    fn clone(&self) -> Self {
        Self(Clone::clone(&self.0))
    }
}

impl<L: ?Sized> PartialEq for Code<L> {
    fn eq(&self, other: &Self) -> bool {
        core::ptr::addr_eq(&raw const *self.0, &raw const *other.0)
    }
}

impl<L: ?Sized + Debug> Debug for Code<L> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<L: ?Sized> Deref for Code<L> {
    type Target = L;

    fn deref(&self) -> &L {
        &self.0
    }
}

/// User-defined laws of a model, by number, each with its effect or coupling. The list also records which law failed.
#[derive(Debug)]
pub struct Codes {
    forces: Vec<(u32, Code<dyn ForceLaw>)>,
    bodies: Vec<(u32, Code<dyn BodyLaw>)>,
    relations: Vec<(u32, Code<dyn Relation>)>,
    /// First effect whose law returned an infinite or NaN number, else the first such coupling plus [`COUPLINGS`]; [`NONE`] without
    /// failure.
    failed: AtomicU32,
}

/// Effect or coupling that a user-defined law belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CodeOwner {
    /// Effect by its number in the scene.
    Effect(u32),
    /// Coupling by its number in the scene.
    Coupling(u32),
}

/// Value of `failed` if no law has failed.
const NONE: u32 = u32::MAX;
/// First number of a failed coupling. Smaller numbers are effects, and no scene has this many effects.
const COUPLINGS: u32 = 1 << 31;

impl Default for Codes {
    fn default() -> Self {
        let (forces, bodies, relations) = (Vec::new(), Vec::new(), Vec::new());
        Self { forces, bodies, relations, failed: AtomicU32::new(NONE) }
    }
}

impl Clone for Codes {
    fn clone(&self) -> Self {
        let (forces, bodies) = (self.forces.clone(), self.bodies.clone());
        Self { forces, bodies, relations: self.relations.clone(), ..Self::default() }
    }
}

impl PartialEq for Codes {
    fn eq(&self, other: &Self) -> bool {
        (&self.forces, &self.bodies, &self.relations)
            == (&other.forces, &other.bodies, &other.relations)
    }
}

impl Codes {
    /// Adds the force law of an effect.
    pub(crate) fn add_force(&mut self, effect: u32, law: &Code<dyn ForceLaw>) -> u32 {
        self.forces.push((effect, law.clone()));
        number(self.forces.len() - 1)
    }

    /// Adds the law of an effect on a body.
    pub(crate) fn add_body(&mut self, effect: u32, law: &Code<dyn BodyLaw>) -> u32 {
        self.bodies.push((effect, law.clone()));
        number(self.bodies.len() - 1)
    }

    /// Adds the relation of a coupling.
    pub(crate) fn add_relation(&mut self, coupling: u32, relation: &Code<dyn Relation>) {
        self.relations.push((coupling, relation.clone()));
    }

    /// Clears the noted failure, so that only later failures are reported.
    pub fn forget(&self) {
        if self.failed.load(Ordering::Relaxed) != NONE {
            self.failed.store(NONE, Ordering::Relaxed);
        }
    }

    /// First effect in the scene whose law returned an infinite or NaN number since the last call of [`forget`](Self::forget). If
    /// there is no such effect, the first such coupling.
    #[must_use]
    pub fn failed(&self) -> Option<CodeOwner> {
        match self.failed.load(Ordering::Relaxed) {
            NONE => None,
            effect if effect < COUPLINGS => Some(CodeOwner::Effect(effect)),
            coupling => Some(CodeOwner::Coupling(coupling - COUPLINGS)),
        }
    }

    /// Relation by its number, in the order of the couplings that have a relation.
    #[must_use]
    pub const fn relation(&self, number: u32) -> NumberedRelation<'_> {
        NumberedRelation { codes: self, number }
    }

    /// Evaluates a law of a line or a joint. Returns NaN if the law fails.
    pub(crate) fn force(&self, number: u32, at: &Measured) -> Force {
        let (effect, force) = match self.forces.get(number as usize) {
            Some((effect, law)) => (*effect, law.evaluate(at)),
            None => return FAILED,
        };
        let Force { force: f, stiffness, damping, energy } = force;
        if [f, stiffness, damping, energy].iter().all(|x| x.is_finite()) {
            return force;
        }
        self.fail(effect);
        FAILED
    }

    /// Evaluates a law on a body. Returns `None` if the law fails.
    pub(crate) fn wrench(&self, number: u32, at: &MeasuredBody) -> Option<Wrench> {
        let (effect, law) = self.bodies.get(number as usize)?;
        let wrench = law.evaluate(at);
        if wrench.force.iter().chain(&wrench.moment).all(|x| x.is_finite()) {
            return Some(wrench);
        }
        self.fail(*effect);
        None
    }

    #[cold]
    fn fail(&self, effect: u32) {
        // All threads of a step report the same effect, whichever thread is first.
        #[cfg(target_has_atomic = "32")]
        self.failed.fetch_min(effect, Ordering::Relaxed);
        #[cfg(not(target_has_atomic = "32"))]
        self.failed.store(effect.min(self.failed.load(Ordering::Relaxed)), Ordering::Relaxed);
    }
}

/// Relation of [`Codes`] by number. A failure is noted, and the result is then NaN.
#[derive(Debug, Clone, Copy)]
pub struct NumberedRelation<'a> {
    codes: &'a Codes,
    number: u32,
}

impl NumberedRelation<'_> {
    #[cold]
    fn fail(&self) -> f64 {
        if let Some((coupling, _)) = self.codes.relations.get(self.number as usize) {
            self.codes.fail(COUPLINGS | *coupling);
        }
        f64::NAN
    }
}

impl Relation for NumberedRelation<'_> {
    fn evaluate(&self, at: &[f64], gradient: &mut [f64]) -> f64 {
        if let Some((_, relation)) = self.codes.relations.get(self.number as usize) {
            let value = relation.evaluate(at, gradient);
            if value.is_finite() && gradient.iter().all(|x| x.is_finite()) {
                return value;
            }
        }
        gradient.fill(f64::NAN);
        self.fail()
    }

    fn curvature(&self, at: &[f64], rates: &[f64]) -> f64 {
        let relation = self.codes.relations.get(self.number as usize);
        let along = relation.map(|(_, relation)| relation.curvature(at, rates));
        along.filter(|along| along.is_finite()).unwrap_or_else(|| self.fail())
    }
}

/// Result of a law that failed. Every number computed with it is NaN.
const FAILED: Force =
    Force { force: f64::NAN, stiffness: f64::NAN, damping: 0.0, energy: f64::NAN };

fn number(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}
