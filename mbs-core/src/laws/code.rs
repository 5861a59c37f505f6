//! User-defined laws with data: objects behind traits, which see doubles whatever a run computes in.
//!
//! ```text
//! along a line, about or along a joint   (t, m, m', u) -> f, df/dm, df/dm', V
//! on a body                              (t, place, velocity, direction, angular velocity, u) -> force, moment
//! ```
//!
//! [Relations](Relation) of couplings are objects too. u are three numbers that are set between steps. Where no allocation or no pointer that
//! threads share can be had, laws are functions: [`user`](super::user).

use super::relation::Relation;
use alloc::vec::Vec;
use core::fmt::{self, Debug, Formatter};
use core::ops::Deref;
use core::sync::atomic::{AtomicU32, Ordering};

/// Measured numbers that a [`ForceLaw`] sees.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Measured {
    /// Time [s].
    pub time: f64,
    /// Length of the line, or the joint's coordinate from the reference configuration [m, rad].
    pub value: f64,
    /// Rate of the value [m/s, rad/s].
    pub rate: f64,
    /// The input of the effect: zero until it is set.
    pub input: [f64; 3],
}

/// Force that a [`ForceLaw`] gives, with derivatives and energy. Derivatives are those of `force`. In steps they steer iterations alone: where
/// they are left at zero, stiff laws need more iterations or smaller steps. The search for an equilibrium takes them for the law's own.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Force {
    /// Pulls the ends together, or turns or moves a joint's second body backwards, when positive [N, N m].
    pub force: f64,
    /// d force / d value [N/m, N m/rad].
    pub stiffness: f64,
    /// d force / d rate [N s/m, N m s/rad].
    pub damping: f64,
    /// Energy that the law stores [J]. It is read at no rate; what it does not hold is work of the law, all of it where this is zero.
    pub energy: f64,
}

/// A force law with data of its own, along the line of two points or on the coordinate of a joint.
///
/// It sees and gives doubles: in a run of 32 digits 16 of them are the law's. A number that is infinite or NaN ends the step with
/// [`StepError::Law`](crate::step::StepError::Law). For its energy it is also asked at no rate, a little beside the value and the time: its
/// numbers are finite there too.
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
    /// Force, tangents and energy: a function of `at` alone, for it is called at trial states, in any order and from several threads.
    fn evaluate(&self, at: &Measured) -> Force;
}

/// Motion of a body that a [`BodyLaw`] sees, global axes. In the plane third components of places are zero, and angular velocity is about z.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct MeasuredBody {
    /// Time [s].
    pub time: f64,
    /// The law's point on the body [m].
    pub position: [f64; 3],
    /// Velocity of the law's point [m/s].
    pub velocity: [f64; 3],
    /// The law's direction as it has turned with the body, of length one.
    pub axis: [f64; 3],
    /// Angular velocity of the body [rad/s].
    pub angular_velocity: [f64; 3],
    /// The input of the effect: zero until it is set.
    pub input: [f64; 3],
}

/// A force and a moment, global axes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wrench {
    /// Force on the body [N].
    pub force: [f64; 3],
    /// Moment on the body [N m].
    pub moment: [f64; 3],
}

/// A law with data of its own that acts on one body. All that it does is work: nothing is stored.
///
/// It sees and gives doubles. A number that is infinite or NaN ends the step with
/// [`StepError::Law`](crate::step::StepError::Law). It has no tangent: where it is stiff, take small steps.
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
    /// Force and moment on the body at the law's point: a function of `at` alone. It is called at trial states, in any order and from several
    /// threads.
    fn evaluate(&self, at: &MeasuredBody) -> Wrench;
}

/// Pointer by which the copies of a law share it.
#[cfg(target_has_atomic = "ptr")]
type Shared<L> = alloc::sync::Arc<L>;
/// Reference by which the copies of a law share it: where nothing can be counted by threads, a law stays for good.
#[cfg(not(target_has_atomic = "ptr"))]
type Shared<L> = &'static L;

/// Law that copies share: two are equal where they are the same one.
pub struct Code<L: ?Sized + 'static>(Shared<L>);

/// Makes a [`Code`] of a law.
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

/// The laws of a model that are objects, by number, with the effects and couplings that they belong to; and which of them failed.
#[derive(Debug)]
pub struct Codes {
    forces: Vec<(u32, Code<dyn ForceLaw>)>,
    bodies: Vec<(u32, Code<dyn BodyLaw>)>,
    relations: Vec<(u32, Code<dyn Relation>)>,
    /// The first effect whose law gave what is not finite, else the first coupling above [`COUPLINGS`]; [`NONE`].
    failed: AtomicU32,
}

/// Effect or coupling that a law in code belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CodeOwner {
    /// The effect in the scene.
    Effect(u32),
    /// The coupling in the scene.
    Coupling(u32),
}

/// No law has failed.
const NONE: u32 = u32::MAX;
/// Couplings are numbered from here on among what has failed: no scene has as many effects.
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

    /// From now on failures are those of what comes.
    pub fn forget(&self) {
        if self.failed.load(Ordering::Relaxed) != NONE {
            self.failed.store(NONE, Ordering::Relaxed);
        }
    }

    /// The first effect in the scene whose law gave what is not finite since failures were [forgotten](Self::forget), else the first
    /// such coupling.
    #[must_use]
    pub fn failed(&self) -> Option<CodeOwner> {
        match self.failed.load(Ordering::Relaxed) {
            NONE => None,
            effect if effect < COUPLINGS => Some(CodeOwner::Effect(effect)),
            coupling => Some(CodeOwner::Coupling(coupling - COUPLINGS)),
        }
    }

    /// The relation of this number, in the order of the scene's couplings that have one.
    #[must_use]
    pub const fn relation(&self, number: u32) -> NumberedRelation<'_> {
        NumberedRelation { codes: self, number }
    }

    /// A law of a line or a joint; NaN where it fails.
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

    /// A law on a body; `None` where it fails.
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
        // Threads that share a step name the same effect, whichever of them comes first.
        #[cfg(target_has_atomic = "32")]
        self.failed.fetch_min(effect, Ordering::Relaxed);
        #[cfg(not(target_has_atomic = "32"))]
        self.failed.store(effect.min(self.failed.load(Ordering::Relaxed)), Ordering::Relaxed);
    }
}

/// A relation of [`Codes`], which notes where it fails and gives NaN there.
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

/// Result of a law that failed: nothing that is computed with it is a number.
const FAILED: Force =
    Force { force: f64::NAN, stiffness: f64::NAN, damping: 0.0, energy: f64::NAN };

fn number(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}
