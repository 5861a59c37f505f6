//! The kinds of effect, a file each: data and keys, checks, where it acts, and its law with tangent, numbers and bound.
//!
//! The list below is all that the rest of the workspace knows of them. A line has a kind, its module, and its Cargo feature
//! (`all()`: every build has it). It has the laws of the file with their numbers in tables of controllers: `tension` for one
//! along a length or about an angle, `body` for one on a body. A law without its feature is in no build; an effect
//! without it is refused by name when a model is built.

#[cfg(feature = "alloc")]
mod data;
#[cfg(feature = "alloc")]
mod example;
#[cfg(feature = "alloc")]
mod field;
#[cfg(feature = "alloc")]
mod kind;
mod table;

#[cfg(feature = "alloc")]
pub use example::Places;
#[cfg(feature = "alloc")]
pub(crate) use field::EffectData;
#[cfg(feature = "alloc")]
pub use field::{Default, Field, Form, JointNeed, Sign, SignalForm, Value};
#[cfg(feature = "alloc")]
pub(crate) use kind::EffectModel;
#[cfg(feature = "alloc")]
pub use kind::Row;

use crate::Real;
#[cfg(feature = "alloc")]
use crate::actions::Compiler;
use crate::laws::Supplies;
use crate::laws::body::{Action, BodyMotion, NeverLaw, WrenchesLaw};
use crate::laws::entry::{Entry, EntryReader, EntryWriter};
use crate::laws::kink::Kink;
use crate::laws::operations::Operations;
use crate::laws::scalar::{Measure, TensionLaw};
#[cfg(feature = "alloc")]
use crate::scene::check::Place;
#[cfg(feature = "alloc")]
use crate::scene::{Scene, SceneError};
#[cfg(feature = "alloc")]
use alloc::vec::Vec;

table::effects! {
    SpringDamper in spring_damper (all()) tension SpringDamper(SpringDamperLaw<T>) = 0;
    JointTorque in joint_torque (all()) tension Torque(TorqueLaw) = 1;
    BodyTorque in body_torque (all());
    Force in force (all());
    TorsionSpring in torsion_spring (all());
    Bumper in bumper (feature = "bumper") tension Bumper(BumperLaw<T>) = 3;
    Polynomial in polynomial (feature = "polynomial") tension Polynomial(PolynomialLaw) = 2;
    Actuator in actuator (all());
    Limit in limit (feature = "limit") tension Limit(LimitLaw<T>) = 4;
    Friction in friction (feature = "friction") tension Friction(FrictionLaw<T>) = 5;
    Bushing in bushing (feature = "bushing");
    AeroDrag in drag (feature = "drag") body Drag(DragLaw<T>) = 0;
    SpeedHold in speed_hold (feature = "speed-hold") body SpeedHold(SpeedHoldLaw<T>) = 1;
    Tire in tire (feature = "tire") body Tire(TireLaw<T>) = 2;
    Own in own (feature = "own-laws") tension Own(OwnLaw<T>) = 6 body Own(OwnBodyLaw<T>) = 3;
    LawOnLine in law_on_line (feature = "own-laws") tension Code(CodeLaw<T>) = 7;
    LawOnJoint in law_on_joint (feature = "own-laws");
    LawOnBody in law_on_body (feature = "own-laws") body Code(CodeBodyLaw<T>) = 4;
}
