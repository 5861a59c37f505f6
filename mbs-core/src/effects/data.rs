//! Names that the files of effects use to describe their data.

pub(super) use super::action::{Action, Compiler};
pub(super) use super::answers::{EffectPicture, LineLook, RoadWheel, RotorInertia, UnitHint};
pub(super) use super::field::Default::{
    As, Needed, NeededWith, NeededWithout, Nothing, Number, Open, OpenWith, Times,
};
pub(super) use super::field::JointNeed::{Coordinate, Rotation};
pub(super) use super::field::Sign::{Any, NotNegative, Positive};
pub(super) use super::field::SignalForm::{Moment, Scalar, Three, Vector};
pub(super) use super::field::effect;
pub(super) use super::kind::EffectModel;
pub(super) use crate::Real;
pub(super) use crate::scene::place::Place;
pub(super) use crate::scene::{
    BodyId, CouplingTerm, Joint, JointId, SceneError, SceneFault, Signal, Surroundings,
};
pub(super) use alloc::vec::Vec;

/// Default of numbers that are zero if the key is left out.
pub(super) const ZERO: super::Default = Number("0");
