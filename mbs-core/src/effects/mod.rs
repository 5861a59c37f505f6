//! Kinds of effect, one file each: data and keys, checks, actions, and the law with tangent, numbers and operation bound. The
//! module `list` lists all kinds.

#[cfg(feature = "alloc")]
pub(crate) mod action;
#[cfg(feature = "alloc")]
mod answers;
pub mod apart;
#[cfg(feature = "alloc")]
mod data;
#[cfg(feature = "alloc")]
mod example;
#[cfg(feature = "alloc")]
mod field;
#[cfg(feature = "alloc")]
mod kind;
mod law;
mod list;
#[cfg(feature = "alloc")]
pub(crate) mod reference;
mod table;

#[cfg(feature = "alloc")]
pub use answers::{EffectPicture, LineLook, RoadWheel, RotorInertia, UnitHint};
#[cfg(feature = "alloc")]
pub use example::Places;
#[cfg(feature = "alloc")]
pub(crate) use field::EffectData;
#[cfg(feature = "alloc")]
pub use field::{Default, Field, Form, JointNeed, Sign, SignalForm, Value};
#[cfg(feature = "alloc")]
pub(crate) use kind::EffectModel;
#[cfg(feature = "alloc")]
pub use kind::{ActsOn, Row};
pub use law::{BodyLaw, Law, laws};

#[cfg(feature = "alloc")]
use crate::Real;
#[cfg(feature = "alloc")]
use crate::scene::place::Place;
#[cfg(feature = "alloc")]
use crate::scene::{Joint, SceneError, Signal, Surroundings};
#[cfg(feature = "alloc")]
use action::Compiler;
#[cfg(feature = "alloc")]
use alloc::vec::Vec;

list::list!(kinds);
